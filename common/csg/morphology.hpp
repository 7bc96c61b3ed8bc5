// Solids made larger or smaller by a distance, after Minkowski and Serra: what is true of every
// line near another follows from that one line through such solids.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "csg/model.hpp"

namespace graycube {

/// A solid that holds every point at most `by` from `p` (scene units). Often a little larger: kinds
/// that have no simple one become a box. New planes of polyhedra are appended to `planes`, whose
/// numbers it has.
Primitive dilated(const Primitive& p, const PrimitiveData& data, double by,
                  std::vector<Plane>& planes);

/// A solid of which every point lies in `p` together with all that is at most `by` from it. Often a
/// little smaller; nothing where there may be no such point, and for kinds that have no simple one.
std::optional<Primitive> eroded(const Primitive& p, const PrimitiveData& data, double by,
                                std::vector<Plane>& planes);

/// How far an object's surface moves.
using ObjectDistance = std::function<double(const Object&)>;

/// The whole scene so, each object for itself: what is taken away from a solid changes the other
/// way round. Nothing when an object would fill all of space.
std::optional<Model> dilated(const Model& model, const ObjectDistance& by);
/// Only the objects of which something is left, and without any that has a transparent material.
Model eroded(const Model& model, const ObjectDistance& by);

}  // namespace graycube
