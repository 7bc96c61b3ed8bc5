// The solids of the plain tracer: CSG by Roth's interval lists (1982) in doubles, with a small
// bounding hierarchy over the children of every large operation. Nothing here is shared with the
// engine, so that it is both a yardstick and a check.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <variant>
#include <vector>

#include "geometry/aabb.hpp"
#include "geometry/affine.hpp"
#include "scene/scene.hpp"

namespace graycube::plain {

inline constexpr double kInf = std::numeric_limits<double>::infinity();

struct Ball {
  Vec3 center;
  double radius;
};
struct Block {
  Vec3 lo, hi;
};
/// Cylinder or cone: its radius at height h above `base` is radius + slope · h, for 0 ≤ h ≤ height.
struct Tube {
  Vec3 base, axis;
  double height, radius, slope;
};
struct Ring {
  Vec3 center, axis;
  double major, minor;
};
/// The points p with normal · p ≤ offset for every plane.
struct Planes {
  std::vector<HalfSpaceShape> planes;
};
using Shape = std::variant<Ball, Block, Tube, Ring, Planes>;

/// The points origin + t · direction; the direction need not be unit.
struct Line {
  Line(const Vec3& o, const Vec3& d)
      : origin(o), direction(d), inverse{1 / d.x, 1 / d.y, 1 / d.z} {}
  Vec3 origin, direction, inverse;
};

/// An interval inside a solid; each end lies on the surface of a leaf.
struct Span {
  double enter, leave;
  std::uint32_t enter_leaf, leave_leaf;
};
/// A stack of lists: intervals from some index on are sorted and disjoint.
using Spans = std::vector<Span>;

/// The part of a line within which intervals need to be right.
struct Window {
  double from, to;
};

struct Hit {
  double t = kInf;
  std::uint32_t leaf = 0;
  bool entering = false;
};

class Solids {
 public:
  /// The scene must have passed read_scene's checks.
  explicit Solids(const Scene& scene);

  std::uint32_t object_count() const { return static_cast<std::uint32_t>(roots_.size()); }
  /// The object's bounds; infinite if it is unbounded.
  const Aabb& bounds(std::uint32_t object) const { return bounds_[roots_[object]]; }

  /// Appends the object's intervals.
  void spans(std::uint32_t object, const Line& line, Window w, Spans& out) const {
    add_spans(roots_[object], line, w, out);
  }
  const Material& material(std::uint32_t leaf) const { return materials_[leaf_material_[leaf]]; }
  /// The unit normal out of the leaf at a point of its surface, in world coordinates.
  Vec3 normal(std::uint32_t leaf, const Vec3& point) const;

 private:
  struct Node {
    std::optional<Operation> operation;  // none: `first` is a leaf
    std::uint32_t first = 0, count = 0;  // children_
    std::int32_t bundle = -1;  // root of the hierarchy over the children that are added up
    std::int32_t map = -1;     // inverse_maps_
  };
  /// A node of a hierarchy: either two bundles, `first` and the next, or `count` nodes from
  /// sorted_[first] on.
  struct Bundle {
    Aabb bounds;
    std::uint32_t first = 0, count = 0;
  };

  std::uint32_t add_node(const CsgNode& node, MaterialIndex material, const Affine& to_world);
  void add_leaf(Shape shape, MaterialIndex material, const Affine& to_world, Node& node);
  void add_operation(const OperationNode& o, MaterialIndex material, const Affine& to_world,
                     Node& node);
  void split(std::uint32_t bundle);

  void add_spans(std::uint32_t node, const Line& line, Window w, Spans& out) const;
  /// Like add_spans(), for a line in the coordinates inside the node's map.
  void add_inside(const Node& node, const Line& line, Window w, Spans& out) const;
  /// Appends the union of the node's children from number `skip` on.
  void add_sum(const Node& node, std::uint32_t skip, const Line& line, Window w, Spans& out) const;
  void add_bundle(std::uint32_t bundle, const Line& line, Window w, Spans& out) const;

  const Scene* scene_;  // while building
  std::vector<Material> materials_;
  std::vector<Shape> leaves_;
  std::vector<std::uint32_t> leaf_material_;
  std::vector<Affine> leaf_to_local_;
  std::vector<Node> nodes_;
  std::vector<Aabb> bounds_;
  std::vector<std::uint32_t> children_, sorted_, roots_;
  std::vector<Bundle> bundles_;
  std::vector<Affine> inverse_maps_;
};

}  // namespace graycube::plain
