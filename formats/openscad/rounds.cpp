#include "formats/openscad/rounds.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "formats/openscad/flat/rounds.hpp"
#include "formats/openscad/hull.hpp"
#include "formats/openscad/hulls/convex_hull.hpp"
#include "formats/openscad/hulls/round_caps.hpp"
#include "formats/openscad/primitives.hpp"
#include "formats/openscad/prism_sums.hpp"
#include "formats/openscad/round_pieces.hpp"
#include "formats/openscad/sweep.hpp"

namespace graycube {
namespace {

/// How far centres on one axis may be off it, relative to the extent of all.
constexpr double kOnAxis = 1e-12;

CsgNode placed(CsgNode node, const Affine& map) {
  if (map == Affine{}) return node;
  node.transform = node.transform ? compose(map, *node.transform) : map;
  return node;
}

/// The figure right and left of the axis that becomes these balls and discs when it is turned;
/// empty if they have no common vertical axis.
std::vector<FlatDisk> profile_of(const RoundPiece& items, const FramedPiece& piece) {
  const Vec3 origin = piece.points.front().center;
  double extent = 0;
  for (const RoundPoint& p : piece.points)
    extent = std::max(extent, max_abs(p.center - origin) + p.radius);
  std::vector<FlatDisk> profile;
  for (std::size_t i = 0; i < items.size(); ++i) {
    const auto& [center, radius] = piece.points[i];
    if (std::max(std::fabs(center.x - origin.x), std::fabs(center.y - origin.y)) > kOnAxis * extent)
      return {};
    if (items[i].kind == RoundItem::Kind::kDisc) {
      profile.push_back({{radius, center.z}, 0, 0});
      profile.push_back({{-radius, center.z}, 0, 0});
    } else {
      profile.push_back({{0, center.z}, radius, 0});
    }
  }
  return profile;
}

ExactSolid turned_about(const std::vector<FlatDisk>& profile, const Vec3& axis, const Affine& frame,
                        ScadImport& import, int line) {
  auto solid = solid_of_profile(profile, import, line);
  if (!solid) return NoExactForm{};
  RoundSolid result{std::move(*solid), {}};
  if (axis.x != 0 || axis.y != 0)
    result.node = placed(std::move(result.node), translation({axis.x, axis.y, 0}));
  result.node = placed(std::move(result.node), frame);
  return result;
}

ExactSolid solid_of_points(const RoundPiece& items, const ScadModule& module, ScadImport& import) {
  std::vector<Vec3> corners;
  for (const RoundItem& item : items) corners.push_back(item.map.point(item.round.center));
  ScadMesh mesh = convex_hull(corners);
  if (mesh.faces.empty()) return EmptySolid{};
  ScadArguments arguments(module, import.report);
  auto solid = polyhedral_solid(std::move(mesh), arguments, precision_of(import.digits));
  if (!solid) return EmptySolid{};
  return RoundSolid{std::move(solid->leaf), std::move(solid->corners)};
}

ExactSolid in_frame(RoundSolid solid, const Affine& frame) {
  solid.node = placed(std::move(solid.node), frame);
  for (Vec3& corner : solid.corners) corner = frame.point(corner);
  return solid;
}

ExactSolid capped(const RoundPiece& items, const FramedPiece& piece) {
  std::vector<BallOrDisc> both;
  for (std::size_t i = 0; i < items.size(); ++i) {
    both.push_back({piece.points[i], items[i].kind == RoundItem::Kind::kDisc});
  }
  bool is_too_large = false;
  auto solid = capped_solid(both, is_too_large);
  if (!solid) return NoExactForm{};
  return in_frame(*std::move(solid), piece.frame);
}

ExactSolid solid_of(const RoundPiece& items, const ScadModule& module, ScadImport& import) {
  const bool is_round = std::any_of(items.begin(), items.end(), [](const RoundItem& item) {
    return item.kind != RoundItem::Kind::kPoint;
  });
  if (!is_round) return solid_of_points(items, module, import);
  const auto piece = framed(items);
  if (!piece) return NoExactForm{};
  if (piece->has_balls && piece->has_discs) {
    const auto profile = profile_of(items, *piece);
    if (profile.empty()) return capped(items, *piece);
    return turned_about(profile, piece->points.front().center, piece->frame, import, module.line);
  }
  bool is_too_large = false;
  const RoundKind kind = piece->has_balls ? RoundKind::kBalls : RoundKind::kDiscs;
  auto solid = round_solid(kind, piece->points, is_too_large);
  if (is_too_large) return NoExactForm{};
  if (!solid) return EmptySolid{};
  return in_frame(*std::move(solid), piece->frame);
}

ExactSolid united(const std::vector<RoundPiece>& pieces, const ScadModule& module,
                  ScadImport& import) {
  RoundSolid whole;
  std::vector<CsgNode> children;
  for (const RoundPiece& piece : pieces) {
    ExactSolid part = solid_of(piece, module, import);
    if (std::holds_alternative<NoExactForm>(part)) return part;
    auto* solid = std::get_if<RoundSolid>(&part);
    if (solid == nullptr) continue;
    children.push_back(std::move(solid->node));
    whole.corners.insert(whole.corners.end(), solid->corners.begin(), solid->corners.end());
  }
  if (children.empty()) return EmptySolid{};
  whole.node = children.size() == 1 ? std::move(children.front())
                                    : CsgNode{OperationNode{Operation::kUnion, std::move(children)},
                                              std::nullopt, kInheritMaterial};
  return whole;
}

/// The sum of a ball and a solid with an axis through its centre, or of two such, turned.
ExactSolid coaxial_sum(const ScadModule& module, ScadImport& import) {
  std::vector<RoundPiece> operands;
  for (const ScadModule& child : module.children) {
    if (child.left_out || child.dimension == 2) continue;
    if (!add_pieces(child, {}, PieceUse::kConvex, import, operands)) return NoExactForm{};
  }
  if (operands.size() != 2) return NoExactForm{};
  RoundPiece both = operands[0];
  both.insert(both.end(), operands[1].begin(), operands[1].end());
  const auto all = framed(both);
  if (!all) return NoExactForm{};
  const auto begin = all->points.begin(),
             middle = begin + static_cast<std::ptrdiff_t>(operands[0].size());
  const auto first = profile_of(operands[0], {all->frame, {begin, middle}, false, false});
  const auto second =
      profile_of(operands[1], {all->frame, {middle, all->points.end()}, false, false});
  std::vector<FlatDisk> sums;
  for (const FlatDisk& p : first) {
    for (const FlatDisk& q : second) {
      const FlatPoint center{p.center.x + q.center.x, p.center.y + q.center.y};
      sums.push_back({center, p.radius + q.radius, std::max(p.sides, q.sides)});
    }
  }
  if (sums.empty()) return NoExactForm{};
  return turned_about(sums, begin->center + middle->center, all->frame, import, module.line);
}

/// Makes an exact form; if there is none, no reports are left behind.
template <typename Make>
ExactSolid or_untold(ScadImport& import, const Make& make) {
  const OpenscadReport report = import.report;
  const auto told = import.told;
  ExactSolid result = make();
  if (std::holds_alternative<NoExactForm>(result)) {
    import.report = report;
    import.told = told;
  }
  return result;
}

ExactSolid exact_form(const ScadModule& module, ScadImport& import) {
  return module.name == "hull" ? exact_hull(module, import) : exact_minkowski(module, import);
}

}  // namespace

ExactSolid exact_hull(const ScadModule& module, ScadImport& import) {
  return or_untold(import, [&]() -> ExactSolid {
    std::vector<RoundPiece> pieces;
    if (!add_pieces(module, {}, PieceUse::kHull, import, pieces) || pieces.empty())
      return NoExactForm{};
    const bool is_round =
        std::any_of(pieces.front().begin(), pieces.front().end(),
                    [](const RoundItem& item) { return item.kind != RoundItem::Kind::kPoint; });
    return is_round ? solid_of(pieces.front(), module, import) : ExactSolid{NoExactForm{}};
  });
}

ExactSolid exact_minkowski(const ScadModule& module, ScadImport& import) {
  if (import.options.facets) return NoExactForm{};
  ExactSolid result = or_untold(import, [&]() -> ExactSolid {
    std::vector<RoundPiece> pieces;
    if (!add_pieces(module, {}, PieceUse::kConvex, import, pieces) || pieces.empty())
      return NoExactForm{};
    return united(pieces, module, import);
  });
  if (!std::holds_alternative<NoExactForm>(result)) return result;
  result = or_untold(import, [&] { return coaxial_sum(module, import); });
  if (!std::holds_alternative<NoExactForm>(result)) return result;
  return or_untold(import, [&]() -> ExactSolid {
    auto node = exact_prism_sum(module, import);
    return node ? ExactSolid{RoundSolid{std::move(*node), {}}} : ExactSolid{NoExactForm{}};
  });
}

bool ExactForms::has_form(const ScadModule& module) {
  const auto known = known_.find(&module);
  if (known != known_.end()) return !std::holds_alternative<NoExactForm>(known->second);
  OpenscadReport unread;
  ScadImport import{options_, unread, delegate_, digits_, {}, &figures_};
  ExactSolid solid = exact_form(module, import);
  const bool is_exact = !std::holds_alternative<NoExactForm>(solid);
  if (!unread.has_errors() && unread.take_warnings().empty())
    known_.emplace(&module, std::move(solid));
  return is_exact;
}

ExactSolid ExactForms::form(const ScadModule& module, ScadImport& import) const {
  const auto known = known_.find(&module);
  return known != known_.end() ? known->second : exact_form(module, import);
}

}  // namespace graycube
