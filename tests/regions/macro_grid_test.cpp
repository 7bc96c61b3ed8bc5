#include "regions/macro_grid.hpp"
#include "geometry/infinity.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <set>
#include <string>
#include <tuple>

#include "catch.hpp"
#include "geometry/simd.hpp"
#include "regions/oblique_frame.hpp"

namespace graycube {
namespace {

using testing::oblique_frame;

constexpr ImageSize kImage{40, 24, 1};

struct Shape {
  std::uint32_t columns, rows;
};
constexpr Shape kShapes[] = {{1, 1}, {2, 1},  {1, 2},   {2, 2},   {3, 1},  {3, 3},
                             {4, 2}, {4, 4},  {5, 3},   {6, 7},   {8, 4},  {1, 9},
                             {9, 1}, {16, 8}, {32, 32}, {64, 50}, {20, 12}};

/// Axes along x, −y and z and pixels of 2^-4, so that f = 0 can be met exactly.
CameraFrame square_frame() {
  CameraFrame frame;
  frame.image = {32, 32, 1};
  frame.right = {1, 0, 0};
  frame.down = {0, -1, 0};
  frame.forward = {0, 0, 1};
  frame.pixel_size = 0.0625;
  return frame;
}

class Dice {
 public:
  explicit Dice(std::uint32_t seed) : engine_(seed) {}
  double between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine_);
  }
  Vec3 point(double reach) {
    return {between(-reach, reach), between(-reach, reach), between(-reach, reach)};
  }
  Vec3 direction() { return normalized(point(1)); }
  std::uint32_t below(std::uint32_t n) {
    return std::uniform_int_distribution<std::uint32_t>(0, n - 1)(engine_);
  }

 private:
  std::mt19937 engine_;
};

RegionIndex at(std::uint32_t column, std::uint32_t row) {
  return {static_cast<std::uint16_t>(column), static_cast<std::uint16_t>(row)};
}

template <class Visit>
void for_each_region(const MacroGrid& grid, Visit&& visit) {
  for (std::uint32_t row = 0; row < grid.rows(); ++row) {
    for (std::uint32_t column = 0; column < grid.columns(); ++column) visit(at(column, row));
  }
}

/// Walks the ray from t = 0, checks the rules of every walk, and returns the region at the end.
RegionIndex walk(const MacroGrid& grid, const Ray& ray, RegionIndex start) {
  RegionIndex region = start;
  double t = 0;
  // Columns − 1 planes one way and the root the other way at most; rows alike.
  const std::uint32_t most = grid.columns() + grid.rows();
  std::set<std::tuple<int, int, int>> passed;
  for (std::uint32_t steps = 0;; ++steps) {
    REQUIRE(steps <= most);
    const auto exit = grid.exit(region, ray, t);
    const double end = exit ? exit->t : t + 2;
    REQUIRE(end >= t);
    REQUIRE(std::isfinite(end));
    if (end - t > 1e-6) {
      const RegionIndex middle = grid.region_of_point(ray.at(t + 0.5 * (end - t)));
      CAPTURE(t, end, region.column, region.row, middle.column, middle.row);
      REQUIRE(middle == region);
    }
    if (!exit) break;
    REQUIRE((exit->next.column == region.column) != (exit->next.row == region.row));
    // Each step goes from one cell to another across a plane: no step comes twice, nor
    // back.
    const bool in_columns = exit->next.row == region.row;
    const int from = in_columns ? region.column : region.row;
    const int to = in_columns ? exit->next.column : exit->next.row;
    const bool two = (in_columns ? grid.columns() : grid.rows()) == 2;
    REQUIRE(passed.emplace(in_columns, from, to).second);
    REQUIRE((two || passed.count({in_columns, to, from}) == 0));
    const auto neighbours = grid.neighbours_of(region);
    REQUIRE(std::find(neighbours.begin(), neighbours.end(), exit->next) != neighbours.end());
    region = exit->next;
    t = end;
  }
  return region;
}

TEST_CASE("macro-regions partition space") {
  Dice dice(1);
  for (const auto projection : {Projection::kPerspective, Projection::kOrthographic}) {
    const CameraFrame frame = oblique_frame(projection, kImage);
    for (const Shape shape : kShapes) {
      const auto grid = MacroGrid::regular(frame, shape.columns, shape.rows);
      const int points = shape.columns * shape.rows > 500 ? 30 : 300;
      for (int i = 0; i < points; ++i) {
        // Points far and near, in front, beside and behind.
        const Vec3 p = frame.eye + dice.point(i % 3 == 0 ? 0.01 : 20);
        const RegionIndex holder = grid.region_of_point(p);
        int holders = 0;
        for_each_region(grid, [&](RegionIndex region) {
          if (grid.contains(region, p)) {
            ++holders;
            CHECK(region == holder);
          }
        });
        CAPTURE(shape.columns, shape.rows, p.x, p.y, p.z);
        CHECK(holders == 1);
      }
    }
  }
}

