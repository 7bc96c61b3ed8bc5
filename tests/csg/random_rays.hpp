// Rays made to be hard for a model: along axes, in the planes of faces, through corners and edges,
// tangent, from surfaces, from inside solids, from far away.
#pragma once

#include <cmath>
#include <optional>
#include <string>

#include "csg/box.hpp"
#include "csg/cylinder.hpp"
#include "csg/dice.hpp"
#include "csg/half_space.hpp"
#include "csg/whole_tree.hpp"

namespace graycube::testing {

/// A ray and the interval in which its crossings count.
struct RayCase {
  const char* what;
  Ray ray;
  double t0 = 0;
  double t1 = kInf;
};

/// The case with a unit direction, and in some cases another beginning and end.
inline RayCase with_random_ends(RayCase c, Dice& dice) {
  c.ray.direction = normalized(c.ray.direction);
  if (dice.one_in(6)) c.t0 = dice.between(-3, 3);
  if (dice.one_in(6)) c.t1 = c.t0 + dice.between(0, 8);
  return c;
}

inline constexpr std::size_t kRayCases = 9;

class RandomRays {
 public:
  RandomRays(std::uint64_t seed, const Model& model)
      : dice_(seed ^ 0x9E3779B97F4A7C15ull), model_(model), trees_(model) {}

  /// Makes a ray of kind number `kind` < kRayCases.
  RayCase make(std::size_t kind) { return with_random_ends(of_kind(kind), dice_); }

  Dice& dice() { return dice_; }

 private:
  RayCase of_kind(std::size_t kind) {
    switch (kind) {
      case 0: return {"anywhere", {dice_.point(6), dice_.unit_vector()}};
      case 1: return {"along an axis, on the grid", {dice_.grid_point(3), dice_.axis()}};
      case 2: return {"between grid points", between(dice_.grid_point(4), dice_.grid_point(4))};
      case 3: return {"in the plane of a face", in_a_face()};
      case 4: return {"through a corner of bounds", between(7 * dice_.unit_vector(), corner())};
      case 5: return from_surface();
      case 6: return {"from inside a solid", {inside_point(), dice_.unit_vector()}};
      case 7: return {"tangent to bounds", tangent()};
      default: return {"from far away", from_afar()};
    }
  }

  Ray between(const Vec3& from, const Vec3& to) {
    return {from, from == to ? dice_.axis() : to - from};
  }

  const Primitive& some_primitive() {
    return model_.primitives[dice_.below(model_.primitives.size())];
  }

  /// The plane of one of the primitive's faces; nothing if it has no plane faces.
  std::optional<Plane> face_of(const Primitive& p) {
    switch (p.kind) {
      case PrimitiveKind::kBox: {
        const std::size_t a = dice_.below(3);
        Vec3 n;
        n[static_cast<int>(a)] = 1;
        return Plane{n, csg::box_side(p.v, dice_.one_in(2) ? 0 : 1, a)};
      }
      case PrimitiveKind::kCylinder:
      case PrimitiveKind::kCone:
        return Plane{csg::cap_normal(p), dice_.one_in(2) ? csg::lower_cap(p) : csg::upper_cap(p)};
      case PrimitiveKind::kHalfSpace: return csg::half_space_plane(p);
      case PrimitiveKind::kPolyhedron:
        return model_.planes[p.first_plane + dice_.below(p.plane_count)];
      default: return std::nullopt;
    }
  }

  Ray in_a_face() {
    for (int tries = 0; tries < 8; ++tries) {
      const auto face = face_of(some_primitive());
      if (!face) continue;
      const Vec3 p = dice_.one_in(2) ? dice_.grid_point(3) : dice_.point(3);
      const Vec3 origin = p + (face->offset - dot(face->normal, p)) * face->normal;
      const Vec3 d = cross(face->normal, dice_.one_in(2) ? dice_.axis() : dice_.unit_vector());
      if (length(d) > 0.1) return {origin, d};
    }
    return {dice_.grid_point(3), dice_.axis()};
  }

  Aabb finite_bounds() {
    for (int tries = 0; tries < 8; ++tries) {
      const Aabb& b = some_primitive().bounds;
      if (b.is_finite()) return b;
    }
    return {{-1, -1, -1}, {1, 1, 1}};
  }
  Vec3 corner() { return finite_bounds().corner(static_cast<int>(dice_.below(8))); }

  /// A ray along an axis in a face of the bounds, which a sphere's, a cylinder's or a torus's
  /// surface touches.
  Ray tangent() {
    const Aabb b = finite_bounds();
    const int a = static_cast<int>(dice_.below(3));
    Vec3 origin = b.center();
    origin[a] = dice_.one_in(2) ? b.lo[a] : b.hi[a];
    Vec3 d;
    d[(a + 1 + static_cast<int>(dice_.below(2))) % 3] = dice_.sign();
    return {origin - 5 * d, d};
  }

  RayCase from_surface() {
    for (int tries = 0; tries < 8; ++tries) {
      const Ray ray{dice_.point(6), dice_.unit_vector()};
      const auto all = trees_.crossings_between(ray, 0, kInf);
      if (all.empty()) continue;
      const Vec3 p = ray.at(all[dice_.below(all.size())].t);
      return {"from a surface",
              {p, dice_.unit_vector()},
              dice_.one_in(2) ? 0 : 1e-9 * std::fmax(1, max_abs(p))};
    }
    return of_kind(0);
  }

  Vec3 inside_point() {
    for (int tries = 0; tries < 30; ++tries) {
      const Vec3 p = dice_.one_in(3) ? dice_.grid_point(2) : dice_.point(2);
      if (trees_.contains_point(dice_.below(trees_.object_count()), p)) return p;
    }
    return {0, 0, 0};
  }

  /// From a distance of up to 10^5 times the scene's size. Beyond 10^7 times the size, a point on a
  /// ray is rounded by as much as cells are grown, and the walk promises nothing.
  Ray from_afar() {
    const double distance = std::pow(10, dice_.between(1, 6));
    return between(distance * dice_.unit_vector(), dice_.point(2));
  }

  Dice dice_;
  const Model& model_;
  WholeTrees trees_;
};

}  // namespace graycube::testing
