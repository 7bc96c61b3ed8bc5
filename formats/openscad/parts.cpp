#include "formats/openscad/parts.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <optional>
#include <utility>

#include "formats/openscad/flat/shape.hpp"
#include "formats/openscad/hull.hpp"
#include "formats/openscad/language/known_arguments.hpp"
#include "formats/openscad/language/matrix.hpp"
#include "formats/openscad/language/module_kinds.hpp"
#include "formats/openscad/primitives.hpp"
#include "formats/openscad/program/by_program.hpp"
#include "formats/openscad/rounds.hpp"
#include "formats/openscad/surroundings.hpp"
#include "formats/openscad/sweep.hpp"
#include "formats/view/palette.hpp"
#include "scene/limits.hpp"

namespace graycube {
namespace {

/// The most levels of a part: its object may have one more, a union around all parts.
constexpr std::uint32_t kMaxPartLevels = kMaxTreeDepth - 1;

/// Half the thickness of a flat shape, and what that of its tools has more.
constexpr double kHalfSlab = 0.5, kToolSlab = 0.25;

/// A map of the plane that leaves heights alone.
Affine lifted(const FlatMap& map) {
  const auto& m = map.m;
  return {{{{m[0][0], m[0][1], 0, m[0][2]}, {m[1][0], m[1][1], 0, m[1][2]}, {0, 0, 1, 0}}}};
}

CsgNode operation(Operation kind, std::vector<CsgNode> children) {
  return {OperationNode{kind, std::move(children)}, std::nullopt, kInheritMaterial};
}

/// Removes the parts from number `from` on, and returns them.
std::vector<Part> taken_from(std::vector<Part>& parts, std::size_t from) {
  const auto begin = parts.begin() + static_cast<std::ptrdiff_t>(from);
  std::vector<Part> taken(std::make_move_iterator(begin), std::make_move_iterator(parts.end()));
  parts.erase(begin, parts.end());
  return taken;
}

class Importer {
 public:
  Importer(ScadImport import, const ExactForms& forms, const FacetedRounds& faceted,
           bool keeps_apart)
      : directions_(reach_directions(import.options.frame)),
        report_(import.report),
        import_(std::move(import)),
        forms_(forms),
        faceted_(faceted),
        keeps_apart_(keeps_apart) {}

  /// Appends the operands of the union of `modules`.
  void add_all(const std::vector<ScadModule>& modules, const Surroundings& around,
               std::vector<Part>& parts) {
    const int dimension = dimension_of(modules);
    const auto is_left = [](const ScadModule& module) { return !module.left_out; };
    Surroundings inner = around;
    inner.is_around_all =
        around.is_around_all && std::count_if(modules.begin(), modules.end(), is_left) == 1;
    for (const ScadModule& module : modules) {
      if (fits(module, dimension)) add(module, inner, parts);
    }
  }
  std::optional<Affine> around_all() const { return around_all_; }
  std::vector<NamedMaterial> take_materials() { return palette_.take(); }

 private:
  void add(const ScadModule& module, const Surroundings& around, std::vector<Part>& parts) {
    if (module.left_out || solid_count_ > kMaxOpenscadSolids) return;
    const std::string& name = module.name;
    if (around.is_around_all && !is_gathering(name)) {
      Surroundings inner = around;
      inner.is_around_all = false;
      return add(module, inner, parts);
    }
    // No shape is in it, unless there is a module that isn't known.
    if (is_empty_without_shapes(name) && module.dimension == 0)
      return add_all(module.children, around, parts);
    if (module.dimension == 2 && !is_gathering(name) && !is_colored_operation(module)) {
      add_slab(module, around, parts);
    } else if (name == "group" || name == "union") {
      add_all(module.children, around, parts);
    } else if (name == "render") {
      Surroundings inner = around;
      inner.is_one_solid = true;
      add_all(module.children, inner, parts);
    } else if (name == "multmatrix") {
      add_transformed(module, around, parts);
    } else if (name == "color") {
      add_colored(module, around, parts);
    } else if (name == "difference") {
      add_difference(module, around, parts);
    } else if (name == "intersection") {
      add_intersection(module, around, parts);
    } else if (is_openscad_primitive(module)) {
      add_primitive(module, around, parts);
    } else if (is_extrusion(name)) {
      add_sweep(module, around, parts);
    } else if (name == "hull") {
      add_hull(module, around, parts);
    } else if (name == "minkowski") {
      add_sum(module, around, parts);
    } else if (is_for_program(name)) {
      add_by_program(module, around, parts);
    } else {
      report_.error(module.line,
                    name.substr(0, kMaxQuotedName) +
                        "() is not a module of .csg files; write them with `openscad -o "
                        "MODEL.csg MODEL.scad`");
    }
  }

