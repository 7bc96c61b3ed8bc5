// All digits of the numbers of an OpenSCAD model, of which .csg files have six. OpenSCAD evaluates
// the model a second time with modules of ours in place of its own (`openscad -D`, which reaches
// used files, too). Each leaves a text() behind that spells the numbers out in whole numbers; these
// are then matched with the numbers of the plain .csg file.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "formats/openscad/language/parser.hpp"

namespace graycube {

/// Larger trees keep their six digits: OpenSCAD needs 0.1 ms more for every module (100 bytes).
inline constexpr std::size_t kMaxSpelledOutBytes = std::size_t{4} << 20;
/// Significant digits of numbers that are spelled out: sines and cosines are right to so many.
inline constexpr std::uint32_t kSpelledOutDigits = 15;

/// Definitions to evaluate a model with: `openscad -D DEFINITIONS -o MARKED.csg MODEL.scad`.
std::string_view openscad_exact_definitions();

/// Puts the numbers that `marked` spells out into `plain`, the tree of the same model. Returns
/// false, and leaves `plain` as it was, unless the trees are the same, groups aside, every length
/// and entry of `plain` has been spelled out, and is what its spelled-out number is in six digits.
bool spell_out(std::vector<ScadModule>& plain, const std::vector<ScadModule>& marked);

/// Whether a tree has flat parts that only OpenSCAD itself evaluates, with six digits.
bool has_flat_parts_of_six_digits(const std::vector<ScadModule>& modules);

}  // namespace graycube
