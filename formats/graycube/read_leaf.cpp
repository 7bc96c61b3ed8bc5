#include "formats/graycube/read_leaf.hpp"

#include <cmath>

#include "check.hpp"
#include "flat/side_crossings.hpp"
#include "geometry/affine.hpp"
#include "scene/flat_solids.hpp"
#include "scene/limits.hpp"

namespace graycube {
namespace {

using Members = std::array<JsonIndex, kMaxNodeKeys>;
constexpr std::size_t kOwn = kCommonKeys;  // position of a type's first own key

template <typename... Keys>
constexpr NodeRules rules_of(NodeType type, std::string_view name, std::string_view owner,
                             Keys... keys) {
  return {name,
          owner,
          type,
          kOwn + sizeof...(keys),
          {{{"type", true}, {"transform"}, {"material"}, {keys, true}...}}};
}

constexpr std::array kRules{
    rules_of(NodeType::kSphere, "sphere", "a sphere", "center", "radius"),
    rules_of(NodeType::kBox, "box", "a box", "min", "max"),
    rules_of(NodeType::kCylinder, "cylinder", "a cylinder", "base", "top", "radius"),
    rules_of(NodeType::kRef, "ref", "a ref", "shape"),
    rules_of(NodeType::kUnion, "union", "a union", "children"),
    rules_of(NodeType::kIntersection, "intersection", "an intersection", "children"),
    rules_of(NodeType::kDifference, "difference", "a difference", "children"),
    rules_of(NodeType::kComplement, "complement", "a complement", "child"),
    rules_of(NodeType::kCone, "cone", "a cone", "base", "base_radius", "top", "top_radius"),
    rules_of(NodeType::kTorus, "torus", "a torus", "center", "axis", "major", "minor"),
    rules_of(NodeType::kHalfSpace, "half_space", "a half_space", "normal", "offset"),
    rules_of(NodeType::kEllipsoid, "ellipsoid", "an ellipsoid", "center", "axes"),
    rules_of(NodeType::kPolyhedron, "polyhedron", "a polyhedron", "planes"),
    rules_of(NodeType::kEllipticCone, "elliptic_cone", "an elliptic_cone", "base", "top", "a", "b",
             "top_a", "top_b"),
    rules_of(NodeType::kEllipticTorus, "elliptic_torus", "an elliptic_torus", "center", "axis",
             "radius", "outward", "upward", "across"),
    rules_of(NodeType::kQuadric, "quadric", "a quadric", "coefficients", "min", "max"),
    NodeRules{"repeat",
              "a repeat",
              NodeType::kRepeat,
              kOwn + 4,
              {{{"type", true},
                {"transform"},
                {"material"},
                {"child", true},
                {"maps", true},
                {"depth", true},
                {"keep"}}}},
    NodeRules{"prism",
              "a prism",
              NodeType::kPrism,
              kOwn + 4,
              {{{"type", true},
                {"transform"},
                {"material"},
                {"points", true},
                {"height", true},
                {"paths"},
                {"base"}}}},
    NodeRules{"mesh",
              "a mesh",
              NodeType::kMesh,
              kOwn + 4,
              {{{"type", true},
                {"transform"},
                {"material"},
                {"points"},
                {"faces"},
                {"file"},
                {"digits"}}}},
    NodeRules{"bezier",
              "a bezier",
              NodeType::kBezier,
              kOwn + 3,
              {{{"type", true},
                {"transform"},
                {"material"},
                {"points", true},
                {"patches", true},
                {"tolerance"}}}},
    rules_of(NodeType::kLathe, "lathe", "a lathe", "outline"),
    NodeRules{"sweep",
              "a sweep",
              NodeType::kSweep,
              kOwn + 3,
              {{{"type", true},
                {"transform"},
                {"material"},
                {"outline", true},
                {"height", true},
                {"base"}}}},
};

/// Reads a leaf's members one after the other; absent ones fail without another report.
class LeafMembers {
 public:
  LeafMembers(JsonAccess& json, const Members& members) : json_(json), members_(members) {}

