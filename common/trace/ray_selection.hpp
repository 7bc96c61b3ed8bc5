// Some rays of a packet, looked up as a packet of their own.
#pragma once

#include <array>
#include <cstddef>

#include "crossings/ray_packet.hpp"
#include "set_bits.hpp"

namespace graycube {

struct RaySelection {
  RayPacket packet;
  /// Of the rays among all.
  std::array<std::size_t, RayPacket::kSize> numbers;

  /// Ray number i of all, as it is to be looked up; the selection must not be full.
  void add(std::size_t i, const Ray& ray, double from, double to) {
    numbers[packet.count] = i;
    packet.add(ray, from, to);
  }
  /// The bits that rays of the selection have among all.
  RayPacket::Mask among_all(RayPacket::Mask selected) const {
    RayPacket::Mask all = 0;
    for (const std::size_t i : SetBits(selected)) all |= RayPacket::Mask{1} << numbers[i];
    return all;
  }
};

}  // namespace graycube
