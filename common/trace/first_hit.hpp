// The AOVs of a picture: what the first hit of a pixel's ray tells apart from its light.
#pragma once

#include "trace/step.hpp"

namespace graycube {

/// Appends the picture's AOVs of a hit to `step`, when `task` is its pixel's ray for them: the
/// primary ray of sample (S/2, S/2), found by its bits. They come as contributions to the slots of
/// aov_slot, without credit, and before the hit's own contribution; whoever holds the ray's credit
/// thus holds them.
void note_first_hit(const Domain& domain, const RayTask& task, const Crossing& hit, Step& step);

}  // namespace graycube
