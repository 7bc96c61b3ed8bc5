#include "formats/openscad/language/recovered_rotation.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>

#include "check.hpp"
#include "geometry/infinity.hpp"
#include "geometry/portable_math.hpp"
#include "written_digits.hpp"

namespace graycube {
namespace {

/// A matrix less orthogonal than this is no rotation; six digits give errors of 1e-5 at most.
constexpr double kLooseness = 1e-4;
/// Entries smaller than this, relative to the largest, are zeros with rounding errors.
constexpr double kNothing = 1e-15;
/// How far, in halves of the largest entry's last digit, entries may be from those of a rotation
/// computed from the entries, of which each depends on several. Entries that are small beside
/// others in a matrix with a 0 must also keep this share of their own size.
constexpr double kMadeOfOthers = 4;
constexpr double kShareOfSmall = 0.01;
/// How far a round angle may be from the angle computed from the entries, in degrees.
constexpr double kAngleDoubt = 2e-4;
constexpr int kFinestPartOfTurn = 64;
/// How far the ratio of two numbers may be from the ratio computed from the entries, and the
/// largest whole number in it.
constexpr double kRatioDoubt = 1e-4;
constexpr int kLargestInRatio = 20;
constexpr double kDegrees = 57.295779513082321;

double& at(Affine& map, std::size_t i, std::size_t j) { return map.m[i][j]; }
Vec3 column(const Affine& map, std::size_t j) { return {map.m[0][j], map.m[1][j], map.m[2][j]}; }

Affine linear_part(Affine map, double factor = 1) {
  for (auto& row : map.m) {
    for (double& v : row) v *= factor;
    row[3] = 0;
  }
  return map;
}

/// The number of fewest digits, at most `digits`, within `doubt` of v.
double round_number(double v, double doubt, std::uint32_t digits) {
  double round = v;
  for (std::uint32_t n = 1; n <= digits; ++n) {
    char text[40];
    const auto precision = static_cast<int>(n) - 1;
    const char* end =
        std::to_chars(text, text + sizeof text, v, std::chars_format::scientific, precision).ptr;
    std::from_chars(text, end, round);
    if (std::fabs(round - v) <= doubt) return round;
  }
  return round;
}

double largest_entry(const Affine& map) {
  return std::max({max_abs(map.row(0)), max_abs(map.row(1)), max_abs(map.row(2))});
}

/// Whether every entry of the map is rounded to the one that was written, or within `more` and
/// `share` of it.
bool is_written_as(const Affine& map, const Affine& written, std::uint32_t digits, double more = 0,
                   double share = 0) {
  const double nothing = kNothing * largest_entry(written);
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      const double v = written.m[i][j];
      const double rounding = (1 + 1e-6) * half_unit(v, digits);
      const double allowed = std::max({rounding, nothing, std::min(more, share * std::fabs(v))});
      if (!(std::fabs(map.m[i][j] - v) <= allowed)) return false;
    }
  }
  return true;
}

bool is_single_number_a_row(const Affine& map) {
  for (std::size_t i = 0; i < 3; ++i) {
    int in_row = 0, in_column = 0;
    for (std::size_t j = 0; j < 3; ++j) {
      in_row += map.m[i][j] != 0 ? 1 : 0;
      in_column += map.m[j][i] != 0 ? 1 : 0;
    }
    if (in_row != 1 || in_column != 1) return false;
  }
  return true;
}

/// The factor of a map that is nearly a similarity.
std::optional<double> rough_factor(const Affine& map) {
  double squares = 0;
  for (std::size_t j = 0; j < 3; ++j) squares += dot(column(map, j), column(map, j));
  const double square = squares / 3;
  if (!(square > 1e-200 && square < 1e200)) return std::nullopt;
  for (std::size_t j = 0; j < 3; ++j) {
    const Vec3 c = column(map, j);
    if (!(std::fabs(dot(c, c) - square) <= kLooseness * square)) return std::nullopt;
    if (!(std::fabs(dot(c, column(map, (j + 1) % 3))) <= kLooseness * square)) return std::nullopt;
  }
  return std::sqrt(square);
}

