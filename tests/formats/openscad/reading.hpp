// Small vocabulary of the tests of the OpenSCAD reader.
#pragma once

#include <string>
#include <vector>

#include "catch.hpp"
#include "formats/openscad/membership.hpp"
#include "formats/openscad/openscad.hpp"

namespace graycube::testing {

inline std::vector<std::string> errors_of(const std::string& text) {
  std::vector<std::string> lines;
  for (const OpenscadError& error : read_openscad_csg(text).errors) {
    lines.push_back(std::to_string(error.line) + ": " + error.message);
  }
  return lines;
}

inline std::vector<std::string> warnings_of(const std::string& text) {
  std::vector<std::string> lines;
  for (const ImportWarning& warning : read_openscad_csg(text).warnings) {
    lines.push_back((warning.where.empty() ? "" : warning.where + ": ") + warning.text);
  }
  return lines;
}

inline Scene scene_of(const std::string& text, const OpenscadOptions& options = {}) {
  OpenscadResult result = read_openscad_csg(text, options);
  INFO(text.substr(0, 2000));
  for (const OpenscadError& error : result.errors)
    UNSCOPED_INFO(error.line << ": " << error.message);
  REQUIRE(result.errors.empty());
  REQUIRE(result.scene);
  return *std::move(result.scene);
}

/// Volume inside [lo, hi], from the centres of a grid of n³ cells.
inline double volume(const Scene& scene, const Vec3& lo, const Vec3& hi, int n = 48) {
  const Vec3 cell = (1.0 / n) * (hi - lo);
  int inside = 0;
  for (int i = 0; i < n * n * n; ++i) {
    const Vec3 step{i % n + 0.5, i / n % n + 0.5, i / (n * n) + 0.5};
    inside += holds(scene, lo + Vec3{step.x * cell.x, step.y * cell.y, step.z * cell.z}) ? 1 : 0;
  }
  return inside * cell.x * cell.y * cell.z;
}

inline const Material& material_of(const Scene& scene, std::size_t object) {
  return scene.materials.at(scene.objects.at(object).material).material;
}

}  // namespace graycube::testing
