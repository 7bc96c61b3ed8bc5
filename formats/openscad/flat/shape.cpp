#include "formats/openscad/flat/shape.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "flat/bounded_offset.hpp"
#include "flat/flush.hpp"
#include "flat/offset.hpp"
#include "flat/side_crossings.hpp"
#include "formats/openscad/flat/polygon_arguments.hpp"
#include "formats/openscad/flat/rounds.hpp"
#include "formats/openscad/flat/sums.hpp"
#include "formats/openscad/language/arguments.hpp"
#include "formats/openscad/language/matrix.hpp"
#include "formats/openscad/language/module_kinds.hpp"
#include "formats/openscad/program/by_program.hpp"
#include "geometry/portable_math.hpp"

namespace graycube {
namespace {

using Kind = FlatShape::Kind;

FlatLoop circle_of(const FlatMap& map, int sides) {
  FlatLoop loop;
  for (int i = 0; i < sides; ++i) {
    loop.push_back(map({cos_degrees(360.0 * i / sides), sin_degrees(360.0 * i / sides)}));
  }
  if (map.determinant() < 0) std::reverse(loop.begin(), loop.end());
  return loop;
}

FlatOperation operation_of(Kind kind) {
  return kind == Kind::kUnion          ? FlatOperation::kUnion
         : kind == Kind::kIntersection ? FlatOperation::kIntersection
                                       : FlatOperation::kDifference;
}

class FlatReader {
 public:
  explicit FlatReader(ScadImport& import) : import_(import) {}

  std::optional<FlatShape> shape(const ScadModule& module, const FlatMap& map) {
    const std::string& name = module.name;
    if (module.left_out || module.dimension == 0) return std::nullopt;
    if (name == "group" || name == "union" || name == "color" || name == "render") {
      return united(module.children, map, module.line);
    }
    if (name == "multmatrix") {
      const auto inner = flat_matrix(module, import_.digits, import_.report);
      if (!inner) return std::nullopt;
      return united(module.children, compose(map, *inner), module.line);
    }
    if (name == "difference") return difference(module, map);
    if (name == "intersection") return intersection(module, map);
    ScadArguments arguments(module, import_.report);
    if (name == "square") return square(module, arguments, map);
    if (name == "circle") return circle(arguments, map);
    if (name == "polygon") return polygon(module, arguments, map);
    if (name == "offset") return offset_of(module, arguments, map);
    if (name == "hull") return hull(module, map);
    if (name == "fill") return filled(module, map);
    if (name == "minkowski") return minkowski(module, map);
    if (name == "projection" && dimension_of(module.children) == 0) return std::nullopt;
    return by_program(module, map);
  }

  std::optional<FlatShape> united(const std::vector<ScadModule>& modules, const FlatMap& map,
                                  int line) {
    std::vector<FlatShape> parts;
    for (const ScadModule& module : modules) {
      if (!takes_part(module)) continue;
      if (auto part = shape(module, map)) parts.push_back(std::move(*part));
    }
    return operated(Kind::kUnion, std::move(parts), line);
  }

  /// The operation's figure, evaluated by Clipper as far as nothing is round.
  std::optional<FlatShape> operated(Kind kind, std::vector<FlatShape> parts, int line) {
    if (parts.empty()) return std::nullopt;
    if (parts.size() == 1) return std::move(parts.front());
    const auto is_round = [](const FlatShape& s) { return s.has_curves(); };
    const auto middle = std::stable_partition(parts.begin() + (kind == Kind::kDifference ? 1 : 0),
                                              parts.end(), is_round);
    std::vector<FlatLoops> straight;
    // Shapes that are subtracted may be united, too.
    const bool is_all_straight = std::none_of(parts.begin(), parts.end(), is_round);
    for (auto part = is_all_straight ? parts.begin() : middle; part != parts.end(); ++part) {
      straight.push_back(std::move(part->loops));
    }
    if (is_all_straight) return of_loops(combined_loops(operation_of(kind), straight, line));
    parts.erase(middle, parts.end());
    const bool intersects = kind == Kind::kIntersection;
    auto loops = combined_loops(intersects ? FlatOperation::kIntersection : FlatOperation::kUnion,
                                straight, line);
    if (intersects && !straight.empty() && !loops) return std::nullopt;
    if (loops) parts.push_back({Kind::kPolygon, std::move(*loops), {}, 0});
    if (parts.size() == 1) return std::move(parts.front());
    return FlatShape{kind, {}, {}, 0, std::move(parts)};
  }

