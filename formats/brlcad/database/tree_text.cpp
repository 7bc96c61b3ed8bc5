// Reads a combination's tree from Tcl text. Each byte is looked at once, however deep the lists
// nest: levels live on a stack here, and words are cut where their level ends.
#include <algorithm>
#include <array>

#include "formats/brlcad/database/database.hpp"
#include "formats/brlcad/database/words.hpp"

namespace graycube {
namespace {

using Op = BrlcadTree::Op;

class TreeTextReader {
 public:
  TreeTextReader(std::string_view text, BrlcadTreeBuilder& builder, std::string& problem)
      : words_(text, TclWords::Ends::kAtBrace), builder_(builder), problem_(problem) {}

  /// False when the text is no tree.
  bool read() {
    do {
      if (!head()) return false;
    } while (!is_whole_);
    return words_.at_end_of_list() || wrong_tree();
  }

 private:
  /// An operation that waits for operands, and how many have come.
  struct Level {
    Op op;
    std::uint8_t operands;
  };

  static std::optional<Op> operation_of(std::string_view word) {
    if (word == "u") return Op::kUnion;
    if (word == "n" || word == "+") return Op::kIntersection;
    if (word == "-") return Op::kDifference;
    if (word == "^") return Op::kXor;
    if (word == "!") return Op::kNot;
    return std::nullopt;
  }

  bool wrong_tree() {
    problem_ = "its tree is no Boolean tree of BRL-CAD's, or deeper than " +
               std::to_string(kMaxBrlcadTreeDepth) + " levels";
    return false;
  }
  bool too_many() {
    problem_ = "more than " + std::to_string(kMaxBrlcadMembers) + " members";
    return false;
  }

  /// Reads a node's first word and, of a leaf, the others; then up to the next node's first word.
  bool head() {
    std::string word;
    if (!words_.next(word)) return wrong_tree();
    if (word == "l") return leaf() && tail();
    const auto op = operation_of(word);
    if (!op) return wrong_tree();
    // The level of an operation of two operands has a member of its own.
    if (levels_.size() >= kMaxBrlcadMembers) return too_many();
    levels_.push_back({*op, 0});
    return operand() && (is_in_braces_ || tail());
  }

  /// Goes into the next operand if it is in braces, as BRL-CAD writes them, or reads it whole if it
  /// is quoted in another of Tcl's ways. Few of those can be nested: each takes twice the
  /// backslashes of the one around it.
  bool operand() {
    is_in_braces_ = words_.open_list();
    if (is_in_braces_) return true;
    std::string text;
    return words_.next(text) ? TreeTextReader(text, builder_, problem_).read() : wrong_tree();
  }

  bool leaf() {
    std::string name, matrix;
    if (!words_.next(name)) return wrong_tree();
    BrlcadPlace place;
    if (words_.next(matrix)) {
      std::vector<double> numbers;
      std::array<double, 16> m{};
      if (append_brlcad_numbers(matrix, 16, numbers))
        std::copy(numbers.begin(), numbers.end(), m.begin());
      place = brlcad_place(m);
    }
    builder_.leaf(std::move(name), place);
    return builder_.leaves() <= kMaxBrlcadMembers || too_many();
  }

  /// Called behind an operand: ends the operations of which it was the last.
  bool tail() {
    while (!levels_.empty()) {
      Level& level = levels_.back();
      if (is_in_braces_ && !words_.close_list()) return wrong_tree();
      if (++level.operands < (level.op == Op::kNot ? 1 : 2)) {
        if (!operand()) return false;
        if (is_in_braces_) return true;
        continue;
      }
      if (!builder_.operation(level.op)) return wrong_tree();
      levels_.pop_back();
      is_in_braces_ = true;
    }
    is_whole_ = true;
    return true;
  }

  TclWords words_;
  BrlcadTreeBuilder& builder_;
  std::string& problem_;
  std::vector<Level> levels_;
  /// Whether the operand under way is in braces.
  bool is_in_braces_ = true;
  bool is_whole_ = false;
};

}  // namespace

std::optional<BrlcadTree> read_brlcad_tree_text(std::string_view text, std::string& problem) {
  BrlcadTreeBuilder builder;
  return TreeTextReader(text, builder, problem).read() ? builder.finish() : std::nullopt;
}

}  // namespace graycube
