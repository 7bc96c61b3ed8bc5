// Pictures against a second renderer in closed form: silhouettes, normals, shades, shadows,
// reflections.
#include <cmath>
#include <cstdint>

#include "analytic_scene.hpp"
#include "catch.hpp"
#include "csg/random_model.hpp"
#include "trace/render_serial.hpp"

using namespace graycube;
using namespace graycube::testing;

namespace {

constexpr std::uint32_t kWidth = 160, kHeight = 120;
constexpr double kPi = 3.14159265358979323846;

AnalyticScene still_life() {
  AnalyticScene s;
  s.solids = {
      {AnalyticFloor{0}, {0.8, 0.8, 0.7}, 0.1, 0.7, 0, 1, 0.2},
      {AnalyticSphere{{-1.2, 1, 0.3}, 1}, {0.9, 0.2, 0.1}, 0.1, 0.6, 0.5, 40, 0.3},
      {AnalyticBox{{0.3, 0, -0.5}, {1.9, 1.3, 0.9}}, {0.2, 0.5, 0.9}, 0.15, 0.7, 0.2, 8, 0},
      {AnalyticColumn{0.1, -1.6, 0, 1.1, 0.45, 0.45}, {0.3, 0.8, 0.3}, 0.1, 0.6, 0.4, 20, 0.1},
      {AnalyticColumn{2.1, -1.7, 0, 1.4, 0.6, 0.2}, {0.9, 0.8, 0.1}, 0.1, 0.7, 0.3, 12, 0},
      {AnalyticColumn{-2.4, -1.5, 0, 1.0, 0.5, 0}, {0.7, 0.3, 0.8}, 0.1, 0.7, 0.3, 12, 0.2},
      {AnalyticSphere{{1.1, 1.55, 0.2}, 0.25}, {1, 1, 1}, 0.05, 0.2, 0.8, 100, 0.7}};
  s.lights = {{{-5, 7, -6}, {0.7, 0.65, 0.6}}, {{6, 5, -3}, {0.3, 0.35, 0.4}}};
  s.background = {0.2, 0.3, 0.5};
  s.max_depth = 3;
  return s;
}

CsgNode solid_of(const AnalyticSphere& s) { return node_of(SphereShape{s.center, s.radius}); }
CsgNode solid_of(const AnalyticBox& b) { return node_of(BoxShape{b.lo, b.hi}); }
CsgNode solid_of(const AnalyticFloor& f) { return node_of(HalfSpaceShape{{0, 1, 0}, f.height}); }
CsgNode solid_of(const AnalyticColumn& c) {
  const Vec3 base{c.x, c.bottom, c.z}, top{c.x, c.top, c.z};
  if (c.radius == c.top_radius) return node_of(CylinderShape{base, top, c.radius});
  return node_of(ConeShape{base, c.radius, top, c.top_radius});
}

Scene scene_from(const AnalyticScene& s, const Camera& camera) {
  Scene scene;
  scene.settings.image = {kWidth, kHeight, 1};
  scene.settings.camera = camera;
  scene.settings.background = s.background;
  scene.settings.max_depth = static_cast<std::uint32_t>(s.max_depth);
  for (const auto& l : s.lights)
    scene.settings.lights.push_back({l.position, l.color, Falloff::kNone});
  for (const AnalyticSolid& a : s.solids) {
    Material m;
    m.color = a.color;
    m.ambient = a.ambient;
    m.diffuse = a.diffuse;
    m.specular = a.specular;
    m.shininess = a.shininess;
    m.reflect = a.reflect;
    const auto material = static_cast<MaterialIndex>(scene.materials.size());
    scene.materials.push_back({"", m});
    scene.objects.push_back(
        {"", material, std::visit([](const auto& shape) { return solid_of(shape); }, a.shape)});
  }
  return scene;
}

/// The ray of a pixel by the contract's words: fov is the full horizontal angle, pixels are square,
/// (0, 0) is top left, the ray passes through the centre; in the left-handed case +x is to the
/// right of eye and up.
struct PinHole {
  Vec3 eye, forward, right, up;
  double half_width;
  bool is_parallel;

