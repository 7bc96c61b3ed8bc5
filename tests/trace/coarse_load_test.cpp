#include "trace/coarse_load.hpp"

#include <array>
#include <numeric>
#include <string>

#include "catch.hpp"
#include "formats/graycube/read_scene.hpp"
#include "trace/corner_scene.hpp"

using namespace graycube;
using namespace graycube::testing;

namespace {

double total(const LoadMap& map) { return std::accumulate(map.load.begin(), map.load.end(), 0.0); }

}  // namespace

TEST_CASE("a coarse render finds the work where the solids are") {
  const Model model = compile_scene(corner_scene());
  const CameraFrame frame = CameraFrame::from(model.settings.camera, model.settings.image);
  const MacroGrid grid = MacroGrid::regular(frame, 8, 8);
  const LoadMap load = coarse_load(Domain(model), grid, nullptr, Staying{}, 0).map;
  const RegionIndex at = grid.region_of_point({0, 0, 0});
  CHECK(load.at(at.column, at.row) > 1.5 * total(load) / 64);
  // The load contains at least the primary rays.
  CHECK(total(load) > kLeastCoarsePixels / 2.0);
  CHECK(total(coarse_load(Domain(model), grid, nullptr, Staying{}, 1).map) > total(load));
}

TEST_CASE("a coarse render tells how many rays descend from a pixel") {
  // A floor that fills the picture, on which both lights shine: a primary ray and two shadow rays
  // each.
  ReadResult read =
      read_scene_text(R"({"graycube": 1, "image": {"width": 64, "height": 64, "samples": 2},
    "camera": {"type": "perspective", "eye": [0,5,0], "look_at": [0,0,0], "up": [0,0,1], "fov": 40},
    "lights": [{"type": "point", "position": [3,9,0], "color": [1,1,1]}, {"type": "point", "position": [-3,9,0], "color": [1,1,1]}],
    "materials": {"m": {}},
    "objects": [{"material": "m", "csg": {"type": "box", "min": [-9,-1,-9], "max": [9,0,9]}}]})");
  REQUIRE(read.scene);
  const Model model = compile_scene(*read.scene);
  const CameraFrame frame = CameraFrame::from(model.settings.camera, model.settings.image);
  CHECK(coarse_load(Domain(model), MacroGrid::regular(frame, 4, 4), nullptr, Staying{}, 0)
            .rays_per_primary == 3);
}

TEST_CASE("shadow rays traced where they begin are work for the region of their surface") {
  const Model model = compile_scene(corner_scene());
  const CameraFrame frame = CameraFrame::from(model.settings.camera, model.settings.image);
  const MacroGrid grid = MacroGrid::regular(frame, 8, 8);
  const Domain whole(model);
  const CoarseLoad goes = coarse_load(whole, grid, nullptr, Staying{}, 0);
  const CoarseLoad begins = coarse_load(whole, grid, nullptr, Staying{.shadow_rays = true}, 0);
  // The same rays leave, each noted once, where it began.
  REQUIRE(goes.left_by_light.size() > 50);
  REQUIRE(begins.left_by_light.size() == goes.left_by_light.size());
  CHECK(begins.rays_per_primary == goes.rays_per_primary);
  for (const LeavingLight& light : begins.left_by_light) {
    REQUIRE(light.ray.kind == RayKind::kShadow);
    REQUIRE(grid.may_touch(light.from, light.ray.ray.origin, 0, model.delta));
    REQUIRE(light.ray.region != light.from);
  }
  // Cells that no primary or secondary ray enters have work only for rays on their way to a light.
  std::size_t idle_goes = 0, idle_begins = 0;
  for (std::size_t i = 0; i < goes.map.load.size(); ++i) {
    idle_goes += goes.map.load[i] == 0 ? 1 : 0;
    idle_begins += begins.map.load[i] == 0 ? 1 : 0;
  }
  CHECK(idle_begins >= idle_goes);
  CHECK(total(begins.map) != total(goes.map));
}

TEST_CASE("what secondary rays lead to is work for the region of their pixel, where they stay") {
  // A mirror ball on the left shows a wall beyond the right edge of the picture, whose right half
  // is empty.
  ReadResult read =
      read_scene_text(R"({"graycube": 1, "image": {"width": 128, "height": 64}, "max_depth": 3,
    "camera": {"type": "perspective", "eye": [0,0,0], "look_at": [0,0,9], "up": [0,1,0], "fov": 60},
    "lights": [{"type": "point", "position": [0,20,0], "color": [1,1,1]}],
    "materials": {"mirror": {"reflect": 1}, "m": {}},
    "objects": [{"material": "mirror", "csg": {"type": "sphere", "center": [-5.5,0,12], "radius": 5}},
                {"material": "m", "csg": {"type": "box", "min": [60,-90,-90], "max": [61,90,90]}}]})");
  REQUIRE(read.scene);
  const Model model = compile_scene(*read.scene);
  const CameraFrame frame = CameraFrame::from(model.settings.camera, model.settings.image);
  const MacroGrid grid = MacroGrid::regular(frame, 8, 4);
  const auto share_of_halves = [&](Staying staying) {
    const CoarseLoad load = coarse_load(Domain(model), grid, nullptr, staying, 1);
    std::array<double, 2> halves{};
    for (std::uint32_t r = 0; r < 4; ++r) {
      for (std::uint32_t c = 0; c < 8; ++c) halves[c / 4] += load.map.at(c, r);
    }
    return std::pair(halves, load.rays_per_primary);
  };
  const std::uint32_t mirror = grid.region_of_point({-5, 0, 12}).column / 4;
  const auto [gone, rays] = share_of_halves({});
  const auto [stayed, same_rays] = share_of_halves({.shadow_rays = true, .secondary_rays = true});
  CHECK(rays == same_rays);
  CHECK(rays > 1.1);
  CHECK(stayed[1 - mirror] < 0.9 * gone[1 - mirror]);
  CHECK(stayed[mirror] / stayed[1 - mirror] > 1.1 * gone[mirror] / gone[1 - mirror]);
}