  /// OpenSCAD doesn't mix dimensions: modules of another one than the first's are left out.
  bool fits(const ScadModule& module, int dimension) {
    if (module.left_out || module.dimension == 0 || module.dimension == dimension) return true;
    report_.warning(module.line, module.name + "() is left out: flat shapes and solids don't mix");
    return false;
  }

  void add_transformed(const ScadModule& module, const Surroundings& around,
                       std::vector<Part>& parts) {
    const bool is_flat = module.dimension == 2;
    const auto flat = is_flat ? flat_matrix(module, import_.digits, report_) : std::nullopt;
    const std::optional<Affine> map = flat      ? lifted(*flat)
                                      : is_flat ? std::nullopt
                                                : openscad_matrix(module, import_.digits, report_);
    if (!map) return;
    Surroundings inner = around;
    inner.to_world = compose(around.to_world, *map);
    if (!inner.to_world.inverse()) {
      report_.warning(
          module.line,
          "multmatrix() is left out: with those around it, it flattens everything in it");
      return;
    }
    if (around.is_around_all) around_all_ = inner.to_world;
    if (!around.is_around_all || !keeps_apart_) inner.to_rest = compose(around.to_rest, *map);
    add_all(module.children, inner, parts);
  }

  void add_colored(const ScadModule& module, const Surroundings& around, std::vector<Part>& parts) {
    const ScadColor color = openscad_color(module, report_);
    Surroundings inner = around;
    if (!around.color.is_valid() && !around.is_one_solid) inner.color = color;
    add_all(module.children, inner, parts);
  }

  /// Operands are gathered at the end of `parts`. If the difference subtracts nothing, its operands
  /// are in place there already: dissolving it costs nothing, however deep such operations nest.
  void add_difference(const ScadModule& module, const Surroundings& around,
                      std::vector<Part>& parts) {
    const std::size_t first = parts.size();
    std::size_t rest = first;
    bool is_first = true;
    for (const ScadModule& child : module.children) {
      if (child.left_out || !fits(child, module.dimension)) continue;
      add(child, is_first ? around : around.of_tool(), parts);
      if (std::exchange(is_first, false)) rest = parts.size();
    }
    if (rest == first) taken_from(parts, first);
    if (rest == parts.size()) return;
    std::vector<Part> used = taken_from(parts, rest);
    used.insert(used.begin(), united(taken_from(parts, first)));
    const Reach reach = used.front().reach;
    add_operation(Operation::kDifference, module, std::move(used), reach, parts);
  }

  void add_intersection(const ScadModule& module, const Surroundings& around,
                        std::vector<Part>& parts) {
    const auto takes_part = [](const ScadModule& child) { return !child.left_out; };
    const auto count = std::count_if(module.children.begin(), module.children.end(), takes_part);
    if (count == 1) {
      add_all(module.children, around, parts);
      return;
    }
    std::vector<Part> used;
    bool has_empty = count == 0;
    for (const ScadModule& child : module.children) {
      if (child.left_out) continue;
      const std::size_t first = parts.size();
      // What doesn't fit is nothing, and so is what it is intersected with.
      if (fits(child, module.dimension)) add(child, around, parts);
      if (parts.size() == first) {
        has_empty = true;
      } else {
        used.push_back(united(taken_from(parts, first)));
      }
    }
    if (has_empty) return;
    Reach reach = used.front().reach;
    for (const Part& part : used) reach = intersection_of(reach, part.reach);
    if (reach.box().is_empty()) {
      report_.warning(module.line,
                      "intersection() is left out: its operands have no point in common");
      return;
    }
    add_operation(Operation::kIntersection, module, std::move(used), reach, parts);
  }

