// Rules that must hold for any text read as a scene: it is refused with reasons, or means a model
// that survives being written for a farm.
#pragma once

#include <string_view>

#include "check.hpp"
#include "formats/graycube/read_scene.hpp"
#include "formats/graycube/write_scene.hpp"
#include "fuzz/compiled.hpp"

namespace graycube {

/// Reads the text and checks these rules; returns whether it was accepted.
inline bool fuzz_scene(std::string_view text) {
  const ReadResult read = read_scene_text(text);
  GRAYCUBE_CHECK(read.scene.has_value() == read.errors.empty(), "%zu errors", read.errors.size());
  if (!read.scene) return false;
  const ReadResult again = read_scene_text(write_scene_text(*read.scene));
  GRAYCUBE_CHECK(again.scene.has_value(), "%s: %s", again.errors.front().pointer.c_str(),
                 again.errors.front().message.c_str());
  GRAYCUBE_CHECK(*again.scene == *read.scene, "another scene");
  GRAYCUBE_CHECK(compiled(*again.scene) == compiled(*read.scene), "another model");
  return true;
}

}  // namespace graycube
