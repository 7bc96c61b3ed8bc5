// Finds how a scene grows when its refs and repeats are expanded: how many leaves, how deep, and
// whether every leaf gets a material. Computed from summaries, without expanding anything: a file
// of a few lines can name 2^100 leaves.
#pragma once

#include <cstdint>
#include <vector>

#include "formats/graycube/tree_counts.hpp"
#include "formats/json/error_report.hpp"
#include "formats/json/name_table.hpp"
#include "formats/json/tree.hpp"
#include "scene/repeat.hpp"

namespace graycube {

/// A ref in a tree.
struct ShapeUse {
  JsonIndex at = 0;
  std::uint32_t shape = 0;
  /// Levels from the root of its own tree down to it, both included.
  std::uint32_t depth = 1;
  /// Whether it or something above it names a material.
  bool has_material = false;
  /// How many copies of it the repeats above it make; saturates.
  std::uint64_t copies = 1;
};

/// A repeat in a tree, and what its copies add to what is spelled out.
struct RepeatUse {
  JsonIndex at = 0;
  TreeCounts added;
};

/// Summary of one tree: repeats expanded, refs not.
struct TreeSummary {
  TreeCounts counts;
  /// Levels; a repeat is one, like a union.
  std::uint32_t depth = 0;
  /// The first leaf without a material of its own or above it; 0 if there is none.
  JsonIndex bare_leaf = 0;
  std::vector<ShapeUse> uses;
  /// Inner ones before outer ones, so that the sum of what they add leads to the counts.
  std::vector<RepeatUse> repeats;

  /// Adds a repeat's child, which has been summed up on its own. `at` is the repeat.
  void add_repeat(JsonIndex at, const RepeatCounts& times, TreeSummary child);
};

/// Reports cycles of refs, trees deeper than kMaxTreeDepth, more leaves, nodes or triangles of
/// meshes than kMaxLeaves, kMaxExpandedNodes and kMaxMeshTriangles, and uses of shapes whose leaves
/// stay without a material. The caller reports bare leaves of the objects' own trees. Too many
/// leaves are reported at `objects_at`; if refs and repeats add more than kMaxRepeatedLeaves and
/// the like, this is reported at the ref or repeat that goes beyond.
void check_expansion(const JsonTree& tree, ErrorReport& errors, const NameTable& shape_names,
                     std::vector<TreeSummary>& shapes, const std::vector<TreeSummary>& objects,
                     JsonIndex objects_at);

}  // namespace graycube