/// The angle of a direction, from −180 to 180 degrees; the direction must not be (0, 0).
double angle_of(double x, double y) {
  const double a = std::fabs(x), b = std::fabs(y);
  const double t = std::min(a, b) / std::max(a, b);
  // Right to 0.25 degrees; each correction by the tangent of the rest leaves a third of its cube.
  double angle = t * (45 + 15.64 * (1 - t));
  if (b > a) angle = 90 - angle;
  if (x < 0) angle = 180 - angle;
  if (y < 0) angle = -angle;
  for (int i = 0; i < 2; ++i) {
    const double c = cos_degrees(angle), s = sin_degrees(angle);
    angle += kDegrees * (c * y - s * x) / (c * x + s * y);
  }
  return angle;
}

/// The roundest angle within doubt, in degrees.
double round_angle(double angle) {
  for (const double unit : {1.0, 0.1, 0.01}) {
    const double round = std::floor(angle / unit + 0.5) / (1 / unit);
    if (std::fabs(round - angle) <= kAngleDoubt) return round;
  }
  for (int n = 7; n <= kFinestPartOfTurn; ++n) {
    const double round = std::floor(angle * n / 360 + 0.5) * 360 / n;
    if (std::fabs(round - angle) <= kAngleDoubt) return round;
  }
  return std::floor(angle * 1000 + 0.5) / 1000;
}

/// A turn about x, then y, then z: OpenSCAD's rotate([x, y, z]).
Affine round_turns(const Affine& r) {
  const double flat = std::sqrt(r.m[0][0] * r.m[0][0] + r.m[1][0] * r.m[1][0]);
  // If y is ±90°, only the difference of x and z matters.
  const bool is_upright = flat < 1e-5;
  const double z = is_upright ? 0 : angle_of(r.m[0][0], r.m[1][0]);
  const double y = angle_of(flat, -r.m[2][0]);
  const double x = is_upright ? angle_of(r.m[1][1], -r.m[1][2]) : angle_of(r.m[2][2], r.m[2][1]);
  return compose(rotation({0, 0, 1}, round_angle(z)),
                 compose(rotation({0, 1, 0}, round_angle(y)), rotation({1, 0, 0}, round_angle(x))));
}

/// A vector of that direction in small whole numbers, if there is one.
std::optional<Vec3> whole_numbers(const Vec3& v) {
  const Vec3 ratio = (1 / max_abs(v)) * v;
  for (int n = 1; n <= kLargestInRatio; ++n) {
    Vec3 whole;
    bool fits = true;
    for (int a = 0; a < 3; ++a) {
      whole[a] = std::floor(n * ratio[a] + 0.5);
      fits = fits && std::fabs(whole[a] / n - ratio[a]) <= kRatioDoubt;
    }
    if (fits) return whole;
  }
  return std::nullopt;
}

/// A turn about one axis: rotate(angle, v), and mirror(v) turned over.
std::optional<Affine> round_turn(const Affine& r) {
  const Vec3 twice_sine{r.m[2][1] - r.m[1][2], r.m[0][2] - r.m[2][0], r.m[1][0] - r.m[0][1]};
  const double twice_cosine = r.m[0][0] + r.m[1][1] + r.m[2][2] - 1;
  Vec3 axis = twice_sine;
  if (twice_cosine < -1.5) {
    // The sine is nearly zero. R + Rᵀ − 2 cos is a multiple of the axis times itself.
    std::size_t longest = 0;
    for (std::size_t j = 1; j < 3; ++j) {
      if (r.m[j][j] > r.m[longest][longest]) longest = j;
    }
    axis = column(r, longest) + r.row(static_cast<int>(longest));
    axis[static_cast<int>(longest)] -= twice_cosine;
    if (dot(axis, twice_sine) < 0) axis = -axis;
  }
  if (!(max_abs(axis) > 1e-5)) return std::nullopt;
  const auto whole = whole_numbers(axis);
  if (!whole) return std::nullopt;
  return rotation(*whole, round_angle(angle_of(twice_cosine, length(twice_sine))));
}

