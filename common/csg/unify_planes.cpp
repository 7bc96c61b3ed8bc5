#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "csg/clusters.hpp"
#include "csg/coincidence.hpp"
#include "csg/faces.hpp"
#include "csg/mesh_faces.hpp"
#include "geometry/check.hpp"

namespace graycube {
namespace {

using csg::Extent;
using csg::Face;
using csg::Measured;

/// One or two faces of a primitive with one direction: those numbered `slot` and, of a pair, slot + 1.
struct Heading {
  Vec3 normal;
  double tolerance = 0;
  std::uint32_t primitive = 0;
  std::uint32_t slot = 0;
  std::uint32_t count = 1;
};

/// A face as seen along the direction of its group.
struct Level {
  double offset = 0;
  double tolerance = 0;
  std::uint32_t primitive = 0;
  std::uint32_t slot : 30;
  std::uint32_t is_backward : 1;
  /// Its normal is the group's already, bit for bit.
  std::uint32_t has_direction : 1;
};

/// The world's axis that the normal is along, to within the tolerance; 3 for none.
int world_axis_of(const Vec3& n, double tolerance) {
  for (int a = 0; a < 3; ++a) {
    if (std::fabs(n[(a + 1) % 3]) <= tolerance && std::fabs(n[(a + 2) % 3]) <= tolerance) return a;
  }
  return 3;
}

Vec3 world_axis(int axis) {
  Vec3 e;
  e[axis] = 1;
  return e;
}

/// Products of two coordinates don't tell a direction from its opposite. By the first of these numbers nearly all directions
/// part that differ.
constexpr int kDirectionNumbers = 6;
Measured direction_number(const Heading& h, int dimension) {
  const Vec3& n = h.normal;
  const double tolerance = 2 * h.tolerance;
  switch (dimension) {
    case 0: {
      constexpr Vec3 kGeneric{0.5359, 0.6411, 0.5497};
      const double along = dot(kGeneric, n);
      return {along * along, tolerance};
    }
    case 1: return {n.x * n.y, tolerance};
    case 2: return {n.y * n.z, tolerance};
    case 3: return {n.z * n.x, tolerance};
    case 4: return {n.x * n.x, tolerance};
    default: return {n.y * n.y, tolerance};
  }
}

/// The opposite that comes first; a choice among bits, not a measurement.
Vec3 turned_first(const Vec3& n) {
  const bool is_backward = n.x != 0 ? n.x < 0 : n.y != 0 ? n.y < 0 : n.z < 0;
  return is_backward ? -n + Vec3{} : n;
}

bool is_better_direction(const Heading& a, const Heading& b) {
  if (a.tolerance != b.tolerance) return a.tolerance < b.tolerance;
  const Vec3 u = turned_first(a.normal), v = turned_first(b.normal);
  return std::tie(u.x, u.y, u.z) < std::tie(v.x, v.y, v.z);
}

/// Finds the least distance above 0 between faces of one primitive that look opposite ways.
class ThicknessFinder {
 public:
  void add(double offset, bool is_backward) {
    const auto own = static_cast<std::size_t>(is_backward), other = 1 - own;
    for (const double seen : {last_[other], before_[other]}) {
      if (seen < offset) least_ = std::min(least_, offset - seen);
    }
    if (offset > last_[own]) before_[own] = std::exchange(last_[own], offset);
  }
  double least() const { return least_; }

 private:
  static constexpr double kNone = -std::numeric_limits<double>::infinity();
  /// By side: the greatest offset so far, and the greatest below it.
  std::array<double, 2> last_{kNone, kNone}, before_{kNone, kNone};
  double least_ = std::numeric_limits<double>::infinity();
};

class PlaneUnifier {
 public:
  PlaneUnifier(Model& model, std::span<const Exactness> exactness) : model_(model), exactness_(exactness) {}

  void run() {
    for (std::uint32_t i = 0; i < model_.primitives.size(); ++i) gather(i);
    for (int a = 0; a < 3; ++a) unify_offsets(world_axis(a), along_[static_cast<std::size_t>(a)]);
    unify_directions();
    settle();
  }

