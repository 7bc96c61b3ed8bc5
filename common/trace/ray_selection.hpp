// Some rays of a packet, traced as a packet of their own.
#pragma once

#include <array>
#include <cstddef>

#include "crossings/ray_packet.hpp"
#include "set_bits.hpp"

namespace graycube {

struct RaySelection {
  RayPacket packet;
  /// The number, in the whole packet, of each ray of the selection.
  std::array<std::size_t, RayPacket::kSize> numbers;

  /// Adds ray number i of the whole packet, t from `from` to `to`; there must be room for it.
  void add(std::size_t i, const Ray& ray, double from, double to) {
    numbers[packet.count] = i;
    packet.add(ray, from, to);
  }
  /// Turns bits of the selection's rays into bits of the same rays in the whole packet.
  RayPacket::Mask among_all(RayPacket::Mask selected) const {
    RayPacket::Mask all = 0;
    for (const std::size_t i : SetBits(selected)) all |= RayPacket::Mask{1} << numbers[i];
    return all;
  }
};

}  // namespace graycube
