#include "formats/brlcad/solids.hpp"

#include <algorithm>
#include <cmath>

#include "formats/brlcad/arb_corners.hpp"
#include "formats/brlcad/solid_nodes.hpp"

namespace graycube {
namespace brlcad {
namespace {

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

/// (|x|^(2/e) + |y|^(2/e))^(e/n) + |z|^(2/n) <= 1: built only if it is an ellipsoid. rt itself
/// never looks at the exponents when it shoots rays (superell.c: a quadric of its own), so there is
/// nothing that other shapes could be compared with.
BrlcadNode superell(const Values& p, double grow) {
  if (p.number(12) == 1 && p.number(13) == 1) {
    return ellipsoid(p.point(0), {p.vector(1), p.vector(2), p.vector(3)}, grow);
  }
  return unsupported("superell with other exponents than n = e = 1 is not supported");
}

/// The lengths of a semi-axis at a cone's two ends.
struct Ends {
  double base, top;
};
/// The lengths at both ends when the cone is made longer by the share e at each end, and wider by
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
  const double major = p.number(6), minor = p.number(7);
  const Vec3 axis = p.raw(1);
  if (!(major > 0 && minor > 0 && length(axis) > 0)) return problem("a radius or its axis is zero");
  return built(round_torus(p.raw(0), axis, major, minor, grow / p.scale(), p.map));
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

BrlcadNode arb(const Values& p, double grow) {
  const ArbCorners corners(p);
  const double size = corners.size;
  const double slack = std::fmax(kBrlcadSkin, kBrlcadPlanar * size);
  PolyhedronShape shape;
  bool is_flat = true;
  for (const ArbFace& face : kArbFaces) {
    const std::vector<Vec3> distinct = corners.distinct(face);
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
      is_flat = is_flat && std::fabs(dot(n, q) - offset) <= slack;
    }
    if (dot(n, corners.center) > offset) {
      n = -n;
      offset = -offset;
    }
    const HalfSpaceShape plane{n, offset + grow};
    if (std::find(shape.planes.begin(), shape.planes.end(), plane) == shape.planes.end()) {
      shape.planes.push_back(plane);
    }
  }
  if (shape.planes.size() < 4) return problem("it has no volume");
  BrlcadNode node = built(node_of(std::move(shape)));
  if (!is_flat) node.change = "faces aren't flat and lie in the plane of their first three corners";
  return node;
}

/// A quadric's box in a frame whose axes are made longer by `grow` on both sides; the surface
/// itself moves outwards because its constant is shifted.
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

/// The factors of 1, z and z². `c`: how far behind the tip the asymptotes cross, in
/// heights.
std::array<double, 4> hyperbola(double second, double c) {
  const double k = 2 * c + 1;
  return {second, -1 / k, 2 * (c + 1) / k, -1};
}

/// rpc and rhc: a parabola or hyperbola of depth B and half width r, extended along H.
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

/// epa and ehy: a paraboloid or hyperboloid with an elliptic rim.
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
  // It doesn't matter to which side of the plane the semi-axis leans.
  const double up = std::fmin(1.0, std::fabs(dot(c, n)) / (length(c) * length(n)));
  const double out = std::sqrt(1 - up * up);
  // rt leaves out those that one of its ellipse's semi-axes makes overlap.
  const double most = r * (1 + kEqualRatio);
  if (length(c) * out > most || p.number(10) * up > most)
    return problem("its ellipse overlaps itself");
  return built(node_of(EllipticTorusShape{p.raw(0), n, r, major * out, major * up, across}, p.map));
}

}  // namespace
}  // namespace brlcad

BrlcadNode brlcad_node(const BrlcadSolid& solid, const Affine& to_world, double grow) {
  using namespace brlcad;
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
