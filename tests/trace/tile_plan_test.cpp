// Every pixel lies in exactly one tile.
#include "trace/tile_plan.hpp"

#include <vector>

#include "catch.hpp"
#include "csg/dice.hpp"
#include "csg/random_model.hpp"
#include "regions/own_pixels.hpp"

using namespace graycube;
using graycube::testing::Dice;

namespace {

/// Each pixel is in the rectangle of its tile, and of no other; tiles' sizes keep within the shape.
void check_partition(const TilePlan& plan, const ImageSize& image, const TileShape& shape) {
  std::vector<std::uint32_t> tile_of(image.width * image.height, ~0u);
  std::uint64_t primary = 0;
  for (std::uint32_t tile = 0; tile < plan.tile_count(); ++tile) {
    const PixelRect r = plan.rect(tile);
    REQUIRE_FALSE(r.is_empty());
    REQUIRE(r.x1 <= image.width);
    REQUIRE(r.y1 <= image.height);
    REQUIRE(r.x1 - r.x0 <= shape.width);
    REQUIRE(r.y1 - r.y0 <= shape.height);
    REQUIRE(plan.primary_rays(tile) ==
            std::uint64_t{r.x1 - r.x0} * (r.y1 - r.y0) * image.samples * image.samples);
    primary += plan.primary_rays(tile);
    for (std::uint32_t y = r.y0; y < r.y1; ++y) {
      for (std::uint32_t x = r.x0; x < r.x1; ++x) {
        std::uint32_t& mine = tile_of[y * image.width + x];
        REQUIRE(mine == ~0u);
        mine = tile;
        REQUIRE(plan.tile_of_pixel(y * image.width + x) == tile);
      }
    }
  }
  for (const std::uint32_t tile : tile_of) REQUIRE(tile != ~0u);
  REQUIRE(primary == std::uint64_t{image.width} * image.height * image.samples * image.samples);
}

void check_areas(const TilePlan& plan, std::uint32_t areas) {
  std::uint32_t next = 0;
  for (std::uint32_t area = 0; area < areas; ++area) {
    REQUIRE(plan.first_tile(area) == next);
    for (std::uint32_t i = 0; i < plan.tile_count_of(area); ++i) {
      REQUIRE(plan.area_of_tile(next++) == area);
    }
  }
  REQUIRE(next == plan.tile_count());
}

MacroGrid random_grid(Dice& dice, const ImageSize& image, std::uint32_t columns,
                      std::uint32_t rows) {
  Camera camera;
  camera.projection = dice.one_in(2) ? Projection::kPerspective : Projection::kOrthographic;
  camera.eye = dice.point(5);
  camera.look_at = camera.eye + dice.unit_vector();
  camera.up = {0.2, 1, 0.1};
  camera.fov_degrees = 50;
  camera.width = 3;
  const CameraFrame frame = CameraFrame::from(camera, image);
  if (dice.one_in(2)) return MacroGrid::regular(frame, columns, rows);
  // Uneven edges, some beyond the picture.
  const auto edges = [&](std::uint32_t cells, std::uint32_t pixels) {
    std::vector<std::int64_t> r;
    std::int64_t at = -static_cast<std::int64_t>(dice.below(5));
    for (std::uint32_t i = 1; i < cells; ++i) {
      at += 1 + static_cast<std::int64_t>(dice.below(2 * pixels / cells + 1));
      r.push_back(at);
    }
    return r;
  };
  auto column_edges = edges(columns, image.width);
  auto row_edges = edges(rows, image.height);
  return {frame, std::move(column_edges), std::move(row_edges)};
}

}  // namespace

TEST_CASE("a plan of the whole picture has every pixel in exactly one tile") {
  for (std::uint64_t seed = 0; seed < 150; ++seed) {
    INFO("seed " << seed);
    Dice dice(seed);
    const auto side = [&](std::size_t most) {
      return static_cast<std::uint32_t>(1 + dice.below(most));
    };
    const ImageSize image{side(90), side(90), side(4)};
    const TileShape shape{side(40), side(40)};
    const TilePlan plan(image, shape);
    check_partition(plan, image, shape);
    check_areas(plan, 1);
  }
}

