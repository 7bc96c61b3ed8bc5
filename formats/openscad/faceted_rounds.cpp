#include "formats/openscad/faceted_rounds.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "formats/openscad/language/module_kinds.hpp"
#include "formats/openscad/program/by_program.hpp"
#include "formats/openscad/sweep.hpp"
#include "scene/flat_solids.hpp"

namespace graycube {
namespace {

/// How many passes follow chains of hulls that touch each other's facets.
constexpr int kMostPasses = 8;
/// Most corners and edges of facets that are kept, and most that all rounds are compared with.
constexpr std::size_t kMostFacetEdges = std::size_t{1} << 23;
constexpr std::size_t kMostCompared = std::size_t{1} << 28;
/// Most corners of the rounds that get facets, and of those that could follow them.
constexpr std::size_t kMostRingCorners = std::size_t{1} << 22;

/// Whether an extrusion may grow or shrink.
bool is_taper(const ScadModule& module) {
  return module.name == "linear_extrude" && module.argument("scale") != nullptr;
}

/// Whether a module, if it has no exact form, is of facets; or one within is. Asked first, since
/// matrices take long to read: their rotations are recovered.
bool may_have_facets(const ScadModule& module) {
  // A shadow is seldom flush with what throws it.
  if (module.name == "projection") return false;
  return module.name == "hull" || module.name == "minkowski" || module.name == "offset" ||
         is_for_program(module.name) || is_taper(module) ||
         std::any_of(module.children.begin(), module.children.end(), may_have_facets);
}

/// The figure of a flat shape, or of an upright extrusion.
std::optional<FlatShape> upright_figure(const ScadModule& solid, ScadImport& import) {
  if (solid.dimension == 2) return flat_shape(solid, {}, import);
  std::optional<PlainSweep> sweep;
  if (solid.name != "linear_extrude" || !plain_sweep(solid, import, sweep) || !sweep ||
      !(sweep->scale == FlatPoint{1, 1}))
    return std::nullopt;
  return std::move(sweep->shape);
}

/// Calls visit(outlines) for each polygon of a figure, but for those that belong to something
/// round.
template <typename Visit>
void for_each_outline(const FlatShape& figure, const Visit& visit) {
  if (!figure.facets.empty()) return;
  if (figure.kind == FlatShape::Kind::kPolygon) visit(figure.loops);
  for (const FlatShape& child : figure.children) for_each_outline(child, visit);
}

/// Whether an extrusion becomes a mesh because it grows or shrinks.
bool is_faceted_taper(const ScadModule& solid, ScadImport& import) {
  std::optional<PlainSweep> sweep;
  return is_taper(solid) && plain_sweep(solid, import, sweep) && sweep &&
         !(sweep->scale == FlatPoint{1, 1}) && !is_exact_taper(*sweep);
}

std::size_t corners_of(const RoundGroup& group) {
  std::size_t corners = 0;
  for (const RoundRing& ring : group) corners += ring.corners.size() + ring.profile.size();
  return corners;
}

}  // namespace

/// A solid whose rounds get facets together.
struct FacetedRounds::Solid {
  const ScadModule* module;
  Affine to_world;
};

FacetedRounds::FacetedRounds(const std::vector<ScadModule>& modules, const OpenscadOptions& options,
                             std::uint32_t digits, OpenscadDelegate& delegate, KeptFigures& figures,
                             ExactForms& forms)
    : options_(options),
      digits_(digits),
      delegate_(delegate),
      figures_(figures),
      forms_(forms),
      share_(placing_share(digits)),
      compared_left_(kMostCompared) {
  if (options.facets || std::none_of(modules.begin(), modules.end(), may_have_facets)) return;
  const auto for_all = [&](const auto& visit) {
    for (const ScadModule& module : modules) for_each_solid(module, {}, digits, visit);
  };
  std::vector<Solid> solids;
  for_all(
      [&](const ScadModule& solid, const Affine& to_world) { look_at(solid, to_world, solids); });
  if (!facets_.empty() || !tapers_.empty()) {
    for_all([&](const ScadModule& solid, const Affine& to_world) { add_flush(solid, to_world); });
    facets_.clear();
    tapers_.clear();
  }
  if (!rings_.empty()) spread(solids);
}

/// Takes down a solid's facets, and a solid whose rounds get facets together.
void FacetedRounds::look_at(const ScadModule& solid, const Affine& to_world,
                            std::vector<Solid>& solids) {
  const std::string& name = solid.name;
  if (solid.dimension == 0) return;  // nothing is in it
  if (solid.dimension == 2 || name == "linear_extrude") {
    if (!may_have_facets(solid)) return;
    OpenscadReport unread;
    ScadImport import{options_, unread, delegate_, digits_, {}, &figures_, true};
    if (const auto figure = upright_figure(solid, import)) add_outlines(*figure, to_world);
    if (is_faceted_taper(solid, import)) add_taper(solid, to_world);
    solids.push_back({&solid, to_world});
  } else if (name == "rotate_extrude") {
    if (may_have_facets(solid)) add_turned_outlines(solid, to_world);
    solids.push_back({&solid, to_world});
  } else if (name == "hull" || name == "minkowski") {
    if (forms_.has_form(solid)) {
      solids.push_back({&solid, to_world});
    } else if (name == "minkowski") {
      add_mesh(solid, to_world);
    } else {
      for (const RoundGroup& group : groups_of(solid, to_world)) add(group);
    }
  } else if (is_for_program(name)) {
    add_mesh(solid, to_world);
  }
}

bool FacetedRounds::is_room_for(std::size_t size) const {
  for (const FacetEdges& facets : facets_) size += facets.size();
  return size <= kMostFacetEdges;
}

void FacetedRounds::add_mesh(const ScadModule& solid, const Affine& to_world) {
  OpenscadReport unread;
  ScadImport import{options_, unread, delegate_, digits_, {}};
  const std::optional<PolygonMesh> mesh = solid_by_program(solid, import);
  if (!mesh) return;
  if (is_room_for(mesh->points.size() + mesh->corners.size()))
    facets_.emplace_back(*mesh, to_world);
}

/// Takes down the polygons of a figure that is extruded.
void FacetedRounds::add_outlines(const FlatShape& figure, const Affine& to_world) {
  for_each_outline(figure, [&](const FlatLoops& loops) { facets_.emplace_back(loops, to_world); });
}

/// Takes down the polygons of a figure that is turned, but for those that belong to something
/// round.
void FacetedRounds::add_turned_outlines(const ScadModule& solid, const Affine& to_world) {
  OpenscadReport unread;
  ScadImport import{options_, unread, delegate_, digits_, {}, &figures_, true};
  const auto turn = round_turn(solid, import);
  if (!turn) return;
  FlatLoops outlines;
  std::size_t corners = 0;
  for_each_outline(turn->shape, [&](const FlatLoops& loops) {
    for (const FlatLoop& loop : loops) corners += loop.size();
    outlines.insert(outlines.end(), loops.begin(), loops.end());
  });
  const RingAngles angles = turn_ring(turn->start, turn->angle, turn->steps);
  if (is_room_for(2 * corners * angles.degrees.size()))
    facets_.emplace_back(outlines, angles, to_world);
}

/// Takes down the cones of an extrusion that is a mesh.
void FacetedRounds::add_taper(const ScadModule& solid, const Affine& to_world) {
  tapered_.insert(&solid);
  std::size_t corners = 0;
  for (RoundGroup& group : groups_of(solid, to_world)) {
    corners += corners_of(group);
    if (corners > kMostRingCorners) return;
    for (RoundRing& ring : group) {
      const std::size_t count = ring.corners.size();
      tapers_.emplace(count, std::move(ring));
    }
  }
}

/// Whether a facet of a round is among those taken down.
bool FacetedRounds::is_facet_there(const RoundRing& ring) {
  return has(tapers_, ring) ||
         std::any_of(facets_.begin(), facets_.end(), [&](const FacetEdges& facets) {
           if (!facets.are_near(ring) || facets.size() > compared_left_) return false;
           compared_left_ -= facets.size();
           return facets.have_one_of(ring, share_);
         });
}

/// Adds those of a solid's rounds that are flush with facets taken down.
void FacetedRounds::add_flush(const ScadModule& solid, const Affine& to_world) {
  if (tapered_.contains(&solid)) return;
  for (RoundGroup& group : groups_of(solid, to_world)) {
    for (RoundRing& ring : group) {
      if (!has(rings_, ring) && is_facet_there(ring)) add({std::move(ring)});
    }
  }
}

/// Gives facets to everything that gets them together with what has them already.
void FacetedRounds::spread(std::vector<Solid>& solids) {
  std::vector<RoundGroup> groups;
  std::size_t corners = 0;
  for (const Solid& solid : solids) {
    for (RoundGroup& group : groups_of(*solid.module, solid.to_world)) {
      corners += corners_of(group);
      if (corners > kMostRingCorners) break;
      if (group.size() > 1) groups.push_back(std::move(group));
    }
  }
  bool has_grown = true;
  for (int pass = 0; has_grown && pass < kMostPasses; ++pass) {
    has_grown = false;
    for (RoundGroup& group : groups) {
      if (!has_any(group)) continue;
      add(group);
      group.clear();
      has_grown = true;
    }
  }
}

std::vector<RoundGroup> FacetedRounds::groups_of(const ScadModule& solid,
                                                 const Affine& to_world) const {
  // OpenSCAD's own mesh has all facets already.
  if (solid.name == "minkowski" && solid.dimension == 3 && !forms_.has_form(solid)) return {};
  OpenscadReport unread;
  ScadImport import{options_, unread, delegate_, digits_, {}, &figures_, true};
  return round_groups(solid, to_world, import);
}

bool FacetedRounds::touch(const ScadModule& module, const Affine& to_world) const {
  if (rings_.empty()) return false;
  const std::vector<RoundGroup> groups = groups_of(module, to_world);
  return std::any_of(groups.begin(), groups.end(),
                     [&](const RoundGroup& group) { return has_any(group); });
}

bool FacetedRounds::change_figure(const ScadModule& module, const Affine& to_world) const {
  if (rings_.empty()) return false;
  OpenscadReport unread;
  ScadImport import{options_, unread, delegate_, digits_, {}, &figures_, true};
  if (module.dimension != 3 || !upright_figure(module, import)) return false;
  return may_have_facets(module) || touch(module, to_world);
}

void FacetedRounds::move_corners(std::vector<Vec3>& points, const Affine& to_world,
                                 bool flat) const {
  const auto back = to_world.inverse();
  if (rings_.empty() || points.empty() || !back) return;
  std::vector<Vec3> moved;
  double largest = 0;
  for (const Vec3& p : points) {
    moved.push_back(to_world.point(p));
    largest = std::max(largest, max_abs(moved.back()));
  }
  const Vec3 up = normalized(to_world.vector({0, 0, 1}));
  std::size_t left = kMostCompared;
  for (const auto& [count, ring] : rings_) {
    const bool is_upright =
        ring.kind == RoundRing::Kind::kCylinder && max_abs(across(ring.along, up)) <= share_;
    if ((flat && !is_upright) || points.size() > left) continue;
    left -= points.size();
    move_to_corners(ring, kHalfOfSixDigits * largest, moved);
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    // What isn't moved keeps its bits.
    if (moved[i] == to_world.point(points[i])) continue;
    const Vec3 p = back->point(moved[i]);
    points[i] = flat ? Vec3{p.x, p.y, 0} : p;
  }
}

void FacetedRounds::move_prisms(CsgNode& solid, const Affine& to_world) const {
  if (auto* inner = std::get_if<OperationNode>(&solid.value)) {
    for (CsgNode& child : inner->children) move_prisms(child, to_world);
  }
  auto* prism = std::get_if<PrismShape>(&solid.value);
  if (prism == nullptr || rings_.empty()) return;
  std::vector<Vec3> corners;
  for (const FlatPoint& p : prism->points) corners.push_back({p.x, p.y, 0});
  move_corners(corners, to_world, true);
  PrismShape moved = *prism;
  for (std::size_t i = 0; i < corners.size(); ++i) moved.points[i] = {corners[i].x, corners[i].y};
  // A sliver could lose its area.
  if (prism_of(moved)) *prism = std::move(moved);
}

FlatShape FacetedRounds::with_facets(FlatShape figure, const Affine& to_world, ScadImport& import,
                                     int line) const {
  if (rings_.empty()) return figure;
  figure = replaced(std::move(figure), to_world, import, line);
  if (figure.kind == FlatShape::Kind::kPolygon || figure.has_curves()) return figure;
  auto outlines = polygon_of(figure, import, line);
  if (!outlines) return figure;
  FlatShape polygon;
  polygon.loops = *std::move(outlines);
  return polygon;
}

FlatShape FacetedRounds::replaced(FlatShape figure, const Affine& to_world, ScadImport& import,
                                  int line) const {
  if (figure.kind == FlatShape::Kind::kDisk || !figure.facets.empty()) {
    const std::vector<RoundGroup> groups = round_groups(figure, to_world);
    if (groups.empty() || !has_any(groups.front())) return figure;
    auto outlines = polygon_of(figure, import, line);
    if (!outlines) return figure;
    FlatShape polygon;
    polygon.loops = *std::move(outlines);
    return polygon;
  }
  for (FlatShape& child : figure.children)
    child = replaced(std::move(child), to_world, import, line);
  return figure;
}

void FacetedRounds::add(const RoundGroup& group) {
  for (const RoundRing& ring : group) {
    if (corners_ + ring.corners.size() > kMostRingCorners || has(rings_, ring)) continue;
    corners_ += ring.corners.size();
    rings_.emplace(ring.corners.size(), ring);
  }
}

bool FacetedRounds::has(const Rings& rings, const RoundRing& ring) const {
  const auto [first, last] = rings.equal_range(ring.corners.size());
  return std::any_of(first, last,
                     [&](const auto& known) { return are_one(known.second, ring, share_); });
}

bool FacetedRounds::has_any(const RoundGroup& group) const {
  return std::any_of(group.begin(), group.end(),
                     [&](const RoundRing& ring) { return has(rings_, ring); });
}

}  // namespace graycube