/// Row i and column j, which meet in a 0, are turns in a plane each; all other entries follow from
/// them.
Affine product_of_two_turns(const Affine& r, std::size_t i, std::size_t j) {
  const std::size_t i1 = (i + 1) % 3, i2 = (i + 2) % 3, j1 = (j + 1) % 3, j2 = (j + 2) % 3;
  const double row = std::sqrt(r.m[i][j1] * r.m[i][j1] + r.m[i][j2] * r.m[i][j2]);
  const double col = std::sqrt(r.m[i1][j] * r.m[i1][j] + r.m[i2][j] * r.m[i2][j]);
  const double p = r.m[i][j1] / row, q = r.m[i][j2] / row;
  const double u = r.m[i1][j] / col, v = r.m[i2][j] / col;
  // The permutations are even throughout, so that the determinant fixes the block's sign.
  Affine turned;
  at(turned, i, j) = 0;
  at(turned, i, j1) = p;
  at(turned, i, j2) = q;
  at(turned, i1, j) = u;
  at(turned, i2, j) = v;
  at(turned, i1, j1) = -v * q;
  at(turned, i1, j2) = v * p;
  at(turned, i2, j1) = u * q;
  at(turned, i2, j2) = -u * p;
  return turned;
}

/// The nearest rotation: Newton's iteration for the polar decomposition, N. J. Higham, "Computing
/// the polar decomposition – with applications", SIAM J. Sci. Stat. Comput. 7 (1986), equation 3.4:
/// X ← (X + X⁻ᵀ) / 2.
Affine nearest_rotation(Affine x) {
  for (int step = 0; step < 4; ++step) {
    const Vec3 a = x.row(0), b = x.row(1), c = x.row(2);
    const double determinant = x.determinant();
    const std::array<Vec3, 3> inverse{cross(b, c), cross(c, a), cross(a, b)};
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 3; ++j) {
        at(x, i, j) = 0.5 * (x.m[i][j] + inverse[i][static_cast<int>(j)] / determinant);
      }
    }
  }
  return x;
}

/// The row and column of an entry that is 0.
std::optional<std::array<std::size_t, 2>> zero_in(const Affine& r) {
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      if (r.m[i][j] == 0) return std::array{i, j};
    }
  }
  return std::nullopt;
}

/// A rotation times the factor, with the translation as written.
Affine placed(const Affine& turned, double factor, const Affine& written) {
  Affine map = linear_part(turned, factor);
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) at(map, i, j) += 0.0;  // no −0
    at(map, i, 3) = written.m[i][3];
  }
  return map;
}

}  // namespace

Affine recovered_rotation(const Affine& written, std::uint32_t digits) {
  GRAYCUBE_CHECK(digits > 0 && digits <= 17, "%u digits", digits);
  const auto rough = rough_factor(written);
  if (!rough || is_single_number_a_row(written)) return written;
  const double doubt = half_unit(largest_entry(written), digits);
  const double sign = written.determinant() < 0 ? -1 : 1;
  const double factor = sign * round_number(*rough, 2 * doubt, digits);
  const Affine r = linear_part(written, sign / *rough);
  Affine map = placed(round_turns(r), factor, written);
  if (is_written_as(map, written, digits)) return map;
  if (const auto turn = round_turn(r)) {
    map = placed(*turn, factor, written);
    if (is_written_as(map, written, digits)) return map;
  }
  const auto zero = zero_in(r);
  map = placed(zero ? product_of_two_turns(r, (*zero)[0], (*zero)[1]) : nearest_rotation(r), factor,
               written);
  constexpr double kAny = kInf;
  return is_written_as(map, written, digits, kMadeOfOthers * doubt, zero ? kShareOfSmall : kAny)
             ? map
             : written;
}

}  // namespace graycube
