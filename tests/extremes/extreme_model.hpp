// Models in the formats of other programs whose numbers are extreme, from a seed.
#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <string>

#include "extremes/extreme_numbers.hpp"

namespace graycube::testing {

/// Writes small models as texts of .csg, .asc, .stl and .off files; some of their numbers are
/// extreme, or all of them are scaled.
class ExtremeModel {
 public:
  explicit ExtremeModel(std::uint64_t seed) : dice_(seed ^ 0x1337C0DEull) {
    constexpr std::array kShares{0.0, 0.01, 0.05, 0.2};
    share_ = kShares[dice_.below(kShares.size())];
    factor_ = dice_.one_in(3) ? extreme_power(dice_) : 1;
  }

  std::string csg() {
    std::string text;
    for (std::size_t i = 0; i <= dice_.below(3); ++i) text += csg_node(3);
    return text;
  }

  std::string asc() {
    std::string text = "title {extremes}\n", tree = "{l s0}";
    const std::size_t count = 1 + dice_.below(4);
    for (std::size_t i = 0; i < count; ++i) {
      const std::string name = "s" + std::to_string(i);
      text += "put " + name + " " + asc_solid() + "\n";
      const std::string leaf =
          "{l " + name + (dice_.one_in(2) ? " {" + asc_matrix() + "}" : "") + "}";
      constexpr std::array kOperations{"u", "u", "-", "n"};
      if (i > 0)
        tree = std::string("{") + kOperations[dice_.below(4)] + " " + tree + " " + leaf + "}";
    }
    return text + "put r comb region yes rgb {255 0 0} tree " + tree + "\n";
  }

  std::string ascii_stl() {
    std::string text = "solid extreme\n";
    for_each_triangle([&](const std::array<Vec3, 3>& corners) {
      text += "facet normal 0 0 0\nouter loop\n";
      for (const Vec3& p : corners) text += "vertex " + spaced(p) + "\n";
      text += "endloop\nendfacet\n";
    });
    return text + "endsolid extreme\n";
  }

  std::string binary_stl() {
    std::string facets;
    std::uint32_t count = 0;
    for_each_triangle([&](const std::array<Vec3, 3>& corners) {
      facets.append(12, '\0');
      for (const Vec3& p : corners) {
        for (int a = 0; a < 3; ++a) append(facets, static_cast<float>(p[a]));
      }
      facets.append(2, '\0');
      ++count;
    });
    std::string text(80, ' ');
    append(text, count);
    return text + facets;
  }

  std::string off() {
    std::string text = "OFF\n8 6 0\n";
    for (const Vec3& p : box()) text += spaced(p) + "\n";
    for (const auto& [a, b, c, d] : kFaces)
      text += "4 " + std::to_string(a) + " " + std::to_string(b) + " " + std::to_string(c) + " " +
              std::to_string(d) + "\n";
    return text;
  }

 private:
  static constexpr std::array<std::array<std::size_t, 4>, 6> kFaces{
      {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}};

  double changed(double v) { return dice_.unit() < share_ ? extreme_number(dice_, v) : v; }
  /// A length, which counts with the scale of the whole, or any other number.
  double length(double v) { return changed(v * factor_); }
  std::string n(double v) { return written(length(v)); }
  std::string plain(double v) { return written(changed(v)); }
  std::string some() { return n(dice_.between(0.5, 3)); }
  /// Text of a point; brackets, or what the format has instead, are put around it.
  std::string comma(const Vec3& p) { return n(p.x) + ", " + n(p.y) + ", " + n(p.z); }
  std::string spaced(const Vec3& p) {
    return written(p.x) + " " + written(p.y) + " " + written(p.z);
  }
  std::string braced(const Vec3& p) { return "{" + n(p.x) + " " + n(p.y) + " " + n(p.z) + "}"; }

  template <typename Value>
  static void append(std::string& bytes, Value value) {
    char raw[sizeof value];
    std::memcpy(raw, &value, sizeof value);
    bytes.append(raw, sizeof value);
  }

  /// The corners of a box, numbered in binary, after their change.
  std::array<Vec3, 8> box() {
    const Vec3 at = dice_.point(2), size{dice_.between(0.1, 3), dice_.between(0.1, 3), 1};
    std::array<Vec3, 8> corners;
    for (std::size_t i = 0; i < 8; ++i) {
      const Vec3 p{at.x + (i & 1 ? size.x : 0), at.y + (i & 2 ? size.y : 0),
                   at.z + (i & 4 ? size.z : 0)};
      corners[i] = {length(p.x), length(p.y), length(p.z)};
    }
    return corners;
  }
  template <typename Use>
  void for_each_triangle(const Use& use) {
    const std::array<Vec3, 8> p = box();
    for (const auto& [a, b, c, d] : kFaces) {
      use({p[a], p[b], p[c]});
      use({p[a], p[c], p[d]});
    }
  }

