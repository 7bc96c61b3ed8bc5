// The subdivision of one macro-region: a BSP with axis-aligned planes (surface-area heuristic),
// whose leaf regions hold, per object with a surface in them, a pruned CSG program, and are linked
// to their neighbours through all six faces (Arnaldi, Priol & Bouatouch 1987), so that a ray walks
// from leaf to leaf without going back to the root.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

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

/// An object restricted to a leaf region.
struct CellProgram {
  enum class Shape : std::uint8_t { kSingle, kAllOf, kAnyOf, kGeneral };

  /// Index into Model::objects.
  std::uint32_t object = 0;
  /// Range in Bsp::program_nodes; one node for kSingle, only the literals for kAllOf and kAnyOf.
  std::uint32_t first_node = 0;
  std::uint32_t node_count = 0;
  /// Number of leaves among the nodes.
  std::uint32_t literals = 0;
  Shape shape = Shape::kSingle;
};

struct BspLeaf {
  Aabb cell;
  /// For each face (axis · 2 + upper), the root node of the smallest subtree that touches the whole
  /// face; kNoNeighbour if there is nothing beyond the face.
  std::array<std::uint32_t, 6> neighbour{};
  std::uint32_t first_program = 0;
  std::uint32_t program_count = 0;
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

  const Model& model() const { return *model_; }
  const std::vector<BspNode>& nodes() const { return nodes_; }
  const std::vector<BspLeaf>& leaves() const { return leaves_; }
  const std::vector<CellProgram>& programs() const { return programs_; }
  const std::vector<TreeNode>& program_nodes() const { return program_nodes_; }
  /// Bytes of nodes, leaf regions and programs.
  std::size_t memory_bytes() const;

 private:
  friend class BspBuilder;
  const Model* model_ = nullptr;
  std::vector<BspNode> nodes_;
  std::vector<BspLeaf> leaves_;
  std::vector<CellProgram> programs_;
  std::vector<TreeNode> program_nodes_;
};

}  // namespace graycube
