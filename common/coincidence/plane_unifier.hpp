// Gives faces that lie in one plane the same plane.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "coincidence/exactness.hpp"
#include "coincidence/heading.hpp"
#include "coincidence/levels.hpp"
#include "coincidence/mesh_faces.hpp"
#include "coincidence/sightings.hpp"
#include "csg/model.hpp"

namespace graycube::csg {

/// Hardly any primitive has a face in another's plane. So each is measured once, when it is added,
/// and only those that may have such a face are looked at again.
class PlaneUnifier {
 public:
  /// `exactness` has an element for each primitive of the model by the time that it is added.
  PlaneUnifier(Model& model, const std::vector<Exactness>& exactness)
      : model_(model), exactness_(exactness) {}

  void reserve(std::size_t primitives) { sightings_.reserve(kNumbersEach * primitives); }
  /// Adds a primitive: each once, and meshes after all others, with which they are compared.
  void add(std::uint32_t primitive);
  /// Gives faces that lie in one plane the same plane; returns whether any face has changed.
  bool unify();

 private:
  template <typename Visit>
  void for_each_heading(std::uint32_t primitive, const Visit& visit) const;
  void collect(std::uint32_t primitive);
  Plane plane_of(std::uint32_t primitive, std::uint32_t slot) const;
  /// A point in the middle of the face.
  Vec3 anchor_of_face(std::uint32_t primitive, std::uint32_t slot) const;
  void add_levels(const Heading& heading, const Vec3& direction, std::vector<Level>& group) const;
  Level level_of(std::uint32_t primitive, std::uint32_t slot, const Vec3& direction) const;
  void unify_directions();
  void unify_direction(std::span<const Extent> cluster);
  void unify_offsets(const Vec3& direction, std::vector<Level> group);
  void set(const Level& level, const Vec3& direction, double offset, bool is_shared_plane);
  bool settle();
  std::size_t place_of_mesh(std::uint32_t primitive) const;

  /// Numbers for which reserve() takes memory: a box has six faces, a cylinder two, a sphere none.
  static constexpr std::size_t kNumbersEach = 4;

  Model& model_;
  const std::vector<Exactness>& exactness_;
  Sightings sightings_;
  /// Faces across each of the world's axes, and the headings of all other faces.
  std::array<std::vector<Level>, 3> along_;
  std::vector<Heading> others_;
  std::vector<MeshFaces> mesh_faces_;
  /// Primitives with the distance by which one of their faces has moved.
  std::vector<std::pair<std::uint32_t, double>> changed_;
};

}  // namespace graycube::csg
