#include "coincidence/candidates.hpp"

#include <limits>

#include "catch.hpp"

namespace graycube::csg {
namespace {

constexpr double kTolerance = 1e-9;

Candidates of(std::initializer_list<Measured> all) {
  Candidates candidates(kTolerance, all.size());
  for (const Measured& m : all) candidates.mark(m);
  return candidates;
}

TEST_CASE("values within their tolerances are candidates, and few others are") {
  const Candidates candidates =
      of({{1, kTolerance}, {1 + 1.5 * kTolerance, kTolerance}, {2, kTolerance}});
  CHECK(candidates.may_meet({1, kTolerance}));
  CHECK(candidates.may_meet({1 + 1.5 * kTolerance, kTolerance}));
  CHECK_FALSE(candidates.may_meet({2, kTolerance}));
}

TEST_CASE("a value that may be anything is soon marked, and meets all others") {
  const Measured anything{0, 1e+300}, other{5, kTolerance};
  const Candidates candidates = of({anything, other});
  CHECK(candidates.may_meet(anything));
  CHECK(candidates.may_meet(other));
}

TEST_CASE("what isn't a number meets nothing") {
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  const Measured overflown{kInfinite, kTolerance}, unknown{1, kInfinite}, other{1, kTolerance};
  const Candidates candidates = of({overflown, unknown, other});
  CHECK_FALSE(candidates.may_meet(overflown));
  CHECK_FALSE(candidates.may_meet(unknown));
  CHECK_FALSE(candidates.may_meet(other));
}

}  // namespace
}  // namespace graycube::csg
