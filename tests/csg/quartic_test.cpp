// The quartic of elliptic cones, in fewer operations.
#include "csg/quartic.hpp"

#include <cmath>

#include "catch.hpp"
#include "dice.hpp"

using namespace graycube::csg;
using graycube::testing::Dice;

TEST_CASE(
    "three squares have bit for bit the values and derivatives of the products that they are") {
  Dice dice(5);
  const auto quadratic = [&] {
    const double scale = std::exp2(static_cast<double>(dice.below(60)) - 30);
    return Quadratic{scale * dice.between(-1, 1), scale * dice.between(-1, 1),
                     scale * dice.between(-1, 1)};
  };
  for (int i = 0; i < 100000; ++i) {
    const Quadratic x = quadratic(), y = quadratic(), w = quadratic();
    const ProductQuartic<3> products{{{{1, x, x}, {1, y, y}, {-1, w, w}}}};
    const SquaresQuartic squares{x, y, w};
    const double s = dice.between(-3, 3);
    INFO("case " << i);
    REQUIRE(squares.f(s) == products.f(s));
    REQUIRE(squares.df(s) == products.df(s));
    REQUIRE(squares.ddf(s) == products.ddf(s));
  }
}
