// Light horizons as bytes, which follow the model slice behind `load`. FORMAT.md, "Light horizons",
// is normative.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "visibility/light_depths.hpp"
#include "visibility/light_horizons.hpp"

namespace graycube {

/// "GCH3", read as a little-endian integer.
inline constexpr std::uint32_t kHorizonMagic = 0x33484347;
inline constexpr std::size_t kHorizonHeaderBytes = 12;
/// The header of a light's depths, before their blocks.
inline constexpr std::size_t kDepthHeaderBytes = 20;
inline constexpr std::size_t kMaxHorizonBytes =
    kHorizonHeaderBytes +
    kMaxCreditLights *
        (2 + sizeof(double) +
         LightHorizons::kTexels * (2 * sizeof(std::uint16_t) + sizeof(std::uint32_t)) +
         kDepthHeaderBytes) +
    2 * kMostDepthTexels * sizeof(std::uint16_t);

/// The horizons may have at most kMaxCreditLights lights.
std::vector<std::byte> encode_horizons(const LightHorizons& horizons);
/// Nothing when the bytes are no horizons for so many lights.
[[nodiscard]] std::optional<LightHorizons> decode_horizons(std::span<const std::byte> bytes,
                                                           std::size_t lights);

}  // namespace graycube
