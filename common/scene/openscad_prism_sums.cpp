#include "scene/openscad_prism_sums.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "scene/flat_offset.hpp"
#include "scene/openscad_flat_rounds.hpp"
#include "scene/openscad_parts.hpp"
#include "scene/openscad_primitives.hpp"
#include "scene/openscad_sweep.hpp"

namespace graycube {
namespace {

struct Prism {
  FlatShape figure;
  double low = 0, high = 0;
};
struct Ball {
  Vec3 center;
  double radius = 0;
};
/// The union of its prisms, or a ball.
struct Operand {
  std::vector<Prism> prisms;
  std::optional<Ball> ball;
};

CsgNode leaf(decltype(CsgNode::value) value) { return {std::move(value), std::nullopt, kInheritMaterial}; }

bool is_upright(const Affine& map) {
  return map.m[0][2] == 0 && map.m[1][2] == 0 && map.m[2][0] == 0 && map.m[2][1] == 0 && map.m[2][2] != 0;
}

Prism placed(const Affine& map, FlatShape figure, double low, double high) {
  const FlatMap flat{{{{map.m[0][0], map.m[0][1], map.m[0][3]}, {map.m[1][0], map.m[1][1], map.m[1][3]}}}};
  const double a = map.m[2][2] * low + map.m[2][3], b = map.m[2][2] * high + map.m[2][3];
  return {mapped(flat, std::move(figure)), std::min(a, b), std::max(a, b)};
}

FlatShape rectangle(const Vec3& lo, const Vec3& hi) {
  FlatShape shape;
  shape.loops = {{{lo.x, lo.y}, {hi.x, lo.y}, {hi.x, hi.y}, {lo.x, hi.y}}};
  return shape;
}

bool add_primitive(const ScadModule& module, const Affine& map, ScadImport& import, Operand& operand) {
  const auto solid = openscad_primitive(module, import.report);
  if (!solid) return true;
  if (const auto* sphere = std::get_if<SphereShape>(&solid->leaf.value)) {
    const auto scale = written_similarity(map);
    if (!scale || operand.ball || !operand.prisms.empty()) return false;
    operand.ball = Ball{map.point(sphere->center), *scale * sphere->radius};
    return true;
  }
  if (operand.ball || !is_upright(map)) return false;
  if (const auto* box = std::get_if<BoxShape>(&solid->leaf.value)) {
    operand.prisms.push_back(placed(map, rectangle(box->min, box->max), box->min.z, box->max.z));
    return true;
  }
  const auto* cylinder = std::get_if<CylinderShape>(&solid->leaf.value);
  if (cylinder == nullptr) return false;
  FlatShape disk;
  disk.kind = FlatShape::Kind::kDisk;
  disk.disk = {{{{cylinder->radius, 0, 0}, {0, cylinder->radius, 0}}}};
  ScadArguments arguments(module, import.report);
  disk.sides = fragments(cylinder->radius, fineness_of(arguments));
  operand.prisms.push_back(placed(map, std::move(disk), cylinder->base.z, cylinder->top.z));
  return true;
}

/// False for what is neither prisms nor a ball.
bool add_operand(const ScadModule& module, const Affine& map, ScadImport& import, Operand& operand) {
  if (module.left_out || module.dimension == 2) return true;
  const std::string& name = module.name;
  Affine inner = map;
  if (name == "multmatrix") {
    const auto own = openscad_matrix(module, import.report);
    if (!own) return true;
    inner = compose(map, *own);
  }
  if (name == "multmatrix" || name == "group" || name == "union" || name == "color" || name == "render") {
    return std::all_of(module.children.begin(), module.children.end(),
                       [&](const ScadModule& child) { return add_operand(child, inner, import, operand); });
  }
  if (is_openscad_primitive(module)) return add_primitive(module, map, import, operand);
  if (name != "linear_extrude" || operand.ball || !is_upright(map)) return false;
  std::optional<PlainSweep> sweep;
  if (!plain_sweep(module, import, sweep)) return false;
  if (!sweep) return true;
  if (!(sweep->scale == FlatPoint{1, 1})) return false;
  operand.prisms.push_back(placed(map, std::move(sweep->shape), sweep->low, sweep->high));
  return true;
}

bool add_prisms(std::vector<Prism>& sums, const std::vector<Prism>& operand) {
  if (sums.size() * operand.size() > kMaxPrismSums) return false;
  std::vector<Prism> next;
  for (const Prism& a : sums) {
    for (const Prism& b : operand) {
      ExactFlat figure = exact_flat_sum(a.figure, b.figure);
      if (!figure.is_exact || !figure.shape) return false;
      next.push_back({*std::move(figure.shape), a.low + b.low, a.high + b.high});
    }
  }
  sums = std::move(next);
  return true;
}

/// A prism of a polygon and everything within the ball's radius of it: taller, wider, and a cylinder along each side at
/// both ends, a ball at each corner that points outwards.
std::optional<std::vector<CsgNode>> rounded(const Prism& prism, const Ball& ball, ScadImport& import, int line) {
  if (prism.figure.kind != FlatShape::Kind::kPolygon) return std::nullopt;
  const double r = ball.radius;
  const auto offset = round_offset(prism.figure.loops, r);
  const ExactFlat wide = exact_offset(prism.figure, r, 0);
  if (!offset || !wide.shape) return std::nullopt;
  std::vector<CsgNode> parts;
  auto tall = extruded(prism.figure, prism.low - r, prism.high + r, import, line);
  auto broad = extruded(*wide.shape, prism.low, prism.high, import, line);
  if (!tall || !broad) return std::nullopt;
  parts.push_back(*std::move(tall));
  parts.push_back(*std::move(broad));
  for (const double z : {prism.low, prism.high}) {
    for (const FlatLoop& loop : prism.figure.loops) {
      for (std::size_t i = 0; i < loop.size(); ++i) {
        const FlatPoint &a = loop[i], &b = loop[(i + 1) % loop.size()];
        parts.push_back(leaf(CylinderShape{{a.x, a.y, z}, {b.x, b.y, z}, r}));
      }
    }
    for (const FlatPoint& p : offset->centers) parts.push_back(leaf(SphereShape{{p.x, p.y, z}, r}));
  }
  for (CsgNode& part : parts) {
    if (ball.center == Vec3{}) break;
    const Affine shift = translation(ball.center);
    part.transform = part.transform ? compose(shift, *part.transform) : shift;
  }
  return parts;
}

}  // namespace

std::optional<CsgNode> exact_prism_sum(const ScadModule& module, ScadImport& import) {
  std::vector<Prism> sums;
  std::optional<Ball> ball;
  for (const ScadModule& child : module.children) {
    if (child.left_out || child.dimension == 2) continue;
    Operand operand;
    if (!add_operand(child, {}, import, operand)) return std::nullopt;
    if (operand.ball && !std::exchange(ball, operand.ball)) continue;
    if (operand.prisms.empty()) return std::nullopt;
    if (sums.empty()) {
      sums = std::move(operand.prisms);
    } else if (!add_prisms(sums, operand.prisms)) {
      return std::nullopt;
    }
  }
  std::vector<CsgNode> parts;
  for (const Prism& prism : sums) {
    if (ball) {
      auto pieces = rounded(prism, *ball, import, module.line);
      if (!pieces) return std::nullopt;
      std::move(pieces->begin(), pieces->end(), std::back_inserter(parts));
    } else if (auto solid = extruded(prism.figure, prism.low, prism.high, import, module.line)) {
      parts.push_back(*std::move(solid));
    }
  }
  if (parts.empty()) return std::nullopt;
  if (parts.size() == 1) return std::move(parts.front());
  return leaf(OperationNode{Operation::kUnion, std::move(parts)});
}

}  // namespace graycube
