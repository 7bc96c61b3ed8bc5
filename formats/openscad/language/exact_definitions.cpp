// Modules that take the place of OpenSCAD's own when it spells a model's numbers out.
#include "formats/openscad/language/exact.hpp"

namespace graycube {
namespace {

/// A number that isn't whole is written [e, p, q, r, s]: an exponent of two, and with the number's
/// sign 12 + 16 + 16 + 16 binary digits, each group at most five decimal digits. A value that is no
/// number is undef. A note is `graycube|MODULE|ARGUMENT=[NUMBER, …]|…`, with the names of a .csg
/// file.
///
/// Arguments are taken as OpenSCAD 2021.01 takes them; if another version differs, the numbers
/// don't agree with the plain file's, which then keeps its own. A module with arguments that it
/// can't use spells out nothing that agrees.
constexpr std::string_view kDefinitions = R"SCAD(
function graycube_number(x) =
  !is_num(x) || x != x || abs(x) > 1e300 ? undef :
  abs(x) < 1e5 && x == floor(x) ? x :
  abs(x) < 1e-290 ? undef :
  let(a = abs(x), e = floor(ln(a) / ln(2)), m = a / pow(2, e) * 4096, p = floor(m),
      n = (m - p) * 65536, q = floor(n), o = (n - q) * 65536, r = floor(o),
      s = floor((o - r) * 65536))
  [e, x < 0 ? -p : p, q, r, s];
function graycube_named(name, v) =
  str(name, "=", is_list(v) ? [for (x = v) graycube_number(x)] : [graycube_number(v)], "|");
function graycube_points(v) = graycube_named("points", is_list(v) ? [for (p = v) each p] : v);
function graycube_or(v, otherwise) = is_undef(v) ? otherwise : v;
function graycube_radius(r, d, otherwise) = is_num(d) ? d / 2 : graycube_or(r, otherwise);
function graycube_at(v, i, otherwise) = is_list(v) && len(v) > i && is_num(v[i]) ? v[i] : otherwise;
function graycube_pair(v) = is_num(v) ? [v, v] : [for (i = [0:1]) graycube_at(v, i, 1)];
function graycube_origin(v) = [for (i = [0:1]) graycube_at(v, i, 0)];
function graycube_three(v, otherwise) =
  is_num(v) ? [v, v, v] : [for (i = [0:2]) graycube_at(v, i, otherwise)];
function graycube_matrix(a, b, c) =
  [a[0], a[1], a[2], 0, b[0], b[1], b[2], 0, c[0], c[1], c[2], 0, 0, 0, 0, 1];
function graycube_turns(x, y, z) =
  let(a = cos(x), b = sin(x), c = cos(y), d = sin(y), e = cos(z), f = sin(z))
  graycube_matrix([c * e, b * d * e - a * f, a * d * e + b * f],
                  [c * f, b * d * f + a * e, a * d * f - b * e], [-d, b * c, a * c]);
function graycube_turn(angle, v) =
  let(n = norm(v), x = v[0] / n, y = v[1] / n, z = v[2] / n,
      s = sin(angle), c = cos(angle), k = 1 - c)
  n == 0 ? graycube_turns(0, 0, 0) :
  graycube_matrix([x * x * k + c, x * y * k - z * s, x * z * k + y * s],
                  [y * x * k + z * s, y * y * k + c, y * z * k - x * s],
                  [z * x * k - y * s, z * y * k + x * s, z * z * k + c]);
function graycube_mirror(v) =
  let(n = norm(v), x = v[0] / n, y = v[1] / n, z = v[2] / n)
  n == 0 ? graycube_turns(0, 0, 0) :
  graycube_matrix([1 - 2 * x * x, -2 * x * y, -2 * x * z], [-2 * y * x, 1 - 2 * y * y, -2 * y * z],
                  [-2 * z * x, -2 * z * y, 1 - 2 * z * z]);
function graycube_full(m) = let(w = graycube_at(m[3], 3, 1))
  [for (i = [0:3]) for (j = [0:3]) graycube_at(m[i], j, i == j ? 1 : 0) / w];
function graycube_fineness() =
  str(graycube_named("$fn", $fn), graycube_named("$fa", $fa), graycube_named("$fs", $fs));
function graycube_round(r, d) =
  str(graycube_fineness(), graycube_named("r", graycube_radius(r, d, 1)));
module graycube_note(name, lists) { text(str("graycube|", name, "|", lists)); }
module cube(size, center) {
  graycube_note("cube", graycube_named("size", graycube_three(size, 1)));
}
module sphere(r, d) { graycube_note("sphere", graycube_round(r, d)); }
module cylinder(h, r1, r2, center, r, d, d1, d2) {
  both = graycube_radius(r, d, 1);
  graycube_note("cylinder", str(graycube_fineness(), graycube_named("h", graycube_or(h, 1)),
                                graycube_named("r1", graycube_radius(r1, d1, both)),
                                graycube_named("r2", graycube_radius(r2, d2, both))));
}
module polyhedron(points, faces, convexity, triangles) {
  graycube_note("polyhedron", graycube_points(points));
}
module square(size, center) {
  graycube_note("square", graycube_named("size", graycube_pair(size)));
}
module circle(r, d) { graycube_note("circle", graycube_round(r, d)); }
module polygon(points, paths, convexity) { graycube_note("polygon", graycube_points(points)); }
module translate(v) {
  w = graycube_three(is_list(v) ? v : [], 0);
  m = [1, 0, 0, w[0], 0, 1, 0, w[1], 0, 0, 1, w[2], 0, 0, 0, 1];
  graycube_note("multmatrix", graycube_named("m", m));
  children();
}
module rotate(a, v) {
  b = graycube_three(a, 0);
  axis = is_list(v) ? graycube_three(v, 0) : [0, 0, 1];
  m = is_list(a) ? graycube_turns(b[0], b[1], b[2]) : graycube_turn(graycube_or(a, 0), axis);
  graycube_note("multmatrix", graycube_named("m", m));
  children();
}
module scale(v) {
  w = graycube_three(graycube_or(v, 1), 1);
  m = graycube_matrix([w[0], 0, 0], [0, w[1], 0], [0, 0, w[2]]);
  graycube_note("multmatrix", graycube_named("m", m));
  children();
}
module mirror(v) {
  m = graycube_mirror(is_list(v) ? graycube_three(v, 0) : [1, 0, 0]);
  graycube_note("multmatrix", graycube_named("m", m));
  children();
}
module multmatrix(m) {
  graycube_note("multmatrix", graycube_named("m", graycube_full(m)));
  children();
}
module linear_extrude(file, layer, height, origin, scale, center, twist, slices, convexity) {
  h = graycube_or(height, is_num(file) ? file : 100);
  graycube_note("linear_extrude", str(graycube_fineness(), graycube_named("height", h),
                                      graycube_named("twist", graycube_or(twist, 0)),
                                      graycube_named("scale", graycube_pair(scale)),
                                      graycube_named("origin", graycube_origin(origin))));
  children();
}
module rotate_extrude(file, layer, origin, scale, convexity, angle, start) {
  from = graycube_or(start, is_undef(angle) ? 180 : 0);
  graycube_note("rotate_extrude", str(graycube_fineness(), graycube_named("start", from),
                                      graycube_named("angle", graycube_or(angle, 360)),
                                      graycube_named("scale", graycube_or(scale, 1)),
                                      graycube_named("origin", graycube_origin(origin))));
  children();
}
module offset(r, delta, chamfer) {
  graycube_note("offset", str(graycube_fineness(), graycube_named("r", graycube_or(r, 1)),
                              graycube_named("delta", delta)));
  children();
}
)SCAD";

}  // namespace

std::string_view openscad_exact_definitions() { return kDefinitions; }

}  // namespace graycube
