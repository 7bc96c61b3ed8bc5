#include "formats/report/import_warnings.hpp"

#include <utility>

namespace graycube {

void ImportWarnings::add(const std::string& kind, ImportWarning warning) {
  if (const auto known = places_.find(kind); known != places_.end()) {
    ++more_[known->second];
    warnings_[known->second].leaves_out |= warning.leaves_out;
    return;
  }
  if (warnings_.size() >= most_kinds_) {
    ++dropped_;
    dropped_leaves_out_ |= warning.leaves_out;
    return;
  }
  places_.emplace(kind, warnings_.size());
  warnings_.push_back(std::move(warning));
  more_.push_back(0);
}

std::vector<ImportWarning> ImportWarnings::take() {
  std::vector<ImportWarning> taken = std::exchange(warnings_, {});
  for (std::size_t i = 0; i < taken.size(); ++i) {
    if (more_[i] > 0) taken[i].text += " (and " + std::to_string(more_[i]) + " more like it)";
  }
  if (dropped_ > 0) {
    taken.push_back({"", "and " + std::to_string(dropped_) + " more warnings of other kinds",
                     dropped_leaves_out_});
  }
  more_.clear();
  places_.clear();
  dropped_ = 0;
  dropped_leaves_out_ = false;
  return taken;
}

}  // namespace graycube
