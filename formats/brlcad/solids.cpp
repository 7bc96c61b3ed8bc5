#include "formats/brlcad/solids.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/aabb.hpp"
#include "scene/limits.hpp"

namespace graycube {
namespace {

/// Vectors shorter than this part of a solid's size count as zero; directions as near as this as
/// parallel.
constexpr double kTiny = 1e-9;
/// Ratios of a cone's ends as near as this count as equal: databases of version 4 hold single
/// precision.
constexpr double kEqualRatio = 1e-6;

CsgNode node_of(decltype(CsgNode::value) value, std::optional<Affine> transform = std::nullopt) {
  CsgNode node;
  node.value = std::move(value);
  node.transform = transform;
  return node;
}

CsgNode operation(Operation op, std::vector<CsgNode> children) {
  if (children.size() == 1) return std::move(children.front());
  return node_of(OperationNode{op, std::move(children)});
}

BrlcadNode problem(std::string why) { return {std::nullopt, std::move(why), false}; }
BrlcadNode refusal(std::string why) { return {std::nullopt, std::move(why), true}; }

bool is_fair(double v) { return std::fabs(v) <= kMostBrlcadSize; }
bool is_fair(const Vec3& v) { return is_fair(v.x) && is_fair(v.y) && is_fair(v.z); }
bool is_direction(const Vec3& v) { return is_fair(v) && length(v) > 0; }

/// What read_scene asks of each shape.
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

BrlcadNode built(CsgNode node) {
  if (!IsSound::is_sound_node(node)) return problem("it is empty, or its numbers are out of range");
  return {std::move(node), {}, false};
}

/// The map whose columns are x, y, z and the origin.
Affine frame(const Vec3& x, const Vec3& y, const Vec3& z, const Vec3& origin) {
  Affine f;
  for (int i = 0; i < 3; ++i) f.m[static_cast<std::size_t>(i)] = {x[i], y[i], z[i], origin[i]};
  return f;
}

/// v made longer by `grow` at its end; zero stays zero.
Vec3 longer(const Vec3& v, double grow) {
  const double l = length(v);
  return l > 0 ? (1 + grow / l) * v : v;
}

bool is_zero(const Vec3& v, double size) { return !(length(v) > kTiny * size); }
bool are_parallel(const Vec3& a, const Vec3& b) {
  return length(cross(a, b)) <= 1e-5 * length(a) * length(b);
}

/// Reads a solid's numbers, points and vectors going through the map.
struct Values {
  const std::vector<double>& v;
  const Affine& map;

