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

}  // namespace graycube
