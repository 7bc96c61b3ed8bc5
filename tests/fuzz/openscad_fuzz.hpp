// Rules that must hold for any text read as OpenSCAD's evaluated tree; the normal suite drives this
// with mutations of small ones.
#pragma once

#include <cstddef>
#include <string_view>

#include "check.hpp"
#include "formats/graycube/read_scene.hpp"
#include "formats/graycube/write_scene.hpp"
#include "formats/openscad/openscad.hpp"
#include "fuzz/compiled.hpp"

namespace graycube::testing {

/// Larger inputs only make the fuzzer slow.
inline constexpr std::size_t kMaxOpenscadFuzzBytes = std::size_t{1} << 14;

/// Answers everything with one of two files, so that reading a program's files is tested.
class CannedOpenscad : public OpenscadProgram {
 public:
  Result evaluate(const std::string& csg, Format format) override {
    if (csg.size() % 5 == 0) return {{}, "no luck"};
    if (csg.size() % 5 == 1) return {};
    if (format == Format::kSvg) return {"<svg><path d=\"M 0,0 L 2,0 L 1,-3 z\"/></svg>", {}};
    return {"OFF 4 4 0\n0 0 0\n2 0 0\n0 2 0\n0 0 2\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n", {}};
  }
};

/// Reads the text and checks these rules; returns whether it was accepted.
inline bool fuzz_openscad(std::string_view text) {
  if (text.size() > kMaxOpenscadFuzzBytes) return false;
  bool accepted = false;
  for (const bool facets : {false, true}) {
    CannedOpenscad program;
    OpenscadOptions options;
    options.facets = facets;
    options.program = &program;
    // Half of the file is also taken for the spelled-out numbers of the whole.
    if (facets) options.spelled_out = text.substr(text.size() / 2);
    const OpenscadResult read = read_openscad_csg(text, options);
    GRAYCUBE_CHECK(read.scene.has_value() == read.errors.empty(), "%zu errors", read.errors.size());
    GRAYCUBE_CHECK(read.errors.size() <= kMaxOpenscadErrors + 1, "%zu errors", read.errors.size());
    GRAYCUBE_CHECK(read.warnings.size() <= kMaxOpenscadWarnings + 1, "%zu warnings",
                   read.warnings.size());
    if (!read.scene) continue;
    accepted = true;
    // A farm must accept the scene's text, and read the same from it.
    const ReadResult again = read_scene_text(write_scene_text(*read.scene));
    GRAYCUBE_CHECK(again.scene.has_value(), "%s: %s", again.errors.front().pointer.c_str(),
                   again.errors.front().message.c_str());
    GRAYCUBE_CHECK(compiled(*again.scene) == compiled(*read.scene), "another model");
  }
  return accepted;
}

}  // namespace graycube::testing