  /// The outlines; nothing when the result is empty or, with a warning, has too many corners.
  std::optional<FlatLoops> combined_loops(FlatOperation operation,
                                          std::span<const FlatLoops> operands, int line) {
    std::size_t corners = 0;
    for (const FlatLoops& loops : operands) {
      for (const FlatLoop& loop : loops) corners += loop.size();
    }
    if (corners > kMaxOpenscadCorners || !crossings_are_few(operands)) {
      import_.leave_out_once("outlines", line,
                             "a figure is left out: its outlines have too many corners, or cross "
                             "one another too often");
      return std::nullopt;
    }
    FlatLoops loops =
        combined_flush(operation, operands, flush_tolerance(operands, import_.digits));
    if (loops.empty()) return std::nullopt;
    return loops;
  }

 private:
  static std::optional<FlatShape> of_loops(std::optional<FlatLoops> loops) {
    if (!loops || loops->empty()) return std::nullopt;
    return FlatShape{Kind::kPolygon, std::move(*loops), {}, 0};
  }
  std::optional<FlatShape> of_loops(const FlatLoops& loops, const FlatMap& map, int line) {
    const FlatLoops placed = mapped(map, loops);
    return of_loops(combined_loops(FlatOperation::kUnion, std::span(&placed, 1), line));
  }

  bool takes_part(const ScadModule& module) {
    if (module.left_out) return false;
    if (module.dimension != 3) return true;
    import_.report.warning(
        module.line, module.name + "() is left out: it is three-dimensional among flat shapes");
    return false;
  }

  std::optional<FlatShape> difference(const ScadModule& module, const FlatMap& map) {
    std::vector<FlatShape> parts;
    bool is_first = true;
    for (const ScadModule& child : module.children) {
      if (!takes_part(child)) continue;
      auto part = shape(child, map);
      if (std::exchange(is_first, false) && !part) return std::nullopt;
      if (part) parts.push_back(std::move(*part));
    }
    return operated(Kind::kDifference, std::move(parts), module.line);
  }

  std::optional<FlatShape> intersection(const ScadModule& module, const FlatMap& map) {
    std::vector<FlatShape> parts;
    for (const ScadModule& child : module.children) {
      if (!takes_part(child)) continue;
      auto part = shape(child, map);
      if (!part) return std::nullopt;
      parts.push_back(std::move(*part));
    }
    return operated(Kind::kIntersection, std::move(parts), module.line);
  }

  std::optional<FlatShape> square(const ScadModule& module, ScadArguments& arguments,
                                  const FlatMap& map) {
    FlatPoint size{1, 1};
    if (const ScadValue* value = module.argument("size", 0)) {
      const double* edge = value->number();
      const auto both = ScadArguments::pair(*value);
      if (edge != nullptr) size = {*edge, *edge};
      if (both) size = *both;
      if (edge == nullptr && !both) arguments.pass_over("size", "must be a number or two numbers");
    }
    const bool center = arguments.boolean("center", 1);
    const bool good = std::isfinite(size.x) && std::isfinite(size.y) && size.x > 0 && size.y > 0;
    if (arguments.empty_unless(good, "its size is not positive")) return std::nullopt;
    const FlatPoint lo = center ? FlatPoint{-0.5 * size.x, -0.5 * size.y} : FlatPoint{};
    const FlatPoint hi = center ? FlatPoint{0.5 * size.x, 0.5 * size.y} : size;
    return of_loops({{lo, {hi.x, lo.y}, hi, {lo.x, hi.y}}}, map, module.line);
  }

  std::optional<FlatShape> circle(ScadArguments& arguments, const FlatMap& map) {
    const double r = arguments.radius("d", "r", 0, 1);
    const ScadFineness fineness = fineness_of(arguments);
    if (arguments.empty_unless(std::isfinite(r) && r > 0, "its radius is not positive"))
      return std::nullopt;
    FlatShape disk{
        Kind::kDisk, {}, compose(map, FlatMap{{{{r, 0, 0}, {0, r, 0}}}}), fragments(r, fineness)};
    const int few = asked_sides(fineness);
    if (!import_.options.facets && few == 0) return disk;
    return FlatShape{Kind::kPolygon, {circle_of(disk.disk, disk.sides)}, {}, 0};
  }

  std::optional<FlatShape> polygon(const ScadModule& module, ScadArguments& arguments,
                                   const FlatMap& map) {
    FlatLoops loops;
    if (!read_polygon(module, arguments, loops)) return std::nullopt;
    std::erase_if(loops, [](const FlatLoop& loop) { return loop.size() < 3; });
    if (arguments.empty_unless(!loops.empty(), "it has fewer than three corners"))
      return std::nullopt;
    return of_loops(loops, map, module.line);
  }

