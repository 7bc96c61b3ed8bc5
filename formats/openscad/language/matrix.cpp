#include "formats/openscad/language/matrix.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "formats/openscad/language/arguments.hpp"
#include "formats/openscad/language/recovered_rotation.hpp"

namespace graycube {
namespace {

/// The entries as written, divided by the last one; the map may be singular.
std::optional<Affine> written_matrix(const ScadModule& module, ScadArguments& arguments) {
  std::array<std::array<double, 4>, 4> m{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}}};
  if (const ScadValue* value = module.argument("m", 0)) {
    const ScadList* rows = value->list();
    if (rows == nullptr) arguments.pass_over("m", "must be a list of rows");
    for (std::size_t i = 0; rows != nullptr && i < std::min<std::size_t>(rows->size(), 4); ++i) {
      const ScadList* row = (*rows)[i].list();
      if (row == nullptr) arguments.pass_over("a row of m", "must be a list of numbers");
      for (std::size_t j = 0; row != nullptr && j < std::min<std::size_t>(row->size(), 4); ++j) {
        if (const double* entry = (*row)[j].number()) {
          m[i][j] = *entry;
        } else if (!(*row)[j].is_undef()) {
          arguments.pass_over("an entry of m", "must be a number");
        }
      }
    }
  }
  if (m[3][0] != 0 || m[3][1] != 0 || m[3][2] != 0) {
    arguments.ignore("fourth row", "the first three entries of a matrix's fourth row are ignored");
  }
  Affine map;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 4; ++j) map.m[i][j] = m[i][j] / m[3][3];
  }
  if (arguments.empty_unless(map.is_finite(), "its matrix is not finite")) return std::nullopt;
  return map;
}

FlatMap flat_part(const Affine& map) {
  return {{{{map.m[0][0], map.m[0][1], map.m[0][3]}, {map.m[1][0], map.m[1][1], map.m[1][3]}}}};
}

}  // namespace

std::optional<Affine> openscad_matrix(const ScadModule& module, std::uint32_t digits,
                                      OpenscadReport& report) {
  ScadArguments arguments(module, report);
  const auto map = written_matrix(module, arguments);
  if (!map ||
      arguments.empty_unless(map->inverse().has_value(), "its matrix flattens everything in it")) {
    return std::nullopt;
  }
  return recovered_rotation(*map, digits);
}

std::optional<Affine> openscad_matrix_of_corners(const ScadModule& module, std::uint32_t digits,
                                                 OpenscadReport& report) {
  ScadArguments arguments(module, report);
  const auto map = written_matrix(module, arguments);
  if (!map || !map->inverse()) return map;
  return recovered_rotation(*map, digits);
}

std::optional<FlatMap> flat_matrix(const ScadModule& module, std::uint32_t digits,
                                   OpenscadReport& report) {
  ScadArguments arguments(module, report);
  const auto map = written_matrix(module, arguments);
  if (!map) return std::nullopt;
  const FlatMap flat = flat_part(*map);
  if (arguments.empty_unless(flat.determinant() != 0, "its matrix flattens everything in it"))
    return std::nullopt;
  // Heights don't matter: turned about z, and scaled along z as in the plane, the map may be a
  // rotation.
  const double a = flat.m[0][0], b = flat.m[1][0];
  const Affine upright{{{{a, flat.m[0][1], 0, flat.m[0][2]},
                         {b, flat.m[1][1], 0, flat.m[1][2]},
                         {0, 0, std::sqrt(a * a + b * b), 0}}}};
  return flat_part(recovered_rotation(upright, digits));
}

}  // namespace graycube
