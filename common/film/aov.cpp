#include "film/aov.hpp"

#include <algorithm>
#include <bit>

#include "geometry/infinity.hpp"

namespace graycube {

std::optional<AovSet> parse_aovs(std::string_view text) {
  AovSet set;
  while (!text.empty()) {
    const std::size_t comma = text.find(',');
    const auto name = std::find(kAovNames.begin(), kAovNames.end(), text.substr(0, comma));
    if (name == kAovNames.end()) return std::nullopt;
    const auto aov = static_cast<Aov>(name - kAovNames.begin());
    if (set.has(aov)) return std::nullopt;
    set.add(aov);
    if (comma == std::string_view::npos) break;
    text.remove_prefix(comma + 1);
    if (text.empty()) return std::nullopt;
  }
  return set;
}

std::string to_string(AovSet aovs) {
  std::string text;
  for (std::size_t i = 0; i < kAovNames.size(); ++i) {
    if (!aovs.has(static_cast<Aov>(i))) continue;
    if (!text.empty()) text += ',';
    text += kAovNames[i];
  }
  return text;
}

AovWords aov_background(std::size_t plane) {
  if (plane != kDepthPlane) return {0, 0, 0};
  return {std::bit_cast<std::uint32_t>(kFloatInf), 0, 0};
}

}  // namespace graycube
