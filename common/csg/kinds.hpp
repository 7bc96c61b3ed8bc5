// The table of the kinds of primitives: one row for each, with all that the engine must know of it.
// The functions that a row names are in the kind's own file.
#pragma once

#include <array>
#include <functional>
#include <string_view>
#include <type_traits>

#include "csg/box.hpp"
#include "csg/cylinder.hpp"
#include "csg/elliptic_cone.hpp"
#include "csg/elliptic_torus.hpp"
#include "csg/half_space.hpp"
#include "csg/quadric.hpp"
#include "csg/sphere.hpp"
#include "csg/torus.hpp"
#include "outline/lathe.hpp"
#include "outline/sweep.hpp"

namespace graycube::csg {

/// The functions of csg/primitive.hpp, for one kind.
struct Solvers {
  Spans (*spans)(const Primitive&, const PrimitiveData&, const Ray&);
  bool (*contains)(const Primitive&, const PrimitiveData&, const Vec3&);
  Vec3 (*normal)(const Primitive&, const PrimitiveData&, const Ray&, double t);
  CellSide (*classify)(const Primitive&, const PrimitiveData&, const Aabb&);
};

struct KindTraits {
  PrimitiveKind kind;
  std::string_view name;
  Solvers solvers;
  /// A line may be inside it in two intervals (or more). Other kinds are solved for several rays at
  /// once (crossings/packet_intervals-inl.hpp).
  bool has_two_intervals = false;
  /// The number of its intervals has no bound.
  bool has_many_intervals = false;
  /// It can be solved from its slots alone.
  bool is_all_slots = false;
  /// Its solver mostly solves a quartic, which WalkCounts counts.
  bool is_quartic = false;
  /// Moves the surface outwards, appending moved planes; null if no solid of the kind can be that.
  bool (*move)(Primitive&, const PrimitiveData&, double by, std::vector<Plane>&) = nullptr;
  /// The bounds of a solid that was moved outwards; null if its bounds just grow by as much.
  Aabb (*grown_bounds)(const Primitive&, double by) = nullptr;
};

inline PlacedOutline placed_outline(const Primitive& p, const PrimitiveData& data) {
  return {
      data.outlines[p.outline], p.to_local, p.bounds, cap_normal(p), lower_cap(p), upper_cap(p)};
}

/// Calls a kind's function with what it asks for: the primitive, its faces, both, its outline, or
/// its mesh.
template <auto function, typename... Arguments>
auto ask(const Primitive& p, const PrimitiveData& data, const Arguments&... arguments) {
  using F = decltype(function);
  using Faces = std::span<const Plane>;
  if constexpr (std::is_invocable_v<F, const Primitive&, const Arguments&...>) {
    return function(p, arguments...);
  } else if constexpr (std::is_invocable_v<F, const Primitive&, Faces, const Arguments&...>) {
    return function(p, faces_of(p, data.planes), arguments...);
  } else if constexpr (std::is_invocable_v<F, Faces, const Arguments&...>) {
    return function(faces_of(p, data.planes), arguments...);
  } else if constexpr (std::is_invocable_v<F, const PlacedOutline&, const Arguments&...>) {
    return function(placed_outline(p, data), arguments...);
  } else {
    return std::invoke(function, data.meshes[p.mesh], arguments...);
  }
}

/// A kind's solvers. `normal` may take the point, or the ray and its parameter.
template <auto spans, auto contains, auto normal, auto classify>
constexpr Solvers solvers() {
  return {[](const Primitive& p, const PrimitiveData& data, const Ray& ray) {
            return ask<spans>(p, data, ray);
          },
          [](const Primitive& p, const PrimitiveData& data, const Vec3& point) {
            return ask<contains>(p, data, point);
          },
          [](const Primitive& p, const PrimitiveData& data, const Ray& ray, double t) {
            if constexpr (std::is_invocable_v<decltype(normal), const Primitive&, const Vec3&>) {
              return normal(p, ray.at(t));
            } else {
              return ask<normal>(p, data, ray, t);
            }
          },
          [](const Primitive& p, const PrimitiveData& data, const Aabb& cell) {
            return ask<classify>(p, data, cell);
          }};
}

/// Wraps a move that needs no planes for KindTraits::move.
template <auto function>
bool plain_move(Primitive& p, const PrimitiveData&, double by, std::vector<Plane>&) {
  return function(p, by);
}
inline bool move_faces(Primitive& p, const PrimitiveData& data, double by,
                       std::vector<Plane>& planes) {
  return move_polyhedron(p, faces_of(p, data.planes), by, planes);
}

/// In the order of PrimitiveKind, whose values go over the wire.
inline constexpr std::array<KindTraits, kPrimitiveKinds> kKinds{{
    {.kind = PrimitiveKind::kSphere,
     .name = "sphere",
     .solvers = solvers<sphere_spans, sphere_contains, sphere_normal, classify_sphere>(),
     .is_all_slots = true,
     .move = plain_move<move_sphere>},
    {.kind = PrimitiveKind::kEllipsoid,
     .name = "ellipsoid",
     .solvers =
         solvers<ellipsoid_spans, ellipsoid_contains, ellipsoid_normal, classify_ellipsoid>(),
     .move = plain_move<move_ellipsoid>,
     .grown_bounds = bounds_grown_around},
    {.kind = PrimitiveKind::kBox,
     .name = "box",
     .solvers = solvers<box_spans, box_contains, box_normal, classify_box>(),
     .is_all_slots = true,
     .move = plain_move<move_box>},
    {.kind = PrimitiveKind::kParallelepiped,
     .name = "parallelepiped",
     .solvers = solvers<parallelepiped_spans, parallelepiped_contains, parallelepiped_normal,
                        classify_parallelepiped>(),
     .move = plain_move<move_box>,
     .grown_bounds = grown_parallelepiped_bounds},
    {.kind = PrimitiveKind::kCylinder,
     .name = "cylinder",
     .solvers = solvers<cylinder_spans, cylinder_contains, cylinder_normal, classify_cylinder>(),
     .move = plain_move<move_cylinder>,
     .grown_bounds = grown_cylinder_bounds},
    {.kind = PrimitiveKind::kCone,
     .name = "cone",
     .solvers = solvers<cone_spans, cone_contains, cone_normal, classify_cone>(),
     .move = plain_move<move_cone>,
     .grown_bounds = grown_cone_bounds},
    {.kind = PrimitiveKind::kTorus,
     .name = "torus",
     .solvers = solvers<torus_spans, torus_contains, torus_normal, classify_torus>(),
     .has_two_intervals = true,
     .is_quartic = true,
     .move = plain_move<move_torus>,
     .grown_bounds = bounds_grown_around},
    {.kind = PrimitiveKind::kHalfSpace,
     .name = "half_space",
     .solvers =
         solvers<half_space_spans, half_space_contains, half_space_normal, classify_half_space>(),
     .is_all_slots = true,
     .move = plain_move<move_half_space>},
    {.kind = PrimitiveKind::kPolyhedron,
     .name = "polyhedron",
     .solvers =
         solvers<polyhedron_spans, polyhedron_contains, polyhedron_normal, classify_polyhedron>(),
     .move = move_faces},
    {.kind = PrimitiveKind::kEllipticCone,
     .name = "elliptic_cone",
     .solvers = solvers<elliptic_cone_spans, elliptic_cone_contains, elliptic_cone_normal,
                        classify_elliptic_cone>(),
     .has_two_intervals = true},
    {.kind = PrimitiveKind::kEllipticTorus,
     .name = "elliptic_torus",
     .solvers = solvers<elliptic_torus_spans, elliptic_torus_contains, elliptic_torus_normal,
                        classify_elliptic_torus>(),
     .has_two_intervals = true,
     .is_quartic = true},
    {.kind = PrimitiveKind::kQuadric,
     .name = "quadric",
     .solvers = solvers<quadric_spans, quadric_contains, quadric_normal, classify_quadric>(),
     .has_two_intervals = true},
    {.kind = PrimitiveKind::kMesh,
     .name = "mesh",
     .solvers = solvers<&Mesh::spans, &Mesh::contains, &Mesh::outward_normal, &Mesh::classify>(),
     .has_two_intervals = true,
     .has_many_intervals = true},
    {.kind = PrimitiveKind::kLathe,
     .name = "lathe",
     .solvers = solvers<lathe_spans, lathe_contains, lathe_normal, classify_lathe>(),
     .has_two_intervals = true,
     .has_many_intervals = true},
    {.kind = PrimitiveKind::kSweep,
     .name = "sweep",
     .solvers = solvers<sweep_spans, sweep_contains, sweep_normal, classify_sweep>(),
     .has_two_intervals = true,
     .has_many_intervals = true},
}};

constexpr const KindTraits& traits_of(PrimitiveKind kind) {
  return kKinds[static_cast<std::size_t>(kind)];
}

/// A mask in which bit k tells that kind number k has a trait: a quick test for code that asks for
/// every literal of every ray.
constexpr std::uint32_t kinds_with(bool KindTraits::*trait) {
  std::uint32_t mask = 0;
  for (std::size_t k = 0; k < kKinds.size(); ++k) mask |= std::uint32_t{kKinds[k].*trait} << k;
  return mask;
}
constexpr bool is_among(PrimitiveKind kind, std::uint32_t mask) {
  return (mask >> static_cast<unsigned>(kind) & 1) != 0;
}

static_assert(
    [] {
      for (std::size_t k = 0; k < kKinds.size(); ++k) {
        if (kKinds[k].kind != static_cast<PrimitiveKind>(k)) return false;
      }
      return true;
    }(),
    "a row a kind, in the order of PrimitiveKind");

}  // namespace graycube::csg