  void add_operation(Operation kind, const ScadModule& module, std::vector<Part> used,
                     const Reach& reach, std::vector<Part>& parts) {
    Part result{{}, reach, 0, module.line, module.name};
    std::vector<CsgNode> children;
    for (Part& part : used) {
      result.levels = std::max(result.levels, part.levels + 1);
      children.push_back(std::move(part.node));
    }
    if (result.levels > kMaxPartLevels) {
      leave_out_deep(module);
      return;
    }
    result.node = operation(kind, std::move(children));
    parts.push_back(std::move(result));
  }

  void add_primitive(const ScadModule& module, const Surroundings& around,
                     std::vector<Part>& parts) {
    const bool facets = import_.options.facets || faceted_.touch(module, around.to_world);
    std::optional<ScadSolid> solid = openscad_primitive(module, report_, facets, import_.digits);
    if (solid) add_solid(std::move(solid->leaf), solid->corners, module, around, parts);
  }

  void add_sweep(const ScadModule& module, const Surroundings& around, std::vector<Part>& parts) {
    std::optional<CsgNode> solid;
    std::optional<PlainSweep> sweep;
    if (faceted_.change_figure(module, around.to_world)) {
      if (!plain_sweep(module, import_, sweep) || !sweep) return;
      const FlatShape figure =
          faceted_.with_facets(std::move(sweep->shape), around.to_world, import_, module.line);
      solid = extruded(figure, sweep->low, sweep->high, import_, module.line);
      if (solid) faceted_.move_prisms(*solid, around.to_world);
    } else {
      solid = faceted_.touch(module, around.to_world) ? faceted_sweep(module, import_)
                                                      : openscad_sweep(module, import_);
    }
    if (solid) add_solid(std::move(*solid), {}, module, around, parts);
  }

  /// Adds a flat shape as a slab, as OpenSCAD's preview shows it.
  void add_slab(const ScadModule& module, const Surroundings& around, std::vector<Part>& parts) {
    import_.warn_once(module.line, "flat shapes that nothing extrudes are shown one unit thick");
    auto shape = flat_shape(module, {}, import_);
    if (!shape) return;
    shape = faceted_.with_facets(*std::move(shape), around.to_world, import_, module.line);
    const double half = kHalfSlab + kToolSlab * around.cuts;
    auto solid = extruded(*shape, -half, half, import_, module.line);
    if (solid) add_solid(std::move(*solid), {}, module, around, parts);
  }

  /// Adds the module's exact form; false if there is none.
  bool add_exact(const ScadModule& module, ExactSolid exact, const Surroundings& around,
                 std::vector<Part>& parts) {
    if (std::holds_alternative<NoExactForm>(exact)) return false;
    if (auto* solid = std::get_if<RoundSolid>(&exact)) {
      add_solid(std::move(solid->node), solid->corners, module, around, parts);
    } else {
      report_.warning(module.line, module.name + "() is left out: it encloses no volume");
    }
    return true;
  }

  void add_hull(const ScadModule& module, const Surroundings& around, std::vector<Part>& parts) {
    const bool is_flush = faceted_.touch(module, around.to_world);
    if (!is_flush && add_exact(module, forms_.form(module, import_), around, parts)) return;
    std::vector<Vec3> corners;
    if (!corners_of(module, {}, import_, corners)) {
      const bool is_alone = is_flush && !import_.delegate.is_there();
      if (is_alone && add_exact(module, forms_.form(module, import_), around, parts)) return;
      return add_by_program(module, around, parts);
    }
    auto solid = solid_hull(module, corners, import_);
    if (solid) add_solid(std::move(solid->leaf), solid->corners, module, around, parts);
  }

  void add_sum(const ScadModule& module, const Surroundings& around, std::vector<Part>& parts) {
    if (faceted_.touch(module, around.to_world)) {
      if (auto sum = faceted_sum(module, import_)) {
        faceted_.move_prisms(sum->node, around.to_world);
        return add_solid(std::move(sum->node), sum->corners, module, around, parts);
      }
      if (import_.delegate.is_there()) return add_by_program(module, around, parts);
    }
    if (!add_exact(module, forms_.form(module, import_), around, parts))
      add_by_program(module, around, parts);
  }