TEST_CASE("a plan of macro-regions has every pixel in exactly one tile, of its own region") {
  for (std::uint64_t seed = 0; seed < 150; ++seed) {
    INFO("seed " << seed);
    Dice dice(seed);
    const auto side = [&](std::size_t most) {
      return static_cast<std::uint32_t>(1 + dice.below(most));
    };
    const ImageSize image{side(70), side(70), 1};
    const TileShape shape{side(20), side(20)};
    const std::uint32_t columns = side(9), rows = side(9);
    const MacroGrid grid = random_grid(dice, image, columns, rows);
    const TilePlan plan(image, shape, grid);
    check_partition(plan, image, shape);
    check_areas(plan, columns * rows);
    for (std::uint32_t tile = 0; tile < plan.tile_count(); ++tile) {
      const PixelRect r = plan.rect(tile);
      for (const auto& [x, y] : {std::pair{r.x0, r.y0}, std::pair{r.x1 - 1, r.y1 - 1}}) {
        const RegionIndex region = grid.region_of_pixel(x, y);
        REQUIRE(plan.area_of_tile(tile) == region.row * columns + region.column);
        REQUIRE(plan.region_of_tile(tile) == region);
      }
    }
  }
}

TEST_CASE(
    "a plan with own pixels has every pixel in exactly one tile, of one region and one owner") {
  std::size_t beside = 0;
  for (std::uint64_t seed = 0; seed < 150; ++seed) {
    INFO("seed " << seed);
    Dice dice(seed);
    const auto side = [&](std::size_t most) {
      return static_cast<std::uint32_t>(1 + dice.below(most));
    };
    const std::uint32_t columns = side(6), rows = side(6);
    const ImageSize image{columns + side(60), side(70), 1};
    const TileShape shape{side(20), side(20)};
    const MacroGrid grid = random_grid(dice, image, columns, rows);
    std::vector<std::int64_t> own;
    for (std::uint32_t row = 0; row < rows; ++row) {
      for (std::uint32_t column = 1; column < columns; ++column) {
        // The first is 1 or 2, and each further one is 1 or 2 more than the one before.
        own.push_back(column + static_cast<std::int64_t>(dice.below(2)) +
                      (column == 1 ? 0 : own.back() - column + 1));
      }
    }
    const TilePlan plan(image, shape, grid, own);
    check_partition(plan, image, shape);
    std::size_t tiles = 0;
    for (std::uint32_t row = 0; row < rows; ++row) {
      for (std::uint32_t column = 0; column < columns; ++column)
        tiles += plan.tiles_of({columns, rows, column, row}).size();
    }
    REQUIRE(tiles == plan.tile_count());
    for (std::uint32_t tile = 0; tile < plan.tile_count(); ++tile) {
      const PixelRect r = plan.rect(tile);
      for (const auto& [x, y] : {std::pair{r.x0, r.y0}, std::pair{r.x1 - 1, r.y1 - 1}}) {
        const RegionIndex region = grid.region_of_pixel(x, y);
        REQUIRE(plan.region_of_tile(tile) == region);
        REQUIRE(plan.owner_of_tile(tile) == owner_of_pixel(x, region, grid, own));
        beside += plan.owner_of_tile(tile) == region ? 0 : 1;
      }
    }
  }
  CHECK(beside > 1000);
}

TEST_CASE("the shares of a scattered grid have every tile once, each in its owner's regions") {
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    INFO("seed " << seed);
    Dice dice(seed);
    const auto side = [&](std::size_t most) {
      return static_cast<std::uint32_t>(1 + dice.below(most));
    };
    const ImageSize image{side(70), side(70), 1};
    const std::uint32_t columns = side(4), rows = side(4), k = side(4);
    const MacroGrid grid = random_grid(dice, image, columns * k, rows * k);
    const TilePlan plan(image, {side(20), side(20)}, grid);
    std::vector<int> times(plan.tile_count(), 0);
    for (std::uint32_t row = 0; row < rows; ++row) {
      for (std::uint32_t column = 0; column < columns; ++column) {
        const RegionShare share{columns, rows, column, row};
        for (const std::uint32_t tile : plan.tiles_of(share)) {
          ++times[tile];
          const PixelRect r = plan.rect(tile);
          REQUIRE(share.owns(grid.region_of_pixel(r.x0, r.y0)));
        }
      }
    }
    REQUIRE(times == std::vector<int>(plan.tile_count(), 1));
  }
}

TEST_CASE("lines and single pixels are tiles too") {
  const ImageSize image{30, 20, 2};
  CHECK(TilePlan(image, {30, 1}).tile_count() == 20);
  CHECK(TilePlan(image, {1, 1}).tile_count() == 600);
  CHECK(TilePlan(image, {1, 1}).rect(31) == PixelRect{1, 1, 2, 2});
  CHECK(TilePlan(image, {}).tile_count() == 4);
}
