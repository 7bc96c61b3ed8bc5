#include "formats/openscad/prism_sums.hpp"

#include <algorithm>
#include <iterator>
#include <utility>
#include <vector>

#include "formats/openscad/flat/rounds.hpp"
#include "formats/openscad/flat/similarity.hpp"
#include "formats/openscad/flat/sums.hpp"
#include "formats/openscad/language/matrix.hpp"
#include "formats/openscad/primitives.hpp"
#include "formats/openscad/sweep.hpp"

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
/// An operand of the sum: a union of prisms, or a ball.
struct Operand {
  std::vector<Prism> prisms;
  std::optional<Ball> ball;
};

CsgNode leaf(decltype(CsgNode::value) value) {
  return {std::move(value), std::nullopt, kInheritMaterial};
}

bool is_upright(const Affine& map) {
  return map.m[0][2] == 0 && map.m[1][2] == 0 && map.m[2][0] == 0 && map.m[2][1] == 0 &&
         map.m[2][2] != 0;
}

Prism placed(const Affine& map, FlatShape figure, double low, double high) {
  const FlatMap flat{
      {{{map.m[0][0], map.m[0][1], map.m[0][3]}, {map.m[1][0], map.m[1][1], map.m[1][3]}}}};
  const double a = map.m[2][2] * low + map.m[2][3], b = map.m[2][2] * high + map.m[2][3];
  return {mapped(flat, std::move(figure)), std::min(a, b), std::max(a, b)};
}

FlatShape rectangle(const Vec3& lo, const Vec3& hi) {
  FlatShape shape;
  shape.loops = {{{lo.x, lo.y}, {hi.x, lo.y}, {hi.x, hi.y}, {lo.x, hi.y}}};
  return shape;
}

