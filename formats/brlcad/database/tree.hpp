// The Boolean tree of one BRL-CAD combination: built from operations in postfix order, or read from
// Tcl text.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "geometry/affine.hpp"

namespace graycube {

/// Most members of one combination, and most levels of its tree with chains flattened.
inline constexpr std::size_t kMaxBrlcadMembers = std::size_t{1} << 20;
inline constexpr std::size_t kMaxBrlcadTreeDepth = 100;

struct BrlcadTree {
  /// Unions and intersections of two or more; a difference, the first without the others; xor,
  /// either and not both; the complement of one.
  enum class Op : std::uint8_t { kLeaf, kUnion, kIntersection, kDifference, kXor, kNot };
  Op op = Op::kLeaf;
  std::string name;
  std::optional<Affine> matrix;
  /// A leaf whose matrix is no invertible affine map: nobody knows where it is.
  bool has_broken_matrix = false;
  std::vector<BrlcadTree> children;
};

/// Where a member of a combination is: a 4 × 4 matrix as the file has it, read.
struct BrlcadPlace {
  /// Nothing where the member stays where it is.
  std::optional<Affine> matrix;
  bool is_broken = false;
};

/// Builds a tree from its operations in postfix order. Chains of unions, of intersections and of
/// differences from one solid become one node. However a chain leans, each member is moved a
/// logarithmic number of times at most, and once if it leans to one side.
class BrlcadTreeBuilder {
 public:
  void leaf(std::string name, const BrlcadPlace& place);
  /// Joins the last two operands, or inverts the last. False if too few, or the tree gets too deep.
  [[nodiscard]] bool operation(BrlcadTree::Op op);
  /// The tree, when exactly one operand is left.
  std::optional<BrlcadTree> finish();
  std::size_t leaves() const { return leaves_; }

 private:
  /// An operand; `front` holds more children of its root, before its first, the foremost last.
  struct Operand {
    BrlcadTree tree;
    std::vector<BrlcadTree> front;
    std::size_t depth = 1;

    std::size_t children() const { return front.size() + tree.children.size(); }
  };
  Operand take();
  static BrlcadTree settled(Operand operand);
  static Operand alone_under(BrlcadTree::Op op, Operand operand);
  static Operand joined(Operand left, Operand right);

  std::vector<Operand> stack_;
  std::size_t leaves_ = 0;
};

/// Reads {l NAME MATRIX?} or {OP LEFT RIGHT}, without the outermost braces, in one pass; the
/// operations are u, n or +, -, ^ and ! (of one operand). Nothing when the text is something else,
/// and then `problem` says what.
std::optional<BrlcadTree> read_brlcad_tree_text(std::string_view text, std::string& problem);

}  // namespace graycube
