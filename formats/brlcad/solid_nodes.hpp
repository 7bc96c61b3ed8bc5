// Tools that turn the solids of BRL-CAD into nodes: their numbers under a map, and checks that
// shapes are sound.
#pragma once

#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "formats/brlcad/solids.hpp"
#include "geometry/affine.hpp"

namespace graycube::brlcad {

/// Vectors shorter than this part of a solid's size count as zero; directions as near as this as
/// parallel.
inline constexpr double kTiny = 1e-9;
/// Ratios of a cone's ends as near as this count as equal: databases of version 4 hold single
/// precision.
inline constexpr double kEqualRatio = 1e-6;

CsgNode node_of(decltype(CsgNode::value) value, std::optional<Affine> transform = std::nullopt);
/// Joins the children; a single child stands for itself.
CsgNode operation(Operation op, std::vector<CsgNode> children);

/// The result for a solid that rt leaves out, too.
BrlcadNode problem(std::string why);
/// The result for a solid that rt would draw.
BrlcadNode unsupported(std::string why);
/// The result for a node, unless the scene reader would refuse a value in it.
BrlcadNode built(CsgNode node);

/// The map whose columns are x, y, z and the origin.
Affine frame(const Vec3& x, const Vec3& y, const Vec3& z, const Vec3& origin);

/// v made longer by `grow` at its end; zero stays zero.
Vec3 longer(const Vec3& v, double grow);

/// Whether a vector is as good as zero beside a solid of this size.
inline bool is_zero(const Vec3& v, double size) { return !(length(v) > kTiny * size); }
inline bool are_parallel(const Vec3& a, const Vec3& b) {
  return length(cross(a, b)) <= 1e-5 * length(a) * length(b);
}

/// Reads a solid's numbers; points and vectors go through the map.
struct Values {
  const std::vector<double>& v;
  const Affine& map;

  Vec3 raw(std::size_t i) const { return {v[3 * i], v[3 * i + 1], v[3 * i + 2]}; }
  Vec3 point(std::size_t i) const { return map.point(raw(i)); }
  Vec3 vector(std::size_t i) const { return map.vector(raw(i)); }
  double number(std::size_t i) const { return v[i]; }
  /// The factor by which the map makes lengths grow, as the cube root of that of volumes.
  double scale() const { return std::cbrt(std::fabs(map.determinant())); }
};

/// A torus whose tube is `grow` thicker than `minor`. One whose tube is thicker than its ring
/// closes its hole, with a dent at each end of the axis.
CsgNode round_torus(const Vec3& center, const Vec3& axis, double major, double minor, double grow,
                    std::optional<Affine> transform = std::nullopt);

/// A cone between two circles about an axis, or a cylinder; the larger end's radius is above 0.
CsgNode round_cone(const Vec3& base, double base_radius, const Vec3& top, double top_radius);

// Solids that take more than one shape (formats/brlcad/pipe.cpp).

/// Two balls and the cone that touches both.
BrlcadNode particle(const Values& p, double grow);
BrlcadNode pipe(const Values& p, double grow);

}  // namespace graycube::brlcad