TEST_CASE("a point on a boundary is on its far side") {
  const auto grid = MacroGrid::regular(square_frame(), 4, 4);
  REQUIRE(grid.column_edges() == std::vector<std::int64_t>{8, 16, 24});
  CHECK(grid.region_of_point({0, -0.1, 1}) == at(2, 2));
  CHECK(grid.region_of_point({0, 0, 0}) == at(3, 3));  // the eye is on every plane
  CHECK(grid.region_of_point({-0.001, -0.1, 1}) == at(1, 2));
}

TEST_CASE("behind the eye only the four corner regions are left") {
  Dice dice(2);
  const auto grid = MacroGrid::regular(square_frame(), 8, 6);
  for (int i = 0; i < 1000; ++i) {
    // Within the pyramid's mirror image.
    const double z = dice.between(0.1, 10);
    const Vec3 p{dice.between(-1, 1) * z * 0.2, dice.between(-1, 1) * z * 0.2, -z};
    const RegionIndex region = grid.region_of_point(p);
    CHECK((region.column == 0 || region.column == 7));
    CHECK((region.row == 0 || region.row == 5));
    CHECK((region.column == 7) == (p.x >= 0));
    CHECK((region.row == 5) == (p.y <= 0));
  }
}

TEST_CASE("regular boundaries are spread evenly on pixel edges") {
  const auto frame = oblique_frame(Projection::kPerspective, {10, 3, 1});
  const auto grid = MacroGrid::regular(frame, 4, 3);
  CHECK(grid.column_edges() == std::vector<std::int64_t>{2, 5, 7});
  CHECK(grid.row_edges() == std::vector<std::int64_t>{1, 2});
  CHECK(grid.pixels_of(at(1, 2)) == PixelRect{2, 2, 5, 3});
}

TEST_CASE("boundaries continue beyond the picture when columns outnumber pixels") {
  const auto frame = oblique_frame(Projection::kPerspective, {2, 1, 1});
  const auto grid = MacroGrid::regular(frame, 6, 4);
  CHECK(grid.column_edges() == std::vector<std::int64_t>{-1, 0, 1, 2, 3});
  CHECK(grid.pixels_of(at(0, 0)).is_empty());
  CHECK(grid.region_of_pixel(0, 0).column == 2);
  CHECK(grid.region_of_pixel(1, 0).column == 3);
}

TEST_CASE("the regions' pixels partition the picture") {
  const ImageSize images[] = {kImage, {3, 2, 1}, {1, 1, 1}, {33, 17, 1}};
  for (const ImageSize image : images) {
    const CameraFrame frame = oblique_frame(Projection::kPerspective, image);
    for (const Shape shape : kShapes) {
      const auto grid = MacroGrid::regular(frame, shape.columns, shape.rows);
      std::uint64_t pixels = 0;
      for_each_region(grid, [&](RegionIndex region) {
        const PixelRect rect = grid.pixels_of(region);
        if (rect.is_empty()) return;
        pixels += std::uint64_t{rect.x1 - rect.x0} * (rect.y1 - rect.y0);
        CHECK(grid.region_of_pixel(rect.x0, rect.y0) == region);
        CHECK(grid.region_of_pixel(rect.x1 - 1, rect.y1 - 1) == region);
      });
      CHECK(pixels == std::uint64_t{image.width} * image.height);
    }
  }
}

TEST_CASE("primary rays start in the region of their pixel and never leave it") {
  for (const auto projection : {Projection::kPerspective, Projection::kOrthographic}) {
    for (const ImageSize image : {ImageSize{40, 24, 2}, ImageSize{3, 5, 1}}) {
      const CameraFrame frame = oblique_frame(projection, image);
      for (const Shape shape : kShapes) {
        const auto grid = MacroGrid::regular(frame, shape.columns, shape.rows);
        for (std::uint32_t i = 0; i < image.width * image.height; ++i) {
          const std::uint32_t x = i % image.width, y = i / image.width;
          const std::uint32_t s = image.samples - 1;
          const Ray ray = frame.primary_ray(x, y, s, 0);
          const RegionIndex region = grid.region_of_pixel(x, y);
          REQUIRE_FALSE(grid.exit(region, ray, 0));
          REQUIRE(grid.region_of_point(ray.at(5)) == region);
        }
      }
    }
  }
}

