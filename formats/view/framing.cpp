#include "formats/view/framing.hpp"

#include <algorithm>
#include <cmath>
#include <variant>

#include "geometry/infinity.hpp"
#include "geometry/portable_math.hpp"

namespace graycube {
namespace {

constexpr double kTiltDegrees = 55;
constexpr double kTurnDegrees = 25;

/// In linear RGB, the light grey #f0f0f0.
constexpr Rgb kBackground{0.87, 0.87, 0.87};
constexpr Rgb kKeyLight{0.8, 0.8, 0.8};
constexpr Rgb kFillLight{0.35, 0.35, 0.35};
/// Distance of the lights, in radii of the bounding sphere, and their directions: right, up,
/// towards the eye.
constexpr double kLightDistance = 6;
constexpr Vec3 kKeyDirection{-0.7, 0.8, 0.9};
constexpr Vec3 kFillDirection{1.0, 0.25, 0.6};
/// Least distance of the eye from the bounding sphere's centre, in radii: it stays outside.
constexpr double kLeastEyeDistance = 1.05;

/// Tangents of half the angles of view, less the margin, across and up the picture.
struct Opening {
  double across, upright;
};

Opening opening(const Frame& frame) {
  const double across = tan_degrees(0.5 * frame.fov_degrees) * (1 - 2 * frame.margin);
  return {across, across * frame.image.height / frame.image.width};
}

double disc_reach(const Vec3& direction, const Vec3& center, const Vec3& axis, double radius) {
  const Vec3 in_plane = direction - dot(direction, axis) * axis;
  return dot(direction, center) + radius * length(in_plane);
}

/// The largest n · p over a leaf in its own coordinates.
struct LocalReach {
  const Vec3& n;
  std::span<const Vec3> corners;

