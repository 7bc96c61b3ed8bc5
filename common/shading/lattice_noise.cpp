#include "shading/lattice_noise.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "geometry/portable_math.hpp"

namespace graycube {
namespace {

/// The period of the lattice, and the number of its random numbers.
constexpr std::size_t kPeriod = 4096;
/// A lattice point's hash picks four numbers that follow each other.
constexpr std::size_t kPicked = 256, kNumbers = kPicked + 3;
/// The place in libbn's row of random numbers from which these are taken.
constexpr std::size_t kFirstNumber = 14;

/// libbn's row of random numbers: those of POSIX's drand48 from its default state, rounded to eight
/// decimal digits, in single precision.
constexpr std::array<float, kPeriod> random_row() {
  constexpr std::uint64_t kFactor = 0x5DEECE66D, kSummand = 0xB, kMask = (1ull << 48) - 1;
  constexpr double kDigits = 1e8, kStates = 281474976710656.0;
  std::uint64_t state = 0x1234ABCD330E;
  std::array<float, kPeriod> row{};
  for (float& v : row) {
    state = (state * kFactor + kSummand) & kMask;
    const auto digits =
        static_cast<std::uint64_t>(static_cast<double>(state) * (kDigits / kStates) + 0.5);
    v = static_cast<float>(static_cast<double>(digits) / kDigits);
  }
  return row;
}

struct Tables {
  /// A permutation of 0 … 4095.
  std::array<std::uint16_t, kPeriod> shuffled{};
  /// Numbers from −1 to 1.
  std::array<double, kNumbers> numbers{};
};

constexpr Tables make_tables() {
  const std::array<float, kPeriod> row = random_row();
  Tables t;
  for (std::size_t i = 0; i < kPeriod; ++i) t.shuffled[i] = static_cast<std::uint16_t>(i);
  for (std::size_t i = kPeriod - 1, next = 0; i > 0; --i, ++next) {
    const auto other = static_cast<std::size_t>(double{row[next]} * double{kPeriod});
    std::swap(t.shuffled[i], t.shuffled[other]);
  }
  for (std::size_t i = 0; i < kNumbers; ++i) t.numbers[i] = row[kFirstNumber + i] * 2.0 - 1.0;
  return t;
}

constexpr Tables kTables = make_tables();

/// A coordinate's lattice cell, from 0, and how far into it the coordinate lies, 0 … 1.
struct Cell {
  std::size_t index = 0;
  double within = 0;
  /// The smooth weight of the cell's upper end.
  double weight = 0;
};

/// Everything here is exact but the weight.
Cell cell_of(double v) {
  const double size = std::isfinite(v) ? std::fabs(v) : 0.0;
  const double period = double{kPeriod};
  const double folded = size - period * std::floor(size / period);
  Cell c;
  c.index = static_cast<std::size_t>(folded);
  c.within = folded - std::floor(folded);
  c.weight = c.within * c.within * (3 - 2 * c.within);
  return c;
}

/// Four numbers for a point of the lattice, each below 4096.
const double* numbers_at(std::size_t x, std::size_t y, std::size_t z) {
  constexpr std::size_t kMask = kPeriod - 1;
  const auto& shuffled = kTables.shuffled;
  const std::size_t hash =
      shuffled[shuffled[shuffled[x & kMask] ^ (y & kMask)] ^ (z & kMask)] % kPicked;
  return &kTables.numbers[hash];
}

double frequency_weight(double frequency, double decay) {
  return decay < 0 ? portable_pow(frequency, -decay) : 1 / portable_pow(frequency, decay);
}

/// The weighted sum of `term` of the noise of each whole octave, and of the noise of what is left.
template <typename Term>
double sum_of_octaves(Vec3 p, const NoiseOctaves& octaves, Term&& term) {
  double sum = 0, frequency = 1;
  const double whole = std::floor(octaves.count);
  for (double i = 0; i < whole; ++i) {
    sum += term(lattice_noise(p)) * frequency_weight(frequency, octaves.decay);
    p = octaves.lacunarity * p;
    frequency *= octaves.lacunarity;
  }
  const double rest = octaves.count - whole;
  if (rest > 0) sum += rest * lattice_noise(p) * frequency_weight(frequency, octaves.decay);
  return sum;
}

}  // namespace

double lattice_noise(const Vec3& p) {
  const Cell x = cell_of(p.x), y = cell_of(p.y), z = cell_of(p.z);
  double sum = 0;
  for (std::size_t corner = 0; corner < 8; ++corner) {
    const std::size_t dx = corner & 1, dy = corner >> 1 & 1, dz = corner >> 2;
    const double weight = (dx == 1 ? x.weight : 1 - x.weight) *
                          (dy == 1 ? y.weight : 1 - y.weight) * (dz == 1 ? z.weight : 1 - z.weight);
    const double* n = numbers_at(x.index + dx, y.index + dy, z.index + dz);
    sum += weight * (n[0] * 0.5 + n[1] * (x.within - static_cast<double>(dx)) +
                     n[2] * (y.within - static_cast<double>(dy)) +
                     n[3] * (z.within - static_cast<double>(dz)));
  }
  return sum;
}

double fractal_noise(const Vec3& p, const NoiseOctaves& octaves) {
  return sum_of_octaves(p, octaves, [](double noise) { return noise; });
}

double turbulence(const Vec3& p, const NoiseOctaves& octaves) {
  return sum_of_octaves(p, octaves, [](double noise) { return std::fabs(noise); });
}

}  // namespace graycube