  std::optional<FlatShape> offset_of(const ScadModule& module, ScadArguments& arguments,
                                     const FlatMap& map) {
    const auto radius = arguments.number("r", 0), delta = arguments.number("delta", -1);
    const bool is_round = radius || !delta;
    const double distance = radius ? *radius : delta.value_or(1);
    const bool chamfer = arguments.boolean("chamfer", -1);
    const ScadFineness fineness = fineness_of(arguments);
    if (!(std::fabs(distance) <= kMaxOpenscadCoordinate)) {
      arguments.leave_out("distance", "its distance is not a number of sensible size");
      return std::nullopt;
    }
    const auto inner = united(module.children, {}, module.line);
    if (!inner) return std::nullopt;
    const int sides = fragments(std::fabs(distance), fineness);
    const double tolerance = std::fabs(distance) * (1 - cos_degrees(180.0 / sides));
    const FlatJoin join = is_round  ? FlatJoin::kRound
                          : chamfer ? FlatJoin::kSquare
                                    : FlatJoin::kMiter;
    const auto with_facets = [&]() -> FlatLoops {
      const auto loops = polygon_of(*inner, import_, module.line);
      if (!loops || distance == 0) return loops ? *loops : FlatLoops{};
      auto result = bounded_offset(*loops, distance, join, tolerance);
      if (!result) {
        import_.leave_out_once("offset", module.line,
                               "offset() is left out: its outline has too many corners, or sides "
                               "that cross one another too often once they are moved");
        return {};
      }
      return join == FlatJoin::kMiter ? on_lines(*std::move(result), *loops, distance) : *result;
    };
    const bool may_be_round = is_round && asked_sides(fineness) == 0;
    const bool may_be_moved = may_be_round || inner->kind == Kind::kDisk ||
                              (join == FlatJoin::kMiter && inner->has_curves());
    if (!import_.options.facets && may_be_moved) {
      const FlatCorners corners = is_round ? FlatCorners::kRound : FlatCorners::kSharp;
      if (auto exact = exact_offset(*inner, distance, sides, corners); exact.is_exact) {
        return with_own_facets(std::move(exact.shape), with_facets, map);
      }
    }
    if (inner->has_curves() || (may_be_round && !import_.options.facets))
      import_.warn_of_sides(module.name, module.line);
    return of_loops(with_facets(), map, module.line);
  }

  /// A shape with curves keeps the polygon that OpenSCAD makes of it.
  template <typename WithFacets>
  static std::optional<FlatShape> with_own_facets(std::optional<FlatShape> shape,
                                                  const WithFacets& with_facets,
                                                  const FlatMap& map) {
    if (!shape) return std::nullopt;
    if (shape->kind != Kind::kDisk && shape->has_curves()) shape->facets = with_facets();
    return mapped(map, *std::move(shape));
  }

  /// OpenSCAD's of 2022 and later: without the holes.
  std::optional<FlatShape> filled(const ScadModule& module, const FlatMap& map) {
    import_.warn_once(module.line,
                      "fill() is done here, as OpenSCAD 2025 does it: older ones don't know it");
    const auto inner = united(module.children, {}, module.line);
    if (!inner) return std::nullopt;
    if (inner->kind == Kind::kDisk) return mapped(map, *inner);
    if (inner->has_curves()) import_.warn_of_sides(module.name, module.line);
    const auto loops = polygon_of(*inner, import_, module.line);
    if (!loops) return std::nullopt;
    FlatLoops outlines;
    for (FlatRegion& region : regions_of(*loops)) outlines.push_back(std::move(region.outline));
    return of_loops(outlines, map, module.line);
  }

  std::vector<FlatShape> operands(const ScadModule& module, const FlatMap& map) {
    std::vector<FlatShape> parts;
    for (const ScadModule& child : module.children) {
      if (!takes_part(child)) continue;
      if (auto part = shape(child, map)) parts.push_back(std::move(*part));
    }
    return parts;
  }

