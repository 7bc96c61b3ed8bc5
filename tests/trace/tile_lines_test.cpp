#include "trace/tile_lines.hpp"

#include "catch.hpp"

using namespace graycube;

namespace {

CameraFrame frame_of(const ImageSize& image) {
  Camera camera;
  camera.eye = {0, 0, -5};
  camera.look_at = {0, 0, 0};
  camera.up = {0, 1, 0};
  return CameraFrame::from(camera, image);
}

}  // namespace

TEST_CASE("tiles begin at the boundaries, and at every side of a tile from there") {
  const ImageSize image{40, 24, 1};
  const MacroGrid grid(frame_of(image), {10}, {12});
  const TilePlan plan(image, {8, 8}, grid);
  const TileLines lines = TileLines::of(plan);
  CHECK(lines.columns == std::vector<std::int64_t>{0, 8, 10, 18, 26, 34});
  CHECK(lines.rows == std::vector<std::int64_t>{0, 8, 12, 20});
  const auto cuts = lines.cuts_of(grid);
  REQUIRE(cuts);
  CHECK(*cuts == RectilinearCuts{{2}, {2}});
  CHECK(lines.has_room(*cuts));
  CHECK(lines.column_of(18) == 3);
  CHECK(lines.row_of(12) == 2);
}

TEST_CASE("with boundaries on any of the lines, every tile is in one macro-region") {
  const ImageSize image{40, 24, 1};
  const TilePlan plan(image, {8, 8}, MacroGrid(frame_of(image), {10}, {12}));
  const TileLines lines = TileLines::of(plan);
  for (std::size_t i = 1; i < lines.columns.size(); ++i) {
    for (std::size_t j = 1; j < lines.rows.size(); ++j) {
      const MacroGrid grid(frame_of(image), {lines.columns[i]}, {lines.rows[j]});
      REQUIRE(lines.cuts_of(grid));
      for (std::uint32_t tile = 0; tile < plan.tile_count(); ++tile) {
        const PixelRect r = plan.rect(tile);
        CHECK(grid.region_of_pixel(r.x0, r.y0) == grid.region_of_pixel(r.x1 - 1, r.y1 - 1));
      }
    }
  }
}

TEST_CASE("boundaries beyond the picture, or within tiles, are no lines") {
  const ImageSize image{2, 2, 1};
  const MacroGrid beyond = MacroGrid::regular(frame_of(image), 4, 2);
  CHECK_FALSE(TileLines::of(TilePlan(image, {8, 8}, beyond)).cuts_of(beyond));
  const ImageSize large{16, 16, 1};
  const TileLines lines = TileLines::of(TilePlan(large, {8, 8}));
  CHECK_FALSE(lines.cuts_of(MacroGrid(frame_of(large), {4}, {})));
  const auto cuts = lines.cuts_of(MacroGrid(frame_of(large), {8}, {8}));
  REQUIRE(cuts);
  CHECK_FALSE(lines.has_room(*cuts));
}
