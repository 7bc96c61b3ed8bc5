#include "formats/openscad/language/report.hpp"

#include <algorithm>
#include <utility>

namespace graycube {
namespace {

std::string where(int line) { return line > 0 ? "line " + std::to_string(line) : ""; }

}  // namespace

void OpenscadReport::error(int line, std::string message) {
  if (errors_.size() >= kMaxOpenscadErrors) {
    ++dropped_errors_;
    return;
  }
  errors_.push_back({line, std::move(message)});
}

void OpenscadReport::warning(int line, const std::string& message) {
  warning(message, line, message);
}

void OpenscadReport::warning(const std::string& kind, int line, const std::string& message) {
  warnings_.add(kind, where(line), message);
}

void OpenscadReport::leave_out(const std::string& kind, int line, const std::string& message) {
  warnings_.leave_out(kind, where(line), message);
}

std::vector<OpenscadError> OpenscadReport::take_errors() {
  std::stable_sort(errors_.begin(), errors_.end(),
                   [](const OpenscadError& a, const OpenscadError& b) { return a.line < b.line; });
  if (dropped_errors_ > 0) {
    errors_.push_back({0, "and " + std::to_string(dropped_errors_) + " more errors"});
  }
  return std::move(errors_);
}

std::vector<ImportWarning> OpenscadReport::take_warnings() { return warnings_.take(); }

}  // namespace graycube
