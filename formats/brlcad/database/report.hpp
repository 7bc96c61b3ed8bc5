// Collects the errors and warnings of the parts of the BRL-CAD reader.
#pragma once

#include <cstddef>
#include <set>
#include <string>
#include <vector>

namespace graycube {

/// Messages beyond so many are only counted.
inline constexpr std::size_t kMaxBrlcadMessages = 100;

/// `where` is "line 7", "byte 4096", an object's name, or empty for the whole file.
struct BrlcadMessage {
  std::string where;
  std::string text;
  friend bool operator==(const BrlcadMessage&, const BrlcadMessage&) = default;
};

class BrlcadReport {
 public:
  void error(std::string where, std::string text) {
    has_errors_ = true;
    add(errors_, std::move(where), std::move(text));
  }
  void warning(std::string where, std::string text) {
    add(warnings_, std::move(where), std::move(text));
  }
  /// A warning that is given once for each `kind`.
  void warning_once(const std::string& kind, std::string where, std::string text) {
    if (kinds_.size() < kMaxBrlcadMessages && kinds_.insert(kind).second) {
      warning(std::move(where), std::move(text));
    }
  }
  bool has_errors() const { return has_errors_; }

  std::vector<BrlcadMessage> take_errors() { return std::move(errors_); }
  std::vector<BrlcadMessage> take_warnings() { return std::move(warnings_); }

 private:
  static void add(std::vector<BrlcadMessage>& list, std::string where, std::string text) {
    if (list.size() < kMaxBrlcadMessages) list.push_back({std::move(where), std::move(text)});
  }

  std::vector<BrlcadMessage> errors_, warnings_;
  std::set<std::string> kinds_;
  bool has_errors_ = false;
};

}  // namespace graycube
