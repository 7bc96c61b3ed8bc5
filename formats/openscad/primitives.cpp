#include "formats/openscad/primitives.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "formats/openscad/polyhedron.hpp"
#include "geometry/aabb.hpp"

namespace graycube {
namespace {

bool positive(double v) { return std::isfinite(v) && v > 0; }

ScadSolid round_solid(decltype(CsgNode::value) shape) {
  return {CsgNode{std::move(shape), std::nullopt, kInheritMaterial}, {}};
}

/// The sides of a round solid that is made of facets; 0 if it stays round.
int sides_of(ScadArguments& arguments, double radius, bool facets) {
  const ScadFineness fineness = fineness_of(arguments);
  const int asked = asked_sides(fineness);
  return asked > 0 || !facets ? asked : fragments(radius, fineness);
}

std::optional<ScadSolid> cube(const ScadModule& module, ScadArguments& arguments) {
  Vec3 size{1, 1, 1};
  if (const ScadValue* value = module.argument("size", 0)) {
    const double* edge = value->number();
    const std::optional<Vec3> vector = ScadArguments::vector(*value);
    if (edge != nullptr) size = {*edge, *edge, *edge};
    if (vector) size = *vector;
    if (edge == nullptr && !vector)
      arguments.pass_over("size", "must be a number or three numbers");
  }
  const bool center = arguments.boolean("center", 1);
  if (arguments.empty_unless(positive(size.x) && positive(size.y) && positive(size.z),
                             "its size is not positive")) {
    return std::nullopt;
  }
  const BoxShape box = center ? BoxShape{-0.5 * size, 0.5 * size} : BoxShape{{}, size};
  ScadSolid solid = round_solid(box);
  for (int i = 0; i < 8; ++i) solid.corners.push_back(Aabb{box.min, box.max}.corner(i));
  return solid;
}

std::optional<ScadSolid> sphere(ScadArguments& arguments, bool facets) {
  const double r = arguments.radius("d", "r", 0, 1);
  const int sides = sides_of(arguments, r, facets);
  if (arguments.empty_unless(positive(r), "its radius is not positive")) return std::nullopt;
  if (std::size_t(sides) * std::size_t(sides) / 2 > kMaxOpenscadFacets) {
    arguments.leave_out("facets",
                        "it has more than " + std::to_string(kMaxOpenscadFacets) + " facets");
    return std::nullopt;
  }
  if (sides > 0) return polyhedral_solid(faceted_sphere(r, sides), arguments);
  return round_solid(SphereShape{{}, r});
}

std::optional<ScadSolid> cylinder(ScadArguments& arguments, bool facets) {
  const double h = arguments.number("h", 0, 1);
  const double r = arguments.radius("d", "r", -1, 1);
  const double r1 = arguments.radius("d1", "r1", 1, r), r2 = arguments.radius("d2", "r2", 2, r);
  const bool center = arguments.boolean("center", 3);
  const int sides = sides_of(arguments, std::max(r1, r2), facets);
  if (arguments.empty_unless(positive(h), "its height is not positive")) return std::nullopt;
  const bool radii = (r1 == 0 || positive(r1)) && (r2 == 0 || positive(r2)) && r1 + r2 > 0;
  if (arguments.empty_unless(radii, "its radii are not positive")) return std::nullopt;
  const double low = center ? -0.5 * h : 0, high = center ? 0.5 * h : h;
  if (sides > 0) return polyhedral_solid(faceted_cylinder(low, high, r1, r2, sides), arguments);
  if (r1 == r2) return round_solid(CylinderShape{{0, 0, low}, {0, 0, high}, r1});
  return round_solid(ConeShape{{0, 0, low}, r1, {0, 0, high}, r2});
}

}  // namespace

bool is_openscad_primitive(const ScadModule& module) {
  return module.name == "cube" || module.name == "sphere" || module.name == "cylinder" ||
         module.name == "polyhedron";
}

std::optional<ScadSolid> openscad_primitive(const ScadModule& module, OpenscadReport& report,
                                            bool facets, std::uint32_t digits) {
  ScadArguments arguments(module, report);
  if (module.name == "cube") return cube(module, arguments);
  if (module.name == "sphere") return sphere(arguments, facets);
  if (module.name == "cylinder") return cylinder(arguments, facets);
  return polyhedron(arguments, digits);
}

std::optional<ScadRound> openscad_round(const ScadModule& module) {
  if (module.name != "sphere" && module.name != "cylinder") return std::nullopt;
  OpenscadReport unread;
  const std::optional<ScadSolid> solid = openscad_primitive(module, unread);
  if (!solid) return std::nullopt;
  ScadRound round;
  if (const auto* ball = std::get_if<SphereShape>(&solid->leaf.value)) {
    round = {true, ball->radius, ball->radius, 0, 0, 0};
  } else if (const auto* cylinder = std::get_if<CylinderShape>(&solid->leaf.value)) {
    round = {false, cylinder->radius, cylinder->radius, cylinder->base.z, cylinder->top.z, 0};
  } else if (const auto* cone = std::get_if<ConeShape>(&solid->leaf.value)) {
    round = {false, cone->base_radius, cone->top_radius, cone->base.z, cone->top.z, 0};
  } else {
    return std::nullopt;
  }
  ScadArguments arguments(module, unread);
  round.sides = fragments(std::max(round.radius, round.top_radius), fineness_of(arguments));
  return round;
}

ScadColor openscad_color(const ScadModule& module, OpenscadReport& report) {
  ScadArguments arguments(module, report);
  ScadColor color;
  if (const ScadValue* value = module.argument("c", 0)) {
    const ScadList* list = value->list();
    const auto is_number = [](const ScadValue& v) { return v.number() != nullptr; };
    if (list == nullptr || list->size() < 3 || list->size() > 4 ||
        !std::all_of(list->begin(), list->end(), is_number)) {
      arguments.pass_over("c", "must be three or four numbers");
      return color;
    }
    color.rgba[3] = 1;
    for (std::size_t i = 0; i < list->size(); ++i) {
      const double component = *(*list)[i].number();
      // Negated so that a NaN leaves the component open.
      color.rgba[i] = !(component >= 0) ? -1 : std::min(component, 1.0);
    }
  }
  color.rgba[3] = std::min(arguments.number("alpha", 1, color.rgba[3]), 1.0);
  return color;
}

}  // namespace graycube
