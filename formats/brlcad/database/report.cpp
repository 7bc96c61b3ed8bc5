#include "formats/brlcad/database/report.hpp"

namespace graycube {
namespace {

/// A message about many things names so many of them.
constexpr std::size_t kMostNamed = 3;

std::string some_of(const std::set<std::string>& names) {
  std::string list;
  std::size_t count = 0;
  for (const std::string& name : names) {
    if (count++ == kMostNamed) return list + ", …";
    list += (list.empty() ? "" : ", ") + name;
  }
  return list;
}

std::string left_out_text(const BrlcadNamed::Line& line) {
  const std::string why = line.what.empty() ? "" : " (" + line.what + ")";
  return line.count + (line.is_one ? " is" : " are") + " left out" + why + ": " + line.names;
}

}  // namespace

void BrlcadNamed::add(const std::string& things, const std::string& what, const std::string& name,
                      const std::string& detail) {
  const auto group = groups_.find({things, what});
  if (group != groups_.end()) {
    group->second.names.insert(name);
  } else if (groups_.size() < kMaxBrlcadMessages) {
    groups_[{things, what}] = {{name}, detail.empty() ? "" : "; " + name + ": " + detail};
  }
}

std::vector<BrlcadNamed::Line> BrlcadNamed::take() {
  std::vector<Line> lines;
  for (const auto& [key, group] : groups_) {
    const auto& [things, what] = key;
    const std::size_t count = group.names.size();
    const std::string counted =
        std::to_string(count) + " " + (count == 1 ? things.substr(0, things.size() - 1) : things);
    lines.push_back({counted, what + group.detail, some_of(group.names), count == 1});
  }
  groups_.clear();
  return lines;
}

std::string BrlcadReport::take_left_out() {
  const std::vector<BrlcadNamed::Line> lines = left_out_.take();
  return lines.empty() ? "" : left_out_text(lines.front());
}

std::vector<ImportWarning> BrlcadReport::take_warnings() {
  std::vector<ImportWarning> all = warnings_.take();
  for (const BrlcadNamed::Line& line : left_out_.take())
    all.push_back({"", left_out_text(line), true});
  for (const BrlcadNamed::Line& line : air_.take()) all.push_back({"", left_out_text(line), false});
  for (const BrlcadNamed::Line& line : changed_.take())
    all.push_back({"", line.count + ": " + line.what + ": " + line.names, false});
  return all;
}

}  // namespace graycube
