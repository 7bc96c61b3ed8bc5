#include "coincidence/plane_unifier.hpp"

#include <algorithm>
#include <cmath>

#include "coincidence/faces.hpp"
#include "geometry/infinity.hpp"
#include "stop_point.hpp"
#include "stoppable_sort.hpp"

namespace graycube::csg {

namespace {

/// Faces through the origin are told apart by their directions, which weigh as much as an offset of
/// this many scene units.
constexpr double kDirectionWeight = 1;

/// The tolerance of the number of a face that lies no farther from the origin than `reach`.
double number_tolerance(double distance, double direction, double reach) {
  return 2 * distance + 8 * (reach + kDirectionWeight) * direction;
}

/// The largest absolute coordinate of the bounds; 0 if they are infinite.
double reach_of(const Aabb& bounds) {
  const double most = larger(max_abs(bounds.lo), max_abs(bounds.hi));
  return most < kInf ? most : 0.0;
}

}  // namespace

/// Calls visit(heading, number of its first face, number of its last face). The number is the same
/// whichever way the plane's normal looks, and differs for nearly all planes that differ: it is the
/// plane's place along a generic direction, seen along its normal.
template <typename Visit>
void PlaneUnifier::for_each_heading(std::uint32_t primitive, const Visit& visit) const {
  const Primitive& p = model_.primitives[primitive];
  const Exactness& exact = exactness_[primitive];
  const double distance = exact.distance(), reach = reach_of(p.bounds);
  const auto visit_faces = [&](const Heading& h, double first, double last) {
    const double along = dot(kGenericDirection, h.normal);
    const double farthest = larger(reach, larger(std::fabs(first), std::fabs(last)));
    const double tolerance = number_tolerance(distance, h.tolerance, farthest),
                 base = kDirectionWeight * along * along;
    visit(h, Measured{along * first + base, tolerance}, Measured{along * last + base, tolerance});
  };
  const double direction{exact.direction};
  switch (p.kind) {
    case PrimitiveKind::kMesh:
      mesh_faces_[place_of_mesh(primitive)].for_each([&](std::uint32_t number, const MeshFace& f) {
        visit_faces({f.plane.normal, f.direction_tolerance, primitive, number, 1}, f.plane.offset,
                    f.plane.offset);
      });
      return;
    // The most frequent kinds are handled without looking up planes.
    case PrimitiveKind::kBox:
      for (std::uint32_t a = 0; a < 3; ++a)
        visit_faces({world_axis(static_cast<int>(a)), direction, primitive, 2 * a, 2},
                    box_side(p.v, 0, a), box_side(p.v, 1, a));
      return;
    case PrimitiveKind::kParallelepiped:
      for (std::uint32_t a = 0; a < 3; ++a)
        visit_faces({p.to_local.row(static_cast<int>(a)), direction, primitive, 2 * a, 2},
                    box_side(p.v, 0, a), box_side(p.v, 1, a));
      return;
    default: break;
  }
  const std::uint32_t count = face_count(p), step = has_opposite_faces(p) ? 2 : 1;
  for (std::uint32_t slot = 0; slot < count; slot += step) {
    const Vec3 normal = heading_of(model_, p, slot);
    const double tolerance = p.plane_count > 0 ? direction_tolerance(p, normal, exact) : direction;
    visit_faces({normal, tolerance, primitive, slot, step}, offset_of(model_, p, slot),
                offset_of(model_, p, slot + step - 1));
  }
}

void PlaneUnifier::add(std::uint32_t primitive) {
  if (model_.primitives[primitive].kind == PrimitiveKind::kMesh)
    mesh_faces_.emplace_back(model_, primitive, exactness_[primitive]);
  for_each_heading(primitive, [&](const Heading& h, const Measured& first, const Measured& last) {
    sightings_.add(primitive, first);
    if (h.count == 2) sightings_.add(primitive, last);
  });
}

void PlaneUnifier::collect(std::uint32_t primitive) {
  for_each_heading(primitive, [&](const Heading& h, const Measured& first, const Measured& last) {
    if (!sightings_.may_meet(first) && (h.count == 1 || !sightings_.may_meet(last))) return;
    const int axis = world_axis_of(h);
    if (axis == 3) return others_.push_back(h);
    add_levels(h, world_axis(axis), along_[static_cast<std::size_t>(axis)]);
  });
}

bool PlaneUnifier::unify() {
  sightings_.for_each_candidate([&](std::uint32_t primitive) { collect(primitive); });
  for (int a = 0; a < 3; ++a)
    unify_offsets(world_axis(a), std::move(along_[static_cast<std::size_t>(a)]));
  unify_directions();
  return settle();
}

void PlaneUnifier::unify_directions() {
  std::vector<Extent> items(others_.size());
  for (std::uint32_t i = 0; i < others_.size(); ++i) items[i].item = i;
  const auto measure = [&](std::uint32_t i, int which) {
    return direction_number(others_[i], which);
  };
  for_each_cluster(std::move(items), kDirectionNumbers, measure,
                   [&](std::span<const Extent> cluster) { unify_direction(cluster); });
}

void PlaneUnifier::unify_direction(std::span<const Extent> cluster) {
  const Heading* best = &others_[cluster.front().item];
  for (const Extent& e : cluster) {
    if (is_better_direction(others_[e.item], *best)) best = &others_[e.item];
  }
  const Vec3 direction = turned_first(best->normal);
  std::vector<Level> group;
  std::vector<Vec3> anchors;
  Aabb around = Aabb::nothing();
  for (const Extent& e : cluster) {
    stop_if_asked();
    const Heading& h = others_[e.item];
    for (std::uint32_t slot = h.slot; slot < h.slot + h.count; ++slot) {
      group.push_back(level_of(h.primitive, slot, direction));
      anchors.push_back(anchor_of_face(h.primitive, slot));
      around.include(anchors.back());
    }
  }
  // Along a direction that is a little off, offsets of faces that are apart in one plane differ.
  // That error is measured from the place nearest the origin among the faces, since the distance
  // that they share separates none of them.
  Vec3 from;
  for (int a = 0; a < 3; ++a) from[a] = std::min(std::max(0.0, around.lo[a]), around.hi[a]);
  for (std::size_t i = 0; i < group.size(); ++i) {
    const Vec3 away = anchors[i] - from;
    group[i].tolerance += best->tolerance * length(away - dot(direction, away) * direction);
  }
  unify_offsets(direction, std::move(group));
}

/// Appends the levels of a heading's faces along a direction that its own can't be told from.
void PlaneUnifier::add_levels(const Heading& heading, const Vec3& direction,
                              std::vector<Level>& group) const {
  for (std::uint32_t slot = heading.slot; slot < heading.slot + heading.count; ++slot)
    group.push_back(level_of(heading.primitive, slot, direction));
}

Plane PlaneUnifier::plane_of(std::uint32_t primitive, std::uint32_t slot) const {
  return model_.primitives[primitive].kind == PrimitiveKind::kMesh
             ? mesh_faces_[place_of_mesh(primitive)].face(slot).plane
             : face_of(model_, primitive, slot).plane;
}

Vec3 PlaneUnifier::anchor_of_face(std::uint32_t primitive, std::uint32_t slot) const {
  const Primitive& p = model_.primitives[primitive];
  return p.kind == PrimitiveKind::kMesh ? mesh_faces_[place_of_mesh(primitive)].face(slot).middle
                                        : anchor_of(p, face_of(model_, primitive, slot).plane);
}

Level PlaneUnifier::level_of(std::uint32_t primitive, std::uint32_t slot,
                             const Vec3& direction) const {
  const Plane plane = plane_of(primitive, slot);
  Level level;
  level.primitive = primitive;
  level.slot = slot;
  level.is_of_mesh = model_.primitives[primitive].kind == PrimitiveKind::kMesh;
  level.is_backward = dot(direction, plane.normal) < 0;
  level.own = level.is_backward ? Plane{-plane.normal, -plane.offset} : plane;
  level.has_direction = level.own.normal == direction;
  // A face whose normal differs is turned about its middle.
  level.offset =
      level.has_direction ? level.own.offset : dot(direction, anchor_of_face(primitive, slot));
  const Vec3 position = exactness_[primitive].position();
  level.tolerance = std::fabs(direction.x) * position.x + std::fabs(direction.y) * position.y +
                    std::fabs(direction.z) * position.z;
  return level;
}

/// Unifies the offsets of faces whose normals are one direction or its opposite.
void PlaneUnifier::unify_offsets(const Vec3& direction, std::vector<Level> group) {
  const Planes planes(std::move(group));
  // If no planes coincide, or all that do are equal already, normals that differ in their last
  // places may stay as they are. Otherwise all get the same normal, so that opposite faces still
  // share one.
  if (!planes.has_unequal()) return;
  planes.for_each([&](std::span<const Level> plane, double offset) {
    stop_if_asked();
    const bool is_shared_plane = is_shared(plane);
    for (const Level& f : plane) set(f, direction, offset, is_shared_plane);
  });
}

void PlaneUnifier::set(const Level& level, const Vec3& direction, double offset,
                       bool is_shared_plane) {
  const Primitive& p = model_.primitives[level.primitive];
  const Plane plane{level.is_backward ? -direction : direction,
                    level.is_backward ? -offset : offset};
  if (p.kind == PrimitiveKind::kMesh) {
    if (is_shared_plane) mesh_faces_[place_of_mesh(level.primitive)].set(level.slot, plane);
    return;
  }
  if (level.has_direction && level.offset == offset) return;
  set_face(model_, {plane, level.primitive, level.slot});
  const bool is_turned = !level.has_direction && p.bounds.is_finite();
  const double turned =
      is_turned ? length(p.bounds.hi - p.bounds.lo) * exactness_[level.primitive].direction : 0.0;
  changed_.emplace_back(level.primitive, std::fabs(level.offset - offset) + turned);
}

bool PlaneUnifier::settle() {
  stoppable_sort(std::span(changed_));
  for (std::size_t i = 0; i < changed_.size(); ++i) {
    stop_if_asked();
    // The last entry of a primitive is that of the face that has moved most.
    if (i + 1 < changed_.size() && changed_[i + 1].first == changed_[i].first) continue;
    settle_faces(model_, changed_[i].first, changed_[i].second);
  }
  bool has_changed = !changed_.empty();
  for (MeshFaces& faces : mesh_faces_) has_changed = faces.settle(model_) || has_changed;
  return has_changed;
}

std::size_t PlaneUnifier::place_of_mesh(std::uint32_t primitive) const {
  const auto at =
      std::lower_bound(mesh_faces_.begin(), mesh_faces_.end(), primitive,
                       [](const MeshFaces& m, std::uint32_t p) { return m.primitive() < p; });
  return static_cast<std::size_t>(at - mesh_faces_.begin());
}

}  // namespace graycube::csg
