// The parts of the search for surfaces that coincide. Other tests check that none is left of them
// in pictures.
#include "coincidence/coincidence.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <vector>

#include "catch.hpp"
#include "coincidence/candidates.hpp"
#include "coincidence/clusters.hpp"
#include "coincidence/levels.hpp"
#include "csg/build_primitive.hpp"
#include "csg/dice.hpp"
#include "csg/quartic.hpp"
#include "csg/random_model.hpp"
#include "mesh/samples.hpp"

using namespace graycube;
using namespace graycube::csg;
using namespace graycube::testing;

namespace {

bool meet(const Measured& a, const Measured& b) {
  return a.value - a.tolerance <= b.value + b.tolerance &&
         b.value - b.tolerance <= a.value + a.tolerance;
}

/// Some near each other, some far away, some known badly, some not at all.
std::vector<Measured> some_numbers(Dice& dice, std::size_t count) {
  std::vector<Measured> numbers;
  for (std::size_t i = 0; i < count; ++i) {
    Measured m{dice.between(-10, 10), dice.between(0, 2e-13)};
    if (i > 0 && dice.one_in(3))
      m.value = numbers[dice.below(i)].value + dice.between(-3e-13, 3e-13);
    if (dice.one_in(40)) m.value *= 1e9;
    if (dice.one_in(20)) m.tolerance *= std::exp(dice.between(0, 40));
    if (dice.one_in(50)) m.value = std::nan("");
    numbers.push_back(m);
  }
  return numbers;
}

/// The groups of two or more that for_each_run makes, each as a sorted list of names.
std::set<std::vector<int>> runs_of(const std::vector<Measured>& numbers,
                                   const std::vector<int>& names) {
  std::vector<Extent> extents;
  for (std::uint32_t i = 0; i < numbers.size(); ++i) {
    extents.push_back(
        {numbers[i].value - numbers[i].tolerance, numbers[i].value + numbers[i].tolerance, i});
  }
  std::set<std::vector<int>> runs;
  for_each_run(std::span(extents), [&](std::span<Extent> run) {
    std::vector<int> group;
    for (const Extent& e : run) group.push_back(names[e.item]);
    std::sort(group.begin(), group.end());
    runs.insert(group);
  });
  return runs;
}

template <typename T>
void shuffle(std::vector<T>& v, Dice& dice) {
  for (std::size_t i = v.size(); i > 1; --i) std::swap(v[i - 1], v[dice.below(i)]);
}

Exactness exact_to(double distance, double direction = 1e-14) {
  const auto d = static_cast<float>(distance);
  return {{d, d, d}, static_cast<float>(direction)};
}

/// A model of leaves as the compiler makes it before it unifies coincident surfaces.
Model model_of(const std::vector<Primitive>& primitives, std::vector<Plane> planes = {}) {
  Model model;
  model.primitives = primitives;
  model.planes = std::move(planes);
  return model;
}

Affine some_turn(Dice& dice) { return rotation(dice.unit_vector(), dice.between(1, 359)); }

}  // namespace

TEST_CASE("no two numbers that may be one are missed as candidates") {
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    INFO("seed " << seed);
    Dice dice(seed);
    const auto numbers = some_numbers(dice, 2 + dice.below(200));
    Candidates candidates(dice.one_in(4) ? 0 : 1e-13, numbers.size());
    for (const Measured& m : numbers) candidates.mark(m);
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      for (std::size_t j = 0; j < numbers.size(); ++j) {
        if (i == j || !meet(numbers[i], numbers[j])) continue;
        REQUIRE(candidates.may_meet(numbers[i]));
      }
    }
  }
}

