#include "formats/openscad/hull.hpp"

#include <algorithm>
#include <utility>

#include "formats/openscad/hulls/convex_hull.hpp"
#include "formats/openscad/language/matrix.hpp"
#include "formats/openscad/prism_sums.hpp"
#include "formats/openscad/round_pieces.hpp"
#include "formats/openscad/sweep.hpp"

namespace graycube {
namespace {

bool is_container(const std::string& name) {
  return name == "group" || name == "union" || name == "color" || name == "render" ||
         name == "hull";
}

/// Corners of convex solids, a row for each.
using CornerSets = std::vector<std::vector<Vec3>>;

bool corners_of_all(const std::vector<ScadModule>& modules, const Affine& map, ScadImport& import,
                    std::vector<Vec3>& corners) {
  for (const ScadModule& module : modules) {
    if (module.left_out || module.dimension == 2) continue;
    if (!corners_of(module, map, import, corners)) return false;
  }
  return true;
}

/// Appends the sums of each corner with each; false if they are too many.
bool add_sums(const std::vector<Vec3>& a, const std::vector<Vec3>& b, std::vector<Vec3>& sums) {
  if (sums.size() + a.size() * b.size() > kMaxFacetedSum) return false;
  for (const Vec3& p : a) {
    for (const Vec3& q : b) sums.push_back(p + q);
  }
  return true;
}

/// The hull of a sum is the sum of the hulls.
bool corners_of_sum(const ScadModule& module, const Affine& map, ScadImport& import,
                    std::vector<Vec3>& corners) {
  std::vector<Vec3> sum{Vec3{}};
  for (const ScadModule& child : module.children) {
    if (child.left_out || child.dimension == 2) continue;
    std::vector<Vec3> operand, next;
    if (!corners_of(child, {}, import, operand) || !add_sums(sum, operand, next)) return false;
    sum = std::move(next);
  }
  for (const Vec3& p : sum) corners.push_back(map.point(p));
  return true;
}

/// Adds the corners of the convex solids whose union the module is; false if it isn't known to be
/// one.
bool add_convex(const ScadModule& module, const Affine& map, ScadImport& import, CornerSets& sets) {
  if (module.left_out || module.dimension == 2) return true;
  const auto add_children = [&](const Affine& inner) {
    return std::all_of(
        module.children.begin(), module.children.end(),
        [&](const ScadModule& child) { return add_convex(child, inner, import, sets); });
  };
  if (module.name == "multmatrix") {
    const auto own = openscad_matrix(module, import.digits, import.report);
    return !own || add_children(compose(map, *own));
  }
  if (is_container(module.name) && module.name != "hull") return add_children(map);
  std::vector<RoundPiece> pieces;
  if (!add_pieces(module, {}, PieceUse::kConvex, import, pieces) || pieces.size() > 1) return false;
  return pieces.empty() || corners_of(module, map, import, sets.emplace_back());
}

/// The sums of each solid with each; false if they are too many.
bool add_to_sums(CornerSets& sums, const CornerSets& operand) {
  if (sums.size() * operand.size() > kMaxSumPieces) return false;
  CornerSets next;
  std::size_t corners = 0;
  for (const auto& a : sums) {
    for (const auto& b : operand) {
      corners += a.size() * b.size();
      if (corners > kMaxFacetedSum || !add_sums(a, b, next.emplace_back())) return false;
    }
  }
  sums = std::move(next);
  return true;
}

/// The corners of the convex solids whose union is the sum; none if they aren't known.
CornerSets sums_of(const ScadModule& module, ScadImport& import) {
  CornerSets sums;
  for (const ScadModule& child : module.children) {
    if (child.left_out || child.dimension == 2) continue;
    CornerSets operand;
    if (!add_convex(child, {}, import, operand)) return {};
    if (sums.empty()) {
      sums = std::move(operand);
    } else if (!add_to_sums(sums, operand)) {
      return {};
    }
  }
  return sums;
}

}  // namespace

bool corners_of(const ScadModule& module, const Affine& map, ScadImport& import,
                std::vector<Vec3>& corners) {
  if (is_container(module.name)) return corners_of_all(module.children, map, import, corners);
  if (module.name == "multmatrix") {
    const auto inner = openscad_matrix_of_corners(module, import.digits, import.report);
    return !inner || corners_of_all(module.children, compose(map, *inner), import, corners);
  }
  if (module.name == "linear_extrude" || module.name == "rotate_extrude") {
    std::vector<Vec3> own;
    sweep_corners(module, import, own);
    for (const Vec3& p : own) corners.push_back(map.point(p));
    return true;
  }
  if (module.name == "minkowski") return corners_of_sum(module, map, import, corners);
  if (!is_openscad_primitive(module)) return false;
  if (module.name == "polyhedron") {
    for (const Vec3& p : polyhedron_corners(module, import.report)) corners.push_back(map.point(p));
    return true;
  }
  if (module.name == "sphere" || module.name == "cylinder") {
    import.warn_of_sides("hull", module.line);
  }
  if (const auto solid = openscad_primitive(module, import.report, true)) {
    for (const Vec3& p : solid->corners) corners.push_back(map.point(p));
  }
  return true;
}

std::optional<ScadSolid> solid_hull(const ScadModule& module, const std::vector<Vec3>& corners,
                                    ScadImport& import) {
  ScadMesh mesh = convex_hull(corners);
  if (mesh.faces.empty()) {
    const auto is_far = [](const Vec3& p) { return !(max_abs(p) <= kMaxOpenscadCoordinate); };
    if (std::any_of(corners.begin(), corners.end(), is_far)) {
      import.report.leave_out(module.name + "() " + kBeyondReach, module.line,
                              module.name + "() is left out: " + kBeyondReach);
    } else {
      import.report.warning(module.line,
                            module.name + "() is left out: its corners lie in a plane");
    }
    return std::nullopt;
  }
  ScadArguments arguments(module, import.report);
  return polyhedral_solid(std::move(mesh), arguments, precision_of(import.digits));
}

std::optional<RoundSolid> faceted_sum(const ScadModule& module, ScadImport& import) {
  OpenscadReport unread;
  ScadImport silent{import.options, unread, import.delegate, import.digits, {},
                    import.figures, true};
  RoundSolid sum;
  OperationNode parts{Operation::kUnion, {}};
  for (const std::vector<Vec3>& corners : sums_of(module, silent)) {
    auto part = solid_hull(module, corners, silent);
    if (!part) return std::nullopt;
    parts.children.push_back(std::move(part->leaf));
    sum.corners.insert(sum.corners.end(), part->corners.begin(), part->corners.end());
  }
  if (parts.children.empty()) {
    auto prisms = faceted_prism_sum(module, silent);
    return prisms ? std::optional<RoundSolid>{{*std::move(prisms), {}}} : std::nullopt;
  }
  const bool is_one = parts.children.size() == 1;
  sum.node = is_one ? std::move(parts.children.front())
                    : CsgNode{std::move(parts), std::nullopt, kInheritMaterial};
  return sum;
}

}  // namespace graycube