TEST_CASE("orthographic primary rays never leave their region whatever way the camera looks") {
  Dice dice(8);
  for (int i = 0; i < 200; ++i) {
    Camera camera;
    camera.projection = Projection::kOrthographic;
    camera.eye = dice.point(100);
    camera.look_at = dice.point(100);
    camera.up = dice.direction();
    camera.width = dice.between(0.1, 50);
    const CameraFrame frame = CameraFrame::from(camera, kImage);
    const auto grid = MacroGrid::regular(frame, 8, 8);
    const std::uint32_t x = dice.below(kImage.width), y = dice.below(kImage.height);
    REQUIRE_FALSE(grid.exit(grid.region_of_pixel(x, y), frame.primary_ray(x, y, 0, 0), 0));
  }
}

TEST_CASE("a ray on the wrong side of a plane that it never meets is handed on at once") {
  const auto grid = MacroGrid::regular(square_frame(), 2, 2);
  const Ray ray{{1, 1, 1}, {0, 0, 1}};
  const auto exit = grid.exit(at(0, 0), ray, 3);
  REQUIRE(exit);
  CHECK(exit->t == 3);
  CHECK(exit->next == at(1, 0));
  CHECK_FALSE(grid.exit(exit->next, ray, exit->t));
}

TEST_CASE("walks along random rays end and visit what the points say") {
  Dice dice(3);
  for (const auto projection : {Projection::kPerspective, Projection::kOrthographic}) {
    const CameraFrame frame = oblique_frame(projection, kImage);
    for (const Shape shape : kShapes) {
      const auto grid = MacroGrid::regular(frame, shape.columns, shape.rows);
      for (int i = 0; i < 400; ++i) {
        const Ray ray{frame.eye + dice.point(i % 2 == 0 ? 15 : 1), dice.direction()};
        CAPTURE(shape.columns, shape.rows, i);
        const RegionIndex last = walk(grid, ray, grid.region_of_point(ray.origin));
        CHECK(last == grid.region_of_point(ray.at(1e9)));
      }
    }
  }
}

TEST_CASE("walks along rays through the eye end behind it") {
  Dice dice(4);
  const CameraFrame frame = oblique_frame(Projection::kPerspective, kImage);
  for (const Shape shape : kShapes) {
    const auto grid = MacroGrid::regular(frame, shape.columns, shape.rows);
    for (int i = 0; i < 300; ++i) {
      const Vec3 origin = frame.eye + dice.point(8);
      const Ray ray{origin, normalized(frame.eye - origin)};
      CAPTURE(shape.columns, shape.rows, i);
      const RegionIndex last = walk(grid, ray, grid.region_of_point(ray.origin));
      CHECK(last == grid.region_of_point(ray.at(100)));
    }
  }
}

TEST_CASE("walks along rays in boundary planes and along the axes end") {
  Dice dice(5);
  const CameraFrame frame = square_frame();
  for (const Shape shape : kShapes) {
    if (shape.columns > frame.image.width) continue;
    const auto grid = MacroGrid::regular(frame, shape.columns, shape.rows);
    for (int i = 0; i < 300; ++i) {
      // Multiples of 1/16 on the planes x = c z: f is often exactly 0, at the origin and along the
      // ray.
      const auto sixteenths = [&] { return (static_cast<double>(dice.below(65)) - 32) / 16; };
      const double z = static_cast<double>(dice.below(9)) - 4;
      const double dz = static_cast<double>(dice.below(3)) - 1;
      const Vec3 origin{sixteenths() * z, sixteenths() * z, z};
      Vec3 d{sixteenths() * dz, sixteenths() * dz, dz};
      if (i % 4 == 0) d = {dz, 0, 0};
      if (i % 4 == 1) d = {0, dz, 0};
      if (d == Vec3{}) d = {0, 0, -1};
      CAPTURE(shape.columns, shape.rows, i);
      const Ray ray{origin, normalized(d)};
      RegionIndex region = grid.region_of_point(ray.origin);
      double t = 0;
      std::uint32_t steps = 0;
      for (auto exit = grid.exit(region, ray, t); exit; exit = grid.exit(region, ray, t)) {
        REQUIRE(++steps <= grid.columns() + grid.rows());
        REQUIRE(exit->t >= t);
        region = exit->next;
        t = exit->t;
      }
      // Beyond every plane the touching test, unlike points on a plane, must still agree.
      CHECK(grid.may_touch(region, ray.at(t + 1), 0, 1e-9));
    }
  }
}

