// Arbitrary output variables: values that a picture may hold for each pixel beside its light. They
// are those of the first hit of one primary ray, never sums, and are sent and kept as bit patterns.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace graycube {

enum class Aov : std::uint8_t {
  kDepth,   ///< distance along the ray; +infinity where nothing is hit
  kNormal,  ///< world, unit, outward from the solid; 0 where nothing is hit
  kAlbedo,  ///< the material's colour; 0 where nothing is hit
  kObject,  ///< 1 + the object's index in the file; 0 where nothing is hit
};

/// Names on the command line and on the wire, indexed by Aov.
inline constexpr std::array<std::string_view, 4> kAovNames{"depth", "normal", "albedo", "object"};

class AovSet {
 public:
  static constexpr std::uint8_t kAllBits = 15;

  constexpr AovSet() = default;
  static constexpr AovSet from_bits(std::uint8_t bits) {
    AovSet s;
    s.bits_ = bits & kAllBits;
    return s;
  }
  static constexpr AovSet all() { return from_bits(kAllBits); }

  constexpr bool has(Aov a) const { return (bits_ >> static_cast<unsigned>(a) & 1) != 0; }
  constexpr void add(Aov a) { bits_ |= static_cast<std::uint8_t>(1u << static_cast<unsigned>(a)); }
  constexpr bool any() const { return bits_ != 0; }
  constexpr std::uint8_t bits() const { return bits_; }
  friend constexpr bool operator==(const AovSet&, const AovSet&) = default;

 private:
  std::uint8_t bits_ = 0;
};

/// Parses a list such as "depth,normal": names in any order, each at most once; the empty text is
/// the empty set. Nothing for any other text.
std::optional<AovSet> parse_aovs(std::string_view text);
/// The text from which parse_aovs() makes the set.
std::string to_string(AovSet aovs);

/// AOVs are kept in planes of three 32-bit words a pixel: normal X, Y, Z; albedo R, G, B; depth,
/// object and an unused one. A plane exists if one of its AOVs is asked for.
inline constexpr std::size_t kAovPlanes = 3;
using AovWords = std::array<std::uint32_t, 3>;
inline constexpr std::size_t kNormalPlane = 0, kAlbedoPlane = 1, kDepthPlane = 2;

constexpr bool has_plane(AovSet aovs, std::size_t plane) {
  if (plane == kNormalPlane) return aovs.has(Aov::kNormal);
  if (plane == kAlbedoPlane) return aovs.has(Aov::kAlbedo);
  return plane == kDepthPlane && (aovs.has(Aov::kDepth) || aovs.has(Aov::kObject));
}

/// The words that a plane holds for a pixel whose ray hits nothing.
AovWords aov_background(std::size_t plane);

/// The number under which a pixel's AOVs are addressed like light: slots 0 … pixels − 1 are the
/// light, then those of the kAovPlanes planes follow.
constexpr std::uint32_t aov_slot(std::size_t plane, std::uint64_t pixels, std::uint32_t pixel) {
  return static_cast<std::uint32_t>((plane + 1) * pixels + pixel);
}

}  // namespace graycube
