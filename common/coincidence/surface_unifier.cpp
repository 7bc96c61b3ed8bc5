#include "coincidence/surface_unifier.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "coincidence/clusters.hpp"
#include "csg/cylinder.hpp"
#include "csg/elliptic_cone.hpp"
#include "csg/elliptic_torus.hpp"
#include "csg/quadric.hpp"
#include "csg/torus.hpp"
#include "stop_point.hpp"

namespace graycube::csg {
namespace {

void copy_rows(const Affine& from, int count, Affine& to) {
  for (int i = 0; i < count; ++i)
    to.m[static_cast<std::size_t>(i)] = from.m[static_cast<std::size_t>(i)];
}

/// Whether the other cone is on the same half (nappe) of the double cone.
bool is_on_same_nappe(const Primitive& cone, const Primitive& other) {
  const auto to_world = other.to_local.inverse();
  if (!to_world) return false;
  const Vec3 inside = cone.to_local.point(to_world->point({0, 0, 0}));
  return 1 + cone_slope(cone) * inside.z > 0;
}

void divide_row(Affine& map, std::size_t row, double by) {
  for (double& x : map.m[row]) x /= by;
}

/// Makes a cone whose ends are equal a cylinder, an elliptic torus that is round a torus, and
/// brings a quadric that is a cylinder to one form; all up to `tolerance` (scene units).
void simplify(Primitive& p, double tolerance) {
  if (p.kind != PrimitiveKind::kCone && p.kind != PrimitiveKind::kEllipticTorus &&
      p.kind != PrimitiveKind::kQuadric)
    return;
  // The tolerance in the frame, across the axis.
  const double local = tolerance * larger(length(p.to_local.row(0)), length(p.to_local.row(1)));
  // Surfaces known worse than this (those beyond the range of floats, for example) are left alone.
  constexpr double kWorst = 1e-3;
  if (!(local < kWorst)) return;
  if (p.kind == PrimitiveKind::kCone && std::fabs(cone_slope(p)) <= local) {
    p.kind = PrimitiveKind::kCylinder;
    set_cone_slope(p, 0);
  }
  if (p.kind == PrimitiveKind::kEllipticTorus) {
    const Vec3 ellipse = ellipse_of(p);
    const double minor = 1 / std::sqrt(larger(ellipse.x, ellipse.z));
    const double off = 2 * local / (minor * minor * minor);
    if (std::fabs(ellipse.x - ellipse.z) <= off && std::fabs(ellipse.y) <= off) {
      p.kind = PrimitiveKind::kTorus;
      p.v = torus_slots(minor);
    }
  }
  if (p.kind != PrimitiveKind::kQuadric) return;
  const auto [of_yy, of_zz, of_z, of_one] = quadric_coefficients(p);
  if (of_yy > 0 && of_zz == 0 && of_z == 0 && of_one < 0) {
    divide_row(p.to_local, 0, std::sqrt(-of_one));
    divide_row(p.to_local, 1, std::sqrt(-of_one / of_yy));
    p.v = quadric_slots({1, 0, 0, -1});
  }
}

/// Gives the primitive the other's surface; its caps and faces stay its own.
void take_surface(const Primitive& from, Primitive& p) {
  switch (family_of(p)) {
    case SurfaceFamily::kBall:
    case SurfaceFamily::kTorus:
    case SurfaceFamily::kEllipticTorus:
      p.kind = from.kind;
      p.v = from.v;
      p.to_local = from.to_local;
      p.bounds = from.bounds;
      return;
    case SurfaceFamily::kCylinder: copy_rows(from.to_local, 2, p.to_local); return;
    case SurfaceFamily::kCone:
      if (!is_on_same_nappe(from, p)) return;
      [[fallthrough]];
    case SurfaceFamily::kEllipticCone:
      p.to_local = from.to_local;
      if (p.kind == PrimitiveKind::kCone) set_cone_slope(p, cone_slope(from));
      if (p.kind == PrimitiveKind::kEllipticCone) set_second_slope(p, second_slope(from));
      return;
    case SurfaceFamily::kQuadric:
      p.to_local = from.to_local;
      p.v = from.v;
      return;
    case SurfaceFamily::kNone: return;
  }
}

}  // namespace

void SurfaceUnifier::add(std::uint32_t primitive) {
  Primitive& p = model_.primitives[primitive];
  const Exactness& exact = exactness_[primitive];
  simplify(p, exact.distance());
  if (family_of(p) != SurfaceFamily::kNone) sightings_.add(primitive, surface_number(p, exact, 0));
}

bool SurfaceUnifier::unify() {
  sightings_.for_each_candidate([&](std::uint32_t primitive) {
    const SurfaceFamily family = family_of(model_.primitives[primitive]);
    families_[static_cast<std::size_t>(family)].push_back({0, 0, primitive});
  });
  const auto measure = [&](std::uint32_t i, int which) {
    return surface_number(model_.primitives[i], exactness_[i], which);
  };
  const auto unify = [&](std::span<const Extent> cluster) { unify_cluster(cluster); };
  for (std::size_t f = 0; f < families_.size(); ++f) {
    for_each_cluster(std::move(families_[f]), number_count(static_cast<SurfaceFamily>(f)), measure,
                     unify);
  }
  return has_changed_;
}

/// Prefers simpler kinds, then the better known; beyond that the choice is arbitrary but fixed.
bool SurfaceUnifier::is_better(std::uint32_t a, std::uint32_t b) const {
  const Primitive &p = model_.primitives[a], &q = model_.primitives[b];
  if (p.kind != q.kind) return p.kind < q.kind;
  const double x = exactness_[a].distance(), y = exactness_[b].distance();
  return std::tie(x, p.to_local.m, p.v) < std::tie(y, q.to_local.m, q.v);
}

void SurfaceUnifier::unify_cluster(std::span<const Extent> cluster) {
  std::uint32_t best = cluster.front().item;
  for (const Extent& e : cluster) {
    if (is_better(e.item, best)) best = e.item;
  }
  const Primitive from = model_.primitives[best];
  for (const Extent& e : cluster) {
    stop_if_asked();
    Primitive& p = model_.primitives[e.item];
    const Primitive before = p;
    take_surface(from, p);
    if (p == before) continue;
    has_changed_ = true;
    if (p.bounds != before.bounds) continue;
    p.bounds = p.bounds.grown(2 * exactness_[e.item].distance());
  }
}

}  // namespace graycube::csg
