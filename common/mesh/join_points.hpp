// Points that lie so close to each other that they are meant to be one.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesh/triangle_mesh.hpp"

namespace graycube {

/// The share of a mesh's largest coordinate by which sums and products of doubles may be off:
/// points no farther apart are one, written by a program that computed them in two ways.
inline constexpr double kRoundingShare = 1e-12;

/// The number that each point gets when those of `chosen` that differ by at most `distance` in
/// every coordinate become one: that of the nearest chosen point before it that kept its own
/// number, or its own. Points keep their numbers unless they are chosen. Distances are positive
/// and at least 1e-15 of the largest coordinate; for smaller ones nothing is joined.
std::vector<std::uint32_t> joined_points(std::span<const Vec3> points,
                                         std::span<const std::uint32_t> chosen, double distance);

}  // namespace graycube
