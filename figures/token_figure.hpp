// The token of Dijkstra, Feijen and van Gasteren on its ring of nodes (report, 3.3.4), with the
// rays that keep it from ending the image.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "figures/run_record.hpp"

namespace graycube::figures {

/// A round of the token: from when node 0 sends it to when it is back there.
struct TokenRound {
  std::uint32_t round = 0, hops = 0;
  double began_s = 0, ended_s = 0;
  /// Its colour and sum on the last way, back to node 0.
  bool is_black = false;
  std::int64_t count = 0;
};
std::vector<TokenRound> rounds_of(const RunRecord& run);

/// The token must have been handed on at least once.
std::string token_svg(std::string_view scene, const Hypercube& cube, const RunRecord& run);

}  // namespace graycube::figures
