#include "formats/openscad/part.hpp"

#include <algorithm>
#include <optional>
#include <utility>

namespace graycube {

Reach reach_of(const std::vector<Part>& parts) {
  Reach reach = Reach::nothing();
  for (const Part& part : parts) reach = union_of(reach, part.reach);
  return reach;
}

Part united(std::vector<Part> parts) {
  if (parts.size() == 1) return std::move(parts.front());
  Part result{{}, reach_of(parts), 0, parts.front().line, "union"};
  std::vector<CsgNode> children;
  for (Part& part : parts) {
    result.levels = std::max(result.levels, part.levels + 1);
    children.push_back(std::move(part.node));
  }
  result.node = {OperationNode{Operation::kUnion, std::move(children)}, std::nullopt,
                 kInheritMaterial};
  return result;
}

std::uint32_t levels_of(const CsgNode& node) {
  std::uint32_t most = 0;
  if (const auto* inner = std::get_if<OperationNode>(&node.value)) {
    for (const CsgNode& child : inner->children) most = std::max(most, levels_of(child));
  }
  return most + 1;
}

CsgNode placed(CsgNode node, const Affine& map) {
  if (map == Affine{}) return node;
  auto* sphere = std::get_if<SphereShape>(&node.value);
  const std::optional<double> scale = sphere != nullptr ? map.similarity_scale() : std::nullopt;
  if (scale) {
    *sphere = {map.point(sphere->center), *scale * sphere->radius};
  } else {
    node.transform = node.transform ? compose(map, *node.transform) : map;
  }
  return node;
}

}  // namespace graycube
