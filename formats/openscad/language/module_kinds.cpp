#include "formats/openscad/language/module_kinds.hpp"

#include <algorithm>

namespace graycube {
namespace {

bool has_color(const ScadModule& module) {
  return module.name == "color" ||
         std::any_of(module.children.begin(), module.children.end(), has_color);
}

}  // namespace

bool is_gathering(const std::string& name) {
  return name == "group" || name == "union" || name == "render" || name == "multmatrix" ||
         name == "color";
}

bool is_extrusion(const std::string& name) {
  return name == "linear_extrude" || name == "rotate_extrude";
}

bool is_for_program(const std::string& name) {
  return name == "resize" || name == "import" || name == "surface" || name == "roof" ||
         name == "intersection_for";
}

bool is_newer_than_2021(const std::string& name) { return name == "roof"; }

bool is_empty_without_shapes(const std::string& name) {
  return is_gathering(name) || is_for_program(name) || name == "difference" ||
         name == "intersection" || name == "hull" || name == "minkowski" || name == "offset" ||
         name == "fill" || name == "projection";
}

bool is_colored_operation(const ScadModule& module) {
  return (module.name == "difference" || module.name == "intersection") && has_color(module);
}

int dimension_of(const std::vector<ScadModule>& modules) {
  for (const ScadModule& module : modules) {
    if (!module.left_out && module.dimension != 0) return module.dimension;
  }
  return 0;
}

}  // namespace graycube
