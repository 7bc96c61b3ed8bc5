// Sorts faces of one direction by their offsets along it, and groups those that may lie in one
// plane.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "coincidence/clusters.hpp"
#include "geometry/plane.hpp"

namespace graycube::csg {

/// A face as seen along the direction of its group.
struct Level {
  /// The face's own plane, turned over if it looks against the direction.
  Plane own;
  double offset = 0;
  double tolerance = 0;
  std::uint32_t primitive = 0;
  std::uint32_t slot = 0;
  /// The face looks against the direction.
  bool is_backward = false;
  /// Its normal is the direction already, or its opposite, bit for bit.
  bool has_direction = false;
  /// A flat part of a mesh: until it gets a plane, each of its triangles has one of its own.
  bool is_of_mesh = false;
};

/// Whether the faces are of more than one primitive.
bool is_shared(std::span<const Level> levels);

/// Groups levels into planes. A solid never becomes thinner than it was written: if opposite faces
/// of one would come together, its numbers are better than was thought, and levels there are told
/// apart by an eighth of the faces' distance.
class Planes {
 public:
  explicit Planes(std::vector<Level> levels);

  /// Whether faces of different primitives lie in one plane but don't agree to the bit.
  bool has_unequal() const { return has_unequal_; }

  /// Calls visit(levels of one plane, its offset) for each; the offset is that of the face that is
  /// known best.
  template <typename Visit>
  void for_each(const Visit& visit) const {
    std::size_t first = 0;
    for (const std::size_t end : ends_) {
      const auto plane = std::span(levels_).subspan(first, end - first);
      visit(plane, best_offset(plane));
      first = end;
    }
  }

 private:
  void add_run(std::span<const Extent> run, const std::vector<Level>& given);
  void add_plane(std::span<const Extent> plane, const std::vector<Level>& given);
  static double best_offset(std::span<const Level> plane);

  std::vector<Level> levels_;
  /// The index in levels_ at which each plane's levels end.
  std::vector<std::size_t> ends_;
  bool has_unequal_ = false;
};

}  // namespace graycube::csg
