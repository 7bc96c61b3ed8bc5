// Random scenes and rays, on which finders of crossings are compared, bit for bit, with the whole
// trees.
#pragma once

#include <cmath>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "catch.hpp"
#include "crossings/bsp.hpp"
#include "crossings/crossings.hpp"
#include "csg/random_model.hpp"
#include "csg/random_rays.hpp"
#include "csg/whole_tree.hpp"

namespace graycube::testing {

inline WholeCrossing plain(const Crossing& c) { return {c.t, c.primitive, c.object, c.entering}; }

inline std::string describe(std::uint64_t seed, const RayCase& c) {
  std::ostringstream s;
  s.precision(17);
  const auto& [o, d] = c.ray;
  s << "seed " << seed << ", ray " << c.what << ": origin " << o.x << ' ' << o.y << ' ' << o.z
    << " direction " << d.x << ' ' << d.y << ' ' << d.z << " from " << c.t0 << " to " << c.t1;
  return s.str();
}
inline std::string describe(const std::vector<WholeCrossing>& list) {
  std::ostringstream s;
  s.precision(17);
  for (const WholeCrossing& c : list) {
    s << "\n  t " << c.t << " primitive " << c.primitive << " object " << c.object
      << (c.entering ? " entering" : " leaving");
  }
  return s.str();
}

/// The light that is left after it crosses the surfaces; nothing if one of them is opaque.
inline std::optional<Rgb> filtered(const Model& model, const std::vector<WholeCrossing>& crossings,
                                   Rgb light) {
  for (const WholeCrossing& c : crossings) {
    const double transmit = model.materials[model.primitives[c.primitive].material].transmit;
    if (!(transmit > 0)) return std::nullopt;
    light = transmit * light;
  }
  return light;
}

/// Compares the first crossing, all the following ones, and the light of a shadow ray. `first(t0,
/// t1)` gives an optional Crossing, `pass(t0, t1, light)` whether the light passes. False at the
/// first difference.
template <typename First, typename Pass>
bool agrees(const Model& model, const RayCase& c, const std::vector<WholeCrossing>& expected,
            const First& first, const Pass& pass) {
  double t0 = c.t0;
  for (std::size_t i = 0;; ++i) {
    // If several crossings have one parameter, the first object's is found.
    while (i > 0 && i < expected.size() && expected[i].t == expected[i - 1].t) ++i;
    const std::optional<Crossing> hit = first(t0, c.t1);
    if (hit.has_value() != (i < expected.size()) || (hit && !(plain(*hit) == expected[i]))) {
      UNSCOPED_INFO("crossings expected:" << describe(expected));
      if (hit) UNSCOPED_INFO("found from " << t0 << " on:" << describe({plain(*hit)}));
      return false;
    }
    if (!hit) break;
    t0 = std::nextafter(hit->t, kInf);
  }
  const Rgb start{0.9, 0.7, 0.3};
  const auto light = filtered(model, expected, start);
  Rgb passed = start;
  const bool open = pass(c.t0, c.t1, passed);
  if (open == light.has_value() && (!open || passed == *light)) return true;
  UNSCOPED_INFO("light differs; crossings:" << describe(expected));
  return false;
}

/// A plane of a subdivision: where `axis` has the coordinate `at`.
struct SplitPlane {
  int axis;
  double at;
};
inline void add_planes(const Bsp& bsp, std::vector<SplitPlane>& planes) {
  for (const BspNode& n : bsp.nodes()) {
    if (n.axis != BspNode::kLeafAxis) planes.push_back({n.axis, n.split});
  }
}

/// Moves a ray so that it starts on a plane of the subdivision; in half of all cases it stays in
/// it.
inline void snap_to(const std::vector<SplitPlane>& planes, Dice& dice, RayCase& c) {
  if (planes.empty()) return;
  const SplitPlane& plane = planes[dice.below(planes.size())];
  c.what = "from a plane of the subdivision";
  c.ray.origin[plane.axis] = plane.at;
  Vec3 flat = c.ray.direction;
  flat[plane.axis] = 0;
  if (dice.one_in(2) && length(flat) > 0) c.ray.direction = normalized(flat);
}

/// Calls `check(model, ray case, expected crossings)` along random rays of a random scene, after
/// `prepare(model)`, which gives the planes of its subdivisions; a false result fails the test with
/// the seed. Returns how many rays crossed something.
template <typename Prepare, typename Check>
std::size_t compare_scene(std::uint64_t seed, const RandomOptions& options, int rays,
                          const Prepare& prepare, const Check& check) {
  const Scene scene = RandomModel(seed, options).scene();
  const Model model = compile_scene(scene);
  const WholeTrees trees(model, scene);
  const std::vector<SplitPlane> planes = prepare(model);
  RandomRays maker(seed, model);
  std::size_t crossing = 0;
  for (int i = 0; i < rays; ++i) {
    RayCase c = maker.make(static_cast<std::size_t>(i) % kRayCases);
    if (maker.dice().one_in(4)) snap_to(planes, maker.dice(), c);
    const auto expected = trees.crossings_between(c.ray, c.t0, c.t1);
    crossing += expected.empty() ? 0 : 1;
    if (!check(model, c, expected)) {
      FAIL_CHECK(describe(seed, c));
      break;
    }
  }
  return crossing;
}

/// Families of scenes: everything mixed; many bounded objects; a few deep trees; single trees of
/// many leaves.
struct SceneFamily {
  const char* name;
  RandomOptions options;
  /// The family's share of the seeds, out of a thousand.
  std::uint64_t share;
};
inline const std::vector<SceneFamily> kFamilies{
    {"everything", {}, 1000},
    {"many objects",
     {.coincidences = true, .unbounded = false, .max_objects = 60, .max_tree_depth = 2},
     40},
    {"deep trees",
     {.coincidences = true, .unbounded = true, .max_objects = 2, .max_tree_depth = 6},
     100},
    {"without coincidences",
     {.coincidences = false, .unbounded = true, .max_objects = 8, .max_tree_depth = 4},
     100}};

/// All families, each with its share of `seeds`; every scene sees each kind of ray equally often.
template <typename Prepare, typename Check>
void compare_families(std::uint64_t seeds, const Prepare& prepare, const Check& check) {
  constexpr int kRays = 20 * static_cast<int>(kRayCases);
  for (const SceneFamily& family : kFamilies) {
    INFO(family.name);
    const std::uint64_t count = seeds * family.share / 1000;
    std::size_t crossing = 0;
    for (std::uint64_t seed = 0; seed < count; ++seed) {
      crossing += compare_scene(seed, family.options, kRays, prepare, check);
    }
    CHECK(crossing * 5 > count * static_cast<std::uint64_t>(kRays));
  }
}

}  // namespace graycube::testing