  template <typename T, typename... Rule>
  LeafMembers& read(std::size_t own_key, T& out, const Rule&... rule) {
    const JsonIndex at = members_[kOwn + own_key];
    good_ = at != 0 && json_.read(at, out, rule...) && good_;
    return *this;
  }
  LeafMembers& read_direction(std::size_t own_key, Vec3& out) {
    const JsonIndex at = members_[kOwn + own_key];
    good_ = at != 0 && json_.read_direction(at, out) && good_;
    return *this;
  }
  JsonIndex at(std::size_t own_key) const { return members_[kOwn + own_key]; }
  bool good() const { return good_; }

 private:
  JsonAccess& json_;
  const Members& members_;
  bool good_ = true;
};

void check_axis_length(JsonAccess& json, JsonIndex top_at, const Vec3& base, const Vec3& top) {
  const double l = length(top - base);
  if (!(l > 0) || !std::isfinite(l))
    json.wrong(top_at, "a top at a finite, non-zero distance from the base");
}

SphereShape read_sphere(JsonAccess&, LeafMembers members) {
  SphereShape s;
  members.read(0, s.center).read(1, s.radius, kPositive);
  return s;
}

BoxShape read_box(JsonAccess& json, LeafMembers members) {
  BoxShape b;
  members.read(0, b.min).read(1, b.max);
  constexpr std::string_view kAxes = "xyz";
  for (int a = 0; members.good() && a < 3; ++a) {
    if (b.min[a] < b.max[a]) continue;
    json.wrong(members.at(1), "max." + std::string(1, kAxes[static_cast<std::size_t>(a)]) +
                                  " greater than that of min " + json.tree.describe(members.at(0)));
  }
  return b;
}

CylinderShape read_cylinder(JsonAccess& json, LeafMembers members) {
  CylinderShape c;
  members.read(0, c.base).read(1, c.top).read(2, c.radius, kPositive);
  if (members.good()) check_axis_length(json, members.at(1), c.base, c.top);
  return c;
}

ConeShape read_cone(JsonAccess& json, LeafMembers members) {
  ConeShape c;
  members.read(0, c.base).read(1, c.base_radius, kNotNegative);
  members.read(2, c.top).read(3, c.top_radius, kNotNegative);
  if (!members.good()) return c;
  check_axis_length(json, members.at(2), c.base, c.top);
  if (c.base_radius == 0 && c.top_radius == 0)
    json.wrong(members.at(3), "a top_radius > 0 where base_radius is 0");
  return c;
}

TorusShape read_torus(JsonAccess& json, LeafMembers members) {
  TorusShape t;
  members.read(0, t.center)
      .read_direction(1, t.axis)
      .read(2, t.major, kPositive)
      .read(3, t.minor, kPositive);
  if (members.good() && !(t.minor < t.major))
    json.wrong(members.at(3),
               "a minor radius below the major one, " + json.tree.describe(members.at(2)));
  return t;
}

HalfSpaceShape read_half_space(JsonAccess&, LeafMembers members) {
  HalfSpaceShape h;
  members.read_direction(0, h.normal).read(1, h.offset);
  return h;
}

EllipsoidShape read_ellipsoid(JsonAccess& json, LeafMembers members) {
  EllipsoidShape e;
  members.read(0, e.center);
  const JsonIndex axes = members.at(1);
  if (axes == 0) return e;
  if (json.tree.kind(axes) != JsonKind::kArray || json.tree.size(axes) != 3) {
    json.wrong(axes, "three vectors");
    return e;
  }
  bool good = true;
  JsonIndex child = json.tree.first_child(axes);
  for (Vec3& axis : e.axes) {
    good = json.read(child, axis) && good;
    child = json.tree.next(child);
  }
  Affine map;
  for (int row = 0; row < 3; ++row)
    for (std::size_t column = 0; column < 3; ++column)
      map.m[static_cast<std::size_t>(row)][column] = e.axes[column][row];
  if (good && !map.inverse())
    json.errors.add(axes, "expected three linearly independent vectors, found dependent ones");
  return e;
}

EllipticConeShape read_elliptic_cone(JsonAccess& json, LeafMembers members) {
  EllipticConeShape c;
  members.read(0, c.base).read(1, c.top).read(2, c.a).read(3, c.b);
  members.read(4, c.top_a, kNotNegative).read(5, c.top_b, kNotNegative);
  if (!members.good()) return c;
  const Vec3 h = c.top - c.base;
  Affine map;
  for (int row = 0; row < 3; ++row) {
    map.m[static_cast<std::size_t>(row)] = {c.a[row], c.b[row], h[row], 0};
  }
  if (!map.is_finite() || !map.inverse()) {
    json.errors.add(members.at(2),
                    "expected a, b and top - base linearly independent, found them dependent");
  }
  return c;
}

EllipticTorusShape read_elliptic_torus(JsonAccess& json, LeafMembers members) {
  EllipticTorusShape t;
  members.read(0, t.center).read_direction(1, t.axis).read(2, t.radius, kPositive);
  members.read(3, t.outward).read(4, t.upward).read(5, t.across, kPositive);
  if (!members.good()) return t;
  const double m2 = t.outward * t.outward + t.upward * t.upward;
  if (!(m2 > 0) || !std::isfinite(m2)) {
    json.wrong(members.at(4), "outward and upward not both 0");
    return t;
  }
  return t;
}

QuadricShape read_quadric(JsonAccess& json, LeafMembers members) {
  QuadricShape q;
  members.read(1, q.min).read(2, q.max);
  for (int a = 0; members.good() && a < 3; ++a) {
    if (q.min[a] < q.max[a]) continue;
    json.wrong(members.at(2), "max greater than min " + json.tree.describe(members.at(1)));
    break;
  }
  const JsonIndex at = members.at(0);
  if (at == 0) return q;
  if (json.tree.kind(at) != JsonKind::kArray || json.tree.size(at) != 4) {
    json.wrong(at, "four numbers");
    return q;
  }
  JsonIndex child = json.tree.first_child(at);
  for (std::size_t i = 0; i < 4; ++i) {
    json.read(child, q.coefficients[i], i == 0 ? kNotNegative : kAnyNumber);
    child = json.tree.next(child);
  }
  return q;
}

void read_plane(JsonAccess& json, JsonIndex at, HalfSpaceShape& plane) {
  if (json.tree.kind(at) != JsonKind::kArray || json.tree.size(at) != 4) {
    json.wrong(at, "a plane [nx, ny, nz, d]");
    return;
  }
  std::array<double, 4> v{};
  bool good = true;
  JsonIndex child = json.tree.first_child(at);
  for (double& number : v) {
    good = json.read(child, number) && good;
    child = json.tree.next(child);
  }
  plane = {{v[0], v[1], v[2]}, v[3]};
  const double l = length(plane.normal);
  if (good && (!(l > 0) || !std::isfinite(l)))
    json.wrong(at, "a plane whose normal has a finite, non-zero length");
}

PolyhedronShape read_polyhedron(JsonAccess& json, LeafMembers members) {
  PolyhedronShape p;
  const JsonIndex planes = members.at(0);
  if (planes == 0 || !json.is_array(planes)) return p;
  const std::uint32_t count = json.tree.size(planes);
  if (count == 0 || count > kMaxPlanes) {
    json.wrong(planes, "1 to " + std::to_string(kMaxPlanes) + " planes");
    return p;
  }
  p.planes.resize(count);
  JsonIndex child = json.tree.first_child(planes);
  for (auto& plane : p.planes) {
    read_plane(json, child, plane);
    child = json.tree.next(child);
  }
  return p;
}

void read_prism_points(JsonAccess& json, JsonIndex at, PrismShape& prism) {
  if (!json.is_array(at)) return;
  const std::uint32_t count = json.tree.size(at);
  if (count < 3 || count > kMaxPrismPoints) {
    json.wrong(at, "3 to " + std::to_string(kMaxPrismPoints) + " points");
    return;
  }
  prism.points.resize(count);
  JsonIndex child = json.tree.first_child(at);
  for (FlatPoint& point : prism.points) {
    if (json.tree.kind(child) != JsonKind::kArray || json.tree.size(child) != 2) {
      json.wrong(child, "a point [x, y]");
    } else {
      const JsonIndex x = json.tree.first_child(child);
      json.read(x, point.x);
      json.read(json.tree.next(x), point.y);
    }
    child = json.tree.next(child);
  }
}

void read_prism_paths(JsonAccess& json, JsonIndex at, PrismShape& prism) {
  if (!json.is_array(at)) return;
  if (json.tree.size(at) == 0) json.wrong(at, "one path or more");
  std::size_t corners = 0;
  for (JsonIndex path = json.tree.first_child(at); path != json.tree.end(at);
       path = json.tree.next(path)) {
    if (!json.is_array(path)) continue;
    corners += json.tree.size(path);
    if (corners > kMaxPrismPoints) {
      json.wrong(at, "at most " + std::to_string(kMaxPrismPoints) + " corners");
      return;
    }
    auto& numbers = prism.paths.emplace_back(json.tree.size(path));
    JsonIndex child = json.tree.first_child(path);
    for (std::uint32_t& number : numbers) {
      json.read(child, number, 0u, static_cast<std::uint32_t>(prism.points.size()) - 1);
      child = json.tree.next(child);
    }
  }
}

PrismShape read_prism(JsonAccess& json, const LeafMembers& members) {
  PrismShape p;
  const std::uint64_t errors = json.errors.total();
  if (members.at(0) != 0) read_prism_points(json, members.at(0), p);
  if (members.at(1) != 0) json.read(members.at(1), p.height, kPositive);
  if (members.at(2) != 0 && !p.points.empty()) read_prism_paths(json, members.at(2), p);
  json.read_optional(members.at(3), p.base);
  if (json.errors.total() != errors || members.at(0) == 0 || members.at(1) == 0) return p;
  if (!crossings_are_few(std::vector<FlatLoops>{loops_of(p)})) {
    json.errors.add(members.at(0), "the outline crosses itself too often");
  } else if (!prism_of(p)) {
    json.errors.add(members.at(0), "expected points that go round an area, found none");
  }
  return p;
}

}  // namespace

std::span<const NodeRules> node_rules() { return kRules; }

void read_leaf_value(JsonAccess& json, NodeType type, const Members& members, CsgNode& out) {
  const LeafMembers leaf(json, members);
  switch (type) {
    case NodeType::kSphere: out.value = read_sphere(json, leaf); return;
    case NodeType::kBox: out.value = read_box(json, leaf); return;
    case NodeType::kCylinder: out.value = read_cylinder(json, leaf); return;
    case NodeType::kCone: out.value = read_cone(json, leaf); return;
    case NodeType::kTorus: out.value = read_torus(json, leaf); return;
    case NodeType::kHalfSpace: out.value = read_half_space(json, leaf); return;
    case NodeType::kEllipsoid: out.value = read_ellipsoid(json, leaf); return;
    case NodeType::kPolyhedron: out.value = read_polyhedron(json, leaf); return;
    case NodeType::kEllipticCone: out.value = read_elliptic_cone(json, leaf); return;
    case NodeType::kEllipticTorus: out.value = read_elliptic_torus(json, leaf); return;
    case NodeType::kQuadric: out.value = read_quadric(json, leaf); return;
    case NodeType::kPrism: out.value = read_prism(json, leaf); return;
    default: GRAYCUBE_CHECK(false, "node type %d is no leaf", static_cast<int>(type));
  }
}

}  // namespace graycube
