// Cuts the slices anew that change when boundaries between macro-regions slide. Pure and slow, as
// preparing a scene is.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "regions/macro_grid.hpp"
#include "topology/hypercube.hpp"
#include "transport/message.hpp"

namespace graycube {

struct Model;

struct RecutWork {
  std::uint32_t job = 0;
  /// The generation of the new grid.
  std::uint32_t generation = 1;
  std::shared_ptr<const Model> model;
  Hypercube cube = *Hypercube::of_size(1);
  MacroGrid from, to;
};

struct RecutResult {
  std::uint32_t job = 0, generation = 1;
  /// The nodes' slices, by rank; empty where the node needs the same of the scene as before.
  std::vector<SharedBytes> slices;
  /// Primitives in these slices, and those that their nodes didn't hold before.
  std::uint64_t primitives = 0, new_primitives = 0;
  /// Bytes of the slices.
  std::uint64_t bytes = 0;
  /// Seconds that cutting took.
  double seconds = 0;
  /// Why it failed; empty if it didn't.
  std::string error;
};

/// `clock_s` tells seconds, of which only differences count. Never throws.
RecutResult recut(const RecutWork& work, const std::function<double()>& clock_s);

}  // namespace graycube