  void add_by_program(const ScadModule& module, const Surroundings& around,
                      std::vector<Part>& parts) {
    std::optional<PolygonMesh> mesh = solid_by_program(module, import_);
    if (!mesh) return;
    if (mesh->face_ends.empty() && is_newer_than_2021(module.name)) {
      return report_.leave_out(module.name + "() by openscad", module.line,
                               module.name + "() is left out: this openscad doesn't know it");
    }
    faceted_.move_corners(mesh->points, around.to_world);
    auto solid = mesh_leaf(*mesh, module, report_);
    if (solid) add_solid(std::move(*solid), {}, module, around, parts);
  }

  /// Adds a solid. `corners` are those of all polyhedra in it, in the module's coordinates.
  void add_solid(CsgNode solid, std::span<const Vec3> corners, const ScadModule& module,
                 const Surroundings& around, std::vector<Part>& parts) {
    Reach reach = reach_of(solid, corners, around.to_world, directions_);
    if (solid.transform || std::holds_alternative<OperationNode>(solid.value)) {
      const CsgNode all_corners{PolyhedronShape{}, std::nullopt, kInheritMaterial};
      reach = union_of(reach_of(solid, {}, around.to_world, directions_),
                       reach_of(all_corners, corners, around.to_world, directions_));
    }
    const Aabb box = reach.box();
    if (!(std::max(max_abs(box.lo), max_abs(box.hi)) <= kMaxOpenscadCoordinate)) {
      return leave_out_far(module);
    }
    const Vec3 extent = box.hi - box.lo;
    if (std::min(extent.x, std::min(extent.y, extent.z)) < 1 / kMaxOpenscadCoordinate) {
      report_.warning(module.line, module.name + "() is left out: it is too thin to be seen");
      return;
    }
    if (!counts(module)) return;
    const std::uint32_t levels = levels_of(solid);
    if (levels > kMaxPartLevels) {
      return leave_out_deep(module);
    }
    solid = placed(std::move(solid), around.to_rest);
    solid.material = palette_.index_of(around.color, around.face);
    parts.push_back({std::move(solid), reach, levels, module.line, module.name});
  }

  /// Whether the model may have one more solid; the first one too many is an error.
  bool counts(const ScadModule& module) {
    if (++solid_count_ <= kMaxOpenscadSolids) return true;
    if (solid_count_ == kMaxOpenscadSolids + 1) {
      report_.error(module.line,
                    "more than " + std::to_string(kMaxOpenscadSolids) + " solids in a model");
    }
    return false;
  }

  void leave_out(const ScadModule& module, const std::string& why) {
    report_.leave_out(module.name + "() " + why, module.line,
                      module.name + "() is left out: " + why);
  }
  void leave_out_far(const ScadModule& module) { leave_out(module, kBeyondReach); }
  void leave_out_deep(const ScadModule& module) {
    leave_out(module,
              "it has more than " + std::to_string(kMaxPartLevels) + " levels of operations");
  }

  static constexpr std::size_t kMaxQuotedName = 40;

  ReachDirections directions_;
  OpenscadReport& report_;
  ScadImport import_;
  const ExactForms& forms_;
  const FacetedRounds& faceted_;
  bool keeps_apart_;
  std::size_t solid_count_ = 0;
  Palette palette_;
  std::optional<Affine> around_all_;
};

}  // namespace

OpenscadModules::OpenscadModules(const std::vector<ScadModule>& modules,
                                 const OpenscadOptions& options, std::uint32_t digits,
                                 OpenscadDelegate& delegate)
    : modules_(modules),
      options_(options),
      digits_(digits),
      delegate_(delegate),
      forms_(options, delegate_, digits, figures_),
      faceted_(modules, options, digits, delegate_, figures_, forms_) {}

OpenscadParts OpenscadModules::parts(bool keeps_apart, OpenscadReport& report) {
  Importer importer({options_, report, delegate_, digits_, {}, &figures_}, forms_, faceted_,
                    keeps_apart);
  OpenscadParts result;
  Surroundings none;
  none.is_around_all = true;
  warn_of_unknown_arguments(modules_, report);
  importer.add_all(modules_, none, result.parts);
  result.materials = importer.take_materials();
  result.around_all = importer.around_all();
  return result;
}

}  // namespace graycube
