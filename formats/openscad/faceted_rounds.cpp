#include "formats/openscad/faceted_rounds.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "formats/openscad/language/import.hpp"
#include "formats/openscad/language/matrix.hpp"
#include "formats/openscad/primitives.hpp"
#include "formats/openscad/rounds.hpp"
#include "geometry/portable_math.hpp"

namespace graycube {
namespace {

/// How many passes follow chains of hulls that touch each other's facets.
constexpr int kMostPasses = 8;
/// Levels of modules that are looked into.
constexpr int kMostLevels = 256;

bool is_looked_into(const std::string& name) {
  return name == "group" || name == "union" || name == "render" || name == "color" ||
         name == "difference" || name == "intersection" || name == "hull";
}

/// Asked first, since matrices take long to read: their rotations are recovered.
bool has_hull(const std::vector<ScadModule>& modules) {
  return std::any_of(modules.begin(), modules.end(), [](const ScadModule& module) {
    return module.name == "hull" || has_hull(module.children);
  });
}

Vec3 across(const Vec3& v, const Vec3& along) { return v - dot(along, v) * along; }

/// Calls visit(module, to_world) for each module within that is_looked_into() doesn't name.
template <typename Visit>
void for_each_solid(const ScadModule& module, const Affine& to_world, std::uint32_t digits,
                    int levels, const Visit& visit) {
  if (module.left_out || module.dimension == 2 || levels == 0) return;
  std::optional<Affine> inner = to_world;
  if (module.name == "multmatrix") {
    OpenscadReport unread;
    inner = openscad_matrix(module, digits, unread);
    if (inner) inner = compose(to_world, *inner);
  } else if (!is_looked_into(module.name)) {
    return visit(module, to_world);
  }
  if (!inner || !inner->inverse()) return;
  for (const ScadModule& child : module.children)
    for_each_solid(child, *inner, digits, levels - 1, visit);
}

}  // namespace

struct FacetedRounds::Hull {
  const ScadModule* module;
  Affine to_world;
  bool is_exact;
};

FacetedRounds::FacetedRounds(const std::vector<ScadModule>& modules, const OpenscadOptions& options,
                             std::uint32_t digits)
    : digits_(digits), share_(digits == kOpenscadDigits ? 1e-5 : 1e-9) {
  if (options.facets || !has_hull(modules)) return;
  std::vector<Hull> hulls;
  find_hulls(modules, {}, hulls);
  OpenscadReport unread;
  OpenscadDelegate nobody(nullptr, options.folder);
  ScadImport import{options, unread, nobody, digits, {}};
  for (Hull& hull : hulls) {
    const ExactSolid exact = exact_hull(*hull.module, import);
    hull.is_exact = !std::holds_alternative<NoExactForm>(exact);
    if (!hull.is_exact) add_all(*hull.module, hull.to_world);
  }
  if (rings_.empty()) return;
  bool has_grown = true;
  for (int pass = 0; has_grown && pass < kMostPasses; ++pass) {
    has_grown = false;
    for (Hull& hull : hulls) {
      if (!hull.is_exact || !touch(*hull.module, hull.to_world)) continue;
      hull.is_exact = false;
      has_grown = true;
      add_all(*hull.module, hull.to_world);
    }
  }
}

template <typename Visit>
void FacetedRounds::for_each_round(const ScadModule& module, const Affine& to_world,
                                   const Visit& visit) const {
  for_each_solid(module, to_world, digits_, kMostLevels,
                 [&](const ScadModule& solid, const Affine& map) {
                   Ring ring;
                   if (ring_of(solid, map, ring)) visit(ring);
                 });
}

void FacetedRounds::find_hulls(const std::vector<ScadModule>& modules, const Affine& to_world,
                               std::vector<Hull>& hulls) const {
  for (const ScadModule& module : modules) {
    if (module.left_out || module.dimension == 2) continue;
    if (module.name == "hull") {
      hulls.push_back({&module, to_world, true});
    } else if (module.name == "multmatrix") {
      OpenscadReport unread;
      const auto inner = openscad_matrix(module, digits_, unread);
      if (inner) find_hulls(module.children, compose(to_world, *inner), hulls);
    } else if (is_looked_into(module.name)) {
      find_hulls(module.children, to_world, hulls);
    }
  }
}

void FacetedRounds::add_all(const ScadModule& module, const Affine& to_world) {
  for_each_round(module, to_world, [&](const Ring& ring) {
    if (!has(ring)) rings_.emplace(ring.corners.size(), ring);
  });
}

bool FacetedRounds::touch(const ScadModule& module, const Affine& to_world) const {
  if (rings_.empty()) return false;
  bool touches = false;
  for_each_round(module, to_world, [&](const Ring& ring) { touches = touches || has(ring); });
  return touches;
}

bool FacetedRounds::contains(const ScadModule& module, const Affine& to_world) const {
  Ring ring;
  return !rings_.empty() && ring_of(module, to_world, ring) && has(ring);
}

bool FacetedRounds::ring_of(const ScadModule& module, const Affine& to_world, Ring& ring) {
  const std::optional<ScadRound> round = openscad_round(module);
  if (!round) return false;
  ring.is_ball = round->is_ball;
  const Vec3 axis = to_world.vector({0, 0, 1});
  // A ball's ring is its equator; the direction to the pole tells the other rings.
  ring.along = round->is_ball ? round->radius * axis : normalized(axis);
  const auto placed = [&](const Vec3& p) {
    return round->is_ball ? to_world.point(p) : across(to_world.point(p), ring.along);
  };
  ring.center = placed({0, 0, 0});
  for (int i = 0; i < round->sides; ++i) {
    const double angle = 360.0 * i / round->sides;
    ring.corners.push_back(
        placed({round->radius * cos_degrees(angle), round->radius * sin_degrees(angle), 0}));
  }
  return true;
}

bool FacetedRounds::has(const Ring& ring) const {
  const auto [first, last] = rings_.equal_range(ring.corners.size());
  return std::any_of(first, last, [&](const auto& known) { return is_one(known.second, ring); });
}

/// Rings are equal whichever corner they begin with, and whichever way they go.
bool FacetedRounds::is_one(const Ring& a, const Ring& b) const {
  const double off = share_ * (max_abs(a.center) + length(a.corners[0] - a.center));
  const auto are_near = [&](const Vec3& p, const Vec3& q) { return max_abs(p - q) <= off; };
  if (a.is_ball != b.is_ball || !are_near(a.center, b.center)) return false;
  const double turned = a.is_ball ? off : share_;
  if (max_abs(a.along - b.along) > turned && max_abs(a.along + b.along) > turned) return false;
  const std::size_t count = a.corners.size();
  const auto at = std::find_if(b.corners.begin(), b.corners.end(),
                               [&](const Vec3& q) { return are_near(a.corners[0], q); });
  if (at == b.corners.end()) return false;
  const auto begin = static_cast<std::size_t>(at - b.corners.begin());
  for (const std::size_t step : {std::size_t{1}, count - 1}) {
    std::size_t i = 0;
    while (i < count && are_near(a.corners[i], b.corners[(begin + step * i) % count])) ++i;
    if (i == count) return true;
  }
  return false;
}

}  // namespace graycube
