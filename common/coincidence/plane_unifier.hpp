// Gives faces that lie in one plane the same plane.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "coincidence/candidates.hpp"
#include "coincidence/exactness.hpp"
#include "coincidence/heading.hpp"
#include "coincidence/levels.hpp"
#include "coincidence/mesh_faces.hpp"
#include "csg/model.hpp"

namespace graycube::csg {

/// To be shown all primitives three times, since nearly none of them has a face in another's plane:
/// that is quicker than to keep what is known of each.
class PlaneUnifier {
 public:
  PlaneUnifier(Model& model, std::span<const Exactness> exactness)
      : model_(model), exactness_(exactness) {}

  void count(std::uint32_t primitive);
  /// `reach`: the largest coordinate of what is bounded.
  void begin_marking(double reach);
  void mark(std::uint32_t primitive);
  void collect(std::uint32_t primitive);
  /// Changes the faces of what was collected; whether any differ now.
  bool unify();

 private:
  template <typename Visit>
  void for_each_heading(std::uint32_t primitive, const Visit& visit) const;
  static double number_tolerance(double distance, double direction, double reach);
  /// A face and a point of it, in its middle.
  struct Anchored {
    Plane plane;
    Vec3 anchor;
  };
  Anchored anchored_face(std::uint32_t primitive, std::uint32_t slot) const;
  void add_levels(const Heading& heading, const Vec3& direction, std::vector<Level>& group) const;
  Level level_of(std::uint32_t primitive, std::uint32_t slot, const Anchored& face,
                 const Vec3& direction) const;
  void unify_directions();
  void unify_direction(std::span<const Extent> cluster);
  void unify_offsets(const Vec3& direction, std::vector<Level> group);
  void set(const Level& level, const Vec3& direction, double offset, bool is_shared_plane);
  bool settle();
  std::size_t place_of_mesh(std::uint32_t primitive) const;

  Model& model_;
  std::span<const Exactness> exactness_;
  std::size_t count_ = 0;
  /// Sums over all faces of how far they may be off.
  double distances_ = 0, directions_ = 0;
  double reach_ = 0;
  std::optional<Candidates> candidates_;
  /// Across the world's axes, and others.
  std::array<std::vector<Level>, 3> along_;
  std::vector<Heading> others_;
  std::vector<MeshFaces> mesh_faces_;
  /// Primitives with how far a face has moved.
  std::vector<std::pair<std::uint32_t, double>> changed_;
};

}  // namespace graycube::csg
