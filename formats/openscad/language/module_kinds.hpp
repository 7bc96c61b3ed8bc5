// What kinds of modules there are in .csg files.
#pragma once

#include <string>
#include <vector>

#include "formats/openscad/language/parser.hpp"

namespace graycube {

/// Whether the module only gathers or places the modules in it, whatever its dimension.
bool is_gathering(const std::string& name);
bool is_extrusion(const std::string& name);
/// Whether the program `openscad` must evaluate it.
bool is_for_program(const std::string& name);
/// Whether OpenSCAD 2021.01 doesn't know it, and makes nothing of it; what is done here isn't among
/// them.
bool is_newer_than_2021(const std::string& name);
/// Whether it is a module of .csg files that is empty when no shape is in it.
bool is_empty_without_shapes(const std::string& name);

/// Whether it is a difference or an intersection of which OpenSCAD shows parts in colours of their
/// own.
bool is_colored_operation(const ScadModule& module);

/// The dimension, 2 or 3, of the first module that has one; 0 if none has.
int dimension_of(const std::vector<ScadModule>& modules);

}  // namespace graycube
