// Finds how a scene grows when its refs are expanded: how many leaves, how deep, and whether every
// leaf gets a material. Computed from summaries, without expanding anything: a file of a few lines
// can name 2^100 leaves.
#pragma once

#include <cstdint>
#include <vector>

#include "formats/json/error_report.hpp"
#include "formats/json/name_table.hpp"
#include "formats/json/tree.hpp"

namespace graycube {

/// A ref in a tree.
struct ShapeUse {
  JsonIndex at = 0;
  std::uint32_t shape = 0;
  /// Levels from the root of its own tree down to it, both included.
  std::uint32_t depth = 1;
  /// Whether it or something above it names a material.
  bool has_material = false;
};

/// Summary of one tree, refs not expanded.
struct TreeSummary {
  std::uint64_t leaves = 0;
  std::uint64_t nodes = 0;
  std::uint64_t triangles = 0;
  /// Planes of polyhedra.
  std::uint64_t planes = 0;
  std::uint32_t depth = 0;
  /// The first leaf without a material of its own or above it; 0 if there is none.
  JsonIndex bare_leaf = 0;
  std::vector<ShapeUse> uses;
};

/// Reports cycles of refs, trees deeper than kMaxTreeDepth, more leaves, nodes or triangles of
/// meshes than kMaxLeaves, kMaxExpandedNodes and kMaxMeshTriangles, and uses of shapes whose leaves
/// stay without a material. The caller reports bare leaves of the objects' own trees. Too many
/// leaves are reported at `objects_at`; if refs repeat more than kMaxRepeatedLeaves and the like,
/// this is reported at the ref that goes beyond.
void check_expansion(const JsonTree& tree, ErrorReport& errors, const NameTable& shape_names,
                     std::vector<TreeSummary>& shapes, const std::vector<TreeSummary>& objects,
                     JsonIndex objects_at);

}  // namespace graycube
