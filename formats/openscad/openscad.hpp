// Reads the tree that OpenSCAD writes with `openscad -o MODEL.csg MODEL.scad`: primitives,
// matrices, Boolean operations and colours, everything else evaluated away. OpenSCAD 2021.01 is the
// reference for what empty operands, degenerate primitives and the modifiers % # ! * mean.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "formats/openscad/language/limits.hpp"
#include "formats/openscad/language/options.hpp"
#include "formats/openscad/language/report.hpp"
#include "scene/scene.hpp"

namespace graycube {

/// `scene` is there exactly when `errors` is empty. Errors are in the order of their lines.
/// A warning's `where` is "line N", or empty when it is about the whole file; they tell, too, of
/// solids that OpenSCAD leaves out.
struct OpenscadResult {
  std::optional<Scene> scene;
  std::vector<OpenscadError> errors;
  std::vector<ImportWarning> warnings;
};

/// The scene of a .csg file: OpenSCAD's axes (z up, right-handed) and its default direction
/// of view, framed, with two lights and a grey background. Never throws, whatever `text`
/// holds.
///
/// Spheres and cylinders are exact, unless $fn asks for 8 sides or fewer: then they are the
/// polyhedra that OpenSCAD builds. Parts outside any difference and intersection become objects of
/// their own, unless some part is transparent: inner surfaces would show, so then the file is one
/// object, a union.
OpenscadResult read_openscad_csg(std::string_view text, const OpenscadOptions& options = {});

}  // namespace graycube
