// Tools that the simulation tests share: a scene, its serial picture, a comparison of a farm's
// picture with it, and sums over a farm's nodes.
#pragma once

#include <string>

#include "catch.hpp"
#include "formats/graycube/read_scene.hpp"
#include "scene/compile_scene.hpp"
#include "simulation/random_machine.hpp"
#include "trace/render_serial.hpp"

namespace graycube::simulation {

/// Mirrors, glass, a torus, a drilled box and a floor without end, small enough for hundreds of
/// runs.
inline std::string scene_text(unsigned width, unsigned height) {
  return R"({"graycube": 1, "image": {"width": )" + std::to_string(width) + R"(, "height": )" +
         std::to_string(height) + R"(},
  "camera": {"type": "perspective", "eye": [0,3,-9], "look_at": [0,1,0], "up": [0,1,0], "fov": 60},
  "background": [0.1,0.2,0.4], "max_depth": 4,
  "lights": [{"type": "point", "position": [5,9,-6], "color": [0.6,0.6,0.6]},
             {"type": "point", "position": [-2,0.5,-3], "color": [0.4,0.3,0.3]}],
  "materials": {"floor": {"reflect": 0.3, "pattern": {"type": "camouflage",
                          "colors": [[0.7,0.7,0.6], [0.3,0.5,0.2], [0.2,0.2,0.1]]}},
                "mirror": {"color": [0.9,0.9,0.9], "diffuse": 0.2, "reflect": 0.8},
                "glass": {"diffuse": 0.1, "transmit": 0.9, "reflect": 0.1, "ior": 1.5},
                "red": {"color": [0.9,0.2,0.1], "specular": 0.5, "shininess": 20}},
  "objects": [
    {"material": "floor", "csg": {"type": "half_space", "normal": [0,1,0], "offset": 0}},
    {"material": "mirror", "csg": {"type": "sphere", "center": [-2.5,1.2,1], "radius": 1.2}},
    {"material": "glass", "csg": {"type": "sphere", "center": [0.3,1,-2.5], "radius": 0.9}},
    {"material": "red", "csg": {"type": "torus", "center": [2.5,1,1.5], "axis": [1,1,0], "major": 1.2, "minor": 0.4}},
    {"material": "red", "csg": {"type": "difference", "children": [
       {"type": "box", "min": [-0.8,0,0.5], "max": [0.8,1.6,2]},
       {"type": "cylinder", "base": [0,0.8,-1], "top": [0,0.8,3], "radius": 0.5}]}},
    {"material": "mirror", "csg": {"type": "box", "min": [-5,0,4], "max": [5,4,4.2]}}]})";
}

/// The sum of a figure over the nodes' reports.
inline std::uint64_t total(const Outcome& outcome, std::uint64_t control::NodeStats::*field) {
  std::uint64_t sum = 0;
  for (const control::NodeStats& n : outcome.reports) sum += n.*field;
  return sum;
}

inline Picture serial_picture(const std::string& text, AovSet aovs = {}) {
  ReadResult read = read_scene_text(text);
  REQUIRE(read.scene);
  read.scene->settings.aovs = aovs;
  const Domain domain(compile_scene(*read.scene));
  const ImageSize& image = domain.settings().image;
  Film film(image.width, image.height, image.samples * image.samples, aovs);
  render_serial(domain, {}, film);
  return film.develop();
}

inline void check_same_picture(Farm& farm, const Outcome& outcome, std::uint32_t job,
                               const Picture& expected) {
  for (const std::string& v : outcome.violations) UNSCOPED_INFO(v);
  CHECK(outcome.violations.empty());
  if (outcome.failed && !outcome.failed->errors.empty()) {
    UNSCOPED_INFO(outcome.failed->errors.front().where + ": " + outcome.failed->errors.front().why);
  }
  REQUIRE(outcome.done);
  const Picture* picture = farm.store().picture(job);
  REQUIRE(picture != nullptr);
  CHECK(*picture == expected);
}

inline control::JobOptions with(Algorithm algorithm, Grain grain = Grain::kTile) {
  control::JobOptions o;
  o.algorithm = algorithm;
  o.grain = grain;
  return o;
}

}  // namespace graycube::simulation