  Vec3 raw(std::size_t i) const { return {v[3 * i], v[3 * i + 1], v[3 * i + 2]}; }
  Vec3 point(std::size_t i) const { return map.point(raw(i)); }
  Vec3 vector(std::size_t i) const { return map.vector(raw(i)); }
  double number(std::size_t i) const { return v[i]; }
  /// By how much the map makes lengths grow, as the cube root of volumes.
  double scale() const { return std::cbrt(std::fabs(map.determinant())); }
};

BrlcadNode ellipsoid(const Vec3& center, std::array<Vec3, 3> axes, double grow) {
  double largest = 0, least = kInf;
  for (Vec3& axis : axes) {
    axis = longer(axis, grow);
    largest = std::fmax(largest, length(axis));
    least = std::fmin(least, length(axis));
  }
  const bool is_upright = std::fabs(dot(axes[0], axes[1])) + std::fabs(dot(axes[1], axes[2])) +
                              std::fabs(dot(axes[2], axes[0])) <=
                          kTiny * largest * largest;
  if (is_upright && largest - least <= kTiny * largest && largest > 0) {
    return built(node_of(SphereShape{center, largest}));
  }
  if (!frame(axes[0], axes[1], axes[2], center).inverse()) return problem("it has no volume");
  return built(node_of(EllipsoidShape{center, axes}));
}

/// (|x|^(2/e) + |y|^(2/e))^(e/n) + |z|^(2/n) <= 1: only what is an ellipsoid. rt itself never looks
/// at the exponents when it shoots rays (superell.c: a quadric of its own), so there is nothing
/// that others could be held against.
BrlcadNode superell(const Values& p, double grow) {
  if (p.number(12) == 1 && p.number(13) == 1) {
    return ellipsoid(p.point(0), {p.vector(1), p.vector(2), p.vector(3)}, grow);
  }
  return refusal("superell with other exponents than n = e = 1 is not supported");
}

/// A cone between two circles about an axis, or a cylinder; the larger end's radius is above 0.
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

/// One end of a cone: semi-axes' lengths.
struct Ends {
  double base, top;
};
/// The lengths at both ends when the cone is made longer by the share e at each and wider by
/// `grow`.
Ends grown(Ends ends, double e, double grow) {
  const double slope = ends.top - ends.base;
  return {std::fmax(0, ends.base - e * slope) + grow, std::fmax(0, ends.top + e * slope) + grow};
}

BrlcadNode tgc(const Values& p, double grow) {
  Vec3 v = p.point(0), h = p.vector(1);
  Vec3 a = p.vector(2), b = p.vector(3), c = p.vector(4), d = p.vector(5);
  const double size = std::fmax(std::fmax(length(a), length(b)), std::fmax(length(c), length(d)));
  if (is_zero(h, length(h) + size)) return problem("it has no height");
  if (is_zero(a, size) || is_zero(b, size)) {
    v = v + h;
    h = -h;
    std::swap(a, c);
    std::swap(b, d);
  }
  if (is_zero(a, size) || is_zero(b, size)) return problem("both of its ends are flat");
  if ((!is_zero(c, size) && !are_parallel(a, c)) || (!is_zero(d, size) && !are_parallel(b, d))) {
    return problem("the axes of its two ends are not parallel");
  }
  const double height = std::fabs(dot(h, normalized(cross(a, b))));
  if (!(height > kTiny * length(h))) return problem("its height lies in the plane of its base");
  const double e = grow / height;
  const Ends first = grown({length(a), length(c)}, e, grow);
  const Ends second = grown({length(b), length(d)}, e, grow);
  const Affine map = frame((first.base / length(a)) * a, (second.base / length(b)) * b,
                           (1 + 2 * e) * h, v - e * h);
  if (!map.inverse()) return problem("it has no volume");
  double x = first.top / first.base, y = second.top / second.base;
  if (x < kTiny) x = 0;
  if (y < kTiny) y = 0;
  if (std::fabs(x - y) <= kEqualRatio * std::fmax(x, y)) {
    if (std::fabs(x - 1) <= kEqualRatio) x = 1;
    if (x == 1) return built(node_of(CylinderShape{{0, 0, 0}, {0, 0, 1}, 1}, map));
    return built(node_of(ConeShape{{0, 0, 0}, 1, {0, 0, 1}, x}, map));
  }
  return built(node_of(EllipticConeShape{{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {0, 1, 0}, x, y}, map));
}

BrlcadNode torus(const Values& p, double grow) {
  double major = p.number(6), minor = p.number(7);
  const Vec3 axis = p.raw(1);
  if (!(major > 0 && minor > 0 && length(axis) > 0)) return problem("a radius or its axis is zero");
  if (minor > major * (1 + kEqualRatio)) return problem("its tube is thicker than its ring");
  const double scale = p.scale();
  minor = std::fmin(minor + grow / scale, major * (1 - kTiny));
  return built(node_of(TorusShape{p.raw(0), axis, major, minor}, p.map));
}

BrlcadNode half(const Values& p, double grow) {
  const Vec3 n = p.raw(0);
  if (!(length(n) > 0)) return problem("its normal is zero");
  return built(node_of(HalfSpaceShape{n, p.number(3) + grow / p.scale() * length(n)}, p.map));
}

BrlcadNode arbn(const Values& p, double grow) {
  PolyhedronShape shape;
  for (std::size_t i = 0; i + 3 < p.v.size(); i += 4) {
    const Vec3 n{p.v[i], p.v[i + 1], p.v[i + 2]};
    if (!(length(n) > 0)) return problem("a plane without a normal");
    shape.planes.push_back({n, p.v[i + 3] + grow / p.scale() * length(n)});
  }
  if (shape.planes.size() < 4) return problem("it has fewer than four planes");
  return built(node_of(std::move(shape), p.map));
}

/// The faces of an arb8, corners in order around each.
constexpr std::array<std::array<std::size_t, 4>, 6> kArbFaces{
    {{3, 2, 1, 0}, {4, 5, 6, 7}, {4, 7, 3, 0}, {2, 6, 5, 1}, {1, 5, 4, 0}, {7, 6, 2, 3}}};

BrlcadNode arb(const Values& p, double grow) {
  std::array<Vec3, 8> corners;
  Aabb box = Aabb::nothing();
  Vec3 center;
  for (std::size_t i = 0; i < 8; ++i) {
    corners[i] = p.point(i);
    box.include(corners[i]);
    center = center + 0.125 * corners[i];
  }
  const double size = length(box.hi - box.lo);
  const double slack = std::fmax(kBrlcadSkin, kBrlcadPlanar * size);
  PolyhedronShape shape;
  for (const auto& face : kArbFaces) {
    std::vector<Vec3> distinct;
    for (const std::size_t i : face) {
      const bool is_new = std::none_of(distinct.begin(), distinct.end(), [&](const Vec3& q) {
        return is_zero(q - corners[i], size);
      });
      if (is_new) distinct.push_back(corners[i]);
    }
    if (distinct.size() < 3) continue;
    // The plane of the first three corners that span one.
    Vec3 n = cross(distinct[1] - distinct[0], distinct[2] - distinct[0]);
    if (distinct.size() == 4 && !(length(n) > kTiny * size * size)) {
      n = cross(distinct[2] - distinct[0], distinct[3] - distinct[0]);
    }
    if (!(length(n) > kTiny * kTiny * size * size)) continue;
    n = normalized(n);
    double offset = dot(n, distinct[0]);
    for (const Vec3& q : distinct) {
      if (std::fabs(dot(n, q) - offset) <= slack) continue;
      return refusal("a face is not flat: a corner lies " +
                     std::to_string(std::fabs(dot(n, q) - offset)) +
                     " mm off the plane of the others");
    }
    if (dot(n, center) > offset) {
      n = -n;
      offset = -offset;
    }
    const HalfSpaceShape plane{n, offset + grow};
    if (std::find(shape.planes.begin(), shape.planes.end(), plane) == shape.planes.end()) {
      shape.planes.push_back(plane);
    }
  }
  if (shape.planes.size() < 4) return problem("it has no volume");
  return built(node_of(std::move(shape)));
}

/// A quadric's box in a frame whose axes are made longer by `grow` on both sides; the surface
/// itself moves outwards by a shift of its constant.
BrlcadNode quadric(std::array<double, 4> q, Vec3 lo, Vec3 hi, const Affine& map, double grow) {
  if (!map.inverse()) return problem("it has no volume");
  double shift = 0;
  for (int a = 0; a < 3; ++a) {
    const Vec3 axis{map.m[0][static_cast<std::size_t>(a)], map.m[1][static_cast<std::size_t>(a)],
                    map.m[2][static_cast<std::size_t>(a)]};
    const double share = grow / length(axis);
    lo[a] -= share;
    hi[a] += share;
    shift = std::fmax(shift, share);
  }
  // Near the surface the value's slope is about 2.
  q[3] -= 2 * shift;
  return built(node_of(QuadricShape{q, lo, hi}, map));
}

/// The depth of the hyperbola's asymptotes' crossing behind its tip, in heights, gives 1, z and z²
/// their factors.
std::array<double, 4> hyperbola(double second, double c) {
  const double k = 2 * c + 1;
  return {second, -1 / k, 2 * (c + 1) / k, -1};
}

/// rpc and rhc: over a parabola or hyperbola of depth B and half width r, along H.
BrlcadNode trough(const Values& p, bool is_hyperbolic, double grow) {
  const Vec3 h = p.vector(1), b = p.vector(2);
  const double r = p.number(9) * p.scale();
  if (!(r > 0)) return problem("its half width is not above 0");
  const double c = is_hyperbolic ? p.number(10) * p.scale() / length(b) : 0;
  if (is_hyperbolic && !(c > 0)) return problem("its distance to the asymptotes is not above 0");
  const auto q = is_hyperbolic ? hyperbola(0, c) : std::array<double, 4>{0, 0, 1, -1};
  return quadric(q, {-1, 0, 0}, {1, 1, 1}, frame(r * normalized(cross(h, b)), h, b, p.point(0)),
                 grow);
}

/// epa and ehy.
BrlcadNode bowl(const Values& p, bool is_hyperbolic, double grow) {
  const Vec3 h = p.vector(1), a = normalized(p.vector(2));
  const double r1 = p.number(9) * p.scale(), r2 = p.number(10) * p.scale();
  if (!(r1 > 0 && r2 > 0)) return problem("a radius is not above 0");
  const double c = is_hyperbolic ? p.number(11) * p.scale() / length(h) : 0;
  if (is_hyperbolic && !(c > 0)) return problem("its distance to the asymptotes is not above 0");
  const auto q = is_hyperbolic ? hyperbola(1, c) : std::array<double, 4>{1, 0, 1, -1};
  return quadric(q, {-1, -1, 0}, {1, 1, 1},
                 frame(r1 * a, r2 * normalized(cross(a, h)), h, p.point(0)), grow);
}

/// The hyperboloid of one sheet between its two equal ends; the neck is in the middle.
BrlcadNode hyp(const Values& p, double grow) {
  const Vec3 h = p.vector(1), a = p.vector(2);
  const double b = p.number(9) * p.scale(), neck = p.number(10);
  if (!(neck > 0 && neck <= 1 && b > 0))
    return problem("a radius or its neck's ratio is out of range");
  const double most = 1 / neck;
  return quadric({1, 1 - most * most, 0, -1}, {-most, -most, -1}, {most, most, 1},
                 frame(neck * a, neck * b * normalized(cross(h, a)), 0.5 * h, p.point(0) + 0.5 * h),
                 grow);
}

BrlcadNode eto(const Values& p, double grow) {
  const Vec3 n = p.raw(1), c = p.raw(2);
  const double r = p.number(9), across = p.number(10) + grow / p.scale();
  const double major = length(c) + grow / p.scale();
  if (!(r > 0 && p.number(10) > 0 && length(n) > 0 && length(c) > 0)) {
    return problem("a radius or its axis is zero");
  }
  // The side that its semi-axis leans to doesn't count.
  const double up = std::fmin(1.0, std::fabs(dot(c, n)) / (length(c) * length(n)));
  const double out = std::sqrt(1 - up * up);
  const double reach = std::sqrt(major * out * major * out + across * up * across * up);
  if (!(reach < r)) return problem("its ellipse reaches its axis");
  return built(node_of(EllipticTorusShape{p.raw(0), n, r, major * out, major * up, across}, p.map));
}

BrlcadNode particle(const Values& p, double grow) {
  const Vec3 v = p.point(0), h = p.vector(1);
  const double rv = p.number(6) * p.scale() + grow, rh = p.number(7) * p.scale() + grow;
  if (!(rv > 0 && rh > 0)) return problem("a radius is not above 0");
  const double l = length(h);
  if (!(std::fabs(rv - rh) < l * (1 - kTiny))) {
    return built(node_of(rv >= rh ? SphereShape{v, rv} : SphereShape{v + h, rh}));
  }
  // The cone that touches both spheres.
  const double sine = (rv - rh) / l;
  const double cosine = std::sqrt(1 - sine * sine);
  const Vec3 along = (1 / l) * h;
  return built(operation(
      Operation::kUnion,
      {node_of(SphereShape{v, rv}), node_of(SphereShape{v + h, rh}),
       round_cone(v + rv * sine * along, rv * cosine, v + h + rh * sine * along, rh * cosine)}));
}

struct PipePoint {
  Vec3 at;
  double inner, outer, bend;
};

/// The solid that a pipe's outside (or inside) sweeps: cones, and sectors of tori around the bends.
bool sweep(const std::vector<PipePoint>& points, bool is_inner, double grow,
           std::vector<CsgNode>& out, std::string& why) {
  const auto radius = [&](const PipePoint& p) {
    return 0.5 * (is_inner ? p.inner : p.outer) + grow;
  };
  const auto has_any = [&](const PipePoint& p) { return (is_inner ? p.inner : p.outer) > 0; };
  Vec3 from = points.front().at;
  const auto straight = [&](const Vec3& to, const PipePoint& a, const PipePoint& b) {
    const double l = length(to - from);
    if (!(l > kBrlcadSkin) || (!has_any(a) && !has_any(b))) return;
    const Vec3 e = (grow / l) * (to - from);
    out.push_back(round_cone(from - e, radius(a), to + e, radius(b)));
  };
  for (std::size_t i = 1; i < points.size(); ++i) {
    const PipePoint& here = points[i];
    if (i + 1 == points.size()) {
      straight(here.at, points[i - 1], here);
      break;
    }
    const Vec3 back = normalized(points[i - 1].at - here.at);
    const Vec3 ahead = normalized(points[i + 1].at - here.at);
    const Vec3 normal = cross(back, ahead);
    if (!(length(normal) > 1e-7)) {
      straight(here.at, points[i - 1], here);
      from = here.at;
      continue;
    }
    // tan of half the bend's angle: the angle between −back and ahead.
    const double cosine = dot(back, ahead);
    const double reach = here.bend * std::sqrt((1 + cosine) / (1 - cosine));
    if (here.bend < 0.5 * here.outer * (1 - kEqualRatio)) {
      why = "a bend is tighter than its tube is thick";
      return false;
    }
    const Vec3 start = here.at + reach * back;
    straight(start, points[i - 1], here);
    from = here.at + reach * ahead;
    if (!has_any(here)) continue;
    const Vec3 inwards = normalized(back + ahead);
    const Vec3 center = here.at + std::sqrt(reach * reach + here.bend * here.bend) * inwards;
    const double minor = std::fmin(radius(here), here.bend * (1 - kTiny));
    std::vector<CsgNode> sector;
    sector.push_back(node_of(TorusShape{center, normal, here.bend, minor}));
    sector.push_back(node_of(HalfSpaceShape{back, dot(back, center) + grow}));
    sector.push_back(node_of(HalfSpaceShape{ahead, dot(ahead, center) + grow}));
    out.push_back(operation(Operation::kIntersection, std::move(sector)));
  }
  return true;
}

BrlcadNode pipe(const Values& p, double grow) {
  std::vector<PipePoint> points;
  const double scale = p.scale();
  bool is_hollow = false;
  for (std::size_t i = 0; i + 5 < p.v.size(); i += 6) {
    const double* v = p.v.data() + i;
    points.push_back({p.map.point({v[0], v[1], v[2]}), v[3] * scale, v[4] * scale, v[5] * scale});
    is_hollow = is_hollow || v[3] > 0;
    if (!(v[4] > 0) || v[3] < 0 || v[3] > v[4] || v[5] < 0)
      return problem("a diameter is out of range");
  }
  if (points.size() < 2) return problem("it has fewer than two points");
  std::vector<CsgNode> outside, inside;
  std::string why;
  if (!sweep(points, false, grow, outside, why)) return problem(why);
  // What the bore takes away ends flush with the tube: grown where the tube is not.
  if (is_hollow && !sweep(points, true, kBrlcadSkin - grow, inside, why)) return problem(why);
  if (outside.empty()) return problem("it has no length");
  std::vector<CsgNode> parts;
  parts.push_back(operation(Operation::kUnion, std::move(outside)));
  for (CsgNode& bore : inside) parts.push_back(std::move(bore));
  return built(operation(Operation::kDifference, std::move(parts)));
}

}  // namespace

BrlcadNode brlcad_node(const BrlcadSolid& solid, const Affine& to_world, double grow) {
  const Values p{solid.values, to_world};
  if (solid.values.size() < brlcad_value_count(solid.kind)) return problem("it is incomplete");
  switch (solid.kind) {
    case BrlcadKind::kArb8: return arb(p, grow);
    case BrlcadKind::kTgc: return tgc(p, grow);
    case BrlcadKind::kEll:
      return ellipsoid(p.point(0), {p.vector(1), p.vector(2), p.vector(3)}, grow);
    case BrlcadKind::kSuperell: return superell(p, grow);
    case BrlcadKind::kTor: return torus(p, grow);
    case BrlcadKind::kHalf: return half(p, grow);
    case BrlcadKind::kRpc: return trough(p, false, grow);
    case BrlcadKind::kRhc: return trough(p, true, grow);
    case BrlcadKind::kEpa: return bowl(p, false, grow);
    case BrlcadKind::kEhy: return bowl(p, true, grow);
    case BrlcadKind::kHyp: return hyp(p, grow);
    case BrlcadKind::kEto: return eto(p, grow);
    case BrlcadKind::kPart: return particle(p, grow);
    case BrlcadKind::kArbn: return arbn(p, grow);
    case BrlcadKind::kPipe: return pipe(p, grow);
    case BrlcadKind::kArs:
    case BrlcadKind::kBot: return brlcad_mesh_node(solid.mesh, to_world, grow);
  }
  return problem("it is of no known kind");
}

}  // namespace graycube
