// The ways in which `graycube compare` renders a scene.
#pragma once

#include <string>
#include <vector>

#include "proto/messages.hpp"

namespace graycube {

/// A way to render: its name, its arguments for `graycube render`, and its options.
struct Way {
  std::string name, arguments;
  control::JobOptions options;
};

/// Algorithms, and 1987's and today's means in `macro`. `common` has what all ways share.
std::vector<Way> ways_of_algorithms(const control::JobOptions& common);

/// Each subdivision with `serial`, `roth` by tiles, the report's own distribution (regular
/// boundaries, every ray forwarded), today's, and that with light going back to senders; then
/// today's with each other mesh. The first way is `serial` as it is today.
std::vector<Way> ways_of_report(const control::JobOptions& common);

}  // namespace graycube
