// The names of the figures that can be drawn.
#pragma once

#include <cstdint>
#include <string_view>

namespace graycube::figures {

enum class FigureName : std::uint8_t {
  kHypercube,
  kMacroRegions,
  kBsp,
  kPointers,
  kEntry,
  kTraffic,
  kToken,
};

constexpr std::string_view to_string(FigureName name) {
  switch (name) {
    case FigureName::kHypercube: return "hypercube";
    case FigureName::kMacroRegions: return "macro-regions";
    case FigureName::kBsp: return "bsp";
    case FigureName::kPointers: return "pointers";
    case FigureName::kEntry: return "entry";
    case FigureName::kTraffic: return "traffic";
    case FigureName::kToken: return "token";
  }
  return {};
}

/// Figures of leaf regions, for which a subdivision that has them is drawn.
constexpr bool shows_leaves(FigureName name) {
  return name == FigureName::kBsp || name == FigureName::kPointers || name == FigureName::kEntry;
}
/// Figures of what goes from node to node.
constexpr bool shows_messages(FigureName name) {
  return name == FigureName::kEntry || name == FigureName::kTraffic || name == FigureName::kToken;
}

}  // namespace graycube::figures
