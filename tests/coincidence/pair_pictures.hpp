// The scenes of a pair as pictures, and the differences between these.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <string>

#include "catch.hpp"
#include "coincidence/pair_maker.hpp"
#include "scene/compile_scene.hpp"
#include "trace/render_serial.hpp"

namespace graycube::testing {

/// Gives both scenes the same camera, which looks at one of the pair's parts, lights and material.
inline void set_up_picture(FlushPair& pair, std::uint32_t side) {
  Dice dice(pair.seed ^ 0xC0FFEEull);
  const Site& site = pair.sites[dice.below(pair.sites.size())];
  const double size = site.world_size();
  RenderSettings s;
  s.image = {side, side, 1};
  s.camera.projection = dice.one_in(4) ? Projection::kOrthographic : Projection::kPerspective;
  s.camera.look_at = site.to_world.point({0, 0, 0.5 * site.height});
  const Vec3 view = dice.unit_vector();
  s.camera.eye = s.camera.look_at + 4 * size * view;
  s.camera.up = std::fabs(view.y) < 0.9 ? Vec3{0, 1, 0} : Vec3{1, 0, 0};
  s.camera.fov_degrees = 35;
  s.camera.width = 2.5 * size;
  s.background = {0.1, 0.2, 0.3};
  s.max_depth = 3;
  for (int i = 0; i < 2; ++i) {
    s.lights.push_back({s.camera.look_at + 5 * size * (view + dice.unit_vector()),
                        {0.6, 0.5, 0.5},
                        Falloff::kNone});
  }
  s.aovs = AovSet::all();
  Material m;
  m.color = {0.9, 0.7, 0.5};
  m.specular = 0.3;
  m.shininess = 20;
  m.reflect = dice.one_in(2) ? 0.2 : 0;
  if (dice.one_in(3)) {
    m.transmit = 0.6;
    m.ior = 1.5;
  }
  for (Scene* scene : {&pair.flush, &pair.longer}) {
    scene->settings = s;
    scene->materials = {{"plain", m}};
  }
}

inline Picture picture_of(const Scene& scene, const SubdivisionChoice& subdivision = {}) {
  const ImageSize& image = scene.settings.image;
  const Domain domain(compile_scene(scene), subdivision);
  Film film(image.width, image.height, image.samples * image.samples, scene.settings.aovs);
  render_serial(domain, {}, film);
  return film.develop();
}

/// Differences between two pictures of one size, of which the second is right.
struct PictureDifference {
  std::size_t pixels = 0;
  /// The number of those around which the right picture shows one surface.
  std::size_t interior = 0;
  /// The number of all pixels around which the right picture shows one surface.
  std::size_t all_interior = 0;
};

class PictureComparison {
 public:
  PictureComparison(const Picture& found, const Picture& expected)
      : found_(found), expected_(expected) {}

  PictureDifference run() const {
    PictureDifference d;
    for (std::uint32_t y = 0; y < expected_.height; ++y) {
      for (std::uint32_t x = 0; x < expected_.width; ++x) {
        const bool interior = is_interior(x, y);
        d.all_interior += interior ? 1 : 0;
        if (!differs(x, y)) continue;
        ++d.pixels;
        d.interior += interior ? 1 : 0;
      }
    }
    return d;
  }

 private:
  std::size_t at(std::uint32_t x, std::uint32_t y) const {
    return 3 * (std::size_t{y} * expected_.width + x);
  }
  /// Whether the pixel differs by more than four steps of a 16-bit picture.
  bool differs(std::uint32_t x, std::uint32_t y) const {
    constexpr double kMost = 4.0 / 65535;
    for (std::size_t i = at(x, y); i < at(x, y) + 3; ++i) {
      const double a = std::clamp<double>(found_.rgb[i], 0, 1),
                   b = std::clamp<double>(expected_.rgb[i], 0, 1);
      if (std::fabs(a - b) > kMost) return true;
    }
    return false;
  }
  std::uint32_t object(std::uint32_t x, std::uint32_t y) const {
    return expected_.aov_planes[kDepthPlane][at(x, y) + 1];
  }
  Vec3 normal(std::uint32_t x, std::uint32_t y) const {
    const auto word = [&](std::size_t i) {
      return std::bit_cast<float>(expected_.aov_planes[kNormalPlane][at(x, y) + i]);
    };
    return {word(0), word(1), word(2)};
  }
  /// Whether all nine pixels around show the same object, and about the same normal.
  bool is_interior(std::uint32_t x, std::uint32_t y) const {
    constexpr double kBend = 0.15;
    if (x == 0 || y == 0 || x + 1 == expected_.width || y + 1 == expected_.height) return false;
    for (std::uint32_t v = y - 1; v <= y + 1; ++v) {
      for (std::uint32_t u = x - 1; u <= x + 1; ++u) {
        if (object(u, v) != object(x, y) || length(normal(u, v) - normal(x, y)) > kBend)
          return false;
      }
    }
    return true;
  }

  const Picture& found_;
  const Picture& expected_;
};

/// Counts pixels that differ, over the scenes of a test.
class PictureTally {
 public:
  void add(const std::string& what, const Picture& found, const Picture& expected) {
    const PictureDifference d = PictureComparison(found, expected).run();
    if (d.interior > 0) {
      wrong_ += "\n  " + what + ": " + std::to_string(d.pixels) + " pixels, " +
                std::to_string(d.interior) + " of them inside";
    }
    sum_.pixels += d.pixels;
    sum_.interior += d.interior;
    sum_.all_interior += d.all_interior;
    pixels_ += std::uint64_t{expected.width} * expected.height;
  }
  /// Checks that interior pixels never differ, and others hardly ever. `share`: the least part of
  /// all pixels that must be interior.
  void check(double share = 0.5) const {
    INFO(sum_.pixels << " of " << pixels_ << " pixels" << wrong_);
    CHECK(sum_.interior == 0);
    CHECK(sum_.pixels * 10'000 <= pixels_);
    CHECK(static_cast<double>(sum_.all_interior) > share * static_cast<double>(pixels_));
  }

 private:
  PictureDifference sum_;
  std::string wrong_;
  std::uint64_t pixels_ = 0;
};

}  // namespace graycube::testing
