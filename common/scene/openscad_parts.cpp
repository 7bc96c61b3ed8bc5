#include "scene/openscad_parts.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <optional>
#include <utility>

#include "scene/openscad_palette.hpp"
#include "scene/openscad_primitives.hpp"
#include "scene/read_scene.hpp"

namespace graycube {
namespace {

/// OpenSCAD writes matrices with six digits, so a rotation's columns are off by this much in length
/// and angle.
constexpr double kRotationPrecision = 2e-6;
/// The largest difference of levels between a part and its object: a union around all parts.
constexpr std::uint32_t kMaxPartLevels = kMaxTreeDepth - 1;

/// The factor of a similarity, as far as the written digits tell.
std::optional<double> written_similarity(const Affine& map) {
  std::array<Vec3, 3> column;
  for (std::size_t j = 0; j < 3; ++j) column[j] = {map.m[0][j], map.m[1][j], map.m[2][j]};
  const double scale = (length(column[0]) + length(column[1]) + length(column[2])) / 3;
  for (std::size_t j = 0; j < 3; ++j) {
    const double shear = std::fabs(dot(column[j], column[(j + 1) % 3]));
    if (!(std::fabs(length(column[j]) - scale) <= kRotationPrecision * scale)) return std::nullopt;
    if (!(shear <= kRotationPrecision * scale * scale)) return std::nullopt;
  }
  return scale;
}

struct Surroundings {
  Affine to_world;
  ScadColor color;
  bool transformed = false;
};

CsgNode operation(Operation kind, std::vector<CsgNode> children) {
  return {OperationNode{kind, std::move(children)}, std::nullopt, kInheritMaterial};
}

/// Takes the parts from number `from` on away.
std::vector<Part> taken_from(std::vector<Part>& parts, std::size_t from) {
  const auto begin = parts.begin() + static_cast<std::ptrdiff_t>(from);
  std::vector<Part> taken(std::make_move_iterator(begin), std::make_move_iterator(parts.end()));
  parts.erase(begin, parts.end());
  return taken;
}

const char* why_unsupported(const std::string& name) {
  if (name == "hull" || name == "minkowski" || name == "resize" || name == "roof") {
    return " needs meshes of its children, which are not supported yet";
  }
  if (name == "linear_extrude" || name == "rotate_extrude") {
    return " of 2-D shapes is not supported yet";
  }
  if (name == "square" || name == "circle" || name == "polygon" || name == "text" ||
      name == "projection" || name == "offset" || name == "fill") {
    return " is two-dimensional, which is not supported yet";
  }
  if (name == "import" || name == "surface") return " of another file is not supported yet";
  return " is not a module of .csg files; write them with `openscad -o MODEL.csg MODEL.scad`";
}

class Importer {
 public:
  Importer(const ReachDirections& directions, OpenscadReport& report)
      : directions_(directions), report_(report) {}

  /// Appends the operands of the union of `modules`.
  void add_all(const std::vector<ScadModule>& modules, const Surroundings& around,
               std::vector<Part>& parts) {
    for (const ScadModule& module : modules) add(module, around, parts);
  }
  std::vector<NamedMaterial> take_materials() { return palette_.take(); }

 private:
  void add(const ScadModule& module, const Surroundings& around, std::vector<Part>& parts) {
    if (module.left_out) return;
    const std::string& name = module.name;
    if (name == "group" || name == "union" || name == "render") {
      add_all(module.children, around, parts);
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
    } else {
      report_.error(module.line, name.substr(0, kMaxQuotedName) + "()" + why_unsupported(name));
    }
  }

  void add_transformed(const ScadModule& module, const Surroundings& around,
                       std::vector<Part>& parts) {
    const std::optional<Affine> map = openscad_matrix(module, report_);
    if (!map) return;
    Surroundings inner = around;
    inner.to_world = compose(around.to_world, *map);
    inner.transformed = inner.to_world != Affine{};
    if (!inner.to_world.inverse()) {
      report_.warning(
          module.line,
          "multmatrix() is left out: with those around it, it flattens everything in it");
      return;
    }
    add_all(module.children, inner, parts);
  }

