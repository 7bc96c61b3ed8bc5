// The texts of the work that the importer leaves to OpenSCAD itself: a part of a .csg file goes
// out, a polygon comes back.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "flat/polygon.hpp"
#include "formats/openscad/language/parser.hpp"

namespace graycube {

/// The text of a module as OpenSCAD reads it; the names of files in `file = …` are made absolute by
/// `folder`, when it isn't empty.
std::string scad_text(const ScadModule& module, const std::string& folder);

/// The polygon of an SVG file that OpenSCAD wrote: its path's closed loops, y upwards. Nothing when
/// the text is no such file.
std::optional<FlatLoops> loops_of_svg(std::string_view text);

}  // namespace graycube
