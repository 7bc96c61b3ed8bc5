// The edges of a triangle mesh: which triangles use them, and in which direction.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "mesh/triangle_mesh.hpp"

namespace graycube {

struct MeshEdge {
  std::uint32_t from, to;
};

/// Every edge with how often it is used from its lower to its higher point, and back. Points are
/// below 2³¹.
class MeshEdges {
 public:
  struct Uses {
    std::uint32_t forward = 0, backward = 0;
  };

  explicit MeshEdges(std::span<const Triangle> triangles);

  std::size_t count() const { return count_; }
  /// Edges that are not used as often one way as the other.
  std::size_t unbalanced_count() const { return unbalanced_count_; }
  /// The uses of an edge, `forward` meaning from e.from to e.to.
  Uses uses(const MeshEdge& e) const;
  /// The first unbalanced edge in the order of the triangles.
  std::optional<MeshEdge> first_unbalanced(std::span<const Triangle> triangles) const;

 private:
  /// A word for each use, sorted: lower point, higher point, and 1 if it goes down.
  std::vector<std::uint64_t> records_;
  std::size_t count_ = 0, unbalanced_count_ = 0;
};

/// For each side 3 · triangle + i, which goes from corner i to the next, the number of the other
/// triangle's side at the same edge; `none` at edges that don't belong to exactly two triangles.
std::vector<std::uint32_t> sides_across(std::span<const Triangle> triangles, std::uint32_t none);

/// Turns triangles over so that neighbours at edges of exactly two triangles agree, keeping the
/// majority of each connected part as it is. Returns an edge at which that can't be done (on a
/// one-sided surface), if there is one.
std::optional<MeshEdge> agree_on_orientation(std::span<Triangle> triangles);

}  // namespace graycube
