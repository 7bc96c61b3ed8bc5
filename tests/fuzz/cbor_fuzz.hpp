// Rules that must hold for any bytes read as CBOR: they are refused, or mean a tree that can be
// written and read again.
#pragma once

#include <bit>
#include <cstdint>
#include <string>
#include <string_view>

#include "check.hpp"
#include "formats/graycube/read_scene.hpp"
#include "formats/json/cbor_writer.hpp"
#include "formats/json/tree.hpp"

namespace graycube {

inline void check_same_meaning(const JsonTree& a, const JsonTree& b) {
  GRAYCUBE_CHECK(a.value_count() == b.value_count(), "%zu values, not %zu", a.value_count(),
                 b.value_count());
  for (JsonIndex i = 0; i < a.value_count(); ++i) {
    const JsonKind kind = a.kind(i);
    GRAYCUBE_CHECK(b.kind(i) == kind && b.next(i) == a.next(i) && b.key(i) == a.key(i),
                   "value %u differs", i);
    if (kind == JsonKind::kNumber) {
      GRAYCUBE_CHECK(
          std::bit_cast<std::uint64_t>(a.number(i)) == std::bit_cast<std::uint64_t>(b.number(i)),
          "value %u: %a, not %a", i, b.number(i), a.number(i));
    }
    if (kind == JsonKind::kString)
      GRAYCUBE_CHECK(a.string(i) == b.string(i), "value %u: another string", i);
  }
}

/// Checks that a root without a length, which isn't read in pieces, gives the same scene. `cbor`
/// must have no syntax errors.
inline void check_whole_is_same(const std::string& cbor, const ReadResult& read) {
  const auto root = static_cast<unsigned char>(cbor[kCborMagic.size()]);
  constexpr unsigned kEmptyMap = 0xA0, kFullMap = 0xB7;
  if (root < kEmptyMap || root > kFullMap) return;
  std::string whole = cbor + '\xFF';
  whole[kCborMagic.size()] = '\xBF';
  const ReadResult again = read_scene_text(whole);
  GRAYCUBE_CHECK(!again.was_read_in_pieces, "read in pieces");
  GRAYCUBE_CHECK(again.scene == read.scene && again.errors.size() == read.errors.size(),
                 "%zu errors, not %zu", again.errors.size(), read.errors.size());
  for (std::size_t i = 0; i < read.errors.size(); ++i) {
    GRAYCUBE_CHECK(again.errors[i].pointer == read.errors[i].pointer &&
                       again.errors[i].message == read.errors[i].message,
                   "%s, not %s", again.errors[i].message.c_str(), read.errors[i].message.c_str());
  }
}

/// Reads the bytes with the magic before them; returns whether they were accepted as CBOR.
inline bool fuzz_cbor(std::string_view bytes) {
  const std::string text = std::string(kCborMagic) + std::string(bytes);
  const JsonTree tree(text);
  GRAYCUBE_CHECK(tree.is_cbor(), "not taken for CBOR");
  const ReadResult read = read_scene_text(text);
  GRAYCUBE_CHECK(read.scene.has_value() == read.errors.empty(), "%zu errors", read.errors.size());
  if (tree.syntax_error()) return false;
  check_whole_is_same(text, read);
  const std::string written = cbor_of(tree);
  // Half-precision numbers, of three bytes, are written as singles, of five.
  GRAYCUBE_CHECK(written.size() <= text.size() + 2 * tree.value_count(), "%zu bytes of %zu",
                 written.size(), text.size());
  const JsonTree again(written);
  GRAYCUBE_CHECK(!again.syntax_error(), "%s", again.syntax_error()->message.c_str());
  check_same_meaning(tree, again);
  return true;
}

}  // namespace graycube
