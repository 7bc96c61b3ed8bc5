#include "flat/flush.hpp"

#include <cmath>
#include <random>

#include "catch.hpp"
#include "formats/openscad/reading.hpp"

namespace graycube {
namespace {

using namespace graycube::testing;

double area(const FlatLoops& loops) {
  double twice = 0;
  for (const FlatLoop& loop : loops) {
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const FlatPoint &a = loop[i], &b = loop[(i + 1) % loop.size()];
      twice += a.x * b.y - b.x * a.y;
    }
  }
  return twice / 2;
}
std::size_t corners(const FlatLoops& loops) {
  std::size_t count = 0;
  for (const FlatLoop& loop : loops) count += loop.size();
  return count;
}

/// Rectangles turned and moved, every corner off by up to `noise`.
class Sheet {
 public:
  explicit Sheet(std::uint64_t seed, double noise = 0) : random_(seed), noise_(noise) {
    const double angle = between(0, 6.3);
    map_ = {{{{std::cos(angle), -std::sin(angle), between(-20, 20)},
              {std::sin(angle), std::cos(angle), between(-20, 20)}}}};
  }
  double between(double lo, double hi) { return std::uniform_real_distribution<>(lo, hi)(random_); }
  FlatLoops rectangle(double x0, double y0, double x1, double y1) {
    FlatLoop loop;
    for (const FlatPoint& p : {FlatPoint{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}) {
      const FlatPoint q = map_(p);
      const double angle = between(0, 6.3), length = between(0, noise_);
      loop.push_back({q.x + length * std::cos(angle), q.y + length * std::sin(angle)});
    }
    return {loop};
  }

 private:
  std::mt19937_64 random_;
  double noise_;
  FlatMap map_;
};

FlatLoops flush(FlatOperation operation, std::initializer_list<FlatLoops> operands, double noise) {
  const std::vector<FlatLoops> list(operands);
  return combined_flush(operation, list, noise > 0 ? 4 * noise : flush_tolerance(list, 15));
}

TEST_CASE("turned notches that are flush with a side leave no skin") {
  for (const double noise : {0.0, 1e-5}) {
    for (std::uint64_t seed = 1; seed <= 1000; ++seed) {
      Sheet sheet(seed, noise);
      const double w = sheet.between(2, 30), h = sheet.between(2, 30),
                   d = sheet.between(0.1, 0.6) * h;
      const double a = sheet.between(0.1, 0.4) * w, b = sheet.between(0.5, 0.9) * w;
      const FlatLoops plate = sheet.rectangle(0, 0, w, h);
      INFO("seed " << seed << ", noise " << noise);
      const FlatLoops notched =
          flush(FlatOperation::kDifference, {plate, sheet.rectangle(a, h - d, b, h)}, noise);
      REQUIRE(notched.size() == 1);
      REQUIRE(corners(notched) == 8);
      REQUIRE(area(notched) == Approx(w * h - (b - a) * d).epsilon(1e-9 + 100 * noise));
      const FlatLoops lower =
          flush(FlatOperation::kDifference, {plate, sheet.rectangle(0, h - d, w, h)}, noise);
      REQUIRE(lower.size() == 1);
      REQUIRE(corners(lower) == 4);
      const FlatLoops both =
          flush(FlatOperation::kUnion,
                {sheet.rectangle(0, 0, w, h - d), sheet.rectangle(0, h - d, w, h)}, noise);
      REQUIRE(both.size() == 1);
      REQUIRE(corners(both) == 4);
      REQUIRE(
          flush(FlatOperation::kDifference, {plate, sheet.rectangle(0, 0, w, h)}, noise).empty());
      REQUIRE(flush(FlatOperation::kIntersection, {plate, sheet.rectangle(0, h, w, h + d)}, noise)
                  .empty());
    }
  }
}

TEST_CASE("what is farther apart than the tolerance stays apart") {
  const FlatLoops left{{{0, 0}, {10, 0}, {10, 10}, {0, 10}}};
  const auto right = [](double gap) {
    return FlatLoops{{{10 + gap, 0}, {20, 0}, {20, 10}, {10 + gap, 10}}};
  };
  const auto parts = [&](double gap, std::uint32_t digits) {
    const std::vector<FlatLoops> both{left, right(gap)};
    return combined_flush(FlatOperation::kUnion, both, flush_tolerance(both, digits)).size();
  };
  CHECK(parts(1e-11, 15) == 1);
  CHECK(parts(2e-10, 15) == 2);
  CHECK(parts(0.00005, 6) == 1);
  CHECK(parts(0.0001, 6) == 2);
}

TEST_CASE("details that are finer than the digits of what is far off keep their corners") {
  FlatLoop fine;
  for (int i = 0; i < 12; ++i)
    fine.push_back(
        {150 + 1e-4 * std::cos(i * 0.5235987755982988), 1e-4 * std::sin(i * 0.5235987755982988)});
  const std::vector<FlatLoops> operands{{fine}, {{{0, 0}, {10, 0}, {10, 10}}}};
  const FlatLoops loops =
      combined_flush(FlatOperation::kUnion, operands, flush_tolerance(operands, 6));
  CHECK(corners(loops) == 15);
  CHECK(area(loops) == Approx(50 + 3e-8).epsilon(1e-12));
}

TEST_CASE("the corners of a round outline of many sides stay, however flat they are") {
  FlatLoop round;
  for (int i = 0; i < 1000; ++i)
    round.push_back(
        {10 * std::cos(i * 0.006283185307179586), 10 * std::sin(i * 0.006283185307179586)});
  const std::vector<FlatLoops> operands{{round}, {{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}}};
  REQUIRE(flush_tolerance(operands, 6) > 5e-5);
  CHECK(corners(combined_flush(FlatOperation::kDifference, operands,
                               flush_tolerance(operands, 6))) == 1004);
}

TEST_CASE("holes, and parts that touch at a corner, stay what they are") {
  const std::vector<FlatLoops> operands{
      {{{0, 0}, {10, 0}, {10, 10}, {0, 10}}, {{2, 2}, {4, 2}, {4, 4}, {2, 4}}},
      {{{10, 10}, {20, 10}, {20, 20}, {10, 20}}}};
  const FlatLoops loops =
      combined_flush(FlatOperation::kUnion, operands, flush_tolerance(operands, 6));
  CHECK(area(loops) == 196);
  CHECK(corners(loops) == 12);
  CHECK(is_within(loops, {1, 1}));
  CHECK_FALSE(is_within(loops, {3, 3}));
  CHECK(is_within(loops, {15, 15}));
  CHECK_FALSE(is_within(loops, {15, 5}));
}

TEST_CASE("figures of six digits that a .csg file puts side by side are one") {
  // Strips of 25.4 / 7, each moved by its number.
  const Scene scene = scene_of(
      "linear_extrude(height = 1) { square(size = [3.62857, 3]); "
      "multmatrix([[1, 0, 0, 3.62857], [0, 1, 0, 0]]) square(size = [3.62857, 3]); "
      "multmatrix([[1, 0, 0, 7.25714], [0, 1, 0, 0]]) square(size = [3.62857, 3]); "
      "multmatrix([[1, 0, 0, 10.8857], [0, 1, 0, 0]]) square(size = [3.62857, 3]); "
      "multmatrix([[1, 0, 0, 14.5143], [0, 1, 0, 0]]) square(size = [3.62857, 3]); }");
  REQUIRE(scene.objects.size() == 1);
  REQUIRE(std::holds_alternative<PrismShape>(scene.objects[0].csg.value));
  CHECK(std::get<PrismShape>(scene.objects[0].csg.value).points.size() == 4);
}

}  // namespace
}  // namespace graycube
