#include "cli/openscad/model_view.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <string>
#include <system_error>

namespace graycube {
namespace {

/// Three numbers each of $vpt and $vpr, then $vpd and $vpf.
using Numbers = std::array<double, 8>;

/// The variables' values where nothing sets them (OpenSCAD 2021.01; the camera's own differ).
constexpr Numbers kUnset{0, 0, 0, 0, 0, 0, 500, 22.5};

/// The numbers of "[[1, 2, 3], [4, 5, 6], 7, 8]"; nothing for other texts.
std::optional<Numbers> numbers_in(std::string_view told) {
  Numbers numbers{};
  for (double& number : numbers) {
    told.remove_prefix(std::min(told.find_first_not_of("[], "), told.size()));
    const auto [end, error] = std::from_chars(told.data(), told.data() + told.size(), number);
    if (error != std::errc{}) return std::nullopt;
    told.remove_prefix(static_cast<std::size_t>(end - told.data()));
  }
  return numbers;
}

/// Whether the text assigns to the variable; comments count, too, which does no harm: its value is
/// then the same as in the program's window.
bool assigns(std::string_view model, std::string_view variable) {
  for (std::size_t at = model.find(variable); at != std::string_view::npos;
       at = model.find(variable, at + 1)) {
    const std::size_t after = model.find_first_not_of(" \t\r\n", at + variable.size());
    if (after != std::string_view::npos && model[after] == '=' && model.substr(after, 2) != "==")
      return true;
  }
  return false;
}

}  // namespace

std::optional<OpenscadView> openscad_view(std::string_view told, std::string_view model) {
  const auto found = numbers_in(told);
  if (!found) return std::nullopt;
  const Numbers& n = *found;
  const auto is_set = [&](std::string_view variable, std::size_t from, std::size_t count) {
    for (std::size_t i = from; i < from + count; ++i) {
      if (n[i] != kUnset[i]) return true;
    }
    return assigns(model, variable);
  };
  OpenscadView view;
  const bool has_target = is_set("$vpt", 0, 3), has_rotation = is_set("$vpr", 3, 3);
  const bool has_distance = is_set("$vpd", 6, 1), has_angle = is_set("$vpf", 7, 1);
  if (!has_target && !has_rotation && !has_distance && !has_angle) return std::nullopt;
  if (has_target) view.target = {n[0], n[1], n[2]};
  if (has_rotation) view.rotation = {n[3], n[4], n[5]};
  if (has_distance) view.distance = n[6];
  if (has_angle) view.fov_degrees = n[7];
  return view;
}

}  // namespace graycube