  void add_colored(const ScadModule& module, const Surroundings& around, std::vector<Part>& parts) {
    const std::optional<ScadColor> color = openscad_color(module, report_);
    if (!color) return;
    Surroundings inner = around;
    if (!around.color.is_valid()) inner.color = *color;
    add_all(module.children, inner, parts);
  }

  /// Operands are gathered at the end of `parts`, where those of a difference that takes nothing
  /// off are already in place: dissolving it costs nothing, however deep such operations nest.
  void add_difference(const ScadModule& module, const Surroundings& around,
                      std::vector<Part>& parts) {
    const std::size_t first = parts.size();
    std::size_t rest = first;
    bool is_first = true;
    for (const ScadModule& child : module.children) {
      if (child.left_out) continue;
      add(child, around, parts);
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
      add(child, around, parts);
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
      report_.error(module.line,
                    "more than " + std::to_string(kMaxPartLevels) + " levels of operations");
      return;
    }
    result.node = operation(kind, std::move(children));
    parts.push_back(std::move(result));
  }

  void add_primitive(const ScadModule& module, const Surroundings& around,
                     std::vector<Part>& parts) {
    std::optional<ScadSolid> solid = openscad_primitive(module, report_);
    if (!solid) return;
    const Reach reach = reach_of(solid->leaf, solid->corners, around.to_world, directions_);
    const Aabb box = reach.box();
    if (!(std::max(max_abs(box.lo), max_abs(box.hi)) <= kMaxOpenscadCoordinate)) {
      report_.error(module.line, module.name + "() reaches beyond the largest coordinate, 1e30");
      return;
    }
    const Vec3 extent = box.hi - box.lo;
    if (std::min(extent.x, std::min(extent.y, extent.z)) < 1 / kMaxOpenscadCoordinate) {
      report_.warning(module.line, module.name + "() is left out: it is too thin to be seen");
      return;
    }
    place(solid->leaf, around);
    solid->leaf.material = palette_.index_of(around.color);
    parts.push_back({std::move(solid->leaf), reach, 1, module.line, module.name});
  }

  /// Spheres under rotations stay spheres, though the written digits make them ellipsoids by a
  /// hair.
  static void place(CsgNode& leaf, const Surroundings& around) {
    if (!around.transformed) return;
    auto* sphere = std::get_if<SphereShape>(&leaf.value);
    const std::optional<double> scale =
        sphere != nullptr ? written_similarity(around.to_world) : std::nullopt;
    if (scale) {
      *sphere = {around.to_world.point(sphere->center), *scale * sphere->radius};
    } else {
      leaf.transform = around.to_world;
    }
  }

  static constexpr std::size_t kMaxQuotedName = 40;

  ReachDirections directions_;
  OpenscadReport& report_;
  OpenscadPalette palette_;
};

}  // namespace

OpenscadParts openscad_parts(const std::vector<ScadModule>& modules,
                             const ReachDirections& directions, OpenscadReport& report) {
  Importer importer(directions, report);
  OpenscadParts result;
  importer.add_all(modules, {}, result.parts);
  result.materials = importer.take_materials();
  return result;
}

Reach reach_of(const std::vector<Part>& parts) {
  Reach reach = Reach::nothing();
  for (const Part& part : parts) reach = union_of(reach, part.reach);
  return reach;
}

Part united(std::vector<Part> parts) {
  if (parts.size() == 1) return std::move(parts.front());
  Part result{{}, reach_of(parts), 0, parts.front().line, "union"};
  std::vector<CsgNode> children;
  for (Part& part : parts) {
    result.levels = std::max(result.levels, part.levels + 1);
    children.push_back(std::move(part.node));
  }
  result.node = operation(Operation::kUnion, std::move(children));
  return result;
}

}  // namespace graycube
