// Rules that must hold for any bytes taken for meshes on their way between programs.
#pragma once

#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "check.hpp"
#include "formats/mesh/part_stream.hpp"
#include "fuzz/mesh_fuzz.hpp"

namespace graycube::testing {

inline void fuzz_part_stream(std::string_view bytes) {
  if (bytes.size() > kMaxMeshFuzzBytes) return;
  auto read = decode_parts(bytes);
  if (const auto* parts = std::get_if<std::vector<MeshPart>>(&read)) {
    GRAYCUBE_CHECK(encode_parts(*parts) == bytes, "other bytes");
  }
  fuzz_parts(read);
}

}  // namespace graycube::testing
