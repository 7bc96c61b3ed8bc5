// Noise with the same bits on every machine: smooth random numbers in space, and sums of them at
// ever finer scales. They are those of BRL-CAD's libbn (noise.c: bn_noise_perlin, bn_noise_fbm,
// bn_noise_turb), so that its solid textures look the same here. The method is K. Perlin's (An
// Image Synthesizer, 1985), the sums are F. K. Musgrave's.
#pragma once

#include "geometry/vec.hpp"

namespace graycube {

/// Most octaves of a sum: what is finer than 2⁻³² of the coarsest can't be seen.
inline constexpr double kMaxOctaves = 32;

/// How noises of ever finer scales are added up.
struct NoiseOctaves {
  /// How many, 0 … kMaxOctaves; the fraction is the last one's share.
  double count = 4;
  /// The ratio of one octave's frequency to that of the octave before, above 0.
  double lacunarity = 2.1753974;
  /// An octave's weight is its frequency to the power of −decay.
  double decay = 1;

  friend bool operator==(const NoiseOctaves&, const NoiseOctaves&) = default;
};

/// Noise, about −1 … 1. It changes smoothly over lengths of 1, repeats itself after 4096, and is
/// mirrored at the planes of the axes.
double lattice_noise(const Vec3& p);
/// The weighted sum of noises: fractional Brownian motion.
double fractal_noise(const Vec3& p, const NoiseOctaves& octaves);
/// The weighted sum of their absolute values (of whole octaves, as libbn has it).
double turbulence(const Vec3& p, const NoiseOctaves& octaves);

}  // namespace graycube