  explicit PinHole(const Camera& c)
      : eye(c.eye),
        forward(normalized(c.look_at - c.eye)),
        is_parallel(c.projection == Projection::kOrthographic) {
    right = normalized(cross(c.up, forward));  // left-handed
    up = cross(forward, right);
    if (c.handedness == Handedness::kRight) right = -right;
    half_width = is_parallel ? c.width / 2 : std::tan(c.fov_degrees / 2 * kPi / 180);
  }
  std::pair<Vec3, Vec3> ray(std::uint32_t x, std::uint32_t y) const {
    const double across = ((x + 0.5) / kWidth * 2 - 1) * half_width;
    const double upwards = (1 - (y + 0.5) / kHeight * 2) * half_width * kHeight / kWidth;
    const Vec3 offset = across * right + upwards * up;
    if (is_parallel) return {eye + offset, forward};
    return {eye, normalized(forward + offset)};
  }
};

/// Most pixels must be equal to 10^-6; a silhouette may pass within rounding of a pixel's centre.
void compare(const Scene& scene, const AnalyticScene& expected) {
  const Domain domain(compile_scene(scene));
  Film film(kWidth, kHeight, 1);
  render_serial(domain, {}, film);
  const Picture picture = film.develop();
  const PinHole camera(scene.settings.camera);
  int off = 0, hits = 0;
  for (std::uint32_t y = 0; y < kHeight; ++y) {
    for (std::uint32_t x = 0; x < kWidth; ++x) {
      const auto [o, d] = camera.ray(x, y);
      const Rgb light = expected.seen(o, d);
      hits += light == expected.background ? 0 : 1;
      const float* rgb = picture.rgb.data() + 3 * (std::size_t{y} * kWidth + x);
      const double worst = std::max(
          {std::fabs(rgb[0] - light.r), std::fabs(rgb[1] - light.g), std::fabs(rgb[2] - light.b)});
      if (worst <= 1e-6) continue;
      UNSCOPED_INFO("pixel " << x << ", " << y << " differs by " << worst);
      ++off;
    }
  }
  CHECK(off <= 2);
  CHECK(hits > static_cast<int>(kWidth * kHeight / 3));
}

Camera above() {
  Camera c;
  c.eye = {0.7, 3.1, -7.3};
  c.look_at = {0, 0.7, 0};
  c.up = {0.1, 1, 0};
  c.fov_degrees = 44;
  c.width = 7;
  return c;
}

}  // namespace

TEST_CASE("a still life is rendered as worked out in closed form") {
  const AnalyticScene expected = still_life();
  Camera camera = above();
  SECTION("in perspective, right-handed") {}
  SECTION("in perspective, left-handed") { camera.handedness = Handedness::kLeft; }
  SECTION("in parallel projection") { camera.projection = Projection::kOrthographic; }
  SECTION("from low") { camera.eye = {-3, 0.4, -4}; }
  SECTION("from inside the box") { camera.eye = {1.1, 0.6, 0.1}; }
  SECTION("from below the floor") { camera.eye = {0.3, -4, -3}; }
  compare(scene_from(expected, camera), expected);
}

TEST_CASE("the same still life under maps that change nothing is the same picture") {
  // Each solid is made elsewhere, in another size or mirrored, and brought back.
  const AnalyticScene expected = still_life();
  Scene scene = scene_from(expected, above());
  Dice dice(4);
  for (SceneObject& o : scene.objects) {
    RandomModel random(dice.below(1000));
    const Affine away = compose(random.rigid(), random.shear());
    o.csg = transformed(transformed(o.csg, away), *away.inverse());
    // Composed maps are nearly the identity: keep them from collapsing, so that oblique kinds are
    // used.
    o.csg = operation(Operation::kUnion, {o.csg});
  }
  compare(scene, expected);
}

TEST_CASE("solids cut from others are the same picture") {
  // Each solid is intersected with a larger one, and another is subtracted that it doesn't meet.
  const AnalyticScene expected = still_life();
  Scene scene = scene_from(expected, above());
  for (SceneObject& o : scene.objects) {
    const CsgNode around = node_of(HalfSpaceShape{{0, 1, 0}, 50});
    const CsgNode apart = node_of(SphereShape{{0, 90, 0}, 20});
    const CsgNode both = operation(Operation::kIntersection, {around, o.csg});
    o.csg = operation(Operation::kDifference, {both, apart});
  }
  compare(scene, expected);
}
