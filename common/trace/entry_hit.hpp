// What a ray meets that starts within a solid, seen as rt sees it.
#pragma once

#include <span>

#include "trace/domain.hpp"
#include "trace/ray_task.hpp"

namespace graycube {

/// Where primary rays that start within an object entered that object, as crossings with a negative
/// t; of several objects around it the one entered last. Bit i of the result tells whether found[i]
/// holds one: not when the ray starts outside of all, or the camera doesn't ask (Camera::inside).
/// `packet`: rays of one kind.
///
/// The line is orthographic, so what lies behind the start is in the ray's own macro-region.
RayPacket::Mask entries_behind(const Domain& domain, RayKind kind, const RayPacket& packet,
                               CrossingScratch& scratch,
                               std::span<Crossing, RayPacket::kSize> found);

}  // namespace graycube
