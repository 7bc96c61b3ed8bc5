#include "crossings/masked_program.hpp"

namespace graycube::crossings {
namespace {

bool is_leaf(const TreeNode& n) { return n.size == 1; }

/// Appends the subtree's operations, children first; returns the bit that holds its result. Moves
/// `literal` past the subtree's leaves.
std::uint64_t append_subtree(std::span<const TreeNode> tree, std::size_t& literal, std::size_t& bit,
                             std::vector<MaskOperation>& operations) {
  const TreeNode& root = tree.front();
  if (is_leaf(root)) return std::uint64_t{1} << literal++;
  MaskOperation operation{0, root.kind == TreeNode::Kind::kAnd, static_cast<std::uint8_t>(literal)};
  for (std::size_t i = 1; i < root.size; i += tree[i].size) {
    operation.children |= append_subtree(tree.subspan(i, tree[i].size), literal, bit, operations);
  }
  operations.push_back(operation);
  return std::uint64_t{1} << bit++;
}

}  // namespace

bool MaskedProgram::append(std::span<const TreeNode> tree, std::vector<MaskOperation>& operations) {
  std::size_t literals = 0;
  for (const TreeNode& n : tree) literals += is_leaf(n) ? 1 : 0;
  if (tree.size() > kMaxNodes || literals > kMaxFlatLiterals) return false;
  std::size_t literal = 0;
  append_subtree(tree, literal, literals, operations);
  return true;
}

}  // namespace graycube::crossings