 private:
  void gather(std::uint32_t primitive) {
    const Primitive& p = model_.primitives[primitive];
    const Exactness& exact = exactness_[primitive];
    if (p.kind == PrimitiveKind::kMesh) return gather_mesh(primitive);
    const std::uint32_t count = csg::face_count(p);
    const std::uint32_t step = csg::has_opposite_faces(p) ? 2 : 1;
    for (std::uint32_t slot = 0; slot < count; slot += step) {
      // Of a pair the second looks along the normal.
      const Plane plane = csg::face_of(model_, primitive, slot + step - 1).plane;
      add({plane.normal, csg::direction_tolerance(p, plane, exact), primitive, slot, step});
    }
  }

  void gather_mesh(std::uint32_t primitive) {
    mesh_faces_.emplace_back(model_, primitive, exactness_[primitive]);
    mesh_faces_.back().for_each([&](std::uint32_t triangle, const csg::MeshFace& f) {
      add({f.plane.normal, f.direction_tolerance, primitive, triangle, 1});
    });
  }

  void add(const Heading& heading) {
    const int axis = world_axis_of(heading.normal, heading.tolerance);
    if (axis == 3) {
      others_.push_back(heading);
    } else {
      add_levels(heading, world_axis(axis), 0, along_[static_cast<std::size_t>(axis)]);
    }
  }

  /// The heading's faces along a direction that its own can't be told from.
  void add_levels(const Heading& heading, const Vec3& direction, double direction_tolerance, std::vector<Level>& group) {
    for (std::uint32_t i = 0; i < heading.count; ++i) {
      group.push_back(level_of(heading.primitive, heading.slot + i, direction, direction_tolerance));
    }
  }

  Level level_of(std::uint32_t primitive, std::uint32_t slot, const Vec3& direction, double direction_tolerance) {
    const Primitive& p = model_.primitives[primitive];
    const bool is_mesh = p.kind == PrimitiveKind::kMesh;
    const csg::MeshFace of_mesh = is_mesh ? mesh_of(primitive).face(slot) : csg::MeshFace{};
    const Plane plane = is_mesh ? of_mesh.plane : csg::face_of(model_, primitive, slot).plane;
    const Vec3 anchor = is_mesh ? of_mesh.middle : csg::anchor_of(p, plane);
    const bool is_backward = dot(direction, plane.normal) < 0;
    const bool has_direction = (is_backward ? -plane.normal : plane.normal) == direction;
    // Otherwise it is turned about its middle.
    const double offset =
        !has_direction ? dot(direction, anchor) : is_backward ? -plane.offset : plane.offset;
    const Vec3& position = exactness_[primitive].position;
    // What faces in one plane but far apart come to, seen along a direction that is a little off.
    const double beside = direction_tolerance > 0 ? length(anchor - offset * direction) : 0;
    const double tolerance = std::fabs(direction.x) * position.x + std::fabs(direction.y) * position.y +
                             std::fabs(direction.z) * position.z + direction_tolerance * beside;
    return {offset, tolerance, primitive, slot & 0x3FFFFFFFu, is_backward ? 1u : 0u, has_direction ? 1u : 0u};
  }

  void unify_directions() {
    std::vector<Extent> items(others_.size());
    for (std::uint32_t i = 0; i < others_.size(); ++i) items[i].item = i;
    const auto measure = [&](std::uint32_t i, int dimension) { return direction_number(others_[i], dimension); };
    const auto unify = [&](std::span<const Extent> cluster) {
      const Heading* best = &others_[cluster.front().item];
      for (const Extent& e : cluster) {
        if (is_better_direction(others_[e.item], *best)) best = &others_[e.item];
      }
      const Vec3 direction = turned_first(best->normal);
      std::vector<Level> group;
      for (const Extent& e : cluster) add_levels(others_[e.item], direction, best->tolerance, group);
      unify_offsets(direction, group);
    };
    csg::for_each_cluster(std::move(items), kDirectionNumbers, measure, unify);
  }

  /// Of faces whose normals are one direction, or its opposite.
  void unify_offsets(const Vec3& direction, std::vector<Level>& group) {
    std::vector<Extent> extents;
    extents.reserve(group.size());
    for (std::uint32_t i = 0; i < group.size(); ++i) {
      extents.push_back({group[i].offset - group[i].tolerance, group[i].offset + group[i].tolerance, i});
    }
    csg::for_each_run(std::span(extents), [&](std::span<Extent> run) { unify_run(direction, group, run); });
  }

