// How a farm takes the loss of a node, and what its frontal is told of that.
#pragma once

#include <string>
#include <vector>

#include "proto/messages.hpp"

namespace graycube {

struct LossOptions {
  /// Seconds until a silent node is taken for dead; 0 for what is usual.
  double silence_s = 0;
  std::uint32_t retries = kDefaultRetries;
};

inline std::vector<std::string> loss_arguments(const LossOptions& losses) {
  std::vector<std::string> arguments{"--retries", std::to_string(losses.retries)};
  if (losses.silence_s > 0)
    arguments.insert(arguments.end(), {"--silence", std::to_string(losses.silence_s)});
  return arguments;
}

}  // namespace graycube