TEST_CASE("a packet's rays leave as each does by itself, with every instruction set") {
  Dice dice(23);
  std::size_t leaving = 0, staying = 0;
  for (const Projection projection : {Projection::kPerspective, Projection::kOrthographic}) {
    const CameraFrame frame = oblique_frame(projection, kImage);
    for (const auto& [columns, rows] : kShapes) {
      const MacroGrid grid = MacroGrid::regular(frame, columns, rows);
      for (int i = 0; i < 40; ++i) {
        const RegionIndex region = at(dice.below(columns), dice.below(rows));
        RayPacket packet;
        for (std::uint32_t n = 1 + dice.below(RayPacket::kSize); n > 0; --n) {
          Ray ray{dice.point(15), dice.direction()};
          // In a plane of boundaries, and through the eye, too.
          if (dice.below(4) == 0) ray.origin = frame.eye;
          if (dice.below(4) == 0) ray.direction = frame.forward;
          packet.add(ray, dice.below(2) == 0 ? 0 : dice.between(0, 20),
                     dice.below(2) == 0 ? kInf : dice.between(0, 30));
        }
        for (const std::string& name : simd_names()) {
          REQUIRE(choose_simd(name));
          RayPacket shortened = packet;
          std::array<RegionExit, RayPacket::kSize> exits;
          const RayPacket::Mask mask = grid.shorten_to_exits(region, shortened, exits);
          for (std::size_t k = 0; k < packet.count; ++k) {
            CAPTURE(name, columns, rows, region.column, region.row, k);
            const auto exit = grid.exit(region, packet.ray(k), packet.t0[k]);
            const bool leaves = exit && exit->t < packet.t1[k];
            REQUIRE((mask >> k & 1) == leaves);
            REQUIRE(shortened.t1[k] == (leaves ? exit->t : packet.t1[k]));
            ++(leaves ? leaving : staying);
            if (!leaves) continue;
            REQUIRE(exits[k].t == exit->t);
            REQUIRE(exits[k].next == exit->next);
          }
        }
      }
    }
  }
  choose_simd("best");
  CHECK(leaving > 5000);
  CHECK(staying > 5000);
}

TEST_CASE("a ray is handed on one plane at a time, columns before rows") {
  const auto grid = MacroGrid::regular(square_frame(), 4, 4);
  // Along the diagonal of z = 1 both fans are passed at the same parameters.
  const Ray ray{{-2, 2, 1}, normalized({1, -1, 0})};
  RegionIndex region = grid.region_of_point(ray.origin);
  REQUIRE(region == at(0, 0));
  double t = 0;
  for (int i = 0; i < 3; ++i) {
    const auto across = grid.exit(region, ray, t);
    REQUIRE(across);
    CHECK(across->next == at(static_cast<std::uint32_t>(i) + 1, static_cast<std::uint32_t>(i)));
    const auto down = grid.exit(across->next, ray, across->t);
    REQUIRE(down);
    CHECK(down->next == at(static_cast<std::uint32_t>(i) + 1, static_cast<std::uint32_t>(i) + 1));
    CHECK(down->t == across->t);  // a visit of length zero
    region = down->next;
    t = down->t;
  }
  CHECK_FALSE(grid.exit(region, ray, t));
}

TEST_CASE("two columns share one plane and lead to each other on either half of it") {
  const auto grid = MacroGrid::regular(square_frame(), 2, 1);
  for (const double z : {1.0, -1.0}) {
    const Ray ray{{-1, 0, z}, {1, 0, 0}};
    const auto exit = grid.exit(at(0, 0), ray, 0);
    REQUIRE(exit);
    CHECK(exit->t == 1);
    CHECK(exit->next == at(1, 0));
    CHECK_FALSE(grid.exit(at(1, 0), ray, 1));
  }
  CHECK(grid.neighbours_of(at(0, 0)) == std::vector<RegionIndex>{at(1, 0)});
}

TEST_CASE("a grid of one region is never left") {
  Dice dice(6);
  const auto grid = MacroGrid::regular(square_frame(), 1, 1);
  CHECK(grid.neighbours_of(at(0, 0)).empty());
  for (int i = 0; i < 50; ++i) {
    CHECK_FALSE(grid.exit(at(0, 0), {dice.point(3), dice.direction()}, 0));
  }
}

TEST_CASE("behind the eye the root leads from the first column to the last") {
  const auto grid = MacroGrid::regular(square_frame(), 8, 1);
  const Ray ray{{-5, 0, -1}, {1, 0, 0}};
  const auto exit = grid.exit(grid.region_of_point(ray.origin), ray, 0);
  REQUIRE(exit);
  CHECK(exit->t == 5);
  CHECK(exit->next == at(7, 0));
  const Ray back{{5, 0, -1}, {-1, 0, 0}};
  const auto returned = grid.exit(at(7, 0), back, 0);
  REQUIRE(returned);
  CHECK(returned->next == at(0, 0));
}

