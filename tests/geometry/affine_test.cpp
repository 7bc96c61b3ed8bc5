#include "geometry/affine.hpp"
#include "geometry/infinity.hpp"

#include <cmath>
#include <limits>
#include <random>

#include "catch.hpp"

using namespace graycube;

namespace {

class RandomMaps {
 public:
  explicit RandomMaps(std::uint64_t seed) : engine_(seed) {}

  double number(double lo, double hi) {
    return lo + (hi - lo) * (static_cast<double>(engine_() >> 11) * 0x1p-53);
  }
  Vec3 vector() { return {number(-5, 5), number(-5, 5), number(-5, 5)}; }
  Affine turn() {
    Vec3 axis = vector();
    while (length(axis) < 0.1) axis = vector();
    return rotation(axis, number(-720, 720));
  }
  /// A map that turns, stretches by up to 10 along skew axes and moves: well away from singular.
  Affine map() {
    const Vec3 factors{number(0.1, 1), number(0.5, 5), number(-10, -1)};
    return compose(translation(vector()), compose(turn(), compose(scaling(factors), turn())));
  }

 private:
  std::mt19937_64 engine_;
};

double distance(const Vec3& a, const Vec3& b) { return length(a - b); }

}  // namespace

TEST_CASE("a composed map applies the first map first") {
  const Affine move = translation({1, 2, 3}), stretch = scaling({2, 3, 4});
  CHECK(compose(stretch, move).point({1, 1, 1}) == Vec3{4, 9, 16});
  CHECK(compose(move, stretch).point({1, 1, 1}) == Vec3{3, 5, 7});
  CHECK(compose(move, stretch).vector({1, 1, 1}) == Vec3{2, 3, 4});

  RandomMaps random(1);
  for (int i = 0; i < 200; ++i) {
    const Affine a = random.map(), b = random.map();
    const Vec3 p = random.vector();
    CHECK(distance(compose(a, b).point(p), a.point(b.point(p))) < 1e-11);
  }
}

TEST_CASE("scaling by any power of two has an exact inverse") {
  for (int k = -1023; k <= 1023; ++k) {
    CAPTURE(k);
    const double factor = std::ldexp(1.0, k);
    CHECK(scaling({factor, 1, -factor}).inverse() == scaling({1 / factor, 1, -1 / factor}));
  }
}

TEST_CASE("an inverse undoes its map") {
  RandomMaps random(2);
  for (int i = 0; i < 500; ++i) {
    CAPTURE(i);
    const Affine map = random.map();
    const auto inverse = map.inverse();
    REQUIRE(inverse);
    const Vec3 p = random.vector();
    CHECK(distance(inverse->point(map.point(p)), p) < 1e-11);
    CHECK(distance(map.point(inverse->point(p)), p) < 1e-11);
    CHECK(inverse->determinant() == Approx(1 / map.determinant()).epsilon(1e-11));
  }
}

TEST_CASE("inverses of moves, of scalings by powers of two and of quarter turns are exact") {
  CHECK(translation({1, -2, 0.1}).inverse() == translation({-1, 2, -0.1}));
  CHECK(scaling({2, -4, 0.125}).inverse() == scaling({0.5, -0.25, 8}));
  CHECK(rotation({0, 3, 0}, 90).inverse() == rotation({0, 3, 0}, -90));
}

TEST_CASE("singular and nearly singular maps have no inverse") {
  CHECK_FALSE(scaling({1, 0, 1}).inverse());
  Affine flat;
  flat.m = {{{1, 2, 3, 0}, {4, 5, 6, 0}, {5, 7, 9, 0}}};
  CHECK_FALSE(flat.inverse());
  flat.m[2][2] = 9 + 1e-11;  // the determinant is 3e-11, the row lengths' product 409
  CHECK_FALSE(flat.inverse());
  flat.m[2][2] = 9 + 1e-6;
  CHECK(flat.inverse());
  for (const double bad : {kInf, -kInf, std::numeric_limits<double>::quiet_NaN()}) {
    Affine broken;
    broken.m[1][1] = bad;
    CHECK_FALSE(broken.is_finite());
    CHECK_FALSE(broken.inverse());
    broken = Affine{};
    broken.m[0][3] = bad;
    CHECK_FALSE(broken.is_finite());
    CHECK_FALSE(broken.inverse());
  }
}

TEST_CASE("a map's size alone does not make it singular") {
  for (const double s : {1e-120, 1e-30, 1e30, 1e120}) {
    CAPTURE(s);
    const auto inverse = scaling({s, s, s}).inverse();
    REQUIRE(inverse);
    CHECK(inverse->m[0][0] * s == Approx(1).epsilon(1e-15));
  }
  CHECK(scaling({1e-9, 1, 1e9}).inverse());
}

