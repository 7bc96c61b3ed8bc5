// The walk through the leaf regions against the whole trees: bit for bit.
#include "space/walk.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "csg/random_model.hpp"
#include "csg/random_rays.hpp"
#include "csg/whole_tree.hpp"

using namespace graycube;
using namespace graycube::testing;

namespace {

WholeCrossing plain(const Crossing& c) { return {c.t, c.primitive, c.object, c.entering}; }

std::string describe(std::uint64_t seed, const RayCase& c) {
  std::ostringstream s;
  s.precision(17);
  const auto& [o, d] = c.ray;
  s << "seed " << seed << ", ray " << c.what << ": origin " << o.x << ' ' << o.y << ' ' << o.z
    << " direction " << d.x << ' ' << d.y << ' ' << d.z << " from " << c.t0 << " to " << c.t1;
  return s.str();
}
std::string describe(const std::vector<WholeCrossing>& list) {
  std::ostringstream s;
  s.precision(17);
  for (const WholeCrossing& c : list) {
    s << "\n  t " << c.t << " primitive " << c.primitive << " object " << c.object
      << (c.entering ? " entering" : " leaving");
  }
  return s.str();
}

/// All crossings that the walk comes across, region by region.
std::vector<WholeCrossing> walked(const Bsp& bsp, const RayCase& c, Mailbox& mailbox) {
  std::vector<WholeCrossing> all;
  mailbox.begin_ray();
  walk(bsp, c.ray, c.t0, c.t1, mailbox, [&](const BspLeaf& leaf, double from, double to) {
    const std::size_t first = all.size();
    for (std::uint32_t i = 0; i < leaf.program_count; ++i) {
      for_each_crossing(bsp, bsp.programs()[leaf.first_program + i], c.ray, from, to, mailbox,
                        [&](const Crossing& x) {
                          all.push_back(plain(x));
                          return true;
                        });
    }
    std::stable_sort(all.begin() + static_cast<std::ptrdiff_t>(first), all.end(),
                     [](const auto& a, const auto& b) { return a.t < b.t; });
    return true;
  });
  return all;
}

/// What is left of light that crosses the surfaces; nothing when an opaque one is among them.
std::optional<Rgb> filtered(const Model& model, const std::vector<WholeCrossing>& crossings, Rgb light) {
  for (const WholeCrossing& c : crossings) {
    const double transmit = model.materials[model.primitives[c.primitive].material].transmit;
    if (!(transmit > 0)) return std::nullopt;
    light = transmit * light;
  }
  return light;
}

const std::vector<BspOptions> kOptions{{}, {.step_cost = 0.01, .max_depth = 48}, {.step_cost = 0.6, .max_depth = 9},
                                       {.step_cost = 8, .max_depth = 48}};

/// Compares everything that can be asked of the walk along one ray; false at the first difference.
bool agree(const Model& model, const Bsp& bsp, const RayCase& c,
           const std::vector<WholeCrossing>& expected, Mailbox& mailbox) {
  const std::vector<WholeCrossing> all = walked(bsp, c, mailbox);
  if (all != expected) {
    UNSCOPED_INFO("crossings expected:" << describe(expected) << "\nfound:" << describe(all));
    return false;
  }
  mailbox.begin_ray();
  const auto hit = first_crossing(bsp, c.ray, c.t0, c.t1, mailbox);
  if (hit.has_value() == expected.empty() || (hit && !(plain(*hit) == expected.front()))) {
    UNSCOPED_INFO("first expected:" << describe(expected));
    if (hit) UNSCOPED_INFO("found:" << describe({plain(*hit)}));
    return false;
  }
  const Rgb start{0.9, 0.7, 0.3};
  const auto light = filtered(model, expected, start);
  Rgb passed = start;
  mailbox.begin_ray();
  const bool open = pass_light(bsp, c.ray, c.t0, c.t1, mailbox, passed);
  if (open != light.has_value() || (open && passed != *light)) {
    UNSCOPED_INFO("light differs");
    return false;
  }
  return true;
}

/// Returns how many rays crossed something.
std::size_t compare_scene(std::uint64_t seed, const RandomOptions& options, int rays) {
  const Scene scene = RandomModel(seed, options).scene();
  const Model model = compile_scene(scene);
  const WholeTrees trees(model, scene);
  std::vector<Bsp> bsps;
  for (const BspOptions& o : kOptions) bsps.push_back(Bsp::build(model, o));
  RandomRays maker(seed, model);
  Mailbox mailbox;
  std::size_t crossing = 0;
  for (int i = 0; i < rays; ++i) {
    const RayCase c = maker.make(static_cast<std::size_t>(i) % kRayCases);
    const auto expected = trees.crossings_between(c.ray, c.t0, c.t1);
    crossing += expected.empty() ? 0 : 1;
    for (std::size_t b = 0; b < bsps.size(); ++b) {
      if (!agree(model, bsps[b], c, expected, mailbox)) {
        FAIL_CHECK(describe(seed, c) << ", subdivision " << b);
        return crossing;
      }
    }
  }
  return crossing;
}

}  // namespace

TEST_CASE("the walk gives bit for bit the crossings of the whole trees") {
  constexpr std::uint64_t kSeeds = 1000;
  constexpr int kRays = 180;
  std::size_t crossing = 0;
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) crossing += compare_scene(seed, {}, kRays);
  CHECK(crossing > kSeeds * kRays / 3);
}

TEST_CASE("the walk gives bit for bit the crossings of many bounded objects") {
  const RandomOptions options{
      .coincidences = true, .unbounded = false, .max_objects = 60, .max_tree_depth = 2};
  for (std::uint64_t seed = 1000; seed < 1040; ++seed) compare_scene(seed, options, 180);
}

TEST_CASE("the walk gives bit for bit the crossings of deep trees") {
  const RandomOptions options{
      .coincidences = true, .unbounded = true, .max_objects = 2, .max_tree_depth = 6};
  for (std::uint64_t seed = 2000; seed < 2040; ++seed) compare_scene(seed, options, 180);
}