TEST_CASE("of many numbers far apart few are candidates") {
  Dice dice(7);
  std::vector<Measured> numbers;
  for (int i = 0; i < 20'000; ++i) numbers.push_back({dice.between(-1e3, 1e3), 1e-13});
  Candidates candidates(1e-13, numbers.size());
  for (const Measured& m : numbers) candidates.mark(m);
  const auto count = std::count_if(numbers.begin(), numbers.end(),
                                   [&](const Measured& m) { return candidates.may_meet(m); });
  CHECK(count < 4'000);
}

TEST_CASE(
    "all of a run may be one number, what is one is in one run, and the order given doesn't "
    "matter") {
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    INFO("seed " << seed);
    Dice dice(seed);
    auto numbers = some_numbers(dice, 1 + dice.below(60));
    std::vector<int> names(numbers.size());
    for (std::size_t i = 0; i < names.size(); ++i) names[i] = static_cast<int>(i);
    const auto runs = runs_of(numbers, names);
    for (const auto& run : runs) {
      for (const int a : run) {
        for (const int b : run)
          REQUIRE(meet(numbers[static_cast<std::size_t>(a)], numbers[static_cast<std::size_t>(b)]));
      }
    }
    std::vector<std::size_t> order(numbers.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    shuffle(order, dice);
    std::vector<Measured> shuffled;
    std::vector<int> shuffled_names;
    for (const std::size_t i : order) {
      shuffled.push_back(numbers[i]);
      shuffled_names.push_back(names[i]);
    }
    REQUIRE(runs_of(shuffled, shuffled_names) == runs);
  }
}

TEST_CASE("numbers each within tolerance of the next don't carry the first to the last") {
  std::vector<Measured> chain;
  std::vector<int> names;
  for (int i = 0; i < 1000; ++i) {
    chain.push_back({1e-13 * i, 0.6e-13});
    names.push_back(i);
  }
  for (const auto& run : runs_of(chain, names)) CHECK(run.size() <= 2);
}

TEST_CASE("what is nearest stays together, whatever comes within tolerance of one of them") {
  // The first and the second are within tolerance, but the second and the third are the pair.
  const std::vector<Measured> numbers{{0, 1e-3}, {1.5e-3, 1e-3}, {1.5e-3 + 1e-3, 1e-3}};
  CHECK(runs_of(numbers, {0, 1, 2}) == std::set<std::vector<int>>{{0}, {1, 2}});
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    INFO("seed " << seed);
    Dice dice(seed);
    std::vector<Measured> pairs;
    std::vector<int> names;
    for (int i = 0; i < 100; ++i) {
      // The tolerance is much larger than their differences, and mostly others are within it, too.
      const double at = dice.between(0, 1);
      for (int k = 0; k < 2; ++k) {
        pairs.push_back({at + dice.between(0, 1e-9), 1e-2});
        names.push_back(i);
      }
    }
    std::multiset<int> seen;
    for (const auto& run : runs_of(pairs, names)) {
      const std::set<int> once(run.begin(), run.end());
      CHECK(run.size() == 2 * once.size());
      seen.insert(run.begin(), run.end());
    }
    CHECK(seen.size() == pairs.size());
  }
}

TEST_CASE("opposite faces of one solid stay apart, and others go to the nearer of them") {
  Level lower, upper, third;
  lower.offset = lower.own.offset = 1;
  lower.tolerance = 1e-3;
  lower.is_backward = true;
  upper = lower;
  upper.offset = upper.own.offset = 1.0001;
  upper.is_backward = false;
  third = upper;
  third.primitive = 1;
  third.offset = third.own.offset = 1.000099;
  const Planes planes({lower, upper, third});
  CHECK(planes.has_unequal());
  std::vector<std::vector<double>> found;
  planes.for_each([&](std::span<const Level> plane, double) {
    found.emplace_back();
    for (const Level& f : plane) found.back().push_back(f.offset);
  });
  REQUIRE(found.size() == 2);
  CHECK(found[0] == std::vector<double>{1});
  CHECK(found[1].size() == 2);
}

TEST_CASE(
    "numbers are off by half a unit of their last digit, and by 64 halves of a double's last place "
    "at least") {
  CHECK(share_of_digits(0) == kRoundedShare);
  CHECK(share_of_digits(6) == 5e-6);
  CHECK(share_of_digits(7) == 5e-7);
  CHECK(share_of_digits(17) == kRoundedShare);
  CHECK(share_of_digits(40) == kRoundedShare);
  // A part of 100 mm, and one of 100 m.
  const auto reach_of = [](double size) {
    return exactness_of({}, {size, size, size}, 1, share_of_digits(0), kRoundedShare).distance();
  };
  CHECK(reach_of(100) == Approx(7.1e-13).epsilon(0.01));
  CHECK(reach_of(1e5) == Approx(7.1e-10).epsilon(0.01));
}

TEST_CASE("what a map goes out to and comes back from counts for how exact it is") {
  MeasuredMap map = compose(MeasuredMap{}, translation({1e6, 0, 0}));
  map = compose(map, translation({-1e6, 0, 0}));
  CHECK(map.map == Affine{});
  const Vec3 position = exactness_of(map, {1, 1, 1}, 1, kRoundedShare, kRoundedShare).position();
  CHECK(position.x > 1e6 * kRoundedShare);
  CHECK(position.y < 2 * kRoundedShare);
}

TEST_CASE("surfaces come out the same in whatever order the primitives stand") {
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    INFO("seed " << seed);
    Dice dice(seed);
    const Affine turn = some_turn(dice);
    std::vector<Primitive> primitives;
    for (int i = 0; i < 12; ++i) {
      // The same turn by other arithmetic, so that what coincides differs in its last places.
      const Affine part = rotation({0, 0, 1}, 90 * static_cast<double>(dice.below(4)));
      const Affine map = compose(compose(turn, part.inverse().value()), part);
      const double x = static_cast<double>(dice.below(3)),
                   h = 1 + static_cast<double>(dice.below(2));
      if (dice.one_in(2)) primitives.push_back(build_box(map, {x, 0, 0}, {x + 1, 1, h}));
      primitives.push_back(build_cylinder(map, {x, 0.5, 0}, {x, 0.5, h}, 0.25));
      primitives.push_back(build_sphere(map, {x, 0, 0}, 0.5));
    }
    std::vector<std::uint32_t> order(primitives.size());
    for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
    shuffle(order, dice);
    std::vector<Primitive> shuffled;
    for (const std::uint32_t i : order) shuffled.push_back(primitives[i]);
    Model a = model_of(primitives), b = model_of(shuffled);
    const std::vector<Exactness> exactness(primitives.size(), exact_to(1e-13));
    unify_coincident_surfaces(a, exactness);
    unify_coincident_surfaces(b, exactness);
    for (std::uint32_t i = 0; i < order.size(); ++i) {
      const Primitive &p = a.primitives[order[i]], &q = b.primitives[i];
      REQUIRE(p.kind == q.kind);
      REQUIRE(p.v == q.v);
      REQUIRE(p.to_local == q.to_local);
    }
  }
}

