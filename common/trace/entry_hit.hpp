// What a ray that starts within a solid shows when it is seen as BRL-CAD's rt sees it.
#pragma once

#include <span>

#include "trace/domain.hpp"
#include "trace/ray_task.hpp"

namespace graycube {

/// Finds where primary rays that start within an object entered it, as crossings with a negative t;
/// if several objects surround the start, the one entered last. Bit i of the result tells whether
/// found[i] holds one: not when the ray starts outside of all objects, or the camera doesn't ask
/// for it (Camera::inside). The packet's rays are of one `kind`.
///
/// The rays are orthographic, so whatever lies behind the start is in the ray's own macro-region.
RayPacket::Mask entries_behind(const Domain& domain, RayKind kind, const RayPacket& packet,
                               CrossingScratch& scratch,
                               std::span<Crossing, RayPacket::kSize> found);

}  // namespace graycube
