#include "formats/openscad/sweep_arguments.hpp"

#include <algorithm>
#include <cmath>

#include "formats/openscad/language/arguments.hpp"

namespace graycube {
namespace {

/// How far up it goes: with `v`, which OpenSCAD has since 2022, the height is measured along that,
/// and v's own length is the height if none is given.
double upward_of(const ScadModule& module, ScadArguments& arguments, double height,
                 LinearSweep& sweep) {
  const ScadValue* value = module.argument("v");
  if (value == nullptr) return height;
  const auto along = ScadArguments::vector(*value);
  if (!along || !(max_abs(*along) <= kMaxOpenscadCoordinate) || !is_finite(*along)) {
    arguments.fail("v must be three numbers");
    return height;
  }
  const double size = length(*along);
  if (!(along->z > 0 && size > 0)) return 0;
  sweep.lean = {along->x / along->z, along->y / along->z};
  return module.argument("height", 0) == nullptr ? along->z : height * (along->z / size);
}

}  // namespace

std::optional<LinearSweep> linear_sweep(const ScadModule& module, ScadImport& import) {
  ScadArguments arguments(module, import.report);
  LinearSweep sweep;
  const double height = arguments.number("height", 0, 100);
  const bool center = arguments.boolean("center", -1);
  sweep.twist = arguments.number("twist", -1, 0);
  if (arguments.has("slices")) {
    sweep.slices = static_cast<int>(
        std::clamp(arguments.number("slices", -1, 1), 1.0, double{kMaxOpenscadSides}));
  }
  sweep.fineness = fineness_of(arguments);
  if (const ScadValue* value = module.argument("scale")) {
    const double* both = value->number();
    const auto pair = ScadArguments::pair(*value);
    if (both != nullptr) sweep.scale = {*both, *both};
    if (pair) sweep.scale = *pair;
    if (both == nullptr && !pair) arguments.fail("scale must be a number or two numbers");
  }
  sweep.scale = {std::max(sweep.scale.x, 0.0), std::max(sweep.scale.y, 0.0)};
  const double biggest = std::max({std::fabs(sweep.twist), sweep.scale.x, sweep.scale.y});
  if (arguments.ok() && !(biggest <= kMaxOpenscadCoordinate))
    arguments.fail("twist and scale must be finite");
  const double upward = arguments.ok() ? upward_of(module, arguments, height, sweep) : height;
  if (arguments.empty_unless(std::isfinite(upward) && upward > 0, "its height is not positive"))
    return std::nullopt;
  sweep.low = center ? -0.5 * upward : 0;
  sweep.high = center ? 0.5 * upward : upward;
  return sweep;
}

std::optional<TurnSweep> turn_sweep(const ScadModule& module, ScadImport& import,
                                    const FlatLoops& loops) {
  ScadArguments arguments(module, import.report);
  TurnSweep sweep;
  sweep.angle = arguments.number("angle", -1, 360);
  sweep.fineness = fineness_of(arguments);
  if (!(sweep.angle > -360 && sweep.angle <= 360)) sweep.angle = 360;
  // OpenSCAD 2021.01, which writes no start, begins whole turns on the negative side.
  sweep.start = arguments.number("start", -1, sweep.angle == 360 ? 180 : 0);
  if (arguments.ok() && !(std::fabs(sweep.start) <= kMaxOpenscadCoordinate))
    arguments.fail("start must be finite");
  const auto [lo, hi] = flat_bounds(loops);
  const bool one_side =
      !(hi.x > 0 && lo.x < 0) || std::min(hi.x, -lo.x) <= 1e-9 * std::max(hi.x, -lo.x);
  if (arguments.empty_unless(one_side, "its figure lies on both sides of the axis"))
    return std::nullopt;
  if (arguments.empty_unless(sweep.angle != 0, "its angle is 0")) return std::nullopt;
  sweep.mirrored = hi.x < -lo.x;
  return sweep;
}

Affine leaning(const LinearSweep& sweep) {
  return {{{{1, 0, sweep.lean.x, 0}, {0, 1, sweep.lean.y, 0}, {0, 0, 1, 0}}}};
}

}  // namespace graycube
