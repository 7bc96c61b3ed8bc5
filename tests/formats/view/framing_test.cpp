#include "formats/view/framing.hpp"

#include <cmath>

#include "catch.hpp"
#include "formats/openscad/reading.hpp"

namespace graycube {
namespace {

using testing::scene_of;

/// A point's place in the picture: −1 … 1 from left to right and from bottom to top. By the scene
/// file's contract: right-handed, an eye on −z that looks along +z with y up has +x to its left.
struct Picture {
  const RenderSettings& settings;

  Vec3 at(const Vec3& p) const {
    const Camera& camera = settings.camera;
    REQUIRE(camera.handedness == Handedness::kRight);
    const Vec3 forward = normalized(camera.look_at - camera.eye);
    const Vec3 right = normalized(cross(forward, camera.up));
    const Vec3 up = cross(right, forward);
    const Vec3 d = p - camera.eye;
    const double half = std::tan(camera.fov_degrees * std::acos(-1.0) / 360);
    const double aspect = static_cast<double>(settings.image.height) / settings.image.width;
    const double depth = dot(d, forward);
    return {dot(d, right) / depth / half, dot(d, up) / depth / half / aspect, depth};
  }
};

/// The extent in the picture of points given by `point(i)`, i < count.
template <typename Points>
Aabb extent(const Scene& scene, int count, const Points& point) {
  Aabb box = Aabb::nothing();
  for (int i = 0; i < count; ++i) box.include(Picture{scene.settings}.at(point(i)));
  return box;
}

Vec3 on_unit_sphere(int i) {
  const double z = -1 + 2 * (i + 0.5) / 20000, angle = 2.399963 * i, r = std::sqrt(1 - z * z);
  return {r * std::cos(angle), r * std::sin(angle), z};
}

TEST_CASE("the view is OpenSCAD's: x to the right, y away, z up, from the front right and above") {
  const Scene scene = scene_of("cube(2, center = true);");
  const Picture picture{scene.settings};
  const Vec3 middle = picture.at({0, 0, 0});
  CHECK(picture.at({1, 0, 0}).x > middle.x);
  CHECK(picture.at({0, 0, 1}).y > middle.y);
  CHECK(picture.at({0, 1, 0}).z > middle.z);
  CHECK(picture.at({1, 0, 0}).z < middle.z);
  CHECK(scene.settings.camera.eye.z > 0);
  CHECK(std::fabs(middle.x) < 0.1);
  CHECK(std::fabs(middle.y) < 0.1);
}

TEST_CASE("a box fills the picture up to the margin, in wide, square and tall pictures") {
  for (const auto& [width, height] :
       {std::pair{640u, 480u}, {512u, 512u}, {200u, 900u}, {1900u, 100u}}) {
    const Scene scene =
        scene_of("multmatrix([[1, 0, 0, 100], [0, 1, 0, -50]]) cube([4, 30, 7]);",
                 {.frame = {.image = {width, height, 1}, .fov_degrees = 40, .margin = 0.1}});
    CHECK(scene.settings.camera.fov_degrees == 40);
    CHECK(scene.settings.image == ImageSize{width, height, 1});
    const Aabb box{{100, -50, 0}, {104, -20, 7}};
    const Aabb seen = extent(scene, 8, [&](int i) { return box.corner(i); });
    INFO(width << " x " << height);
    CHECK(std::max({seen.hi.x, -seen.lo.x, seen.hi.y, -seen.lo.y}) == Approx(0.8));
    CHECK((std::fabs(seen.hi.x - 0.8) < 1e-9 || std::fabs(seen.hi.y - 0.8) < 1e-9));
    CHECK((std::fabs(seen.lo.x + 0.8) < 1e-9 || std::fabs(seen.lo.y + 0.8) < 1e-9));
  }
}

TEST_CASE("round solids are framed by their outline, not by a box around them") {
  const Scene sphere =
      scene_of("multmatrix([[2, 0, 0, 7], [0, 2, 0, 0], [0, 0, 2, 0]]) sphere(1);");
  const Aabb seen = extent(sphere, 20000, [](int i) {
    return 2 * on_unit_sphere(i) + Vec3{7, 0, 0};
  });
  CHECK(seen.hi.x == Approx(0.84).margin(1e-3));
  CHECK(seen.lo.y == Approx(-0.84).margin(1e-3));

  const Scene egg = scene_of("multmatrix([[1, 0, 2, 0], [0, 3, 0, 0], [0, 0, 1, 0]]) sphere(1);");
  const Aabb egg_seen = extent(egg, 20000, [](int i) {
    const Vec3 p = on_unit_sphere(i);
    return Vec3{p.x + 2 * p.z, 3 * p.y, p.z};
  });
  CHECK(std::max(egg_seen.hi.x, egg_seen.hi.y) == Approx(0.84).margin(1e-3));

  const Scene cone = scene_of(
      "multmatrix([[1, 0, 0, 0], [0, 0, -1, 0], [0, 1, 0, 0]]) cylinder(h = 5, r1 = 2, r2 = 1);");
  const Aabb cone_seen = extent(cone, 20000, [](int i) {
    const double angle = 0.001 * i;
    const double r = i % 2 == 0 ? 2 : 1;
    return Vec3{r * std::cos(angle), i % 2 == 0 ? 0.0 : -5.0, r * std::sin(angle)};
  });
  CHECK(std::max(cone_seen.hi.x, cone_seen.hi.y) == Approx(0.84).margin(1e-3));
  CHECK(std::min(cone_seen.lo.x, cone_seen.lo.y) == Approx(-0.84).margin(1e-3));
}

TEST_CASE("what is cut off doesn't count for the frame") {
  const RenderSettings whole = scene_of("cube(2);").settings;
  CHECK(scene_of("difference() { cube(2); sphere(50); }").settings == whole);
  CHECK(scene_of("intersection() { cube(2); cube(90, center = true); }").settings == whole);
  CHECK(scene_of("%sphere(50); cube(2);").settings == whole);
  CHECK_FALSE(scene_of("cube(2); sphere(50);").settings == whole);
}

TEST_CASE("the eye and the lights stay outside of what they show") {
  for (const char* text :
       {"cube([1, 1, 1000], center = true);", "cube([1000, 1, 1]);", "cube(1e-6);", "cube(1e9);",
        "intersection() { cube(2); multmatrix([[1, 0, 0, 1.9], [0, 1, 0, 1.9], [0, 0, 1, 1.9]]) "
        "cube(9); }",
        "cube([577, 1, 819], center = true);", ""}) {
    const RenderSettings settings = scene_of(text).settings;
    INFO(text);
    const Scene scene = scene_of(text);
    CHECK_FALSE(testing::holds(scene, settings.camera.eye));
    REQUIRE(settings.lights.size() == 2);
    for (const PointLight& light : settings.lights)
      CHECK_FALSE(testing::holds(scene, light.position));
    const Vec3 view = settings.camera.look_at - settings.camera.eye;
    CHECK(is_finite(view));
    CHECK(length(view) > 0);
    CHECK(length(cross(view, settings.camera.up)) > 0);
  }
}

TEST_CASE("both lights are on the eye's side, the brighter one to the left") {
  const RenderSettings settings = scene_of("cube(2, center = true);").settings;
  const Picture picture{settings};
  const double middle = picture.at({0, 0, 0}).z;
  CHECK(picture.at(settings.lights[0].position).z < middle);
  CHECK(picture.at(settings.lights[1].position).z < middle);
  CHECK(settings.lights[0].color.r > settings.lights[1].color.r);
  const Vec3 forward = normalized(settings.camera.look_at - settings.camera.eye);
  const Vec3 right = normalized(cross(forward, settings.camera.up));
  CHECK(dot(settings.lights[0].position, right) < 0);
  CHECK(dot(settings.lights[1].position, right) > 0);
  CHECK(settings.max_depth == 5);
}

}  // namespace
}  // namespace graycube
