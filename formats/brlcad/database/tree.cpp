#include "formats/brlcad/database/tree.hpp"

#include <algorithm>
#include <iterator>

namespace graycube {

using Op = BrlcadTree::Op;

void BrlcadTreeBuilder::leaf(std::string name, const BrlcadPlace& place) {
  Operand& o = stack_.emplace_back();
  o.tree.name = std::move(name);
  o.tree.matrix = place.matrix;
  o.tree.has_broken_matrix = place.is_broken;
  ++leaves_;
}

BrlcadTreeBuilder::Operand BrlcadTreeBuilder::take() {
  Operand operand = std::move(stack_.back());
  stack_.pop_back();
  return operand;
}

BrlcadTree BrlcadTreeBuilder::settled(Operand operand) {
  auto& children = operand.tree.children;
  if (operand.front.empty()) return std::move(operand.tree);
  std::reverse(operand.front.begin(), operand.front.end());
  operand.front.reserve(operand.children());
  std::move(children.begin(), children.end(), std::back_inserter(operand.front));
  children = std::move(operand.front);
  return std::move(operand.tree);
}

BrlcadTreeBuilder::Operand BrlcadTreeBuilder::alone_under(Op op, Operand operand) {
  Operand above;
  above.tree.op = op;
  above.depth = operand.depth + 1;
  above.tree.children.push_back(settled(std::move(operand)));
  return above;
}

/// Joins two chains; the shorter one is moved into the longer one.
BrlcadTreeBuilder::Operand BrlcadTreeBuilder::joined(Operand left, Operand right) {
  const std::size_t depth = std::max(left.depth, right.depth);
  Operand& longer = right.children() > left.children() ? right : left;
  if (&longer == &left) {
    auto& to = left.tree.children;
    std::move(right.front.rbegin(), right.front.rend(), std::back_inserter(to));
    std::move(right.tree.children.begin(), right.tree.children.end(), std::back_inserter(to));
  } else {
    auto& from = left.tree.children;
    std::move(from.rbegin(), from.rend(), std::back_inserter(right.front));
    std::move(left.front.begin(), left.front.end(), std::back_inserter(right.front));
  }
  longer.depth = depth;
  return std::move(longer);
}

bool BrlcadTreeBuilder::operation(Op op) {
  if (op == Op::kLeaf || stack_.size() < (op == Op::kNot ? 1u : 2u)) return false;
  Operand last = take();
  // A chain may only be merged into the one on its left if brackets don't matter.
  const bool is_associative = op == Op::kUnion || op == Op::kIntersection;
  if (last.tree.op != op || !is_associative) last = alone_under(op, std::move(last));
  if (op != Op::kNot) {
    Operand first = take();
    if (first.tree.op != op || op == Op::kXor) first = alone_under(op, std::move(first));
    last = joined(std::move(first), std::move(last));
  }
  if (last.depth > kMaxBrlcadTreeDepth) return false;
  stack_.push_back(std::move(last));
  return true;
}

std::optional<BrlcadTree> BrlcadTreeBuilder::finish() {
  if (stack_.size() != 1) return std::nullopt;
  return settled(take());
}

}  // namespace graycube
