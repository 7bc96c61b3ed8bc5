// What a ray meets that starts within a solid, seen as rt sees it.
#pragma once

#include <optional>

#include "trace/domain.hpp"
#include "trace/ray_task.hpp"

namespace graycube {

/// Where a primary ray that starts within an object entered that object, as a crossing with a negative t; of several
/// objects around it the one entered last. Nothing when it starts outside of all, or the camera doesn't ask
/// (Camera::inside).
///
/// The line is orthographic, so what lies behind the start is in the ray's own macro-region.
std::optional<Crossing> entry_behind(const Domain& domain, const RayTask& task, CrossingScratch& scratch);

}  // namespace graycube
