// Which arguments of which modules the importer knows.
#pragma once

#include <vector>

#include "formats/openscad/language/parser.hpp"

namespace graycube {

/// Warns, once for each kind, of arguments in the modules and those in them that aren't known: they
/// are ignored, and may have meant something. Modules that OpenSCAD itself evaluates may have any.
void warn_of_unknown_arguments(const std::vector<ScadModule>& modules, OpenscadReport& report);

}  // namespace graycube
