#include "formats/openscad/extrusions/sweep_arguments.hpp"

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
    arguments.pass_over("v", "must be three numbers of sensible size");
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
  const double height = arguments.finite_number("height", 0, 100);
  const bool center = arguments.boolean("center", -1);
  sweep.twist = arguments.finite_number("twist", -1, 0);
  // 0 and less stand for as many as the twist needs.
  sweep.slices = static_cast<int>(
      std::clamp(arguments.finite_number("slices", -1, 0), 0.0, double{kMaxOpenscadSides}));
  sweep.fineness = fineness_of(arguments);
  if (const ScadValue* value = module.argument("scale")) {
    const double* both = value->number();
    auto pair = ScadArguments::pair(*value);
    if (both != nullptr) pair = FlatPoint{*both, *both};
    if (pair && std::isfinite(pair->x) && std::isfinite(pair->y)) {
      sweep.scale = *pair;
    } else {
      arguments.pass_over("scale", "must be a finite number or two of them");
    }
  }
  sweep.scale = {std::max(sweep.scale.x, 0.0), std::max(sweep.scale.y, 0.0)};
  const double biggest = std::max({std::fabs(sweep.twist), sweep.scale.x, sweep.scale.y});
  if (!(biggest <= kMaxOpenscadCoordinate))
    arguments.leave_out("twist or scale", "its twist or scale is not of sensible size");
  const double upward = upward_of(module, arguments, height, sweep);
  if (arguments.empty_unless(upward > 0, "its height is not positive")) return std::nullopt;
  sweep.low = center ? -0.5 * upward : 0;
  sweep.high = center ? 0.5 * upward : upward;
  return sweep;
}

std::optional<TurnSweep> turn_sweep(const ScadModule& module, ScadImport& import,
                                    const FlatLoops& loops) {
  ScadArguments arguments(module, import.report);
  TurnSweep sweep;
  sweep.angle = arguments.finite_number("angle", -1, 360);
  sweep.fineness = fineness_of(arguments);
  if (!(sweep.angle > -360 && sweep.angle <= 360)) sweep.angle = 360;
  // OpenSCAD 2021.01, which writes no start, begins whole turns on the negative side.
  sweep.start = arguments.finite_number("start", -1, sweep.angle == 360 ? 180 : 0);
  if (!(std::fabs(sweep.start) <= kMaxOpenscadCoordinate))
    arguments.leave_out("start", "its start is not of sensible size");
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
