// Many small solids evenly spread in a block of space over a floor.
#include <cmath>

#include "bench/scene_parts.hpp"

namespace graycube::bench {
namespace {

constexpr Vec3 kFieldLo{-50, 3, -50};
constexpr Vec3 kFieldHi{50, 63, 50};
/// The share of the block of space that balls around the solids would fill.
constexpr double kFill = 0.08;
constexpr double kPi = 3.14159265358979323846;

/// The radius of the balls, before it is varied.
double common_reach(std::uint32_t solids) {
  const Vec3 e = kFieldHi - kFieldLo;
  return std::cbrt(kFill * e.x * e.y * e.z / solids * 3 / (4 * kPi));
}

class Field {
 public:
  Field(std::uint32_t solids, std::uint64_t seed, std::uint32_t side)
      : parts_(side, {25, 62, -135}, {0, 28, 0}, 40), dice_(seed), reach_(common_reach(solids)) {
    parts_.light({-120, 160, -120}, 0.7);
    parts_.light({130, 110, -90}, 0.45);
    const auto floor = parts_.material("floor", {.color = {0.7, 0.7, 0.72}, .diffuse = 0.75});
    first_matte_ = parts_.mattes(0.12, 0.65, 0.35, 30);
    mirror_ = parts_.material("mirror", {.color = {0.85, 0.88, 0.92},
                                         .ambient = 0.03,
                                         .diffuse = 0.15,
                                         .specular = 0.6,
                                         .shininess = 120,
                                         .reflect = 0.7});
    parts_.object(floor, box({-250, -5, -250}, {250, 0, 250}));
  }

  Dice& dice() { return dice_; }
  Vec3 somewhere() { return dice_.point_between(kFieldLo, kFieldHi); }
  double reach() { return reach_ * dice_.between(0.75, 1.25); }
  /// Adds a solid; one in five is a mirror.
  void add(CsgNode csg) {
    const bool mirrors = dice_.below(5) == 0;
    const auto matte = first_matte_ + static_cast<MaterialIndex>(dice_.below(kMattes));
    parts_.object(mirrors ? mirror_ : matte, std::move(csg));
  }
  Scene take() { return parts_.take(); }

 private:
  SceneParts parts_;
  Dice dice_;
  double reach_;
  MaterialIndex first_matte_ = 0, mirror_ = 0;
};

CsgNode bore(Dice& dice, double reach) {
  const int axis = static_cast<int>(dice.below(3));
  Vec3 base = reach * dice.point_between({-0.16, -0.16, -0.16}, {0.16, 0.16, 0.16});
  Vec3 top = base;
  base[axis] = -2 * reach;
  top[axis] = 2 * reach;
  return cylinder(base, top, reach * dice.between(0.2, 0.36));
}

CsgNode block(Dice& dice, double reach) {
  const Vec3 half = reach * dice.point_between({0.5, 0.5, 0.5}, {0.72, 0.72, 0.72});
  return box(-half, half);
}

/// (box − cylinder) ∩ sphere: corners rounded off.
CsgNode drilled_box(Dice& dice, double reach) {
  CsgNode body = block(dice, reach);
  CsgNode drilled = operation(Operation::kDifference, {std::move(body), bore(dice, reach)});
  return operation(Operation::kIntersection,
                   {std::move(drilled), sphere({}, reach * dice.between(0.78, 0.92))});
}

/// box ∩ half-space − cylinder: one corner or edge cut off.
CsgNode cut_box(Dice& dice, double reach) {
  CsgNode body = block(dice, reach);
  const Vec3 normal = nine_digits(dice.direction());
  CsgNode side = leaf(HalfSpaceShape{normal, nine_digits(reach * dice.between(0.1, 0.35))});
  CsgNode rest = operation(Operation::kIntersection, {std::move(body), std::move(side)});
  return operation(Operation::kDifference, {std::move(rest), bore(dice, reach)});
}

/// sphere ∩ sphere − cylinder.
CsgNode drilled_lens(Dice& dice, double reach) {
  const double radius = reach * dice.between(0.85, 1.1);
  const double apart = reach * dice.between(0.25, 0.5);
  CsgNode lens = operation(Operation::kIntersection,
                           {sphere({0, 0, -apart}, radius), sphere({0, 0, apart}, radius)});
  return operation(Operation::kDifference, {std::move(lens), bore(dice, reach)});
}

}  // namespace

Scene csg_field(std::uint32_t primitives, std::uint64_t seed, std::uint32_t side) {
  const std::uint32_t solids = (primitives - 1) / 3;
  Field field(solids, seed, side);
  for (std::uint32_t i = 0; i < solids; ++i) {
    const double reach = field.reach();
    const std::size_t kind = field.dice().below(10);
    CsgNode csg = kind < 7   ? drilled_box(field.dice(), reach)
                  : kind < 9 ? drilled_lens(field.dice(), reach)
                             : cut_box(field.dice(), reach);
    csg.transform = random_placement(field.dice(), field.somewhere());
    field.add(std::move(csg));
  }
  return field.take();
}

Scene sphere_field(std::uint32_t spheres, std::uint64_t seed, std::uint32_t side) {
  Field field(spheres, seed, side);
  for (std::uint32_t i = 0; i < spheres; ++i) {
    const double reach = field.reach();
    field.add(sphere(field.somewhere(), reach));
  }
  return field.take();
}

}  // namespace graycube::bench