  std::optional<FlatShape> hull(const ScadModule& module, const FlatMap& map) {
    const std::vector<FlatShape> parts = operands(module, map);
    const auto with_facets = [&]() -> FlatLoops {
      std::vector<FlatPoint> points;
      for (const FlatShape& part : parts) {
        const auto loops = polygon_of(part, import_, module.line);
        if (!loops) continue;
        for (const FlatLoop& loop : *loops) points.insert(points.end(), loop.begin(), loop.end());
      }
      FlatLoop loop = flat_hull(std::move(points));
      return loop.size() < 3 ? FlatLoops{} : FlatLoops{std::move(loop)};
    };
    if (std::any_of(parts.begin(), parts.end(),
                    [](const FlatShape& part) { return part.has_curves(); })) {
      auto exact = exact_flat_hull(parts);
      if (exact.is_exact) return with_own_facets(std::move(exact.shape), with_facets, {});
      import_.warn_of_sides(module.name, module.line);
    }
    return of_loops(with_facets());
  }

  /// Exact if each operand is convex, or all but one are circles; else the program evaluates it.
  std::optional<FlatShape> minkowski(const ScadModule& module, const FlatMap& map) {
    const auto operands = operands_of_sum(module);
    if (!operands) return std::nullopt;
    const std::vector<FlatShape>& parts = *operands;
    if (parts.size() > 1 && import_.options.facets) return by_program(module, map);
    FlatShape sum = parts.front();
    for (std::size_t i = 1; i < parts.size(); ++i) {
      auto next = exact_flat_sum(sum, parts[i]);
      if (!next.is_exact) return by_program(module, map);
      if (!next.shape) return std::nullopt;
      sum = *std::move(next.shape);
    }
    return with_own_facets(
        std::move(sum), [&] { return sum_of_facets(parts, module.line); }, map);
  }

  /// The operands that aren't empty; nothing if the sum is empty. OpenSCAD's is where the first
  /// operand is, or all others are; other empty ones don't count.
  std::optional<std::vector<FlatShape>> operands_of_sum(const ScadModule& module) {
    std::vector<FlatShape> parts;
    bool is_first = true, has_others = false;
    for (const ScadModule& child : module.children) {
      if (child.left_out) continue;
      auto part = takes_part(child) ? shape(child, {}) : std::nullopt;
      if (is_first && !part) return std::nullopt;
      has_others = has_others || !is_first;
      is_first = false;
      if (part) parts.push_back(*std::move(part));
    }
    if (parts.empty() || (parts.size() == 1 && has_others)) return std::nullopt;
    return parts;
  }

  /// The sum of the shapes' polygons; empty if it can't be had here.
  FlatLoops sum_of_facets(const std::vector<FlatShape>& parts, int line) {
    FlatShape sum;
    for (const FlatShape& part : parts) {
      const auto loops = polygon_of(part, import_, line);
      if (!loops) return {};
      FlatShape own;
      own.loops = *loops;
      if (!sum.loops.empty()) {
        auto next = exact_flat_sum(sum, own);
        if (!next.shape || next.shape->kind != Kind::kPolygon) return {};
        own = *std::move(next.shape);
      }
      sum = std::move(own);
    }
    return std::move(sum.loops);
  }

  std::optional<FlatShape> by_program(const ScadModule& module, const FlatMap& map) {
    const std::optional<FlatLoops> loops = flat_by_program(module, import_);
    return loops ? of_loops(*loops, map, module.line) : std::nullopt;
  }

  ScadImport& import_;
};

}  // namespace

bool FlatShape::has_curves() const {
  return kind == Kind::kDisk || std::any_of(children.begin(), children.end(),
                                            [](const FlatShape& s) { return s.has_curves(); });
}

std::optional<FlatShape> flat_shape(const ScadModule& module, const FlatMap& map,
                                    ScadImport& import) {
  return FlatReader(import).shape(module, map);
}

std::optional<FlatShape> flat_union(const std::vector<ScadModule>& modules, const FlatMap& map,
                                    ScadImport& import, int line) {
  return FlatReader(import).united(modules, map, line);
}

std::optional<FlatLoops> polygon_of(const FlatShape& shape, ScadImport& import, int line) {
  if (shape.kind == Kind::kPolygon) return shape.loops;
  if (!shape.facets.empty()) return shape.facets;
  if (shape.kind == Kind::kDisk) return FlatLoops{circle_of(shape.disk, shape.sides)};
  std::vector<FlatLoops> operands;
  for (const FlatShape& child : shape.children) {
    auto loops = polygon_of(child, import, line);
    if (loops) {
      operands.push_back(std::move(*loops));
    } else if (shape.kind == Kind::kIntersection ||
               (shape.kind == Kind::kDifference && operands.empty())) {
      return std::nullopt;
    }
  }
  if (operands.empty()) return std::nullopt;
  return FlatReader(import).combined_loops(operation_of(shape.kind), operands, line);
}

}  // namespace graycube
