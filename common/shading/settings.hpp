// Everything of a scene that is not a solid: picture, camera, lights, limits of the photometric
// tree.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "film/aov.hpp"
#include "geometry/vec.hpp"

namespace graycube {

struct ImageSize {
  std::uint32_t width = 0, height = 0;
  /// S, the side of a pixel's grid of samples: every pixel takes S × S primary rays.
  std::uint32_t samples = 1;

  std::uint64_t primary_rays() const { return std::uint64_t{width} * height * samples * samples; }
  friend bool operator==(const ImageSize&, const ImageSize&) = default;
};

/// Largest width and height, and largest number of pixels (a 128-bit film of it takes 3 GiB).
inline constexpr std::uint32_t kMaxImageSide = 16384;
inline constexpr std::uint64_t kMaxPixels = 1ull << 26;
inline constexpr std::uint32_t kMaxSamples = 64;

enum class Projection : std::uint8_t { kPerspective, kOrthographic };
/// The point that a ray shows if it starts within a solid: where it leaves the solid, or where it
/// would have entered it, behind its start. The latter is rt's way; orthographic cameras only.
enum class InsideView : std::uint8_t { kExit, kEntry };
enum class Handedness : std::uint8_t { kRight, kLeft };

struct Camera {
  Projection projection = Projection::kPerspective;
  Vec3 eye, look_at, up;
  /// Perspective: the full horizontal angle, in degrees, 0 < fov < 180.
  double fov_degrees = 0;
  /// Orthographic: the picture's width in scene units.
  double width = 0;
  Handedness handedness = Handedness::kRight;
  /// The point of its pixel (or, with samples, subcell) that a ray goes through, from the
  /// lower-left corner as shares of the sides: 0 … 1.
  std::array<double, 2> pixel_offset{0.5, 0.5};
  InsideView inside = InsideView::kExit;

  friend bool operator==(const Camera&, const Camera&) = default;
};

enum class Falloff : std::uint8_t { kNone, kInverseSquare };

struct PointLight {
  Vec3 position;
  Rgb color{1, 1, 1};
  Falloff falloff = Falloff::kNone;
  /// Whether solids between the light and a surface keep it in the dark.
  bool shadows = true;
  /// It shines where the angle with this direction, of any length, is at most so many degrees (0 …
  /// 180).
  Vec3 direction{0, 0, -1};
  double angle_degrees = 180;

  bool has_beam() const { return angle_degrees < 180; }
  friend bool operator==(const PointLight&, const PointLight&) = default;
};

inline constexpr std::uint32_t kMaxDepth = 1000;
inline constexpr std::uint32_t kMaxLights = 4096;
/// The deepest photometric tree and the most lights whose credit fits the 320 bits of a tile's sum:
/// the limits of `roth` and `macro`.
inline constexpr std::uint32_t kMaxCreditDepth = 120;
inline constexpr std::uint32_t kMaxCreditLights = 64;

struct RenderSettings {
  ImageSize image;
  Camera camera;
  Rgb background{0, 0, 0};
  Rgb ambient{1, 1, 1};
  std::uint32_t max_depth = 5;
  double min_weight = 0;
  std::vector<PointLight> lights;
  /// Set for a render, not by the scene: no scene file names AOVs.
  AovSet aovs;

  friend bool operator==(const RenderSettings&, const RenderSettings&) = default;
};

}  // namespace graycube
