// The walk through the leaf regions against the whole trees: bit for bit.
#include "space/walk.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <vector>

#include "against_whole_trees.hpp"

using namespace graycube;
using namespace graycube::testing;

namespace {

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

const std::vector<BspOptions> kOptions{{}, {.step_cost = 0.01, .max_depth = 48}, {.step_cost = 0.6, .max_depth = 9},
                                       {.step_cost = 8, .max_depth = 48}};

}  // namespace

TEST_CASE("the walk gives bit for bit the crossings of the whole trees") {
  std::vector<Bsp> bsps;
  Mailbox mailbox;
  const auto prepare = [&](const Model& model) {
    bsps.clear();
    for (const BspOptions& o : kOptions) bsps.push_back(Bsp::build(model, o));
  };
  compare_families(1000, prepare, [&](const Model& model, const RayCase& c, const auto& expected) {
    return std::all_of(bsps.begin(), bsps.end(), [&](const Bsp& bsp) {
      const auto all = walked(bsp, c, mailbox);
      if (all != expected) {
        UNSCOPED_INFO("crossings expected:" << describe(expected) << "\nwalked:" << describe(all));
        return false;
      }
      return agrees(
          model, c, expected,
          [&](double t0, double t1) {
            mailbox.begin_ray();
            return first_crossing(bsp, c.ray, t0, t1, mailbox);
          },
          [&](double t0, double t1, Rgb& light) {
            mailbox.begin_ray();
            return pass_light(bsp, c.ray, t0, t1, mailbox, light);
          });
    });
  });
}
