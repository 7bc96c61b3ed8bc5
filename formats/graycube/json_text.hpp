// Writes JSON text: numbers to all their digits, members and elements with the commas before them.
#pragma once

#include <charconv>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "geometry/vec.hpp"
#include "scene/scene_fault.hpp"

namespace graycube {

class JsonText {
 public:
  std::string text;

  void number(double v) {
    // An importer's arithmetic can come to this, with numbers near the ends of doubles.
    if (!std::isfinite(v))
      throw UnrenderableScene(
          std::vector<SceneFault>{{"", "the model's numbers leave the range of doubles"}});
    char digits[32];
    const auto end = std::to_chars(digits, digits + sizeof digits, v).ptr;
    text.append(digits, end);
  }

  void string(std::string_view s) {
    constexpr std::string_view kHex = "0123456789abcdef";
    text += '"';
    for (const char c : s) {
      const auto byte = static_cast<unsigned char>(c);
      if (c == '"' || c == '\\') {
        text += '\\';
        text += c;
      } else if (byte < 0x20) {
        text += "\\u00";
        text += kHex[byte >> 4];
        text += kHex[byte & 15];
      } else {
        text += c;
      }
    }
    text += '"';
  }

  void key(std::string_view name) {
    string(name);
    text += ": ";
  }
  /// Writes the key of a member that is not its object's first.
  void next_key(std::string_view name) {
    text += ", ";
    key(name);
  }
  void start_line(std::string_view name) {
    text += ",\n";
    key(name);
  }

  void write(double v) { number(v); }
  void write(std::uint32_t v) { text += std::to_string(v); }
  void write(std::string_view v) { string(v); }
  void write(const Vec3& v) { write_numbers({v.x, v.y, v.z}); }
  void write(const Rgb& c) { write_numbers({c.r, c.g, c.b}); }
  void write_numbers(std::initializer_list<double> numbers) {
    char before = '[';
    for (const double v : numbers) {
      text += before;
      number(v);
      before = ',';
    }
    text += ']';
  }

  template <typename T>
  void member(std::string_view name, const T& value) {
    next_key(name);
    write(value);
  }

  /// Writes a list with one element to a line.
  template <typename T, typename WriteOne>
  void list(char open, char close, const std::vector<T>& elements, const WriteOne& write_one) {
    text += open;
    const char* before = "\n  ";
    for (const T& element : elements) {
      text += before;
      write_one(element);
      before = ",\n  ";
    }
    if (!elements.empty()) text += '\n';
    text += close;
  }
};

}  // namespace graycube
