// The subdivision of one macro-region: a BSP with axis-aligned planes (surface-area heuristic),
// whose leaf regions hold, per object with a surface in them, a pruned CSG program, and are linked
// to their neighbours through all six faces (Arnaldi, Priol & Bouatouch 1987), so that a ray walks
// from leaf to leaf without going back to the root.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "crossings/cell_programs.hpp"
#include "csg/model.hpp"

namespace graycube {

struct BspNode {
  static constexpr std::uint8_t kLeafAxis = 3;

  /// Position of the plane on `axis`.
  double split = 0;
  /// Inner: index of the lower child, the upper one follows it. Leaf: index of the leaf region.
  std::uint32_t child = 0;
  std::uint8_t axis = kLeafAxis;
};

struct BspLeaf {
  Aabb cell;
  /// For each face (axis · 2 + upper), the root node of the smallest subtree that touches the whole
  /// face; kNoNeighbour if there is nothing beyond the face.
  std::array<std::uint32_t, 6> neighbour{};
  std::uint32_t first_program = 0;
  std::uint32_t program_count = 0;

  ProgramRange programs() const { return {first_program, program_count}; }
};
inline constexpr std::uint32_t kNoNeighbour = 0xFFFFFFFFu;

struct BspOptions {
  /// Cost of one step of the walk, in tests of a primitive.
  double step_cost = 0.6;
  /// Leaf regions are never deeper than this.
  int max_depth = 48;
};

/// Immutable once built; shared by all evaluator threads. The model must outlive it.
class Bsp {
 public:
  static Bsp build(const Model& model, const BspOptions& options = {});
  /// Subdivides space for one object alone.
  static Bsp build_for_object(const Model& model, std::uint32_t object,
                              const BspOptions& options = {});

  const Model& model() const { return store_.model(); }
  const std::vector<BspNode>& nodes() const { return nodes_; }
  const std::vector<BspLeaf>& leaves() const { return leaves_; }
  const CellPrograms& cell_programs() const { return store_; }
  const std::vector<CellProgram>& programs() const { return store_.programs(); }
  const std::vector<TreeNode>& program_nodes() const { return store_.nodes(); }
  /// Bytes of nodes, leaf regions and programs.
  std::size_t memory_bytes() const;

 private:
  friend class BspAssembly;
  explicit Bsp(const Model& model) : store_(model) {}

  std::vector<BspNode> nodes_;
  std::vector<BspLeaf> leaves_;
  CellPrograms store_;
};

}  // namespace graycube