bool add_primitive(const ScadModule& module, const Affine& map, ScadImport& import,
                   Operand& operand) {
  const auto solid = openscad_primitive(module, import.report, false, import.digits);
  if (!solid) return true;
  if (const auto* sphere = std::get_if<SphereShape>(&solid->leaf.value)) {
    const auto scale = map.similarity_scale();
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

/// Adds a module to the operand; false if it is neither prisms nor a ball.
bool add_operand(const ScadModule& module, const Affine& map, ScadImport& import,
                 Operand& operand) {
  if (module.left_out || module.dimension == 2) return true;
  const std::string& name = module.name;
  Affine inner = map;
  if (name == "multmatrix") {
    const auto own = openscad_matrix(module, import.digits, import.report);
    if (!own) return true;
    inner = compose(map, *own);
  }
  if (name == "multmatrix" || name == "group" || name == "union" || name == "color" ||
      name == "render") {
    return std::all_of(
        module.children.begin(), module.children.end(),
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

/// A prism and everything within a distance of it, as a union: taller, wider, and round rims.
class RoundedPrism {
 public:
  RoundedPrism(double low, double high, double distance, ScadImport& import, int line)
      : low_(low), high_(high), distance_(distance), import_(import), line_(line) {}

  /// Adds the prism of a figure; false if the figure has no exact form.
  bool add(const FlatShape& figure) {
    if (figure.kind == FlatShape::Kind::kUnion) {
      return std::all_of(figure.children.begin(), figure.children.end(),
                         [&](const FlatShape& s) { return add(s); });
    }
    if (figure.kind == FlatShape::Kind::kPolygon) {
      add_rims(figure.loops);
    } else if (figure.kind != FlatShape::Kind::kDisk || !add_rims(figure.disk)) {
      return false;
    }
    const ExactFlat wide = exact_offset(figure, distance_, 0);
    auto tall = extruded(figure, low_ - distance_, high_ + distance_, import_, line_);
    auto broad = wide.shape ? extruded(*wide.shape, low_, high_, import_, line_) : std::nullopt;
    if (!tall || !broad) return false;
    parts_.push_back(*std::move(tall));
    parts_.push_back(*std::move(broad));
    return true;
  }
  std::vector<CsgNode> take() { return std::move(parts_); }

 private:
  /// Adds a cylinder along each side, and a ball at each corner that points outwards.
  void add_rims(const FlatLoops& loops) {
    for (const FlatLoop& loop : loops) {
      for (std::size_t i = 0; i < loop.size(); ++i) {
        const FlatPoint &a = loop[i], &b = loop[(i + 1) % loop.size()],
                        &c = loop[(i + 2) % loop.size()];
        for (const double z : {low_, high_}) {
          parts_.push_back(leaf(CylinderShape{{a.x, a.y, z}, {b.x, b.y, z}, distance_}));
          if (orientation(a, b, c) > 0)
            parts_.push_back(leaf(SphereShape{{b.x, b.y, z}, distance_}));
        }
      }
    }
  }
  /// Adds a torus, which the axis must not reach.
  bool add_rims(const FlatMap& disk) {
    const auto radius = similarity_scale(disk);
    if (!radius || !(*radius > distance_)) return false;
    for (const double z : {low_, high_}) {
      parts_.push_back(
          leaf(TorusShape{{disk.m[0][2], disk.m[1][2], z}, {0, 0, 1}, *radius, distance_}));
    }
    return true;
  }

  double low_, high_, distance_;
  ScadImport& import_;
  int line_;
  std::vector<CsgNode> parts_;
};

std::optional<std::vector<CsgNode>> rounded(const Prism& prism, const Ball& ball,
                                            ScadImport& import, int line) {
  RoundedPrism rounded_prism(prism.low, prism.high, ball.radius, import, line);
  if (!rounded_prism.add(prism.figure)) return std::nullopt;
  std::vector<CsgNode> parts = rounded_prism.take();
  if (ball.center == Vec3{}) return parts;
  const Affine shift = translation(ball.center);
  for (CsgNode& part : parts)
    part.transform = part.transform ? compose(shift, *part.transform) : shift;
  return parts;
}

/// The prisms with OpenSCAD's sides; false if a figure is empty.
bool give_sides(std::vector<Prism>& prisms, ScadImport& import, int line) {
  return std::all_of(prisms.begin(), prisms.end(), [&](Prism& prism) {
    auto outlines = polygon_of(prism.figure, import, line);
    if (!outlines) return false;
    prism.figure = FlatShape{};
    prism.figure.loops = *std::move(outlines);
    return true;
  });
}

/// The prisms whose union the sum is, and the ball that is added to it; false if the operands
/// aren't known, or have no such sum.
bool add_up(const ScadModule& module, bool facets, ScadImport& import, std::vector<Prism>& sums,
            std::optional<Ball>& ball) {
  for (const ScadModule& child : module.children) {
    if (child.left_out || child.dimension == 2) continue;
    Operand operand;
    if (!add_operand(child, {}, import, operand)) return false;
    if (operand.ball && !std::exchange(ball, operand.ball)) continue;
    if (operand.prisms.empty()) return false;
    if (facets && !give_sides(operand.prisms, import, module.line)) return false;
    if (sums.empty()) {
      sums = std::move(operand.prisms);
    } else if (!add_prisms(sums, operand.prisms)) {
      return false;
    }
  }
  return true;
}

std::optional<CsgNode> united(std::vector<CsgNode> parts) {
  if (parts.empty()) return std::nullopt;
  if (parts.size() == 1) return std::move(parts.front());
  return leaf(OperationNode{Operation::kUnion, std::move(parts)});
}

}  // namespace

std::optional<CsgNode> exact_prism_sum(const ScadModule& module, ScadImport& import) {
  std::vector<Prism> sums;
  std::optional<Ball> ball;
  if (!add_up(module, false, import, sums, ball)) return std::nullopt;
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
  return united(std::move(parts));
}

std::optional<CsgNode> faceted_prism_sum(const ScadModule& module, ScadImport& import) {
  std::vector<Prism> sums;
  std::optional<Ball> ball;
  if (!add_up(module, true, import, sums, ball) || ball) return std::nullopt;
  std::vector<CsgNode> parts;
  for (const Prism& prism : sums) {
    auto solid = extruded(prism.figure, prism.low, prism.high, import, module.line);
    if (!solid) return std::nullopt;
    parts.push_back(*std::move(solid));
  }
  return united(std::move(parts));
}

}  // namespace graycube
