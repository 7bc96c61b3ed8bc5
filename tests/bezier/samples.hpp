// Closed nets of patches for tests.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <random>
#include <utility>

#include "bezier/net.hpp"

namespace graycube::testing {

/// The cube [−1, 1]³ as six patches of points a third of a side apart. Each point is then moved by
/// up to `unrest` in each direction.
inline BezierNet cube_net(double unrest = 0, std::uint64_t seed = 1) {
  BezierNet net;
  std::mt19937_64 random(seed);
  const auto moved = [&] { return unrest * (2 * std::generate_canonical<double, 53>(random) - 1); };
  std::map<std::array<int, 3>, std::uint32_t> numbers;
  const auto number_at = [&](const std::array<int, 3>& place) {
    const auto next = static_cast<std::uint32_t>(net.points.size());
    const auto [found, is_new] = numbers.try_emplace(place, next);
    if (is_new) {
      const auto coordinate = [&](std::size_t a) { return 2.0 * place[a] / 3 - 1; };
      const double x = moved(), y = moved(), z = moved();
      net.points.push_back({coordinate(0) + x, coordinate(1) + y, coordinate(2) + z});
    }
    return found->second;
  };
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (const int end : {0, 3}) {
      BezierPatch& patch = net.patches.emplace_back();
      // Rows and columns are exchanged on the far side: all patches turn one way.
      const std::size_t across = (axis + (end == 0 ? 2 : 1)) % 3, up = 3 - axis - across;
      for (int row = 0; row < 4; ++row) {
        for (int column = 0; column < 4; ++column) {
          std::array<int, 3> place{};
          place[axis] = end;
          place[across] = column;
          place[up] = row;
          patch[static_cast<std::size_t>(4 * row + column)] = number_at(place);
        }
      }
    }
  }
  return net;
}

/// The ball of radius 1 as eight patches, each with a whole side at a pole. A quarter of a circle
/// is followed to within 2.8e-4 of the radius.
inline BezierNet ball_net() {
  constexpr double kHandle = 0.5522847498307936;  // 4 (√2 − 1) / 3
  BezierNet net;
  for (int quarter = 0; quarter < 4; ++quarter) {
    const double c = std::array<double, 4>{1, 0, -1, 0}[static_cast<std::size_t>(quarter)];
    const double s = std::array<double, 4>{0, 1, 0, -1}[static_cast<std::size_t>(quarter)];
    for (const double upper : {-1.0, 1.0}) {
      const double radius[] = {1, 1, kHandle, 0}, height[] = {0, kHandle, 1, 1};
      BezierPatch& patch = net.patches.emplace_back();
      for (std::size_t row = 0; row < 4; ++row) {
        for (std::size_t column = 0; column < 4; ++column) {
          const double along[] = {1, 1, kHandle, 0}, beside[] = {0, kHandle, 1, 1};
          const double x = radius[row] * along[column], y = radius[row] * beside[column];
          patch[4 * row + (upper > 0 ? column : 3 - column)] =
              static_cast<std::uint32_t>(net.points.size());
          net.points.push_back({c * x - s * y, s * x + c * y, upper * height[row]});
        }
      }
    }
  }
  return net;
}

}  // namespace graycube::testing
