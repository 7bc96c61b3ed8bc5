#include "formats/openscad/hull.hpp"

#include "formats/openscad/language/matrix.hpp"
#include "formats/openscad/primitives.hpp"
#include "formats/openscad/sweep.hpp"

namespace graycube {
namespace {

bool is_container(const std::string& name) {
  return name == "group" || name == "union" || name == "color" || name == "render" ||
         name == "hull";
}

bool corners_of_all(const std::vector<ScadModule>& modules, const Affine& map, ScadImport& import,
                    std::vector<Vec3>& corners) {
  for (const ScadModule& module : modules) {
    if (module.left_out || module.dimension == 2) continue;
    if (!corners_of(module, map, import, corners)) return false;
  }
  return true;
}

}  // namespace

bool corners_of(const ScadModule& module, const Affine& map, ScadImport& import,
                std::vector<Vec3>& corners) {
  if (is_container(module.name)) return corners_of_all(module.children, map, import, corners);
  if (module.name == "multmatrix") {
    const auto inner = openscad_matrix_of_corners(module, import.digits, import.report);
    return !inner || corners_of_all(module.children, compose(map, *inner), import, corners);
  }
  if (module.name == "linear_extrude" || module.name == "rotate_extrude") {
    std::vector<Vec3> own;
    sweep_corners(module, import, own);
    for (const Vec3& p : own) corners.push_back(map.point(p));
    return true;
  }
  if (!is_openscad_primitive(module)) return false;
  if (module.name == "polyhedron") {
    for (const Vec3& p : polyhedron_corners(module, import.report)) corners.push_back(map.point(p));
    return true;
  }
  if (module.name == "sphere" || module.name == "cylinder") {
    import.warn_of_sides("hull", module.line);
  }
  if (const auto solid = openscad_primitive(module, import.report, true)) {
    for (const Vec3& p : solid->corners) corners.push_back(map.point(p));
  }
  return true;
}

}  // namespace graycube
