// Text in UTF-8, character by character.
#pragma once

#include <cstddef>
#include <string_view>

namespace graycube {

/// The bytes of the character that begins a text that isn't empty, 1 to 4; 0 if it begins with none
/// (RFC 3629, section 4: longer forms than needed, surrogates and what lies beyond U+10FFFF are
/// none).
std::size_t utf8_bytes(std::string_view text);

}  // namespace graycube
