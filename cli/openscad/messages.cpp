#include "cli/openscad/messages.hpp"

#include <algorithm>
#include <initializer_list>
#include <utility>

namespace graycube {
namespace {

/// Lines of how an error came to be that are told.
constexpr std::size_t kMaxErrorLines = 12;
/// Of a model that sets its view; Graycube frames nothing then, either.
constexpr std::string_view kOfView = "WARNING: Viewall and autocenter disabled";

bool is_digit(char c) { return c >= '0' && c <= '9'; }

template <typename Take>
void for_each_line(std::string_view text, const Take& take) {
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    take(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
}

bool begins_with_any(std::string_view line, std::initializer_list<std::string_view> beginnings) {
  return std::any_of(beginnings.begin(), beginnings.end(),
                     [&](std::string_view b) { return line.starts_with(b); });
}

}  // namespace

std::string openscad_message_kind(std::string_view line) {
  line = line.substr(0, line.rfind(" in file "));
  std::string kind;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    const std::size_t end = c == '\'' || c == '"' ? line.find(c, i + 1) : std::string_view::npos;
    if (end != std::string_view::npos) {
      kind += "''";
      i = end;
    } else if (!is_digit(c)) {
      kind += c;
    } else if (kind.empty() || kind.back() != '0') {
      kind += '0';
    }
  }
  return kind;
}

void OpenscadMessages::read(std::string_view log, std::string_view mark) {
  bool is_in_error = false;
  for_each_line(log, [&](std::string_view line) {
    if (line.starts_with(mark)) {
      marked_ = line.substr(mark.size());
      return;
    }
    const bool is_error = line.starts_with("ERROR");
    is_in_error = is_error || (is_in_error && line.starts_with("TRACE"));
    const std::string text(line);
    if (is_in_error) {
      if (errors_.size() < kMaxErrorLines) errors_.push_back(text);
    } else if (line.starts_with("ECHO")) {
      echoes_.add(text, "", text);
    } else if (begins_with_any(line, {"WARNING", "DEPRECATED", "Can't"}) &&
               !line.starts_with(kOfView)) {
      warnings_.add(openscad_message_kind(line), "", text);
    }
  });
}

std::vector<std::string> OpenscadMessages::take_warnings() {
  std::vector<std::string> lines;
  for (ImportWarnings* kept : {&warnings_, &echoes_}) {
    for (ImportWarning& warning : kept->take()) lines.push_back(std::move(warning.text));
  }
  return lines;
}

std::vector<std::string> openscad_troubles(std::string_view log, std::string_view folder) {
  std::vector<std::string> lines;
  for_each_line(log, [&](std::string_view line) {
    if (!begins_with_any(line, {"ERROR", "WARNING", "Can't"})) return;
    std::string text(line.substr(0, line.rfind(" in file ")));
    const std::string prefix = std::string(folder) + "/";
    for (std::size_t at; (at = text.find(prefix)) != std::string::npos;)
      text.erase(at, prefix.size());
    if (std::find(lines.begin(), lines.end(), text) == lines.end()) lines.push_back(text);
  });
  return lines;
}

}  // namespace graycube
