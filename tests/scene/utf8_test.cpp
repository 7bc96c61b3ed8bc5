#include "utf8.hpp"

#include <string>

#include "catch.hpp"

namespace graycube {
namespace {

/// The character in UTF-8, for U+0080 to U+10FFFF.
std::string encoded(char32_t c) {
  const auto tail = [&](unsigned shift) {
    return static_cast<char>(0x80u | ((static_cast<unsigned>(c) >> shift) & 0x3Fu));
  };
  if (c < 0x800) return {static_cast<char>(0xC0u | (c >> 6)), tail(0)};
  if (c < 0x10000) return {static_cast<char>(0xE0u | (c >> 12)), tail(6), tail(0)};
  return {static_cast<char>(0xF0u | (c >> 18)), tail(12), tail(6), tail(0)};
}

TEST_CASE("every character of Unicode has its bytes, and none has fewer") {
  for (char32_t c = 0x80; c <= 0x110000; c += c < 0xF000 ? 1 : 61) {
    const std::string text = encoded(c);
    const bool is_character = c < 0xD800 || (c > 0xDFFF && c <= 0x10FFFF);
    INFO("U+" << static_cast<unsigned>(c));
    REQUIRE(utf8_bytes(text + "a") == (is_character ? text.size() : 0));
    REQUIRE(utf8_bytes(text.substr(0, text.size() - 1)) == 0);
  }
  CHECK(utf8_bytes("a\x80") == 1);
}

TEST_CASE("bytes that begin no character, and forms that are too long, are none") {
  for (const char* text : {"\x80", "\xBF", "\xC0\x80", "\xC1\xBF", "\xE0\x9F\xBF",
                           "\xF0\x8F\xBF\xBF", "\xF4\x90\x80\x80", "\xF5\x80\x80\x80", "\xFF"}) {
    CHECK(utf8_bytes(text) == 0);
  }
}

}  // namespace
}  // namespace graycube