TEST_CASE("balanced boundaries are drawn together where the work is") {
  const Model model = compile_scene(corner_scene());
  const CameraFrame frame = CameraFrame::from(model.settings.camera, model.settings.image);
  const LoadMap load =
      coarse_load(Domain(model), MacroGrid::regular(frame, 16, 16), nullptr, Staying{}, 0).map;
  CHECK(heaviest(load, balanced_cuts(load, 4, 4)) < 0.95 * heaviest(load, even_cuts(load, 4, 4)));
}

TEST_CASE("a coarse render knows that tori take longer than balls") {
  // A torus and a ball, each in its half of the picture and as wide; no light, so that nothing else
  // is traced.
  ReadResult read = read_scene_text(R"({"graycube": 1, "image": {"width": 128, "height": 64},
    "camera": {"type": "orthographic", "eye": [0,0,-9], "look_at": [0,0,0], "up": [0,1,0], "width": 8},
    "lights": [], "materials": {"m": {}},
    "objects": [{"material": "m", "csg": {"type": "torus", "center": [-2,0,0], "axis": [0,0,1], "major": 1, "minor": 0.5}},
                {"material": "m", "csg": {"type": "sphere", "center": [2,0,0], "radius": 1.5}}]})");
  REQUIRE(read.scene);
  const Model model = compile_scene(*read.scene);
  const CameraFrame frame = CameraFrame::from(model.settings.camera, model.settings.image);
  const MacroGrid grid = MacroGrid::regular(frame, 2, 1);
  const LoadMap load = coarse_load(Domain(model), grid, nullptr, Staying{}, 0).map;
  const std::uint32_t torus = grid.region_of_point({-2, 0, 0}).column;
  CHECK(load.at(torus, 0) > 1.5 * load.at(1 - torus, 0));
}

namespace {

/// Two mirrors face each other, and lights stand between them in a row.
Model mirrors_and_lights(int count) {
  std::string lights;
  for (int i = 0; i < count; ++i) {
    lights += std::string(i == 0 ? "" : ",") +
              R"({"type": "point", "color": [1,1,1], "position": [)" +
              std::to_string(i - count / 2) + ",2,-8]}";
  }
  ReadResult read =
      read_scene_text(R"({"graycube": 1, "image": {"width": 128, "height": 96}, "max_depth": 120,
    "camera": {"type": "perspective", "eye": [0,0,-9], "look_at": [2,1,0], "up": [0,1,0], "fov": 60},
    "lights": [)" + lights +
                      R"(],
    "materials": {"mirror": {"reflect": 1}},
    "objects": [{"material": "mirror", "csg": {"type": "box", "min": [-40,-30,3], "max": [40,30,4]}},
                {"material": "mirror", "csg": {"type": "box", "min": [-40,-30,-12], "max": [40,30,-11]}}]})");
  REQUIRE(read.scene);
  return compile_scene(*read.scene);
}

}  // namespace

TEST_CASE("between mirrors the coarse render ends early where secondary rays stay") {
  const Model model = mirrors_and_lights(24);
  const CameraFrame frame = CameraFrame::from(model.settings.camera, model.settings.image);
  const MacroGrid grid = MacroGrid::regular(frame, 16, 16);
  const LoadMap load =
      coarse_load(Domain(model), grid, nullptr, {.shadow_rays = true, .secondary_rays = true}, 0)
          .map;
  const double all = total(load);
  CHECK(all > static_cast<double>(kLeastCoarseCrossings));
  // A pixel takes thousands of rays: without a limit, each of the 1024 pixels would be
  // traced.
  CHECK(all < 40.0 * static_cast<double>(kLeastCoarseCrossings));
}

TEST_CASE(
    "among many lights the coarse render ends early, too, where shadow rays are traced where they "
    "begin") {
  const Model model = mirrors_and_lights(64);
  const CameraFrame frame = CameraFrame::from(model.settings.camera, model.settings.image);
  const auto load = coarse_load(Domain(model), MacroGrid::regular(frame, 16, 16), nullptr,
                                Staying{.shadow_rays = true}, 0);
  CHECK(load.left_by_light.size() > kLeastCoarseCrossings / 2);
  CHECK(load.left_by_light.size() < 3 * kLeastCoarseCrossings);
}

TEST_CASE("between mirrors the coarse render ends early, and has looked everywhere") {
  const Model model = mirrors_and_lights(24);
  const CameraFrame frame = CameraFrame::from(model.settings.camera, model.settings.image);
  const MacroGrid grid = MacroGrid::regular(frame, 16, 16);
  const LoadMap load = coarse_load(Domain(model), grid, nullptr, Staying{}, 0).map;
  const double crossings =
      total(coarse_load(Domain(model), grid, nullptr, Staying{}, 1).map) - total(load);
  CHECK(crossings > kLeastCoarseCrossings);
  // Rays that wait when the limit is reached come on top; all blocks would take over a million.
  CHECK(crossings < 6 * kLeastCoarseCrossings);
  for (std::uint32_t row = 0; row < 16; row += 4) {
    double in_rows = 0;
    for (std::uint32_t r = row; r < row + 4; ++r) {
      for (std::uint32_t c = 0; c < 16; ++c) in_rows += load.at(c, r);
    }
    CHECK(in_rows > total(load) / 32);
  }
}
