// The words of a BRL-CAD shader: its name, and its parameters and their values in turn.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "geometry/vec.hpp"

namespace graycube::brlcad {

using ShaderWords = std::vector<std::string>;

/// The shaders of a text, `plastic a=1 b=2` or `plastic {a 1 b 2}`: one, or the members of a stack,
/// `stack {plastic {…}} {bump {…}}`, `stack plastic …; bump …` or, in version 4, that without
/// `stack`; without those that have no words.
std::vector<ShaderWords> shaders_of(const std::string& text);

/// The number behind word i, if one is there.
std::optional<double> number_behind(const ShaderWords& words, std::size_t i);
/// The three numbers behind word i, in words of their own or as 1/2/3.
std::optional<Vec3> vector_behind(const ShaderWords& words, std::size_t i);

/// A colour that is written 0 … 1, or 0 … 255 if one of its numbers is above 1.
Rgb unit_color(const Vec3& written);

}  // namespace graycube::brlcad