  double operator()(const SphereShape& s) const { return dot(n, s.center) + s.radius * length(n); }
  double operator()(const BoxShape& s) const {
    double sum = 0;
    for (int a = 0; a < 3; ++a) sum += std::max(n[a] * s.min[a], n[a] * s.max[a]);
    return sum;
  }
  double operator()(const CylinderShape& s) const {
    const Vec3 axis = normalized(s.top - s.base);
    return std::max(disc_reach(n, s.base, axis, s.radius), disc_reach(n, s.top, axis, s.radius));
  }
  double operator()(const ConeShape& s) const {
    const Vec3 axis = normalized(s.top - s.base);
    return std::max(disc_reach(n, s.base, axis, s.base_radius),
                    disc_reach(n, s.top, axis, s.top_radius));
  }
  double operator()(const PolyhedronShape&) const {
    double largest = -kInf;
    for (const Vec3& corner : corners) largest = std::max(largest, dot(n, corner));
    return largest;
  }
  double operator()(const PrismShape& s) const {
    double largest = -kInf;
    for (const FlatPoint& p : s.points) largest = std::max(largest, n.x * p.x + n.y * p.y);
    return largest + std::max(n.z * s.base, n.z * (s.base + s.height));
  }
  double operator()(const MeshShape& s) const {
    double largest = -kInf;
    for (const Vec3& p : s.mesh.points) largest = std::max(largest, dot(n, p));
    return largest;
  }
  double operator()(const LatheShape& s) const {
    const double across = std::sqrt(n.x * n.x + n.y * n.y);
    double largest = -kInf;
    for (const OutlineLoop& loop : s.outline) {
      for (const OutlinePoint& p : loop) largest = std::max(largest, across * p.x + n.z * p.y);
    }
    return largest;
  }
  double operator()(const SweepShape& s) const {
    double largest = -kInf;
    for (const OutlineLoop& loop : s.outline) {
      for (const OutlinePoint& p : loop) largest = std::max(largest, n.x * p.x + n.y * p.y);
    }
    return largest + std::max(n.z * s.base, n.z * (s.base + s.height));
  }
  double operator()(const TorusShape& s) const {
    return disc_reach(n, s.center, normalized(s.axis), s.major) + s.minor * length(n);
  }
  double operator()(const EllipticTorusShape& s) const {
    const double longer = std::sqrt(s.outward * s.outward + s.upward * s.upward);
    return disc_reach(n, s.center, normalized(s.axis), s.radius) +
           std::max(longer, s.across) * length(n);
  }
  template <typename Other>
  double operator()(const Other&) const {
    return kInf;
  }
};

Reach reach_of_operation(const OperationNode& operation, const Affine& to_world,
                         const ReachDirections& directions) {
  const auto of = [&](const CsgNode& child) { return reach_of(child, {}, to_world, directions); };
  Reach reach = of(operation.children.front());
  if (operation.operation == Operation::kDifference) return reach;
  for (std::size_t i = 1; i < operation.children.size(); ++i) {
    const Reach other = of(operation.children[i]);
    reach = operation.operation == Operation::kUnion ? union_of(reach, other)
                                                     : intersection_of(reach, other);
  }
  return reach;
}

/// The nearest eye on this view from which the four sides of the pyramid enclose the solid,
/// symmetrically. A side's plane through the eye e lets points with n · p ≤ n · e through; n is,
/// for example, right − k forward.
Vec3 nearest_eye(const ViewAxes& view, const Opening& k, const Reach& reach) {
  const double right = reach.along[6], left = reach.along[7];
  const double upper = reach.along[8], lower = reach.along[9];
  const double depth =
      std::min(-(right + left) / (2 * k.across), -(upper + lower) / (2 * k.upright));
  return 0.5 * (right - left) * view.right + 0.5 * (upper - lower) * view.up + depth * view.forward;
}

Vec3 light_position(const ViewAxes& view, const Vec3& center, double radius,
                    const Vec3& direction) {
  const Vec3 d = normalized(direction);
  return center + kLightDistance * radius * (d.x * view.right + d.y * view.up - d.z * view.forward);
}

Reach reach_of_unit_cube(const ReachDirections& directions) {
  return reach_of(CsgNode{BoxShape{{-1, -1, -1}, {1, 1, 1}}, std::nullopt, kInheritMaterial}, {},
                  Affine{}, directions);
}

}  // namespace

ViewAxes ViewAxes::standard() {
  const double tilt = sin_degrees(kTiltDegrees), lift = cos_degrees(kTiltDegrees);
  const double s = sin_degrees(kTurnDegrees), c = cos_degrees(kTurnDegrees);
  // The direction from the eye, which the rotations turn to there from +z; right is forward × z:
  // not mirrored in right-handed axes.
  const Vec3 forward{-s * tilt, c * tilt, -lift};
  const Vec3 right{c, s, 0};
  return {right, cross(right, forward), forward};
}

ReachDirections reach_directions(const Frame& frame) {
  const ViewAxes view = ViewAxes::standard();
  const Opening k = opening(frame);
  const Vec3 across = k.across * view.forward, upright = k.upright * view.forward;
  return {Vec3{1, 0, 0},     Vec3{-1, 0, 0},    Vec3{0, 1, 0},       Vec3{0, -1, 0},
          Vec3{0, 0, 1},     Vec3{0, 0, -1},    view.right - across, -view.right - across,
          view.up - upright, -view.up - upright};
}

Reach Reach::nothing() {
  Reach result;
  result.along.fill(-kInf);
  return result;
}

Aabb Reach::box() const {
  return {{-along[1], -along[3], -along[5]}, {along[0], along[2], along[4]}};
}

Reach union_of(const Reach& a, const Reach& b) {
  Reach result;
  for (std::size_t i = 0; i < kReachDirections; ++i)
    result.along[i] = std::max(a.along[i], b.along[i]);
  return result;
}

Reach intersection_of(const Reach& a, const Reach& b) {
  Reach result;
  for (std::size_t i = 0; i < kReachDirections; ++i)
    result.along[i] = std::min(a.along[i], b.along[i]);
  return result;
}

Reach reach_of(const CsgNode& leaf, std::span<const Vec3> corners, const Affine& around,
               const ReachDirections& directions) {
  const Affine to_world = leaf.transform ? compose(around, *leaf.transform) : around;
  if (const auto* operation = std::get_if<OperationNode>(&leaf.value)) {
    return reach_of_operation(*operation, to_world, directions);
  }
  Reach result;
  for (std::size_t i = 0; i < kReachDirections; ++i) {
    const Vec3 local = to_world.transposed_vector(directions[i]);
    result.along[i] = dot(directions[i], to_world.translation()) +
                      std::visit(LocalReach{local, corners}, leaf.value);
  }
  return result;
}

RenderSettings framed_settings(const Reach& reach, const Frame& frame) {
  const ReachDirections directions = reach_directions(frame);
  const Reach framed = reach.box().is_empty() ? reach_of_unit_cube(directions) : reach;
  const Aabb box = framed.box();
  const Vec3 center = box.center();
  const double radius = 0.5 * length(box.hi - box.lo);
  const ViewAxes view = ViewAxes::standard();

  // The reach kept of an intersection is only an upper bound, and might place the eye inside.
  Vec3 eye = nearest_eye(view, opening(frame), framed);
  const double inside = dot(eye - center, view.forward) + kLeastEyeDistance * radius;
  if (inside > 0) eye = eye - inside * view.forward;

  RenderSettings settings;
  settings.image = frame.image;
  settings.camera.projection = Projection::kPerspective;
  settings.camera.eye = eye;
  settings.camera.look_at = eye + dot(center - eye, view.forward) * view.forward;
  settings.camera.up = {0, 0, 1};
  settings.camera.fov_degrees = frame.fov_degrees;
  settings.camera.handedness = Handedness::kRight;
  settings.background = kBackground;
  settings.max_depth = frame.max_depth;
  settings.lights = {
      {light_position(view, center, radius, kKeyDirection), kKeyLight, Falloff::kNone},
      {light_position(view, center, radius, kFillDirection), kFillLight, Falloff::kNone}};
  return settings;
}

}  // namespace graycube
