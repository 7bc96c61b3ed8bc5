// A scene as the frontal cuts it for its nodes.
#pragma once

#include "catch.hpp"
#include "formats/graycube/write_scene.hpp"
#include "frontal/preparation/preparation.hpp"

namespace graycube::testing {

inline PreparedScene prepared(const Scene& scene, const control::JobOptions& options,
                              std::uint32_t nodes = 4, Algorithm algorithm = Algorithm::kMacro) {
  const std::string text = write_scene_text(scene);
  PreparationWork work;
  const auto* bytes = reinterpret_cast<const std::byte*>(text.data());
  work.scene.assign(bytes, bytes + text.size());
  work.options = options;
  work.options.algorithm = algorithm;
  work.cube = *Hypercube::of_size(nodes);
  PreparationResult result = prepare(work, [] { return 0.0; });
  REQUIRE(result.scene);
  return *std::move(result.scene);
}

}  // namespace graycube::testing
