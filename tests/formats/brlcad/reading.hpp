// Short names for what tests ask of a BRL-CAD database.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "catch.hpp"
#include "formats/brlcad/brlcad.hpp"
#include "formats/graycube/read_scene.hpp"
#include "formats/graycube/write_scene.hpp"
#include "formats/pov/scene_membership.hpp"

namespace graycube::testing {

/// The scene of a database in any format.
inline Scene scene_of(const std::string& bytes, std::vector<std::string> objects = {}) {
  BrlcadOptions options;
  options.objects = std::move(objects);
  BrlcadResult result = read_brlcad(bytes, options);
  for (const auto& e : result.errors) UNSCOPED_INFO(e.where << ": " << e.text);
  REQUIRE(result.scene);
  // A farm gets the scene as text.
  const ReadResult again = read_scene_text(write_scene_text(*result.scene));
  for (const auto& e : again.errors) UNSCOPED_INFO(e.pointer << ": " << e.message);
  REQUIRE(again.scene);
  CHECK(*again.scene == *result.scene);
  return std::move(*result.scene);
}

/// The first error as "WHERE: WHAT".
inline std::string error_of(const std::string& bytes, std::vector<std::string> objects = {}) {
  BrlcadOptions options;
  options.objects = std::move(objects);
  const BrlcadResult result = read_brlcad(bytes, options);
  REQUIRE_FALSE(result.scene);
  REQUIRE_FALSE(result.errors.empty());
  return result.errors.front().where + ": " + result.errors.front().text;
}

inline bool holds(const Scene& scene, double x, double y, double z) {
  return any_object_holds(scene, {x, y, z});
}

}  // namespace graycube::testing
