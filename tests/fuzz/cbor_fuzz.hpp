// What must hold for any bytes read as CBOR: they are refused, or mean a tree that can be written and read again.
#pragma once

#include <bit>
#include <cstdint>
#include <string>
#include <string_view>

#include "geometry/check.hpp"
#include "scene/cbor_writer.hpp"
#include "scene/json_tree.hpp"
#include "scene/read_scene.hpp"

namespace graycube {

inline void check_same_meaning(const JsonTree& a, const JsonTree& b) {
  GRAYCUBE_CHECK(a.value_count() == b.value_count(), "%zu values, not %zu", a.value_count(), b.value_count());
  for (JsonIndex i = 0; i < a.value_count(); ++i) {
    const JsonKind kind = a.kind(i);
    GRAYCUBE_CHECK(b.kind(i) == kind && b.next(i) == a.next(i) && b.key(i) == a.key(i), "value %u differs", i);
    if (kind == JsonKind::kNumber) {
      GRAYCUBE_CHECK(std::bit_cast<std::uint64_t>(a.number(i)) == std::bit_cast<std::uint64_t>(b.number(i)),
                     "value %u: %a, not %a", i, b.number(i), a.number(i));
    }
    if (kind == JsonKind::kString) GRAYCUBE_CHECK(a.string(i) == b.string(i), "value %u: another string", i);
  }
}

/// Whether the bytes, which the magic is put before, were accepted as CBOR.
inline bool fuzz_cbor(std::string_view bytes) {
  const std::string text = std::string(kCborMagic) + std::string(bytes);
  const JsonTree tree(text);
  GRAYCUBE_CHECK(tree.is_cbor(), "not taken for CBOR");
  const ReadResult read = read_scene_text(text);
  GRAYCUBE_CHECK(read.scene.has_value() == read.errors.empty(), "%zu errors", read.errors.size());
  if (tree.syntax_error()) return false;
  const std::string written = cbor_of(tree);
  GRAYCUBE_CHECK(written.size() <= text.size(), "%zu bytes of %zu", written.size(), text.size());
  const JsonTree again(written);
  GRAYCUBE_CHECK(!again.syntax_error(), "%s", again.syntax_error()->message.c_str());
  check_same_meaning(tree, again);
  return true;
}

}  // namespace graycube
