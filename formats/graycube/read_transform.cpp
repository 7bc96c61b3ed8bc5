#include "formats/graycube/read_transform.hpp"

#include <array>

namespace graycube {
namespace {

/// One of the keys of a transform step.
enum StepKey : std::size_t { kTranslate, kRotate, kScale, kMatrix, kStepKeys };
constexpr std::array<KeyRule, kStepKeys> kStepRules{
    {{"translate"}, {"rotate"}, {"scale"}, {"matrix"}}};

constexpr std::array<KeyRule, 2> kRotateRules{{{"axis", true}, {"angle", true}}};

std::optional<Affine> read_rotation(JsonAccess& json, JsonIndex at) {
  std::array<JsonIndex, 2> member{};
  json.members(at, "a rotation", kRotateRules, member);
  Vec3 axis;
  double angle = 0;
  const bool axis_good = member[0] != 0 && json.read_direction(member[0], axis);
  const bool angle_good = member[1] != 0 && json.read(member[1], angle);
  if (!axis_good || !angle_good) return std::nullopt;
  return rotation(axis, angle);
}

std::optional<Affine> read_scale(JsonAccess& json, JsonIndex at) {
  Vec3 factors;
  double factor = 0;
  if (json.tree.kind(at) == JsonKind::kNumber) {
    if (!json.read(at, factor)) return std::nullopt;
    factors = {factor, factor, factor};
  } else if (json.tree.kind(at) != JsonKind::kArray) {
    json.wrong(at, "a number or a vector [x, y, z]");
    return std::nullopt;
  } else if (!json.read(at, factors)) {
    return std::nullopt;
  }
  const Affine map = scaling(factors);
  if (map.inverse()) return map;
  json.wrong(at, "scale factors that are not zero");
  return std::nullopt;
}

bool read_row(JsonAccess& json, JsonIndex at, std::array<double, 4>& row) {
  if (json.tree.kind(at) != JsonKind::kArray || json.tree.size(at) != 4)
    return json.wrong(at, "a matrix row of 4 numbers");
  bool good = true;
  JsonIndex child = json.tree.first_child(at);
  for (double& v : row) {
    good = json.read(child, v) && good;
    child = json.tree.next(child);
  }
  return good;
}

std::optional<Affine> read_matrix(JsonAccess& json, JsonIndex at) {
  const std::uint32_t rows = json.tree.kind(at) == JsonKind::kArray ? json.tree.size(at) : 0;
  if (rows != 3 && rows != 4) {
    json.wrong(at, "a matrix of 3 or 4 rows of 4 numbers");
    return std::nullopt;
  }
  Affine map;
  bool good = true;
  JsonIndex child = json.tree.first_child(at);
  for (auto& row : map.m) {
    good = read_row(json, child, row) && good;
    child = json.tree.next(child);
  }
  if (rows == 4) {
    std::array<double, 4> last{0, 0, 0, 1};
    if (!read_row(json, child, last))
      good = false;
    else if (last != std::array<double, 4>{0, 0, 0, 1})
      good = json.wrong(child, "[0, 0, 0, 1] as fourth row");
  }
  if (!good) return std::nullopt;
  if (map.inverse()) return map;
  json.errors.add(at,
                  "expected an invertible matrix, found one that is singular to working precision");
  return std::nullopt;
}

std::optional<Affine> read_step(JsonAccess& json, JsonIndex at) {
  std::array<JsonIndex, kStepKeys> member{};
  json.members(at, "a transform step", kStepRules, member);
  if (json.tree.kind(at) != JsonKind::kObject) return std::nullopt;
  if (json.tree.size(at) != 1) {
    json.errors.add(
        at, "expected one key (translate, rotate, scale or matrix) in a transform step, found " +
                std::to_string(json.tree.size(at)));
    return std::nullopt;
  }
  if (member[kTranslate] != 0) {
    Vec3 offset;
    if (!json.read(member[kTranslate], offset)) return std::nullopt;
    return translation(offset);
  }
  if (member[kRotate] != 0) return read_rotation(json, member[kRotate]);
  if (member[kScale] != 0) return read_scale(json, member[kScale]);
  if (member[kMatrix] != 0) return read_matrix(json, member[kMatrix]);
  return std::nullopt;
}

}  // namespace

std::optional<Affine> read_transform(JsonAccess& json, JsonIndex at) {
  if (!json.is_array(at)) return std::nullopt;
  std::optional<Affine> whole;
  bool good = true;
  for (JsonIndex s = json.tree.first_child(at); s != json.tree.end(at); s = json.tree.next(s)) {
    const auto step = read_step(json, s);
    good = good && step.has_value();
    if (good) whole = whole ? compose(*step, *whole) : *step;
  }
  if (!good || !whole) return std::nullopt;
  // Steps that are each fine may together overflow, or shear away all precision.
  if (whole->is_finite() && whole->inverse()) return whole;
  json.errors.add(
      at,
      "expected an invertible map, found steps that together are singular to working precision");
  return std::nullopt;
}

}  // namespace graycube
