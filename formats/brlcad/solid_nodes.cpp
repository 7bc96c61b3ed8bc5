#include "formats/brlcad/solid_nodes.hpp"

#include <algorithm>
#include <utility>

#include "scene/limits.hpp"

namespace graycube::brlcad {
namespace {

bool is_fair(double v) { return std::fabs(v) <= kMostBrlcadSize; }
bool is_fair(const Vec3& v) { return is_fair(v.x) && is_fair(v.y) && is_fair(v.z); }
bool is_direction(const Vec3& v) { return is_fair(v) && length(v) > 0; }

/// Checks the rules that read_scene has for each shape.
struct IsSound {
  bool operator()(const SphereShape& s) const {
    return is_fair(s.center) && is_fair(s.radius) && s.radius > 0;
  }
  bool operator()(const CylinderShape& s) const { return is_fair(s.radius) && s.radius > 0; }
  bool operator()(const ConeShape& s) const {
    return is_fair(s.top_radius) && s.top_radius >= 0 && s.base_radius > 0;
  }
  bool operator()(const TorusShape& s) const {
    return is_fair(s.center) && is_direction(s.axis) && is_fair(s.major) && 0 < s.minor &&
           s.minor < s.major;
  }
  bool operator()(const HalfSpaceShape& s) const {
    return is_direction(s.normal) && is_fair(s.offset);
  }
  bool operator()(const EllipsoidShape& s) const {
    return is_fair(s.center) && is_fair(s.axes[0]) && is_fair(s.axes[1]) && is_fair(s.axes[2]);
  }
  bool operator()(const PolyhedronShape& s) const {
    return s.planes.size() <= kMaxPlanes && std::all_of(s.planes.begin(), s.planes.end(), *this);
  }
  bool operator()(const EllipticConeShape& s) const {
    return is_fair(s.top_a) && is_fair(s.top_b) && s.top_a >= 0 && s.top_b >= 0;
  }
  bool operator()(const EllipticTorusShape& s) const {
    return is_fair(s.center) && is_direction(s.axis) && is_fair(s.radius) && s.across > 0;
  }
  bool operator()(const QuadricShape& s) const {
    bool is_good = is_fair(s.min) && is_fair(s.max) && s.coefficients[0] >= 0;
    for (const double c : s.coefficients) is_good = is_good && is_fair(c);
    return is_good && s.min.x < s.max.x && s.min.y < s.max.y && s.min.z < s.max.z;
  }
  bool operator()(const OperationNode& o) const {
    return std::all_of(o.children.begin(), o.children.end(), is_sound_node);
  }
  template <typename Other>
  bool operator()(const Other&) const {
    return false;
  }
  static bool is_sound_node(const CsgNode& node) {
    if (node.transform) {
      for (const auto& row : node.transform->m) {
        for (const double v : row) {
          if (!is_fair(v)) return false;
        }
      }
      if (!node.transform->inverse()) return false;
    }
    return std::visit(IsSound{}, node.value);
  }
};

}  // namespace

CsgNode node_of(decltype(CsgNode::value) value, std::optional<Affine> transform) {
  CsgNode node;
  node.value = std::move(value);
  node.transform = transform;
  return node;
}

CsgNode operation(Operation op, std::vector<CsgNode> children) {
  if (children.size() == 1) return std::move(children.front());
  return node_of(OperationNode{op, std::move(children)});
}

BrlcadNode problem(std::string why) { return {std::nullopt, std::move(why), false, {}, {}}; }
BrlcadNode unsupported(std::string why) { return {std::nullopt, std::move(why), true, {}, {}}; }

BrlcadNode built(CsgNode node) {
  if (!IsSound::is_sound_node(node)) return problem("it is empty, or its numbers are out of range");
  return {std::move(node), {}, false, {}, {}};
}

Affine frame(const Vec3& x, const Vec3& y, const Vec3& z, const Vec3& origin) {
  Affine f;
  for (int i = 0; i < 3; ++i) f.m[static_cast<std::size_t>(i)] = {x[i], y[i], z[i], origin[i]};
  return f;
}

Vec3 longer(const Vec3& v, double grow) {
  const double l = length(v);
  return l > 0 ? (1 + grow / l) * v : v;
}

CsgNode round_torus(const Vec3& center, const Vec3& axis, double major, double minor, double grow,
                    std::optional<Affine> transform) {
  if (minor <= major * (1 + kEqualRatio)) {
    const double tube = std::fmin(minor + grow, major * (1 - kTiny));
    return node_of(TorusShape{center, axis, major, tube}, transform);
  }
  const double tube = minor + grow;
  return node_of(EllipticTorusShape{center, axis, major, tube, 0, tube}, transform);
}

CsgNode round_cone(const Vec3& base, double base_radius, const Vec3& top, double top_radius) {
  if (base_radius < top_radius) return round_cone(top, top_radius, base, base_radius);
  const Vec3 axis = top - base;
  const Vec3 along = normalized(axis);
  const Vec3 aside =
      normalized(cross(along, std::fabs(along.x) < 0.5 ? Vec3{1, 0, 0} : Vec3{0, 1, 0}));
  const Affine map = frame(base_radius * aside, base_radius * cross(along, aside), axis, base);
  if (base_radius == top_radius) return node_of(CylinderShape{{0, 0, 0}, {0, 0, 1}, 1}, map);
  return node_of(ConeShape{{0, 0, 0}, 1, {0, 0, 1}, top_radius / base_radius}, map);
}

}  // namespace graycube::brlcad
