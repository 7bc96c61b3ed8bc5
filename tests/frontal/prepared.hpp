// A scene as the frontal cuts it for its nodes.
#pragma once

#include "catch.hpp"
#include "formats/graycube/write_scene.hpp"
#include "frontal/preparation/preparation.hpp"

namespace graycube::testing {

/// The preparation of a scene's text for four nodes.
inline PreparationWork work_of(const std::string& text) {
  PreparationWork work;
  const auto bytes = std::as_bytes(std::span(text));
  work.scene = Bytes(bytes.begin(), bytes.end());
  work.cube = *Hypercube::of_size(4);
  return work;
}

inline PreparedScene prepared(const Scene& scene, const control::JobOptions& options,
                              std::uint32_t nodes = 4, Algorithm algorithm = Algorithm::kMacro) {
  PreparationWork work = work_of(write_scene_text(scene));
  work.options = options;
  work.options.algorithm = algorithm;
  work.cube = *Hypercube::of_size(nodes);
  PreparationResult result = prepare(work, [] { return 0.0; });
  REQUIRE(result.scene);
  return *std::move(result.scene);
}

}  // namespace graycube::testing
