// Outlines that meet nowhere need no clipping, however many corners they have.
#pragma once

#include <optional>
#include <vector>

#include "flat/polygon.hpp"

namespace graycube {

/// The connected parts of a figure whose sides meet at their own corners only; nothing where sides
/// cross or touch, or a corner is there twice. Corners on a straight line stay. The time grows as
/// n log n: a line sweeps over the plane, and only sides that are next to each other on it are
/// compared (Shamos & Hoey 1976). Comparisons are exact.
std::optional<std::vector<FlatRegion>> simple_regions(const FlatLoops& loops);

}  // namespace graycube
