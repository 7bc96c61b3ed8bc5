// Refraction many levels deep: a ball of nested shells amid a wreath of lenses, a triplet of
// lenses, a Fresnel disc, a prism and blocks with bubbles, before a wall of drilled bricks.
#include <utility>

#include "bench/scene_parts.hpp"
#include "geometry/portable_math.hpp"

namespace graycube::bench {
namespace {

constexpr int kBubbles = 24;

CsgNode half_space(const Vec3& normal, const Vec3& through) {
  const Vec3 n = nine_digits(normal);
  return leaf(HalfSpaceShape{n, nine_digits(dot(n, through))});
}
CsgNode torus(const Vec3& center, const Vec3& axis, double major, double minor) {
  return leaf(TorusShape{center, axis, nine_digits(major), nine_digits(minor)});
}
CsgNode difference(std::vector<CsgNode> children) {
  return operation(Operation::kDifference, std::move(children));
}
CsgNode intersection(std::vector<CsgNode> children) {
  return operation(Operation::kIntersection, std::move(children));
}
CsgNode shell(const Vec3& center, double outer, double inner) {
  return difference({sphere(center, outer), sphere(center, inner)});
}

class Glassware {
 public:
  Glassware(SceneParts& parts, std::uint64_t seed)
      : parts_(parts),
        dice_(seed),
        mattes_(parts.mattes(0.15, 0.7, 0, 1)),
        crown_(glass("crown", {1, 1, 1}, 0.05, 0.92, 1.52)),
        flint_(glass("flint", {0.9, 0.95, 1}, 0.06, 0.9, 1.7)) {}

  void add_wall() {
    for (int column = -7; column <= 7; ++column) {
      for (int row = 0; row < 7; ++row) {
        const Vec3 c{8.0 * column + dice_.between(-0.35, 0.35), 4 + 7.0 * row, 55};
        parts_.object(mattes_ + static_cast<MaterialIndex>(dice_.below(kMattes)),
                      difference({box(c - Vec3{3, 2.6, 2}, c + Vec3{3, 2.6, 2}),
                                  cylinder(c - Vec3{0, 0, 9}, c + Vec3{0, 0, 9}, 1.5)}));
      }
    }
  }

  void add_nest() {
    const Vec3 c{-20, 17, 0};
    parts_.object(crown_, shell(c, 16, 14.5 + dice_.between(-0.3, 0.3)));
    parts_.object(flint_, shell(c, 9.5, 8 + dice_.between(-0.3, 0.3)));
    parts_.object(crown_,
                  difference({sphere(c, 5), cylinder(c - Vec3{20, 0, 0}, c + Vec3{20, 0, 0}, 1.2),
                              torus(c, {0, 1, 0}, 3.4, 0.7)}));
    const double turn = dice_.between(0, 60);
    for (int i = 0; i < 6; ++i) {
      const double angle = turn + 60 * i;
      const Vec3 at = c + 12.0 * Vec3{cos_degrees(angle), sin_degrees(angle), 0};
      parts_.object(
          i % 2 == 0 ? crown_ : flint_,
          intersection({sphere(at - Vec3{0, 0, 1.5}, 2.6), sphere(at + Vec3{0, 0, 1.5}, 2.6)}));
    }
  }

  void add_triplet() {
    const Vec3 c{21, 17, 0};
    const auto on_axis = [&](double z) { return c + Vec3{0, 0, z}; };
    const double convex = dice_.between(17.5, 18.5);
    parts_.object(flint_, intersection({sphere(on_axis(-21), convex), sphere(on_axis(7), convex)}));
    const double concave = dice_.between(13.5, 14);
    parts_.object(crown_,
                  difference({cylinder(on_axis(2), on_axis(8), 10), sphere(on_axis(-9.9), concave),
                              sphere(on_axis(19.9), concave)}));
    parts_.object(crown_, intersection({sphere(on_axis(9), 12), half_space({0, 0, -1}, on_axis(17)),
                                        cylinder(on_axis(-35), on_axis(45), 9)}));
  }

  void add_fresnel_disc() {
    const Vec3 c{dice_.between(-3, 3), 36, 0};
    std::vector<CsgNode> children{cylinder(c + Vec3{0, 0, -9.2}, c + Vec3{0, 0, -6.8}, 8.6)};
    for (int i = 1; i <= 5; ++i) {
      children.push_back(torus(nine_digits(c + Vec3{0, 0, -9.2}), {0, 0, 1}, 1.5 * i, 0.55));
    }
    parts_.object(crown_, difference(std::move(children)));
  }

  void add_prism_and_blocks() {
    const Vec3 ridge{0, dice_.between(5.8, 6.6), -26};
    parts_.object(flint_, intersection({box({-8, 0.2, -30}, {8, 8, -22}),
                                        half_space({0, 0.743294146, -0.668964732}, ridge),
                                        half_space({0.447213595, 0.894427191, 0}, ridge)}));
    add_bubbles(box({-33, 0.2, -30}, {-19, 6, -20}), {-32, 1.2, -29}, {-20, 5, -21}, crown_);
    const Vec3 axes{8, 4.6, 5};
    add_bubbles(
        leaf(EllipsoidShape{{24, 5, -25}, {{{axes.x, 0, 0}, {0, axes.y, 0}, {0, 0, axes.z}}}}),
        {20, 3.4, -27}, {28, 6.6, -23}, flint_);
  }

  void add_mirror_bowl() {
    const auto mirror = parts_.material("mirror", {.color = {0.8, 0.85, 0.9},
                                                   .ambient = 0.03,
                                                   .diffuse = 0.1,
                                                   .specular = 0.6,
                                                   .shininess = 120,
                                                   .reflect = 0.8});
    parts_.object(mirror, difference({sphere({0, 8, 25}, 8), box({-20, 8.5, 0}, {20, 30, 50})}));
  }

 private:
  MaterialIndex glass(std::string name, const Rgb& color, double reflect, double transmit,
                      double ior) {
    return parts_.material(std::move(name), {.color = color,
                                             .ambient = 0.02,
                                             .diffuse = 0.05,
                                             .specular = 0.6,
                                             .shininess = 200,
                                             .reflect = reflect,
                                             .transmit = transmit,
                                             .ior = ior});
  }

  void add_bubbles(CsgNode body, const Vec3& lo, const Vec3& hi, MaterialIndex material) {
    std::vector<CsgNode> children{std::move(body)};
    for (int i = 0; i < kBubbles; ++i) {
      const Vec3 center = dice_.point_between(lo, hi);
      children.push_back(sphere(center, dice_.between(0.4, 0.9)));
    }
    parts_.object(material, difference(std::move(children)));
  }

  SceneParts& parts_;
  Dice dice_;
  MaterialIndex mattes_, crown_, flint_;
};

}  // namespace

Scene glass_lenses(std::uint32_t max_depth, std::uint64_t seed, std::uint32_t side) {
  SceneParts parts(side, {0, 32, -100}, {0, 19, 0}, 42);
  parts.settings().max_depth = max_depth;
  parts.light({-60, 120, -90}, 0.65);
  parts.light({80, 90, -60}, 0.45);
  const auto floor = parts.material("floor", {.color = {0.75, 0.75, 0.7}, .diffuse = 0.75});
  parts.object(floor, box({-120, -2, -120}, {120, 0, 120}));
  Glassware glassware(parts, seed);
  glassware.add_wall();
  glassware.add_nest();
  glassware.add_triplet();
  glassware.add_fresnel_disc();
  glassware.add_prism_and_blocks();
  glassware.add_mirror_bowl();
  return parts.take();
}

}  // namespace graycube::bench