TEST_CASE("surfaces without a partner keep their bits, and so do those that are equal already") {
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    INFO("seed " << seed);
    Dice dice(seed);
    std::vector<Primitive> primitives;
    for (int i = 0; i < 8; ++i) {
      const Affine map = compose(translation(dice.point(20)), some_turn(dice));
      primitives.push_back(build_box(map, {0, 0, 0}, {1, 2, 3}));
      primitives.push_back(build_cylinder(map, {5, 0, 0.5}, {5, 0, 1.5}, 0.3));
      primitives.push_back(build_torus(map, {0, 0, 9}, {0, 1, 1}, 2, 0.5));
      primitives.push_back(primitives[dice.below(primitives.size())]);
    }
    Model model = model_of(primitives);
    unify_coincident_surfaces(model, std::vector<Exactness>(primitives.size(), exact_to(1e-13)));
    for (std::size_t i = 0; i < primitives.size(); ++i)
      REQUIRE(model.primitives[i] == primitives[i]);
  }
}

TEST_CASE(
    "a cone with equal ends is a cylinder, and one so far away that nothing is known of it stays a "
    "cone") {
  for (const double reach : {1.0, 1e60}) {
    Model model =
        model_of({build_cone({}, {reach, 0, 0}, reach, {reach, 0, reach}, reach * (1 - 1e-15)),
                  build_cone({}, {-reach, 0, 0}, reach, {-reach, 0, reach}, 0.5 * reach)});
    const Exactness exactness =
        exactness_of({}, {2 * reach, 2 * reach, 2 * reach}, 1, kRoundedShare, kRoundedShare);
    unify_coincident_surfaces(model, std::vector<Exactness>(2, exactness));
    CHECK(model.primitives[0].kind ==
          (reach == 1 ? PrimitiveKind::kCylinder : PrimitiveKind::kCone));
    CHECK(model.primitives[1].kind == PrimitiveKind::kCone);
  }
}

