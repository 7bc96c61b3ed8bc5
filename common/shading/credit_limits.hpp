// What only `serial` renders. Who submits a scene to a farm asks, and the frontal again.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "shading/settings.hpp"

namespace graycube {

/// A setting beyond what `roth` and `macro` accept.
struct ExceededLimit {
  /// A JSON pointer into the scene.
  std::string_view where;
  /// What is counted; empty for a plain number.
  std::string_view unit;
  std::uint64_t most = 0, found = 0;
};

/// A tile's sum of credit is exact up to a photometric tree and a number of lights.
inline std::vector<ExceededLimit> exceeded_credit_limits(const RenderSettings& settings) {
  std::vector<ExceededLimit> exceeded;
  if (settings.max_depth > kMaxCreditDepth) {
    exceeded.push_back({"/max_depth", "", kMaxCreditDepth, settings.max_depth});
  }
  if (settings.lights.size() > kMaxCreditLights) {
    exceeded.push_back({"/lights", "lights", kMaxCreditLights, settings.lights.size()});
  }
  return exceeded;
}

}  // namespace graycube
