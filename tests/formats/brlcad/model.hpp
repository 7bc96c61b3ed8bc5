// Small BRL-CAD databases for tests, in each format.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <string>
#include <vector>

namespace graycube::testing {

/// A version 4 record of 24 numbers, the rest zero.
inline std::string v4_solid(int type, const std::string& name, std::vector<double> numbers) {
  numbers.resize(24);
  std::string line = "S " + std::to_string(type) + " " + name + " 0";
  for (const double v : numbers) line += " " + std::to_string(v);
  return line + "\n";
}
inline std::string v4_sphere(const std::string& name, double x, double y, double z, double r) {
  return v4_solid(19, name, {x, y, z, r, 0, 0, 0, r, 0, 0, 0, r});
}
/// A box, by its first corner and the other corners relative to it.
inline std::string v4_box(const std::string& name, double x, double y, double z, double a, double b,
                          double c) {
  return v4_solid(20, name,
                  {x, y, z, a, 0, 0, a, b, 0, 0, b, 0, 0, 0, c, a, 0, c, a, b, c, 0, b, c});
}
inline std::string v4_member(char relation, const std::string& name,
                             const std::array<double, 16>& m = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0,
                                                                0, 0, 0, 1}) {
  std::string line = std::string("M ") + relation + " " + name;
  for (const double v : m) line += " " + std::to_string(v);
  return line + " 0\n";
}
inline std::string v4_region(const std::string& name, int air = 0) {
  return "C Y " + name + " 1000 " + std::to_string(air) + " 1 0 1 100 0 0 0 0 0 0 0\n";
}
inline std::string v4_group(const std::string& name) {
  return "C N " + name + " 0 0 1 0 0 0 0 0 0 0 0 0 0\n";
}
inline const std::string kV4Head = "I 0 v4\nA model\n";

/// Builds a binary database of version 5.
class V5Binary {
 public:
  V5Binary() : bytes_(std::string("v\x01\0\0\0\0\x01\x35", 8)) {}

  void solid(const std::string& name, int minor, const std::vector<double>& numbers) {
    object(name, minor, doubles(numbers), {});
  }
  /// Writes a combination. Operations are in postfix order: 1 a leaf, 2 union, 3 intersection, 4
  /// difference; if there are none, all members are united.
  void comb(const std::string& name, const std::vector<std::string>& members,
            const std::string& postfix, const std::vector<std::array<double, 16>>& matrices = {},
            const std::vector<int>& matrix_of = {}, const std::string& attributes = {}) {
    std::string body(1, '\0');
    std::string leaves;
    for (std::size_t i = 0; i < members.size(); ++i) {
      leaves += members[i] + '\0';
      leaves += static_cast<char>(i < matrix_of.size() ? matrix_of[i] : -1);
    }
    for (const std::size_t n :
         {matrices.size(), members.size(), leaves.size(), postfix.size(), members.size()}) {
      body += static_cast<char>(n);
    }
    for (const auto& m : matrices) body += doubles({m.begin(), m.end()});
    object(name, 31, body + leaves + postfix, attributes);
  }
  /// The code 0 … 3 of the width of all lengths of objects, names and bodies: 1, 2, 4 or 8 bytes.
  unsigned width_code = 0;
  const std::string& bytes() const { return bytes_; }

  static std::string big(std::uint64_t v, unsigned width) {
    std::string text;
    for (unsigned i = width; i-- > 0;) text += static_cast<char>(v >> (8 * i) & 0xFF);
    return text;
  }
  static std::string doubles(const std::vector<double>& numbers) {
    std::string text;
    for (const double v : numbers) text += big(std::bit_cast<std::uint64_t>(v), 8);
    return text;
  }
  void object(const std::string& name, int minor, const std::string& body,
              const std::string& attributes, unsigned compression = 0) {
    object(1, name, minor, body, attributes, compression);
  }
  void attributes_only(const std::string& name, const std::string& attributes) {
    object(2, name, 0, {}, attributes, 0);
  }

 private:
  void object(int major, const std::string& name, int minor, const std::string& body,
              const std::string& attributes, unsigned compression) {
    unsigned width = 1u << width_code;
    unsigned code = width_code;
    if (width == 1 && body.size() + attributes.size() > 200) width = 2, code = 1;
    std::string rest = big(name.size() + 1, width) + name + '\0';
    if (!attributes.empty()) rest += big(attributes.size(), width) + attributes;
    rest += big(body.size(), width) + body;
    std::size_t length = 6 + width + rest.size() + 1;
    rest.append((8 - length % 8) % 8, '\0');
    length = (length + 7) / 8;
    std::string head = "v";
    head += static_cast<char>(0x20 | code << 6 | code << 3);
    head += static_cast<char>(attributes.empty() ? 0 : 0x20 | code << 6);
    head += static_cast<char>(0x20 | code << 6 | compression);
    head += static_cast<char>(major);
    head += static_cast<char>(minor);
    bytes_ += head + big(length, width) + rest + '\x35';
  }

  std::string bytes_;
};

}  // namespace graycube::testing
