// Rules that must hold for any text read as a scene: what isn't refused is traced alike by one
// process and by nodes that share it out.
#pragma once

#include <string_view>
#include <variant>

#include "check.hpp"
#include "formats/graycube/read_scene.hpp"
#include "fuzz/compiled.hpp"
#include "regions/restrict.hpp"
#include "trace/step.hpp"

namespace graycube {

/// Larger models only make the fuzzer slow.
inline constexpr std::size_t kMostFuzzedPrimitives = 200;

/// The primary rays of a model's picture, traced until none is left or any leaves.
inline void trace_all(const Domain& domain, Step& step) {
  const ImageSize& image = domain.settings().image;
  Evaluator(domain).trace_pixels({0, 0, image.width, image.height}, step);
}

/// Traces a tiny picture of the scene whole, and as two nodes would begin to; returns whether the
/// scene was accepted.
inline bool fuzz_render(std::string_view text) {
  ReadResult read = read_scene_text(text);
  if (!read.scene) return false;
  RenderSettings& s = read.scene->settings;
  s.image = {5, 4, 1};
  s.max_depth = s.max_depth < 2 ? s.max_depth : 2;
  if (s.lights.size() > 3) s.lights.resize(3);
  const std::optional<Model> model = compiled(*read.scene);
  if (!model || model->primitives.size() > kMostFuzzedPrimitives) return false;
  Step whole;
  trace_all(Domain(*model), whole);
  GRAYCUBE_CHECK(whole.leaving.empty(), "%zu rays left the whole", whole.leaving.size());
  const auto frame = CameraFrame::from(model->settings.camera, model->settings.image);
  const MacroGrid grid = MacroGrid::regular(frame, 2, 1);
  for (std::uint32_t column = 0; column < 2; ++column) {
    const RegionShare share{2, 1, column, 0};
    const Model slice = restrict_to_share(*model, grid, share);
    GRAYCUBE_CHECK(std::holds_alternative<Model>(decode_model(encode_model(slice))),
                   "a slice that no node accepts");
    Step step;
    trace_all(Domain(grid, share, slice), step);
  }
  return true;
}

}  // namespace graycube
