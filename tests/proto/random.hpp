// Seeded random values for the tests of this folder.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <random>
#include <span>
#include <vector>

#include "geometry/vec.hpp"

namespace graycube::test {

class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}

  /// A number in 0 … below − 1.
  std::uint64_t below(std::uint64_t below) { return engine_() % below; }
  bool chance(std::uint64_t one_in) { return below(one_in) == 0; }
  std::uint64_t bits() { return engine_(); }
  double uniform(double lo, double hi) {
    return lo + (hi - lo) * static_cast<double>(engine_() >> 11) * 0x1p-53;
  }
  /// A finite number; often one at which careless code breaks.
  double any_finite() {
    static constexpr double kOdd[] = {0.0,
                                      -0.0,
                                      1.0,
                                      std::numeric_limits<double>::denorm_min(),
                                      std::numeric_limits<double>::max(),
                                      -1e-300,
                                      1.0 / 3};
    return chance(4) ? kOdd[below(std::size(kOdd))] : uniform(-1e3, 1e3);
  }
  double not_negative() { return chance(4) ? 0.0 : uniform(0, 10); }
  Vec3 vec() { return {any_finite(), any_finite(), any_finite()}; }
  Rgb rgb() { return {not_negative(), not_negative(), not_negative()}; }
  Vec3 unit() {
    const Vec3 v{uniform(-1, 1), uniform(-1, 1), uniform(0.1, 1)};
    return normalized(v);
  }

 private:
  std::mt19937_64 engine_;
};

/// One to four random changes: a bit flipped, a byte set, a cut, a stretch repeated.
inline std::vector<std::byte> mutated(std::vector<std::byte> bytes, Random& random) {
  for (std::uint64_t n = 1 + random.below(4); n > 0 && !bytes.empty(); --n) {
    std::byte& at = bytes[random.below(bytes.size())];
    switch (random.below(8)) {
      case 0: bytes.resize(random.below(bytes.size() + 1)); break;
      case 1: at = std::byte{0xFF}; break;
      case 2: at = static_cast<std::byte>(random.bits()); break;
      case 3: {
        const std::vector<std::byte> stretch(
            bytes.begin(),
            bytes.begin() + 1 + static_cast<std::ptrdiff_t>(random.below(bytes.size())));
        bytes.insert(bytes.end(), stretch.begin(), stretch.end());
        break;
      }
      default: at ^= std::byte{1} << random.below(8); break;
    }
  }
  return bytes;
}

}  // namespace graycube::test
