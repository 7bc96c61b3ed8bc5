// What an importer tells of a file that it can read: warnings, told once a kind with a count.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace graycube {

struct ImportWarning {
  /// "line 7", "byte 4096", the name of a part; empty for the whole file.
  std::string where;
  std::string text;
  /// Whether a part of the model is missing in the scene because of this: --strict then refuses it.
  bool leaves_out = false;
  friend bool operator==(const ImportWarning&, const ImportWarning&) = default;
};

/// Keeps the first warning of each kind, in the order in which the kinds came, and counts those
/// that follow. Beyond so many kinds it only counts.
class ImportWarnings {
 public:
  explicit ImportWarnings(std::size_t most_kinds) : most_kinds_(most_kinds) {}

  /// A warning of a kind, which may be any text that its siblings have in common.
  void add(const std::string& kind, std::string where, std::string text) {
    add(kind, {std::move(where), std::move(text), false});
  }
  /// The same for a part that is left out.
  void leave_out(const std::string& kind, std::string where, std::string text) {
    add(kind, {std::move(where), std::move(text), true});
  }

  /// One warning a kind; "(and 3 more like it)" is put behind the text of those that came four
  /// times. One more line tells how many came beyond the most kinds; it leaves out when any of them
  /// did.
  std::vector<ImportWarning> take();

 private:
  void add(const std::string& kind, ImportWarning warning);

  std::size_t most_kinds_;
  std::vector<ImportWarning> warnings_;
  /// How many more came of each warning's kind, by its place in `warnings_`.
  std::vector<std::size_t> more_;
  std::map<std::string, std::size_t> places_;
  std::size_t dropped_ = 0;
  bool dropped_leaves_out_ = false;
};

}  // namespace graycube
