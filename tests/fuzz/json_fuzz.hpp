// Rules that must hold for any text: read fast or carefully, it gives the same tree or the same
// error. Driven by libFuzzer (scene_json_fuzz.cpp) and by seeded texts in the normal suite.
#pragma once

#include <bit>
#include <cstdint>
#include <string_view>

#include "check.hpp"
#include "formats/json/padded_text.hpp"
#include "formats/json/tree.hpp"

namespace graycube {

inline void check_same_value(const JsonTree& fast, const JsonTree& careful, JsonIndex i) {
  const JsonKind kind = careful.kind(i);
  GRAYCUBE_CHECK(fast.kind(i) == kind, "value %u: kind %d, not %d", i,
                 static_cast<int>(fast.kind(i)), static_cast<int>(kind));
  GRAYCUBE_CHECK(fast.offset(i) == careful.offset(i), "value %u: another offset", i);
  GRAYCUBE_CHECK(fast.next(i) == careful.next(i), "value %u: another next one", i);
  GRAYCUBE_CHECK(fast.key(i) == careful.key(i), "value %u: another key", i);
  if (kind == JsonKind::kNumber)
    GRAYCUBE_CHECK(std::bit_cast<std::uint64_t>(fast.number(i)) ==
                       std::bit_cast<std::uint64_t>(careful.number(i)),
                   "value %u: %a, not %a", i, fast.number(i), careful.number(i));
  if (kind == JsonKind::kString)
    GRAYCUBE_CHECK(fast.string(i) == careful.string(i), "value %u: another string", i);
  if (kind == JsonKind::kArray || kind == JsonKind::kObject)
    GRAYCUBE_CHECK(fast.size(i) == careful.size(i), "value %u: another size", i);
}

/// Reads the text both ways; returns whether the fast parser read it.
inline bool fuzz_json(std::string_view text) {
  const PaddedText padded(text);
  const JsonTree fast(padded), careful(text);
  const auto &error = careful.syntax_error(), &same = fast.syntax_error();
  GRAYCUBE_CHECK(error.has_value() == same.has_value(), "only one way refuses the text");
  if (error)
    GRAYCUBE_CHECK(error->offset == same->offset && error->value == same->value &&
                       error->message == same->message,
                   "\"%s\" and \"%s\"", same->message.c_str(), error->message.c_str());
  GRAYCUBE_CHECK(fast.value_count() == careful.value_count(), "%zu values, not %zu",
                 fast.value_count(), careful.value_count());
  for (std::size_t i = 0; i < careful.value_count(); ++i)
    check_same_value(fast, careful, static_cast<JsonIndex>(i));
  return fast.was_read_fast();
}

}  // namespace graycube