  std::string csg_matrix() {
    std::string rows;
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j)
        rows += (j == 0 ? "[" : ", ") + plain(i == j ? 1 : dice_.one_in(3) ? dice_.unit() : 0);
      rows += ", " + some() + "], ";
    }
    return "[" + rows + "[0, 0, 0, 1]]";
  }
  std::string csg_fineness() {
    return dice_.one_in(2) ? ", $fn = " + plain(static_cast<double>(3 + dice_.below(5))) : "";
  }
  std::string csg_polyhedron() {
    std::string points, faces;
    for (const Vec3& p : box())
      points += "[" + written(p.x) + ", " + written(p.y) + ", " + written(p.z) + "], ";
    for (const auto& [a, b, c, d] : kFaces)
      faces += "[" + std::to_string(d) + ", " + std::to_string(c) + ", " + std::to_string(b) +
               ", " + std::to_string(a) + "], ";
    return "polyhedron(points = [" + points.substr(0, points.size() - 2) + "], faces = [" +
           faces.substr(0, faces.size() - 2) + "]);";
  }
  std::string csg_flat(int depth) {
    switch (dice_.below(depth > 0 ? 7 : 3)) {
      case 0: return "square(size = [" + some() + ", " + some() + "]);";
      case 1: return "circle(r = " + some() + csg_fineness() + ");";
      case 2:
        return "polygon(points = [[0, 0], [" + some() + ", 0], [" + some() + ", " + some() +
               "], [0, " + some() + "]]);";
      case 3: return "offset(r = " + some() + csg_fineness() + ") " + csg_flat(depth - 1);
      case 4: return "offset(delta = " + some() + ") " + csg_flat(depth - 1);
      case 5: return "hull() {" + csg_flat(depth - 1) + csg_flat(depth - 1) + "}";
      default: return "difference() {" + csg_flat(depth - 1) + csg_flat(depth - 1) + "}";
    }
  }
  std::string csg_leaf() {
    switch (dice_.below(7)) {
      case 0: return "cube(size = [" + comma({1, 2, 1}) + "], center = true);";
      case 1: return "sphere(r = " + some() + csg_fineness() + ");";
      case 2:
        return "cylinder(h = " + some() + ", r1 = " + some() + ", r2 = " + some() + csg_fineness() +
               ");";
      case 3: return csg_polyhedron();
      case 4: return "linear_extrude(height = " + some() + ") " + csg_flat(2);
      case 5:
        return "linear_extrude(height = " + some() + ", twist = " + plain(90) + ", scale = [" +
               plain(2) + ", " + plain(1) + "], slices = " + plain(3) + ") " + csg_flat(1);
      default:
        return "rotate_extrude(angle = " + plain(dice_.one_in(2) ? 360 : 90) + ", $fn = 7) " +
               "multmatrix([[1, 0, 0, " + n(5) + "], [0, 1, 0, 0], [0, 0, 1, 0]]) " + csg_flat(1);
    }
  }
  std::string csg_node(int depth) {
    if (depth == 0) return csg_leaf();
    const auto both = [&] { return "{" + csg_node(depth - 1) + csg_node(depth - 1) + "}"; };
    switch (dice_.below(8)) {
      case 0: return "union() " + both();
      case 1: return "difference() " + both();
      case 2: return "intersection() " + both();
      case 3: return "hull() {" + csg_leaf() + csg_leaf() + "}";
      case 4:
        return "minkowski() {cube(size = [" + comma({1, 2, 1}) + "]); sphere(r = " + some() + ");}";
      case 5:
      case 6: return "multmatrix(" + csg_matrix() + ") " + csg_node(depth - 1);
      default: return csg_leaf();
    }
  }

  std::string asc_matrix() {
    std::string numbers;
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j)
        numbers += plain(i == j ? 1 : dice_.one_in(3) ? dice_.unit() : 0) + " ";
      numbers += some() + "  ";
    }
    return numbers + "0 0 0 " + plain(1);
  }
  std::string asc_solid() {
    switch (dice_.below(6)) {
      case 0:
        return "ell V " + braced(dice_.point(1)) + " A " + braced({1, 0, 0}) + " B " +
               braced({0, 2, 0}) + " C " + braced({0, 0, 1});
      case 1:
        return "tor V " + braced(dice_.point(1)) + " H " + braced({0, 0, 1}) + " r_a " + n(3) +
               " r_h " + n(1);
      case 2:
        return "tgc V " + braced(dice_.point(1)) + " H " + braced({0, 0, 3}) + " A " +
               braced({1, 0, 0}) + " B " + braced({0, 1, 0}) + " C " + braced({0.5, 0, 0}) + " D " +
               braced({0, 0.5, 0});
      case 3: {
        const std::array<Vec3, 8> p = box();
        std::string text = "arb8";
        constexpr std::array<std::size_t, 8> kOrder{0, 1, 3, 2, 4, 5, 7, 6};
        for (std::size_t i = 0; i < 8; ++i)
          text += " V" + std::to_string(i + 1) + " {" + spaced(p[kOrder[i]]) + "}";
        return text;
      }
      case 4:
        return "ehy V " + braced({0, 0, 0}) + " H " + braced({0, 0, 2}) + " A " +
               braced({1, 0, 0}) + " r_1 " + n(1) + " r_2 " + n(2) + " c " + n(1);
      default:
        return "pipe V0 {0 0 0} O0 " + n(2) + " I0 " + n(1) + " R0 " + n(3) + " V1 " +
               braced({10, 0, 0}) + " O1 " + n(2) + " I1 " + n(1) + " R1 " + n(3) + " V2 " +
               braced({10, 10, 0}) + " O2 " + n(2) + " I2 " + n(1) + " R2 " + n(3);
    }
  }

  Dice dice_;
  double share_ = 0, factor_ = 1;
};

}  // namespace graycube::testing