TEST_CASE("of three columns the root leads on in front of the eye and round it behind") {
  const auto grid = MacroGrid::regular(square_frame(), 3, 1);
  const auto front = grid.exit(at(0, 0), {{-5, 0, 1}, {1, 0, 0}}, 0);
  const auto behind = grid.exit(at(0, 0), {{-5, 0, -1}, {1, 0, 0}}, 0);
  REQUIRE((front && behind));
  CHECK(front->next == at(1, 0));
  CHECK(behind->next == at(2, 0));
}

TEST_CASE("an orthographic grid is open") {
  const auto grid = MacroGrid::regular(oblique_frame(Projection::kOrthographic, kImage), 4, 3);
  CHECK(grid.neighbours_of(at(0, 0)).size() == 2);
  CHECK(grid.neighbours_of(at(1, 1)).size() == 4);
  CHECK(grid.neighbours_of(at(3, 2)).size() == 2);
}

TEST_CASE("every neighbour on a power-of-two torus is one bit away under Gray codes") {
  const auto gray = [](std::uint32_t i) { return i ^ (i >> 1); };
  for (const Shape shape : {Shape{2, 1}, {2, 2}, {4, 2}, {4, 4}, {8, 4}, {8, 8}, {32, 32}}) {
    const auto grid = MacroGrid::regular(oblique_frame(Projection::kPerspective, kImage),
                                         shape.columns, shape.rows);
    for_each_region(grid, [&](RegionIndex region) {
      for (const RegionIndex next : grid.neighbours_of(region)) {
        const std::uint32_t across = gray(region.column) ^ gray(next.column);
        const std::uint32_t down = gray(region.row) ^ gray(next.row);
        CHECK(__builtin_popcount(across) + __builtin_popcount(down) == 1);
      }
    });
  }
}

TEST_CASE("a region touches every box and sphere that holds one of its points") {
  Dice dice(7);
  for (const auto projection : {Projection::kPerspective, Projection::kOrthographic}) {
    const CameraFrame frame = oblique_frame(projection, kImage);
    for (const Shape shape : kShapes) {
      const auto grid = MacroGrid::regular(frame, shape.columns, shape.rows);
      for (int i = 0; i < 300; ++i) {
        const Vec3 p = frame.eye + dice.point(10);
        const RegionIndex region = grid.region_of_point(p);
        Aabb box{p - Vec3{dice.between(0, 1), dice.between(0, 1), dice.between(0, 1)},
                 p + Vec3{dice.between(0, 1), dice.between(0, 1), dice.between(0, 1)}};
        CHECK(grid.may_touch(region, box, 0));
        CHECK(grid.may_touch(region, Aabb{p, p}, 0));
        box.lo[static_cast<int>(dice.below(3))] = -kInf;
        box.hi[static_cast<int>(dice.below(3))] = kInf;
        CHECK(grid.may_touch(region, box, 0));
        CHECK(grid.may_touch(region, Aabb::everything(), 0));
        const double radius = dice.between(0, 2);
        const Vec3 center = p + 0.999 * radius * dice.direction();
        CHECK(grid.may_touch(region, center, radius, 0));
        CHECK(grid.may_touch(region, center, kInf, 0));
        CHECK_FALSE(grid.may_touch(region, Aabb::nothing(), 1));
      }
    }
  }
}

TEST_CASE("boxes and spheres beyond one of a region's planes do not touch it until it grows") {
  const auto grid = MacroGrid::regular(square_frame(), 2, 2);  // planes x = 0 and y = 0
  const RegionIndex left = grid.region_of_point({-1, 1, 1});
  const Aabb box{{0.5, -1, -1}, {1, 1, 1}};
  CHECK_FALSE(grid.may_touch(left, box, 0.4));
  CHECK(grid.may_touch(left, box, 0.6));
  const Aabb half{{0.5, -kInf, -kInf}, {kInf, kInf, kInf}};
  CHECK_FALSE(grid.may_touch(left, half, 0.4));
  CHECK(grid.may_touch(left, half, 0.6));
  CHECK_FALSE(grid.may_touch(left, {2, 1, 0}, 1, 0.9));
  CHECK(grid.may_touch(left, {2, 1, 0}, 1, 1.1));
  const auto whole = MacroGrid::regular(square_frame(), 1, 1);
  CHECK(whole.may_touch(at(0, 0), box, 0));
}

}  // namespace
}  // namespace graycube
