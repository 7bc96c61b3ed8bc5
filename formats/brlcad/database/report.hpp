// Collects the errors and warnings of the parts of the BRL-CAD reader.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "formats/report/import_warnings.hpp"

namespace graycube {

/// Errors beyond so many are dropped, and kinds of warnings only counted.
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
    const std::string kind = where + ": " + text;
    warnings_.add(kind, std::move(where), std::move(text));
  }
  /// A warning that is given once for each `kind`, with a count.
  void warning_once(const std::string& kind, std::string where, std::string text) {
    warnings_.add(kind, std::move(where), std::move(text));
  }
  /// The same for what is missing in the scene because of it.
  void leave_out(const std::string& kind, std::string where, std::string text) {
    warnings_.leave_out(kind, std::move(where), std::move(text));
  }
  bool has_errors() const { return has_errors_; }

  std::vector<BrlcadMessage> take_errors() { return std::move(errors_); }
  std::vector<ImportWarning> take_warnings() { return warnings_.take(); }

 private:
  static void add(std::vector<BrlcadMessage>& list, std::string where, std::string text) {
    if (list.size() < kMaxBrlcadMessages) list.push_back({std::move(where), std::move(text)});
  }

  std::vector<BrlcadMessage> errors_;
  ImportWarnings warnings_{kMaxBrlcadMessages};
  bool has_errors_ = false;
};

}  // namespace graycube
