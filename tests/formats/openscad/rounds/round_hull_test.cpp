// Hulls of balls and of level discs: against an oracle, and without slits between their pieces.

#include <algorithm>
#include <random>

#include "catch.hpp"
#include "formats/graycube/read_scene.hpp"
#include "formats/graycube/write_scene.hpp"
#include "formats/openscad/convex_oracle.hpp"
#include "formats/openscad/hulls/round_solid.hpp"
#include "formats/pov/scene_membership.hpp"

namespace graycube {
namespace {

using namespace graycube::testing;

Scene scene_of_node(CsgNode node) {
  Scene scene;
  scene.objects.push_back({"hull", kInheritMaterial, std::move(node)});
  return scene;
}

std::optional<Scene> hull_scene(RoundKind kind, const std::vector<RoundPoint>& points) {
  bool is_too_large = false;
  auto solid = round_solid(kind, points, is_too_large);
  REQUIRE_FALSE(is_too_large);
  if (!solid) return std::nullopt;
  return scene_of_node(std::move(solid->node));
}

Vec3 random_point(std::mt19937_64& random, double reach) {
  std::uniform_real_distribution<double> place(-reach, reach);
  return {place(random), place(random), place(random)};
}

std::size_t count_of(const Scene& scene) {
  const auto* whole = std::get_if<OperationNode>(&scene.objects.front().csg.value);
  return whole == nullptr ? 1 : whole->children.size();
}

void check_points(RoundKind kind, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const auto points = random_rounds(random, 2 + seed % 8, kind);
  const auto scene = hull_scene(kind, points);
  if (!scene) return;  // All discs at one height.
  int wrong = 0, sure = 0;
  for (int i = 0; i < 60; ++i) {
    const Vec3 p = random_point(random, 6.5);
    const Side side = side_of_hull(kind, points, p, 1e-4);
    if (side == Side::kNear) continue;
    ++sure;
    // A point that comes near counts as inside, except within the margin.
    const bool is_inside = any_object_holds(*scene, p);
    if (is_inside != (side == Side::kInside) && side_of_hull(kind, points, p, 1e-6) == side)
      ++wrong;
  }
  INFO("seed " << seed);
  CHECK(wrong == 0);
  CHECK(sure > 20);
}

TEST_CASE("a point is in the hull of balls exactly when no plane keeps it out") {
  for (std::uint64_t seed = 0; seed < 300; ++seed) check_points(RoundKind::kBalls, seed);
}

TEST_CASE("a point is in the hull of level discs exactly when no plane keeps it out") {
  for (std::uint64_t seed = 0; seed < 300; ++seed) check_points(RoundKind::kDiscs, seed);
}

/// Checks that along rays from inside outwards, membership ends once, at the oracle's surface.
void check_rays(RoundKind kind, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const auto points = random_rounds(random, 2 + seed % 8, kind);
  const auto scene = hull_scene(kind, points);
  if (!scene) return;
  Vec3 middle;
  for (const RoundPoint& p : points)
    middle = middle + (1.0 / static_cast<double>(points.size())) * p.center;
  int wrong = 0;
  for (int i = 0; i < 30; ++i) {
    const Vec3 far = support_point(kind, points, random_point(random, 1));
    // Just within the surface, and just beyond it.
    for (const double share : {0.0, 0.3, 0.7, 0.97, 1 - 1e-6, 1 - 1e-9}) {
      wrong += any_object_holds(*scene, middle + share * (far - middle)) ? 0 : 1;
    }
    wrong += any_object_holds(*scene, middle + (1 + 1e-6) * (far - middle)) ? 1 : 0;
    // Between two points of the hull there is no gap.
    const Vec3 other = support_point(kind, points, random_point(random, 1));
    for (int k = 1; k < 40; ++k) {
      const Vec3 p = far + (k / 40.0) * (other - far);
      wrong += any_object_holds(*scene, middle + (1 - 1e-9) * (p - middle)) ? 0 : 1;
    }
  }
  INFO("seed " << seed);
  CHECK(wrong == 0);
}

TEST_CASE("the pieces of a hull of balls leave no slit between them") {
  for (std::uint64_t seed = 1000; seed < 1300; ++seed) check_rays(RoundKind::kBalls, seed);
}

TEST_CASE("the pieces of a hull of level discs leave no slit between them") {
  for (std::uint64_t seed = 1000; seed < 1300; ++seed) check_rays(RoundKind::kDiscs, seed);
}

TEST_CASE("a slot is a box and the two cylinders that were given") {
  const std::vector<RoundPoint> discs{
      {{0, 0, 0}, 5}, {{0, 0, 4}, 5}, {{20, 0, 0}, 5}, {{20, 0, 4}, 5}};
  bool is_too_large = false;
  const auto solid = round_solid(RoundKind::kDiscs, discs, is_too_large);
  REQUIRE(solid);
  const auto& pieces = std::get<OperationNode>(solid->node.value).children;
  REQUIRE(pieces.size() == 3);
  CHECK(std::get<BoxShape>(pieces[0].value) == BoxShape{{0, -5, 0}, {20, 5, 4}});
  CHECK(std::get<CylinderShape>(pieces[1].value) == CylinderShape{{0, 0, 0}, {0, 0, 4}, 5});
  CHECK(std::get<CylinderShape>(pieces[2].value) == CylinderShape{{20, 0, 0}, {20, 0, 4}, 5});
}

TEST_CASE(
    "a box of balls has a cylinder for each edge, a ball for each corner, and the planes of its "
    "faces") {
  std::vector<RoundPoint> balls;
  for (int i = 0; i < 8; ++i)
    balls.push_back({{i & 1 ? 10.0 : 0.0, i & 2 ? 8.0 : 0.0, i & 4 ? 6.0 : 0.0}, 2});
  bool is_too_large = false;
  const auto solid = round_solid(RoundKind::kBalls, balls, is_too_large);
  REQUIRE(solid);
  const auto& pieces = std::get<OperationNode>(solid->node.value).children;
  CHECK(pieces.size() == 1 + 12 + 8);
  const auto& planes = std::get<PolyhedronShape>(pieces[0].value).planes;
  for (const HalfSpaceShape& face : {HalfSpaceShape{{1, 0, 0}, 12}, HalfSpaceShape{{-1, 0, 0}, 2},
                                     HalfSpaceShape{{0, 1, 0}, 10}, HalfSpaceShape{{0, 0, 1}, 8}}) {
    CHECK(std::count(planes.begin(), planes.end(), face) == 1);
  }
}

TEST_CASE(
    "two balls are joined by the cone that touches both, and by a cylinder when they are alike") {
  bool is_too_large = false;
  const auto alike = round_solid(RoundKind::kBalls, {{{0, 0, 0}, 1}, {{4, 0, 0}, 1}}, is_too_large);
  REQUIRE(alike);
  const auto& pieces = std::get<OperationNode>(alike->node.value).children;
  REQUIRE(pieces.size() == 3);
  CHECK(std::get<CylinderShape>(pieces[0].value) == CylinderShape{{0, 0, 0}, {4, 0, 0}, 1});
  const auto unlike =
      round_solid(RoundKind::kBalls, {{{0, 0, 0}, 4}, {{5, 0, 0}, 1}}, is_too_large);
  REQUIRE(unlike);
  const auto& cone =
      std::get<ConeShape>(std::get<OperationNode>(unlike->node.value).children[0].value);
  // cos = 3/5 at the axis, sin = 4/5.
  CHECK(cone.base.x == Approx(2.4));
  CHECK(cone.base_radius == Approx(3.2));
  CHECK(cone.top.x == Approx(5.6));
  CHECK(cone.top_radius == Approx(0.8));
}

TEST_CASE("what others hide leaves no piece behind") {
  const std::vector<RoundPoint> seen{{{0, 0, 0}, 2}, {{10, 0, 0}, 3}, {{0, 10, 0}, 1}};
  auto more = seen;
  more.push_back({{0.5, 0, 0}, 1});  // in the first
  more.push_back({{5, 0, 0}, 2.5});  // between the first two
  more.push_back({{3, 3, 0}, 0.5});  // among all three
  more.push_back({{10, 0, 0}, 3});   // twice
  const auto plain = hull_scene(RoundKind::kBalls, seen),
             full = hull_scene(RoundKind::kBalls, more);
  REQUIRE((plain && full));
  CHECK(count_of(*plain) == 1 + 3 + 3);
  CHECK(count_of(*full) == count_of(*plain));
}

TEST_CASE("whatever hull there is can be written as a scene file and read again") {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    std::mt19937_64 random(seed);
    const RoundKind kind = seed % 2 == 0 ? RoundKind::kBalls : RoundKind::kDiscs;
    auto scene = hull_scene(kind, random_rounds(random, 2 + seed % 11, kind));
    if (!scene) continue;
    scene->settings.image = {64, 64, 1};
    scene->settings.camera.eye = {0, 0, 30};
    scene->settings.camera.up = {0, 1, 0};
    scene->settings.camera.fov_degrees = 30;
    scene->materials.push_back({"plain", {}});
    scene->objects.front().material = 0;
    const ReadResult result = read_scene_text(std::string_view(write_scene_text(*scene)));
    INFO("seed " << seed);
    for (const auto& error : result.errors) UNSCOPED_INFO(error.message);
    CHECK(result.errors.empty());
  }
}

TEST_CASE("discs at one height enclose nothing") {
  bool is_too_large = true;
  CHECK_FALSE(round_solid(RoundKind::kDiscs, {{{0, 0, 1}, 2}, {{5, 0, 1}, 1}, {{0, 5, 1}, 0}},
                          is_too_large));
  CHECK_FALSE(is_too_large);
}

TEST_CASE("beyond the limit there is no hull, and the reason is told") {
  std::mt19937_64 random(5);
  std::vector<RoundPoint> balls;
  for (std::size_t i = 0; i <= kMaxRoundPoints; ++i) {
    const Vec3 out = normalized(random_point(random, 1));
    balls.push_back({10 * out, 1});
  }
  bool is_too_large = false;
  CHECK_FALSE(round_solid(RoundKind::kBalls, balls, is_too_large));
  CHECK(is_too_large);
}

}  // namespace
}  // namespace graycube
