// A sphere flake: nine balls a third as large sit on every ball, six about its equator and three
// above, seen from where it sits on its own parent (after E. Haines's standard procedural
// databases, 1987). The seed turns the wreath on every ball.
#include "bench/scene_parts.hpp"
#include "geometry/portable_math.hpp"

namespace graycube::bench {
namespace {

class Flake {
 public:
  Flake(SceneParts& parts, MaterialIndex material, std::uint64_t seed)
      : parts_(parts), material_(material), dice_(seed) {}

  void grow(const Vec3& center, const Vec3& axis, double radius, std::uint32_t depth) {
    parts_.object(material_, sphere(center, radius));
    if (depth == 0) return;
    const Vec3 side =
        normalized(cross(axis, std::fabs(axis.x) < 0.6 ? Vec3{1, 0, 0} : Vec3{0, 1, 0}));
    const Vec3 other = cross(axis, side);
    const double turn = dice_.between(0, 360);
    const auto child = [&](double azimuth, double elevation) {
      const Vec3 level = cos_degrees(azimuth) * side + sin_degrees(azimuth) * other;
      const Vec3 out = normalized(cos_degrees(elevation) * level + sin_degrees(elevation) * axis);
      grow(center + (radius * 4 / 3) * out, out, radius / 3, depth - 1);
    };
    for (int i = 0; i < 6; ++i) child(turn + 60 * i, 0);
    for (int i = 0; i < 3; ++i) child(turn + 30 + 120 * i, 60);
  }

 private:
  SceneParts& parts_;
  MaterialIndex material_;
  Dice dice_;
};

}  // namespace

Scene sphere_flake(std::uint32_t depth, std::uint64_t seed, std::uint32_t side) {
  SceneParts parts(side, {210, 130, 170}, {0, 0, 0}, 45, {0, 0, 1});
  parts.settings().background = {0.078, 0.361, 0.753};
  parts.light({400, 300, 200}, 0.5);
  parts.light({100, -400, 400}, 0.5);
  parts.light({-300, 100, 500}, 0.5);
  const auto floor =
      parts.material("floor", {.color = {1, 0.75, 0.33}, .ambient = 0.06, .diffuse = 0.7});
  const auto ball = parts.material("ball", {.color = {1, 0.9, 0.7},
                                            .ambient = 0.06,
                                            .diffuse = 0.45,
                                            .specular = 0.4,
                                            .shininess = 30,
                                            .reflect = 0.5});
  parts.object(floor, box({-1200, -1200, -60}, {1200, 1200, -50}));
  Flake(parts, ball, seed).grow({0, 0, 0}, {0, 0, 1}, 50, depth);
  return parts.take();
}

}  // namespace graycube::bench
