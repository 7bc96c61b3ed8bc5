// Rules that must hold for any bytes read as a BRL-CAD database; the normal suite drives this with
// mutations of small ones.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "check.hpp"
#include "formats/brlcad/brlcad.hpp"
#include "formats/graycube/read_scene.hpp"
#include "formats/graycube/write_scene.hpp"
#include "fuzz/compiled.hpp"

namespace graycube::testing {

/// Larger inputs only make the fuzzer slow.
inline constexpr std::size_t kMaxFuzzBytes = std::size_t{1} << 16;

inline void fuzz_brlcad(std::string_view bytes) {
  if (bytes.size() > kMaxFuzzBytes) return;
  const BrlcadTops tops = list_brlcad_tops(bytes);
  BrlcadResult read = read_brlcad(bytes);
  GRAYCUBE_CHECK(read.scene.has_value() == read.errors.empty(), "%zu errors", read.errors.size());
  GRAYCUBE_CHECK(tops.errors.empty() || !read.scene, "errors in the list only");
  if (read.scene) {
    // A farm must accept the scene's text, and read the same from it.
    const ReadResult again = read_scene_text(write_scene_text(*read.scene));
    GRAYCUBE_CHECK(again.scene.has_value(), "%s: %s", again.errors.front().pointer.c_str(),
                   again.errors.front().message.c_str());
    GRAYCUBE_CHECK(compiled(*again.scene) == compiled(*read.scene), "another model");
  }
  BrlcadOptions options;
  options.view = std::string(bytes);
  const BrlcadResult seen =
      read_brlcad("title t\nput s ell V {0 0 0} A {1 0 0} B {0 1 0} C {0 0 1}\n", options);
  GRAYCUBE_CHECK(seen.scene.has_value() == seen.errors.empty(), "%zu errors", seen.errors.size());
  if (seen.scene) {
    GRAYCUBE_CHECK(read_scene_text(write_scene_text(*seen.scene)).scene.has_value(),
                   "a view no scene may have");
  }
}

}  // namespace graycube::testing
