// The corners and edges of a solid of facets, among which those of a round solid's facets are
// looked for.
#pragma once

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "flat/polygon.hpp"
#include "formats/openscad/hulls/round_ring.hpp"
#include "mesh/close_mesh.hpp"

namespace graycube {

/// How far a point of six digits may be off, relative to the largest number.
inline constexpr double kHalfOfSixDigits = 5e-6;

class FacetEdges {
 public:
  /// A mesh of OpenSCAD's, which has six digits.
  FacetEdges(const PolygonMesh& mesh, const Affine& to_world);
  /// The walls of upright prisms, so that only cylinders are found; perhaps of six digits.
  FacetEdges(const FlatLoops& outlines, const Affine& to_world);

  /// Outlines turned about z, by their edges around it, so that only what is turned is found.
  FacetEdges(const FlatLoops& outlines, const RingAngles& angles, const Affine& to_world);

  /// Whether the round solid isn't too far away to have any in common.
  bool are_near(const RoundRing& ring) const;
  /// Whether an edge is one between two of the round solid's facets, or for a cylinder or a cone
  /// goes from one line along it to the next: then the solids share a facet's plane. `share`: how
  /// far coordinates in the world may be off, relative to their size.
  bool have_one_of(const RoundRing& ring, double share) const;
  std::size_t size() const { return points_.size() + edges_.size(); }

 private:
  std::vector<Vec3> points_;
  /// Pairs of indices of points, either way round.
  std::vector<std::pair<std::uint32_t, std::uint32_t>> edges_;
  /// The only kind of round solid that is looked for, if there is one.
  std::optional<RoundRing::Kind> only_;
  /// How far the points may be off, their middle, and how far they reach from it.
  double off_ = 0;
  Vec3 middle_;
  double reach_ = 0;

  void find_reach();
};

/// Moves points in the world to the corners of the round solid's facets that are nearer than
/// `off`; to those of a cylinder or a cone on their level.
void move_to_corners(const RoundRing& ring, double off, std::vector<Vec3>& points);

}  // namespace graycube
