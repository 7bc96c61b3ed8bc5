// One primary ray, along +z from z = −10, into a small scene, and the light that comes back.
#pragma once

#include <cmath>
#include <utility>

#include "catch.hpp"
#include "csg/random_model.hpp"
#include "trace/step.hpp"

namespace graycube::testing {

struct Glimpse {
  Rgb light;
  RayCounts rays;
  RoundingCounts rounding;
  Credit credit;

  std::uint64_t count(RayKind kind) const { return rays.created[static_cast<std::size_t>(kind)]; }
};

/// Builds a scene object by object, each with its material.
class Stage {
 public:
  Stage() : scene_(scene_of({})) {
    scene_.materials.clear();
    scene_.settings.camera.eye = {0, 0, -10};
  }

  RenderSettings& settings() { return scene_.settings; }
  Stage& add(CsgNode solid, const Material& material) {
    scene_.materials.push_back({"", material});
    scene_.objects.push_back(
        {"", static_cast<MaterialIndex>(scene_.materials.size() - 1), std::move(solid)});
    return *this;
  }
  Stage& light(const Vec3& position, const Rgb& color = {1, 1, 1},
               Falloff falloff = Falloff::kNone) {
    scene_.settings.lights.push_back({position, color, falloff});
    return *this;
  }
  /// The ray starts at `eye` and goes along `direction`.
  Glimpse look(const Vec3& eye, const Vec3& direction) {
    scene_.settings.camera.eye = eye;
    scene_.settings.camera.look_at = eye + direction;
    scene_.settings.camera.up =
        std::fabs(normalized(direction).y) < 0.9 ? Vec3{0, 1, 0} : Vec3{0, 0, 1};
    return look();
  }
  Glimpse look() {
    const Domain domain(compile_scene(scene_));
    Evaluator evaluator(domain);
    Step step;
    evaluator.trace_pixels({0, 0, 1, 1}, step);
    CHECK(step.leaving.empty());
    Glimpse g{{}, step.rays, step.rounding, {}};
    FixedRgb sum;
    for (const PixelReturn& r : step.returns) {
      sum.add(r.light);
      g.credit.add(r.credit);
    }
    g.light = {static_cast<double>(sum.r) / kFixedOne, static_cast<double>(sum.g) / kFixedOne,
               static_cast<double>(sum.b) / kFixedOne};
    CHECK(g.credit.is_exactly(1));
    return g;
  }

 private:
  Scene scene_;
};

/// Checks that light is equal but for the rounding of some dozen contributions.
inline void check_light(const Rgb& found, const Rgb& expected) {
  INFO(found.r << ' ' << found.g << ' ' << found.b << " against " << expected.r << ' ' << expected.g
               << ' ' << expected.b);
  CHECK(std::fabs(found.r - expected.r) < 1e-8);
  CHECK(std::fabs(found.g - expected.g) < 1e-8);
  CHECK(std::fabs(found.b - expected.b) < 1e-8);
}

/// A material without any light of its own.
inline Material black() {
  Material m;
  m.ambient = 0;
  m.diffuse = 0;
  return m;
}
/// A material that shines with its colour, whatever the light.
inline Material glowing(const Rgb& color) {
  Material m = black();
  m.color = color;
  m.ambient = 1;
  return m;
}
inline Material mirror(double reflect) {
  Material m = black();
  m.reflect = reflect;
  return m;
}
inline Material glass(double transmit, double ior) {
  Material m = black();
  m.transmit = transmit;
  m.ior = ior;
  return m;
}

inline CsgNode ball(const Vec3& center, double radius) {
  return node_of(SphereShape{center, radius});
}
inline CsgNode block(const Vec3& lo, const Vec3& hi) { return node_of(BoxShape{lo, hi}); }
/// The half-space z ≥ at: a wall across the ray.
inline CsgNode wall(double at) { return node_of(HalfSpaceShape{{0, 0, -1}, -at}); }

}  // namespace graycube::testing
