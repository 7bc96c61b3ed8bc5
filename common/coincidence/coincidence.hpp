// What coincides in a model coincides to the bit: faces in one plane get the same plane, surfaces
// that are one sphere, ellipsoid, cylinder, cone, torus or quadric get the same numbers. Then a ray
// crosses them at equal parameters, and what is taken together at equal t (crossings/crossings.hpp)
// leaves no skin where a cut is flush with a face. A model's own surfaces become one where they lie
// within how exactly they are known; docs/design/coincidence.md says how near that is.
#pragma once

#include <span>

#include "coincidence/exactness.hpp"
#include "csg/model.hpp"

namespace graycube {

/// Changes the model's primitives, planes and meshes, and the bounds of primitives, in place;
/// `exactness` has one element for each primitive. Whether anything changed. Deterministic, and
/// independent of the order of primitives; surfaces without a partner keep their bits. Object
/// bounds, trees and delta are left alone: compute them afterwards.
bool unify_coincident_surfaces(Model& model, std::span<const Exactness> exactness);

}  // namespace graycube
