#include "regions/own_pixels.hpp"

#include "catch.hpp"
#include "crossings/surface_tree.hpp"
#include "csg/random_model.hpp"

using namespace graycube;
using namespace graycube::testing;

namespace {

constexpr std::uint32_t kWidth = 40, kHeight = 20;

CameraFrame frame() {
  Camera camera;
  camera.eye = {0, 0, -10};
  camera.look_at = {0, 0, 0};
  camera.up = {0, 1, 0};
  camera.fov_degrees = 60;
  return CameraFrame::from(camera, {kWidth, kHeight, 1});
}

}  // namespace

TEST_CASE("own pixels are the region's, or end with each row's own edges") {
  const MacroGrid grid(frame(), {20}, {10});
  CHECK(owner_of_pixel(5, {0, 1}, grid, {}) == RegionIndex{0, 1});
  CHECK_FALSE(part_beside({0, 1}, grid, frame(), {}));
  const std::vector<std::int64_t> own{16, 28};
  CHECK(owner_of_pixel(15, {0, 0}, grid, own) == RegionIndex{0, 0});
  CHECK(owner_of_pixel(16, {0, 0}, grid, own) == RegionIndex{1, 0});
  CHECK(owner_of_pixel(27, {1, 1}, grid, own) == RegionIndex{0, 1});
  CHECK(owner_of_pixel(28, {1, 1}, grid, own) == RegionIndex{1, 1});
  // Row 0: column 0 has less than its region, column 1 more; row 1: the other way round.
  CHECK_FALSE(part_beside({0, 0}, grid, frame(), own));
  CHECK(part_beside({1, 0}, grid, frame(), own));
  CHECK(part_beside({0, 1}, grid, frame(), own));
  CHECK_FALSE(part_beside({1, 1}, grid, frame(), own));
}

TEST_CASE("what a part beside a region needs is all that its primary rays meet") {
  std::size_t more = 0, met = 0;
  for (std::uint64_t seed = 0; seed < 150; ++seed) {
    INFO("seed " << seed);
    const Model model = compile_scene(RandomModel(seed).scene());
    const CameraFrame camera = CameraFrame::from(model.settings.camera, model.settings.image);
    const auto width = static_cast<std::int64_t>(camera.image.width);
    Dice dice(seed);
    const MacroGrid grid = MacroGrid::regular(camera, 2, 2);
    std::vector<std::int64_t> own;
    for (int i = 0; i < 2; ++i)
      own.push_back(1 + static_cast<std::int64_t>(dice.below(static_cast<std::size_t>(width - 1))));
    const SurfaceTree whole = SurfaceTree::build(model);
    TreeScratch scratch, part_scratch;
    for (std::uint16_t row = 0; row < 2; ++row) {
      for (std::uint16_t column = 0; column < 2; ++column) {
        const RegionIndex region{column, row};
        const Model slice =
            extract(model, contents_with_own_pixels(model, grid, only(region, grid), own));
        more += slice.primitives.size() >
                        restrict_to_share(model, grid, only(region, grid)).primitives.size()
                    ? 1
                    : 0;
        const SurfaceTree tree = SurfaceTree::build(slice);
        for (std::uint32_t y = 0; y < camera.image.height; ++y) {
          for (std::uint32_t x = 0; x < camera.image.width; ++x) {
            if (owner_of_pixel(x, grid.region_of_pixel(x, y), grid, own) != region) continue;
            const Ray ray = camera.primary_ray(x, y, 0, 0);
            const auto expected = whole.first_crossing(ray, 0, 1e30, scratch);
            const auto found = tree.first_crossing(ray, 0, 1e30, part_scratch);
            REQUIRE(found.has_value() == expected.has_value());
            if (!found) continue;
            REQUIRE(found->t == expected->t);
            ++met;
          }
        }
      }
    }
  }
  CHECK(more > 50);
  CHECK(met > 1000);
}
