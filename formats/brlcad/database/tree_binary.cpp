#include "formats/brlcad/database/tree_binary.hpp"

#include <array>
#include <utility>
#include <vector>

namespace graycube {
namespace {

constexpr std::size_t kMatrixBytes = 128;

/// A member of the combination: its name, and the map that places it.
struct Leaf {
  std::string_view name;
  BrlcadPlace place;
};

/// The numbers of all parts of the tree, and the bytes that its numbers take.
struct Layout {
  unsigned width = 0;
  std::uint64_t matrices = 0, leaves = 0, operations = 0;
};

/// Reads a width code and the numbers of matrices, leaves, bytes of leaves, operations and levels.
/// Nothing when the bytes have no room for so many.
std::optional<Layout> read_layout(BrlcadByteReader& r) {
  Layout layout;
  layout.width = width_of(static_cast<unsigned>(r.integer(1)));
  layout.matrices = r.integer(layout.width);
  layout.leaves = r.integer(layout.width);
  r.integer(layout.width);
  layout.operations = r.integer(layout.width);
  r.integer(layout.width);
  if (!r.ok() || layout.matrices > r.remaining() / kMatrixBytes ||
      layout.leaves > kMaxBrlcadMembers || layout.leaves > r.remaining() / 2) {
    return std::nullopt;
  }
  return layout;
}

/// Reads matrices, then leaves, each a name and the number of its matrix, if it has one. Nothing
/// when a leaf's matrix isn't there.
std::optional<std::vector<Leaf>> read_leaves(BrlcadByteReader& r, const Layout& layout) {
  std::vector<BrlcadPlace> places;
  for (std::uint64_t i = 0; i < layout.matrices; ++i) {
    std::array<double, 16> m;
    for (double& v : m) v = r.number();
    places.push_back(brlcad_place(m));
  }
  std::vector<Leaf> leaves;
  for (std::uint64_t i = 0; i < layout.leaves; ++i) {
    Leaf leaf{r.text(), {}};
    const std::uint64_t index = r.integer(layout.width);
    const bool has_matrix = (index >> (8 * layout.width - 1) & 1) == 0;
    if (has_matrix) {
      if (!r.ok() || index >= places.size()) return std::nullopt;
      leaf.place = places[static_cast<std::size_t>(index)];
    }
    leaves.push_back(leaf);
  }
  return leaves;
}

/// Hands the leaves to a builder in their order.
class Members {
 public:
  Members(const std::vector<Leaf>& leaves, BrlcadTreeBuilder& builder)
      : leaves_(leaves), builder_(builder) {}

  /// Hands on the next leaf; false when there is none left.
  bool push() {
    if (used_ >= leaves_.size()) return false;
    const Leaf& leaf = leaves_[used_++];
    builder_.leaf(std::string(leaf.name), leaf.place);
    return true;
  }

 private:
  const std::vector<Leaf>& leaves_;
  BrlcadTreeBuilder& builder_;
  std::size_t used_ = 0;
};

/// The tree of all members united.
std::optional<BrlcadTree> united(const std::vector<Leaf>& leaves) {
  BrlcadTreeBuilder builder;
  Members members(leaves, builder);
  for (std::size_t i = 0; i < leaves.size(); ++i) {
    if (!members.push()) return std::nullopt;
    if (i > 0 && !builder.operation(BrlcadTree::Op::kUnion)) return std::nullopt;
  }
  return builder.finish();
}

/// The tree that operations in postfix order make; operation 1 stands for the next member.
std::optional<BrlcadTree> tree_of(const std::vector<Leaf>& leaves, std::string_view postfix) {
  constexpr BrlcadTree::Op kOps[] = {BrlcadTree::Op::kUnion, BrlcadTree::Op::kIntersection,
                                     BrlcadTree::Op::kDifference, BrlcadTree::Op::kXor,
                                     BrlcadTree::Op::kNot};
  BrlcadTreeBuilder builder;
  Members members(leaves, builder);
  for (const char token : postfix) {
    const bool is_good = token == 1
                             ? members.push()
                             : token >= 2 && token <= 6 && builder.operation(kOps[token - 2]);
    if (!is_good) return std::nullopt;
  }
  return builder.finish();
}

}  // namespace

std::optional<std::string> read_binary_tree(BrlcadByteReader& r, BrlcadComb& comb) {
  if (r.remaining() == 0) return std::nullopt;
  const auto layout = read_layout(r);
  if (!layout) return "a combination with more matrices or members than it has room for";
  const auto leaves = read_leaves(r, *layout);
  if (!leaves) return "a member's matrix isn't there";
  const std::string_view postfix = r.take(layout->operations);
  if (!r.ok()) return "a combination that is shorter than it says";
  if (postfix.empty() && leaves->empty()) return std::nullopt;
  comb.tree = postfix.empty() ? united(*leaves) : tree_of(*leaves, postfix);
  if (comb.tree) return std::nullopt;
  return "its operations are no Boolean tree, or one deeper than " +
         std::to_string(kMaxBrlcadTreeDepth) + " levels";
}

}  // namespace graycube
