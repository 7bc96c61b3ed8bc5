// Parts of a region's tree, joined.
#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>
#include <variant>

#include "scene/scene.hpp"

namespace graycube::brlcad {

/// A part of a region's tree; without a node it is the empty set.
struct Part {
  std::optional<CsgNode> node;
  std::size_t levels = 0;
};

/// The part's complement; the part must have a node.
inline Part inverted(Part part) {
  CsgNode node;
  OperationNode inner{Operation::kComplement, {}};
  inner.children.push_back(std::move(*part.node));
  node.value = std::move(inner);
  return {std::move(node), part.levels + 1};
}

/// Joins two parts; a chain of one operation becomes one node.
inline Part join(Operation op, Part a, Part b) {
  if (!a.node || !b.node) {
    if (op == Operation::kUnion) return a.node ? std::move(a) : std::move(b);
    if (op == Operation::kDifference) return a;
    return {};
  }
  auto* chain = std::get_if<OperationNode>(&a.node->value);
  const bool is_open = !a.node->transform && a.node->material == kInheritMaterial;
  if (chain != nullptr && chain->operation == op && is_open) {
    chain->children.push_back(std::move(*b.node));
    a.levels = std::max(a.levels, b.levels + 1);
    return a;
  }
  Part out;
  OperationNode both{op, {}};
  both.children.push_back(std::move(*a.node));
  both.children.push_back(std::move(*b.node));
  out.node.emplace().value = std::move(both);
  out.levels = std::max(a.levels, b.levels) + 1;
  return out;
}

/// All of space.
inline Part everything() {
  CsgNode half;
  half.value = HalfSpaceShape{{0, 0, 1}, 0};
  return join(Operation::kUnion, {half, 1}, inverted({half, 1}));
}

inline std::size_t leaves_below(const CsgNode& node) {
  const auto* inner = std::get_if<OperationNode>(&node.value);
  if (inner == nullptr) return 1;
  std::size_t sum = 0;
  for (const CsgNode& child : inner->children) sum += leaves_below(child);
  return sum;
}

/// Levels of the tree, at least 1.
inline std::size_t levels_of(const CsgNode& node) {
  std::size_t most = 0;
  if (const auto* inner = std::get_if<OperationNode>(&node.value)) {
    for (const CsgNode& child : inner->children) most = std::max(most, levels_of(child));
  }
  return most + 1;
}

}  // namespace graycube::brlcad
