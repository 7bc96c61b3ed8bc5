#include "bezier/division.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "geometry/aabb.hpp"
#include "mesh/triangle_mesh.hpp"

namespace graycube {
namespace {

/// Upper bounds of the lengths of a patch's second derivatives. By the convex hull property each is
/// the largest of the control points of the derivative, itself a Bézier patch: second differences
/// times 3 · 2, mixed ones times 3 · 3.
struct SecondDerivatives {
  double uu = 0, uv = 0, vv = 0;
};

SecondDerivatives second_derivatives(const BezierNet& net, const BezierPatch& patch) {
  const auto point = [&](std::size_t row, std::size_t column) {
    return net.point(patch, row, column);
  };
  SecondDerivatives most;
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = 0; j < 2; ++j) {
      const Vec3 along_u = point(i, j) - 2 * point(i, j + 1) + point(i, j + 2);
      const Vec3 along_v = point(j, i) - 2 * point(j + 1, i) + point(j + 2, i);
      most.uu = std::max(most.uu, 6 * length(along_u));
      most.vv = std::max(most.vv, 6 * length(along_v));
    }
  }
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      const Vec3 twist = point(i, j) - point(i + 1, j) - point(i, j + 1) + point(i + 1, j + 1);
      most.uv = std::max(most.uv, 9 * length(twist));
    }
  }
  return most;
}

/// The least levels at which triangles are within the tolerance; nothing beyond kMaxBezierLevel.
///
/// A point of a triangle whose corners lie in a cell of a × b in the patch's parameters differs
/// from the patch's point at the same parameters by at most ⅛ (a² uu + 2ab uv + b² vv): by Taylor's
/// formula it is half the mean, weighted by the barycentric coordinates, of the second derivatives
/// along the ways to the corners; these ways have the mean 0, and within a length a no mean square
/// is above a²/4. (For right triangles: Filip, Magedson and Markot 1986.)
std::optional<BezierDivision::Levels> levels_for(const SecondDerivatives& most, double tolerance) {
  BezierDivision::Levels levels;
  for (;;) {
    const double a = std::ldexp(1, -static_cast<int>(levels.u));
    const double b = std::ldexp(1, -static_cast<int>(levels.v));
    const double by_u = a * a * most.uu, by_v = b * b * most.vv;
    if ((by_u + 2 * a * b * most.uv + by_v) / 8 <= tolerance) return levels;
    const bool u_is_coarser = by_u > by_v || (by_u == by_v && levels.u <= levels.v);
    ++(u_is_coarser ? levels.u : levels.v);
    if (std::max(levels.u, levels.v) > kMaxBezierLevel) return std::nullopt;
  }
}

std::uint32_t level_along(const BezierDivision::Levels& levels, std::size_t side) {
  return side % 2 == 0 ? levels.u : levels.v;
}

/// Triangles of a patch: two a cell; a cell that a finer side cuts has one for each part of its
/// outline.
std::uint64_t triangles_of(const BezierDivision& division, std::size_t patch) {
  const auto& levels = division.patches[patch];
  std::uint64_t count = std::uint64_t{2} << (levels.u + levels.v);
  for (std::size_t side = 0; side < 4; ++side) {
    const std::uint32_t own = level_along(levels, side);
    const std::uint32_t curve = division.curves[division.side(patch, side).curve];
    if (curve > own) count += (std::uint64_t{1} << curve) + (std::uint64_t{1} << own);
  }
  return count;
}

MeshFault too_fine() {
  return {"a tolerance so fine takes more than " + std::to_string(kMaxMeshTriangles) +
          " triangles"};
}

}  // namespace

double default_tolerance(const BezierNet& net) {
  Aabb box = Aabb::nothing();
  for (const Vec3& p : net.points) box.include(p);
  return box.is_empty() ? kDefaultBezierShare : kDefaultBezierShare * max_abs(box.hi - box.lo);
}

std::variant<BezierDivision, MeshFault> division_of(const BezierNet& net, double tolerance) {
  BezierDivision division;
  division.sides = sides_of(net);
  if (auto fault = open_side(net, division.sides)) return *std::move(fault);
  division.curves.resize(division.sides.curves.size(), 0);
  for (std::size_t p = 0; p < net.patches.size(); ++p) {
    const auto levels = levels_for(second_derivatives(net, net.patches[p]), tolerance);
    if (!levels) return too_fine();
    division.patches.push_back(*levels);
    for (std::size_t s = 0; s < 4; ++s) {
      std::uint32_t& curve = division.curves[division.side(p, s).curve];
      curve = std::max(curve, level_along(*levels, s));
    }
  }
  for (std::size_t p = 0; p < net.patches.size(); ++p)
    division.triangles += triangles_of(division, p);
  if (division.triangles > kMaxMeshTriangles) return too_fine();
  return division;
}

}  // namespace graycube
