// Figures 6 and 7 of the report: the hypercube of nodes, and the grid that Gray codes lay on it.
#pragma once

#include <string>
#include <vector>

#include "topology/hypercube.hpp"

namespace graycube::figures {

/// Figures with nodes show at most so many, as the report's iPSC had; more wouldn't be legible.
inline constexpr std::uint32_t kMostNodesDrawn = 64;

/// An edge of the hypercube, and what the grid of macro-regions makes of it.
struct CubeEdge {
  enum class Use { kColumns, kRows, kUnused };
  Rank a, b;
  /// Between neighbours of one row (other columns), of one column, or of neither. The grid is a
  /// torus: its ends are neighbours.
  Use use = Use::kUnused;
};
/// All edges, by their first node's rank, each once.
std::vector<CubeEdge> edges_of(const Hypercube& cube);

/// A label's bits, as many as the hypercube has dimensions; "0" for a single node.
std::string bits_text(const Hypercube& cube, GrayLabel label);

std::string hypercube_svg(const Hypercube& cube);

}  // namespace graycube::figures
