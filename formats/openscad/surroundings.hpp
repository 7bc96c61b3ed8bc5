// What the modules around a module of a .csg file mean for the solids in it.
#pragma once

#include "formats/view/palette.hpp"
#include "geometry/affine.hpp"

namespace graycube {

struct Surroundings {
  Affine to_world;
  /// What of it isn't around all parts.
  Affine to_rest;
  ScadColor color;
  /// What tools cut is green where no colour says otherwise; what is cut from a tool isn't.
  ScadFace face = ScadFace::kOuter;
  /// Within a render() all is one solid, in the colour around it.
  bool is_one_solid = false;
  /// Nothing of the file stands beside what is in here.
  bool is_around_all = false;

  /// How many differences subtract it: flat tools are thicker than what they cut.
  int cuts = 0;

  /// Those of what is subtracted from the solid here.
  Surroundings of_tool() const {
    Surroundings inner = *this;
    ++inner.cuts;
    if (!is_one_solid) inner.face = face == ScadFace::kOuter ? ScadFace::kCut : ScadFace::kOuter;
    return inner;
  }
};

}  // namespace graycube
