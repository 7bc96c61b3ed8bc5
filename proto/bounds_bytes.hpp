// Foreign bounds as bytes, which follow the model of a slice. FORMAT.md, "Foreign bounds", is
// normative.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "visibility/foreign_bounds.hpp"

namespace graycube {

/// "GCF1", read as a little-endian integer.
inline constexpr std::uint32_t kBoundsMagic = 0x31464347;
inline constexpr std::uint32_t kMaxBoundsNodes = 1u << 22;

std::vector<std::byte> encode_bounds(const ForeignBounds& bounds);
bool begins_with_bounds(std::span<const std::byte> bytes);
/// Nothing when the bytes do not begin with bounds that can be walked; otherwise `bytes` becomes
/// what follows them.
[[nodiscard]] std::optional<ForeignBounds> take_bounds(std::span<const std::byte>& bytes);

}  // namespace graycube
