// Collects the errors and warnings of the parts of the BRL-CAD reader.
#pragma once

#include <cstddef>
#include <map>
#include <set>
#include <string>
#include <utility>
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

/// Names of things that the same is said of, in one line.
class BrlcadNamed {
 public:
  /// Counts a name among `things` (a plural that ends in s) of which `what` is said; once, however
  /// often it comes. `detail` is shown for the first.
  void add(const std::string& things, const std::string& what, const std::string& name,
           const std::string& detail);

  struct Line {
    /// "2 solids", what is said of them with the first one's detail, and some of their names.
    std::string count, what, names;
    bool is_one = false;
  };
  std::vector<Line> take();

 private:
  struct Group {
    std::set<std::string> names;
    std::string detail;
  };
  std::map<std::pair<std::string, std::string>, Group> groups_;
};

class BrlcadReport {
 public:
  void error(std::string where, std::string text) {
    has_errors_ = true;
    if (errors_.size() < kMaxBrlcadMessages) errors_.push_back({std::move(where), std::move(text)});
  }
  void warning(std::string where, std::string text) {
    const std::string kind = where + ": " + text;
    warnings_.add(kind, std::move(where), std::move(text));
  }
  /// A warning that is given once for each `kind`, with a count.
  void warning_once(const std::string& kind, std::string where, std::string text) {
    warnings_.add(kind, std::move(where), std::move(text));
  }
  /// Counts `name` among the things that are left out for the reason `why` (if any): one line for
  /// all `things` of one reason, as "2 solids are left out (WHY): a, b". `detail` adds to the
  /// reason for the first of them.
  void left_out(const std::string& things, const std::string& why, const std::string& name,
                const std::string& detail = {}) {
    left_out_.add(things, why, name, detail);
  }
  /// Tells of a name that the database doesn't hold; others are counted.
  void missing(const std::string& name) {
    warnings_.leave_out("missing", name, "is not in the database, and left out");
  }
  /// The same as left_out() for air regions, which rt leaves out, too: nothing is missing.
  void air(const std::string& name) { air_.add("air regions", {}, name, {}); }
  /// The same for things that are drawn, but not quite as they are written: "2 solids: WHY: a, b".
  void changed(const std::string& things, const std::string& why, const std::string& name) {
    changed_.add(things, why, name, {});
  }
  bool has_errors() const { return has_errors_; }

  std::vector<BrlcadMessage> take_errors() { return std::move(errors_); }
  std::vector<ImportWarning> take_warnings();
  /// The first of the lines on what is left out; empty when nothing is. Takes them all.
  std::string take_left_out();

 private:
  std::vector<BrlcadMessage> errors_;
  ImportWarnings warnings_{kMaxBrlcadMessages};
  BrlcadNamed left_out_, air_, changed_;
  bool has_errors_ = false;
};

}  // namespace graycube
