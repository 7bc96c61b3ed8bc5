// Solids made larger or smaller by a distance, after Minkowski and Serra: one line through such
// solids tells what holds for all lines near it.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "csg/model.hpp"

namespace graycube {

/// A solid that holds every point at most `by` from `p` (scene units). Often a little larger: kinds
/// that can't be moved become a box. New planes of a polyhedron are appended to `planes`, to which
/// its plane numbers refer.
Primitive dilated(const Primitive& p, const PrimitiveData& data, double by,
                  std::vector<Plane>& planes);

/// A solid whose points all lie in `p` together with everything at most `by` from them. Often a
/// little smaller; nothing when there may be no such point, and for kinds that can't be moved.
std::optional<Primitive> eroded(const Primitive& p, const PrimitiveData& data, double by,
                                std::vector<Plane>& planes);

/// How far an object's surface moves.
using ObjectDistance = std::function<double(const Object&)>;

/// The whole scene dilated, each object by itself; parts that are subtracted from an object are
/// eroded instead. Nothing when an object would fill all of space.
std::optional<Model> dilated(const Model& model, const ObjectDistance& by);
/// The whole scene eroded, without objects that vanish or have a transparent material.
Model eroded(const Model& model, const ObjectDistance& by);

}  // namespace graycube