  /// Of faces that may lie in one plane. A solid never becomes thinner than it was written: where opposite faces of one are
  /// in the run, its numbers are better than was thought.
  void unify_run(const Vec3& direction, const std::vector<Level>& group, std::span<Extent> run) {
    const double gap = least_thickness(group, run);
    if (!(gap < std::numeric_limits<double>::infinity())) return replace(direction, group, run);
    constexpr double kShareOfGap = 1.0 / 8;
    for (Extent& e : run) {
      const Level& f = group[e.item];
      const double tolerance = std::min(f.tolerance, kShareOfGap * gap);
      e.lo = f.offset - tolerance;
      e.hi = f.offset + tolerance;
    }
    csg::for_each_run(run, [&](std::span<Extent> part) { replace(direction, group, part); });
  }

  double least_thickness(const std::vector<Level>& group, std::span<const Extent> run) {
    double least = std::numeric_limits<double>::infinity();
    if (run.size() < 2) return least;
    sides_.clear();
    for (const Extent& e : run) sides_.push_back(&group[e.item]);
    std::sort(sides_.begin(), sides_.end(), [](const Level* a, const Level* b) {
      return std::tie(a->primitive, a->offset) < std::tie(b->primitive, b->offset);
    });
    for (std::size_t first = 0; first < sides_.size();) {
      ThicknessFinder finder;
      std::size_t i = first;
      for (; i < sides_.size() && sides_[i]->primitive == sides_[first]->primitive; ++i) {
        finder.add(sides_[i]->offset, sides_[i]->is_backward != 0);
      }
      least = std::min(least, finder.least());
      first = i;
    }
    return least;
  }

  /// Gives all faces of the run the plane of the one that is known best.
  void replace(const Vec3& direction, const std::vector<Level>& group, std::span<const Extent> run) {
    const Level* best = &group[run.front().item];
    bool is_shared = false;
    for (const Extent& e : run) {
      const Level& f = group[e.item];
      is_shared = is_shared || f.primitive != best->primitive;
      if (std::tie(f.tolerance, f.offset) < std::tie(best->tolerance, best->offset)) best = &f;
    }
    for (const Extent& e : run) {
      const Level& f = group[e.item];
      if (f.has_direction != 0 && f.offset == best->offset && mesh_faces_.empty()) continue;
      set(f, direction, best->offset, is_shared);
    }
  }

  void set(const Level& f, const Vec3& direction, double offset, bool is_shared) {
    const Primitive& p = model_.primitives[f.primitive];
    const bool is_backward = f.is_backward != 0;
    const Plane plane{is_backward ? -direction : direction, is_backward ? -offset : offset};
    if (p.kind == PrimitiveKind::kMesh) {
      if (is_shared) mesh_of(f.primitive).set(f.slot, plane);
      return;
    }
    if (f.has_direction != 0 && f.offset == offset) return;
    csg::set_face(model_, {plane, f.primitive, f.slot});
    const double turned =
        p.bounds.is_finite() ? length(p.bounds.hi - p.bounds.lo) * exactness_[f.primitive].direction : 0.0;
    changed_.emplace_back(f.primitive, std::fabs(f.offset - offset) + (f.has_direction != 0 ? 0.0 : turned));
  }

  csg::MeshFaces& mesh_of(std::uint32_t primitive) {
    return *std::lower_bound(mesh_faces_.begin(), mesh_faces_.end(), primitive,
                             [](const csg::MeshFaces& m, std::uint32_t p) { return m.primitive() < p; });
  }

  void settle() {
    std::sort(changed_.begin(), changed_.end());
    for (std::size_t i = 0; i < changed_.size(); ++i) {
      // The last of a primitive's faces has moved most.
      if (i + 1 < changed_.size() && changed_[i + 1].first == changed_[i].first) continue;
      csg::settle_faces(model_, changed_[i].first, changed_[i].second);
    }
    for (csg::MeshFaces& faces : mesh_faces_) faces.settle(model_);
  }

  Model& model_;
  std::span<const Exactness> exactness_;
  /// Faces across the world's axes.
  std::array<std::vector<Level>, 3> along_;
  std::vector<Heading> others_;
  std::vector<csg::MeshFaces> mesh_faces_;
  std::vector<const Level*> sides_;
  /// Primitives with how far a face has moved.
  std::vector<std::pair<std::uint32_t, double>> changed_;
};

}  // namespace

void unify_planes(Model& model, std::span<const Exactness> exactness) {
  GRAYCUBE_CHECK(exactness.size() == model.primitives.size(), "%zu of %zu", exactness.size(), model.primitives.size());
  PlaneUnifier(model, exactness).run();
}

}  // namespace graycube
