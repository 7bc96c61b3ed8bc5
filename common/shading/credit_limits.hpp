// Settings that only `serial` accepts: both a farm's client and its frontal ask for these.
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
  /// The name of the things counted; empty for a plain number.
  std::string_view unit;
  std::uint64_t most = 0, found = 0;
};

/// The settings beyond what a tile's sum of credit can hold exactly (see kMaxCreditDepth).
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
