// A picture of how the nodes of each compared render spent their time.
#pragma once

#include <string>
#include <vector>

#include "proto/comparison.hpp"

namespace graycube {

/// An SVG: for each row with statistics a group of bars, one a node, of its evaluators' time: busy,
/// blocked, window, idle, as shares of the node's total.
std::string bars_svg(const std::string& title, const std::vector<ComparedRow>& rows);

}  // namespace graycube