TEST_CASE("rotations by multiples of 90 degrees are exact permutations of the axes") {
  CHECK(rotation({0, 0, 1}, 90).point({1, 2, 3}) == Vec3{-2, 1, 3});
  CHECK(rotation({1, 0, 0}, 90).point({1, 2, 3}) == Vec3{1, -3, 2});
  CHECK(rotation({0, 1, 0}, 90).point({1, 2, 3}) == Vec3{3, 2, -1});
  CHECK(rotation({0, 0.3, 0}, 180).point({1, 2, 3}) == Vec3{-1, 2, -3});
  CHECK(rotation({0, 0, 7}, -270) == rotation({0, 0, 0.1}, 90));
  CHECK(rotation({0, -1e-200, 0}, 270) == rotation({0, 1e200, 0}, 90));
  CHECK(rotation({1, 2, 3}, 0) == Affine{});
  CHECK(rotation({0, 2, 0}, 720) == Affine{});
}

TEST_CASE("a rotation keeps lengths, its axis and the right-hand rule") {
  RandomMaps random(3);
  for (int i = 0; i < 300; ++i) {
    CAPTURE(i);
    const Vec3 axis = random.vector(), p = random.vector();
    if (length(axis) < 0.1) continue;
    const double angle = random.number(1, 179);
    const Affine r = rotation(axis, angle);
    CHECK(r.determinant() == Approx(1).epsilon(1e-14));
    CHECK(distance(r.point(axis), axis) < 1e-14 * length(axis) * 4);
    CHECK(length(r.point(p)) == Approx(length(p)).epsilon(1e-14));
    CHECK(dot(cross(p, r.point(p)), axis) > 0);
    CHECK(distance(rotation(axis, -angle).point(r.point(p)), p) < 1e-13);
  }
}

TEST_CASE("moved, turned and evenly scaled maps are similarities and others are not") {
  RandomMaps random(4);
  for (int i = 0; i < 300; ++i) {
    CAPTURE(i);
    const double s = random.number(0.01, 100);
    const auto scale =
        compose(compose(translation(random.vector()), random.turn()), scaling({s, s, s}))
            .similarity_scale();
    REQUIRE(scale);
    CHECK(*scale == Approx(s).epsilon(1e-14));
    const auto squeezed = compose(random.turn(), scaling({s, s, s * (1 + 1e-9)}));
    CHECK_FALSE(squeezed.similarity_scale());
  }
  CHECK(Affine{}.similarity_scale() == 1.0);
  CHECK(scaling({-2, 2, 2}).similarity_scale() == 2.0);  // a mirror image
  CHECK_FALSE(scaling({0, 0, 0}).similarity_scale());
  Affine shear;
  shear.m[0][1] = 1e-12;
  CHECK_FALSE(shear.similarity_scale());
}

TEST_CASE("the transposed inverse keeps normals perpendicular to their surface") {
  RandomMaps random(5);
  for (int i = 0; i < 200; ++i) {
    CAPTURE(i);
    const Affine map = random.map();
    const Vec3 a = random.vector(), b = random.vector(), n = cross(a, b);
    const Vec3 mapped = map.inverse()->transposed_vector(n);
    CHECK(std::fabs(dot(mapped, map.vector(a))) < 1e-10 * length(mapped) * length(map.vector(a)));
    CHECK(std::fabs(dot(mapped, map.vector(b))) < 1e-10 * length(mapped) * length(map.vector(b)));
  }
}

TEST_CASE("a frame whose axes have very different lengths has an inverse however it is turned") {
  RandomMaps random(4);
  for (int i = 0; i < 200; ++i) {
    CAPTURE(i);
    const Affine turn = random.turn();
    const Affine wide = compose(turn, scaling({1e16, 1e16, 1e-3}));
    const auto inverse = wide.inverse();
    REQUIRE(inverse);
    // The short axis keeps its digits: it is the long ones' cross product.
    const Vec3 tip = inverse->point(wide.point({0.25, 0.5, 0}));
    CHECK(tip.x == Approx(0.25).epsilon(1e-9));
    CHECK(tip.y == Approx(0.5).epsilon(1e-9));
    CHECK(length(inverse->row(2)) == Approx(1e3).epsilon(1e-9));
  }
  // What is nearly flat in itself stays singular.
  Affine flat;
  flat.m[0] = {1, 1, 0, 0};
  flat.m[1] = {1, 1 + 1e-14, 0, 0};
  CHECK_FALSE(compose(flat, scaling({1e16, 1, 1})).inverse());
}