TEST_CASE(
    "a box by a turn of three times thirty degrees is one along the axes where another's face lies "
    "in its planes") {
  Affine turn;
  for (int i = 0; i < 3; ++i) turn = compose(rotation({0, 0, 1}, 30), turn);
  Model model =
      model_of({build_box(turn, {0, 0, 0}, {2, 3, 1}), build_box({}, {-3, 0, 0}, {0, 2, 1})});
  REQUIRE(model.primitives[0].kind == PrimitiveKind::kParallelepiped);
  unify_coincident_surfaces(model, std::vector<Exactness>(2, exact_to(1e-13)));
  CHECK(model.primitives[0].kind == PrimitiveKind::kBox);
  CHECK(model.primitives[0].v == model.primitives[1].v);
}

TEST_CASE(
    "a mesh whose faces lie in others' planes stays closed, and its faces are met in those "
    "planes") {
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    INFO("seed " << seed);
    Dice dice(seed);
    const Affine turn = some_turn(dice);
    Model model;
    model.primitives.push_back(build_box(turn, {0, 0, 0}, {3, 3, 1}));
    // The mesh is as exact as six digits are, and has corners that are off by as much.
    PolygonMesh plate = box_polygons({1, 1, 0}, {2, 2, 1});
    for (Vec3& p : plate.points) p = p + 1e-6 * dice.point(1);
    model.primitives.push_back(build_mesh(turn, closed(plate), model.meshes));
    unify_coincident_surfaces(model, {{exact_to(1e-14), exact_to(5e-6, 5e-6)}});
    const Mesh& mesh = model.meshes[0];
    REQUIRE_FALSE(mesh.surface().planes.empty());
    for (int i = 0; i < 50; ++i) {
      // The ray goes from one large face to the other.
      const Vec3 through = turn.point({dice.between(1.3, 1.7), dice.between(1.3, 1.7), 0.5});
      const Vec3 origin =
          through - 5.0 * turn.vector({dice.between(-0.4, 0.4), dice.between(-0.4, 0.4), 1});
      const Ray towards{origin, through - origin};
      const Spans of_box = spans_along(model.primitives[0], model.data(), towards);
      const Spans of_mesh = mesh.spans(towards);
      REQUIRE(of_box.count == 1);
      REQUIRE(of_mesh.count == 1);
      CHECK(of_mesh.interval[0].enter == of_box.interval[0].enter);
      CHECK(of_mesh.interval[0].leave == of_box.interval[0].leave);
    }
  }
}

TEST_CASE("a settled root is the same to the bit whatever interval it was found in") {
  std::size_t compared = 0;
  for (std::uint64_t seed = 0; seed < 2000; ++seed) {
    INFO("seed " << seed);
    Dice dice(seed);
    const SquaresQuartic line{
        product(dice.between(-1, 1), dice.between(-1, 1), 1, dice.between(-0.3, 0.3)),
        product(dice.between(-1, 1), dice.between(-1, 1), 1, dice.between(-0.3, 0.3)),
        product(1, dice.between(-0.3, 0.3), 1, dice.between(-0.3, 0.3))};
    const auto f = [&](double s) { return line.f(s); };
    const auto df = [&](double s) { return line.df(s); };
    const double lo = dice.between(-3, 0), hi = dice.between(0, 3);
    if ((f(lo) < 0) == (f(hi) < 0)) continue;
    const double root = settled_root(f, df, lo, hi);
    const double reach = dice.between(1e-3, 0.1);
    const double from = std::fmax(lo, root - reach), to = std::fmin(hi, root + reach);
    // There is only one root, so that both look for the same one.
    const auto knots = quartic_extremes(line, lo, hi);
    if (knots.count != 2 || (f(from) < 0) == (f(to) < 0)) continue;
    REQUIRE(settled_root(f, df, from, to) == root);
    REQUIRE(root == Approx(bracketed_root(f, df, lo, hi)).margin(1e-12));
    ++compared;
  }
  CHECK(compared > 300);
}
