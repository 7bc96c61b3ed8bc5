#include "one_line.hpp"

#include <array>
#include <cstdint>
#include <cstdio>

#include "utf8.hpp"

namespace graycube {
namespace {

constexpr std::string_view kCut = "…";

std::uint32_t code_point(std::string_view character) {
  const auto byte = [&](std::size_t i) { return static_cast<std::uint8_t>(character[i]); };
  if (character.size() == 1) return byte(0);
  // The first byte has as many bits fewer as the character has bytes more.
  std::uint32_t code = byte(0) & (0x7Fu >> character.size());
  for (std::size_t i = 1; i < character.size(); ++i) code = code << 6 | (byte(i) & 0x3Fu);
  return code;
}

/// Unicode's control characters (C0, DEL, C1), its separators of lines and paragraphs, and what
/// sets the direction of writing (bidirectional formatting characters, UAX #9).
bool is_unfit(std::uint32_t code) {
  return code < 0x20 || (code >= 0x7F && code < 0xA0) || code == 0x2028 || code == 0x2029 ||
         code == 0x200E || code == 0x200F || code == 0x061C || (code >= 0x202A && code <= 0x202E) ||
         (code >= 0x2066 && code <= 0x2069);
}

std::string escape_of(std::uint32_t code) {
  if (code == '\n') return "\\n";
  if (code == '\t') return "\\t";
  if (code == '\r') return "\\r";
  std::array<char, 16> text{};
  std::snprintf(text.data(), text.size(), code < 0x100 ? "\\x%02x" : "\\u%04x", code);
  return text.data();
}

}  // namespace

std::string one_line(std::string_view text, std::size_t longest) {
  std::string line;
  // Where the line can be cut so that the mark of the cut has room.
  std::size_t cut = 0;
  while (!text.empty()) {
    const std::size_t bytes = utf8_bytes(text);
    const std::string_view character = text.substr(0, bytes == 0 ? 1 : bytes);
    const std::uint32_t code =
        bytes == 0 ? static_cast<std::uint8_t>(text.front()) : code_point(character);
    if (bytes == 0 || is_unfit(code)) {
      line += escape_of(code);
    } else if (code == '\\') {
      line += "\\\\";
    } else {
      line += character;
    }
    if (line.size() > longest) {
      line.resize(cut);
      return longest < kCut.size() ? line : line.append(kCut);
    }
    if (line.size() + kCut.size() <= longest) cut = line.size();
    text.remove_prefix(character.size());
  }
  return line;
}

}  // namespace graycube
