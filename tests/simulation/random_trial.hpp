// A tiny farm and job that a seed decides: every way of rendering, with little credit, short queues
// and slow links.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <random>
#include <string>

#include "proto/batch.hpp"
#include "simulation/random_machine.hpp"

namespace graycube::simulation {

/// The tiny scene's depth of rays and number of lights.
inline constexpr std::uint32_t kDepth = 3, kLights = 2;

/// A mirror that faces another, glass between them, and two lights, one of them there too.
inline std::string tiny_scene(unsigned width, unsigned height) {
  return R"({"graycube": 1, "image": {"width": )" + std::to_string(width) + R"(, "height": )" +
         std::to_string(height) + R"(},
  "camera": {"type": "perspective", "eye": [0,1,-6], "look_at": [0,0,0], "up": [0,1,0], "fov": 60},
  "background": [0.1,0.2,0.4], "max_depth": )" +
         std::to_string(kDepth) + R"(,
  "lights": [{"type": "point", "position": [5,9,-6], "color": [0.6,0.6,0.6]},
             {"type": "point", "position": [-1,0.5,-1], "color": [0.4,0.3,0.3]}],
  "materials": {"mirror": {"color": [0.9,0.8,0.9], "diffuse": 0.2, "reflect": 0.8},
                "glass": {"diffuse": 0.1, "transmit": 0.9, "reflect": 0.1, "ior": 1.5}},
  "objects": [
    {"material": "mirror", "csg": {"type": "box", "min": [-3,-2,1], "max": [3,2,1.5]}},
    {"material": "mirror", "csg": {"type": "box", "min": [-3,-1.5,-3], "max": [-2.6,2,1]}},
    {"material": "glass", "csg": {"type": "difference", "children": [
       {"type": "sphere", "center": [0.3,0,-1], "radius": 1.1},
       {"type": "cylinder", "base": [0,0,-3], "top": [0,0,3], "radius": 0.4}]}}]})";
}

/// One seed's farm and job.
struct Trial {
  RandomFarmOptions farm;
  control::JobOptions job;
  bool is_square = false;  ///< larger: small pictures can't be cut by load

  std::string name() const {
    const std::string sums = " " + std::string(to_string(job.sums));
    if (job.algorithm == Algorithm::kRoth)
      return "roth " + std::string(to_string(job.grain)) + sums;
    return "macro " + std::string(to_string(job.shadows)) + " " +
           std::string(to_string(job.partition)) + " " + std::string(to_string(job.flow)) + sums;
  }
};

inline Trial trial_of(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const auto below = [&](std::uint32_t n) { return static_cast<std::uint32_t>(random() % n); };
  Trial t;
  t.farm.seed = seed;
  t.farm.nodes = 1u << below(5);
  t.farm.threads = 1 + below(3);
  t.farm.link_delay_s = below(2) == 0 ? 1e-3 : 1e-1;
  // A window of one ray on a link that takes ten seconds: slow, but no deadlock.
  t.farm.heartbeat_s = t.farm.link_delay_s > 1e-2 ? 100 : 1;
  t.farm.stalled_s = 1e6 * t.farm.link_delay_s;
  t.farm.limits.batch_bytes = static_cast<std::uint32_t>(kRayBytes) << below(4);
  t.farm.limits.link_credit_bytes = t.farm.limits.batch_bytes << (below(2) * below(3));
  t.farm.limits.window_tiles = 1 + below(2);
  t.job.algorithm = below(8) == 0 ? Algorithm::kRoth : Algorithm::kMacro;
  t.job.grain = static_cast<Grain>(below(3));
  t.job.shadows = static_cast<ShadowMode>(below(3));
  t.job.scatter = 1 + below(3);
  if (below(4) == 0) {
    t.job.partition = PartitionMode::kBalanced;
    t.job.scatter = 1;
    t.farm.nodes = std::min(t.farm.nodes, 4u);
    t.is_square = true;
  }
  if (below(6) == 0) {
    t.job.flow = FlowMode::kBlocking;
    t.job.queue = 1 + below(40);
    t.farm.link_delay_s = 1e-3;  // a ray a message: on slower links a picture takes hours
    t.farm.heartbeat_s = 1;
  }
  if (below(2) == 0) t.farm.replica_bytes = 0;
  if (below(2) == 0) t.job.sums = SumsMode::kTree;
  if (below(2) == 0) t.farm.limits.outbox_rays = 1 + below(40);
  return t;
}

inline std::uint64_t number_in_environment(const char* name, std::uint64_t otherwise) {
  const char* text = std::getenv(name);
  return text == nullptr ? otherwise : std::strtoull(text, nullptr, 10);
}

}  // namespace graycube::simulation
