#include "formats/openscad/language/arguments.hpp"

#include <algorithm>
#include <cmath>

namespace graycube {
namespace {

/// With at least so many sides, a circle, cylinder or sphere stands for a round one.
constexpr double kLeastRoundSides = 9;
/// Half of OpenSCAD's finest grid, in OpenSCAD's units.
constexpr double kLeastRadius = 0.00000095367431640625;
constexpr double kPi = 3.14159265358979323846;

}  // namespace

ScadFineness fineness_of(ScadArguments& arguments) {
  return {arguments.number("$fn", -1, 0), arguments.number("$fa", -1, 12),
          arguments.number("$fs", -1, 2)};
}

int fragments(double radius, const ScadFineness& fineness) {
  const double most = kMaxOpenscadSides;
  if (!(radius >= kLeastRadius) || !std::isfinite(fineness.fn)) return 3;
  if (fineness.fn > 0) return static_cast<int>(std::clamp(fineness.fn, 3.0, most));
  const double by_angle = 360 / std::max(fineness.fa, 0.01);
  const double by_length = radius * 2 * kPi / std::max(fineness.fs, 0.01);
  return static_cast<int>(std::min(std::ceil(std::max(std::min(by_angle, by_length), 5.0)), most));
}

int asked_sides(const ScadFineness& fineness) {
  if (!(fineness.fn > 0) || fineness.fn >= kLeastRoundSides) return 0;
  return static_cast<int>(std::max(fineness.fn, 3.0));
}

}  // namespace graycube
