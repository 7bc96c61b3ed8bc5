#include "formats/openscad/language/recovered_rotation.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>
#include <random>
#include <string>

#include "catch.hpp"
#include "formats/openscad/reading.hpp"

namespace graycube {
namespace {

using namespace graycube::testing;

constexpr Vec3 kX{1, 0, 0}, kY{0, 1, 0}, kZ{0, 0, 1};

/// The number as a text of six digits has it.
double six_digits(double v) {
  char text[40];
  const char* end =
      std::to_chars(text, text + sizeof text, v, std::chars_format::scientific, 5).ptr;
  std::from_chars(text, end, v);
  return v;
}
Affine six_digits(Affine map) {
  for (auto& row : map.m) {
    for (double& v : row) v = six_digits(v);
  }
  return map;
}
Affine recovered(const Affine& exact) { return recovered_rotation(six_digits(exact), 6); }

double distance(const Affine& a, const Affine& b) {
  double most = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 4; ++j) most = std::max(most, std::fabs(a.m[i][j] - b.m[i][j]));
  }
  return most;
}
/// How far the columns of a map are from unit length and right angles, after division by the
/// factor.
double unevenness(const Affine& map, double factor = 1) {
  double most = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      double product = i == j ? -1 : 0;
      for (std::size_t k = 0; k < 3; ++k) product += map.m[k][i] / factor * (map.m[k][j] / factor);
      most = std::max(most, std::fabs(product));
    }
  }
  return most;
}

/// The map of OpenSCAD's rotate([x, y, z]).
Affine turns(double x, double y, double z) {
  return compose(rotation(kZ, z), compose(rotation(kY, y), rotation(kX, x)));
}
/// The map of OpenSCAD's mirror(n).
Affine mirror(const Vec3& n) {
  Affine map;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      map.m[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)] -=
          2 * n[i] * n[j] / dot(n, n);
    }
  }
  return map;
}

class Numbers {
 public:
  explicit Numbers(std::uint64_t seed) : random_(seed) {}
  double between(double lo, double hi) { return std::uniform_real_distribution<>(lo, hi)(random_); }
  int whole(int lo, int hi) { return std::uniform_int_distribution<>(lo, hi)(random_); }

 private:
  std::mt19937_64 random_;
};

TEST_CASE("a rotation by round angles is found again in six digits") {
  const auto seed = GENERATE(range(1, 400));
  INFO("seed " << seed);
  Numbers numbers(static_cast<std::uint64_t>(seed));
  const double unit = numbers.whole(0, 1) == 0 ? 0.5 : 0.01;
  const auto angle = [&] {
    return numbers.whole(0, 3) == 0 ? 90.0 * numbers.whole(-2, 2)
                                    : unit * std::floor(numbers.between(-180, 180) / unit);
  };
  const Affine exact = turns(angle(), angle(), angle());
  CHECK(distance(recovered(exact), exact) < 2e-15);
  const Vec3 axis{static_cast<double>(numbers.whole(-9, 9)),
                  static_cast<double>(numbers.whole(-9, 9)), 5};
  const Affine about = rotation(axis, unit * std::floor(numbers.between(1, 179) / unit));
  CHECK(distance(recovered(about), about) < 2e-15);
  const Affine mirrored = mirror(axis);
  CHECK(distance(recovered(mirrored), mirrored) < 2e-15);
}

TEST_CASE("parts of a full turn are found again") {
  for (const int n : {7, 11, 13, 17, 48, 64}) {
    for (int i = 0; i < n; ++i) {
      INFO(i << " / " << n);
      const Affine exact = rotation(kZ, i * 360.0 / n);
      CHECK(distance(recovered(exact), exact) < 1e-15);
    }
  }
}

TEST_CASE("any rotation becomes one to the last bits, as near as its digits") {
  const auto seed = GENERATE(range(1, 2000));
  INFO("seed " << seed);
  Numbers numbers(static_cast<std::uint64_t>(seed));
  // Mostly turns by 0, by a quarter, or by next to nothing.
  const auto angle = [&] {
    const int kind = numbers.whole(0, 5);
    return kind == 0   ? 0
           : kind == 1 ? 90
           : kind == 2 ? numbers.between(-0.1, 0.1)
                       : numbers.between(-180, 180);
  };
  const Affine turned = turns(angle(), angle(), angle());
  const double factor =
      numbers.whole(0, 2) == 0 ? 1 : six_digits(std::exp2(numbers.between(-9, 9)));
  Affine exact = compose(scaling({factor, factor, factor}), turned);
  if (numbers.whole(0, 1) == 0) exact = compose(exact, mirror(kY));
  const Affine map = recovered(exact);
  CHECK(distance(map, exact) <= 1e-5 * factor);
  const double scale = std::sqrt(dot(map.row(0), map.row(0)));
  CHECK(std::fabs(scale - factor) <= 2e-5 * factor);
  CHECK(unevenness(map, scale) < 2e-15);
}

TEST_CASE("what is no rotation stays as it is written") {
  Numbers numbers(7);
  for (int i = 0; i < 500; ++i) {
    // Sheared, or scaled unevenly, by a little more than six digits can hide.
    Affine change;
    const double little = numbers.between(1.2e-5, 1e-3);
    change.m[static_cast<std::size_t>(numbers.whole(0, 2))]
            [static_cast<std::size_t>(numbers.whole(0, 2))] += little;
    const Affine map = six_digits(
        compose(turns(numbers.between(-180, 180), numbers.between(-180, 180), 30), change));
    INFO("i " << i << ", " << little);
    CHECK(recovered_rotation(map, 6) == map);
  }
  for (const Affine& map : {scaling({1, 1, 1.00001}), scaling({0.333333, 0.333333, 0.333333}),
                            translation({0.333333, 0, 1}), scaling({2, 3, -4})}) {
    CHECK(recovered_rotation(map, 6) == map);
  }
  Affine sheared;
  sheared.m[0][1] = 1e-6;
  CHECK(recovered_rotation(sheared, 6) == sheared);
  Affine flat;
  flat.m[0][0] = 0;
  CHECK(recovered_rotation(flat, 6) == flat);
}

TEST_CASE("translations keep their digits") {
  const Affine map = recovered(compose(translation({1.0 / 3, 2, -100.0 / 7}), turns(30, 0, 15)));
  CHECK(map.translation() == Vec3{0.333333, 2, -14.2857});
}

TEST_CASE("a sphere under five nested rotations by 30 and 15 degrees stays one") {
  const std::string turned =
      "multmatrix([[1, 0, 0, 0], [0, 0.866025, -0.5, 0], [0, 0.5, 0.866025, 0], [0, 0, 0, 1]]) "
      "multmatrix([[0.965926, -0.258819, 0, 0], [0.258819, 0.965926, 0, 0], [0, 0, 1, 0], [0, 0, "
      "0, 1]]) ";
  std::string text;
  for (int i = 0; i < 5; ++i) text += turned;
  const Scene ball = scene_of(text + "sphere(r = 3);");
  CHECK(ball.objects[0].csg.transform == std::nullopt);
  CHECK(std::get<SphereShape>(ball.objects[0].csg.value).radius == Approx(3).epsilon(4e-15));
  const Scene box = scene_of(text + "cube(1);");
  REQUIRE(box.objects[0].csg.transform);
  CHECK(unevenness(*box.objects[0].csg.transform) < 4e-15);
  Affine exact;
  for (int i = 0; i < 5; ++i) exact = compose(exact, compose(rotation(kX, 30), rotation(kZ, 15)));
  CHECK(distance(*box.objects[0].csg.transform, exact) < 4e-15);
}

}  // namespace
}  // namespace graycube
