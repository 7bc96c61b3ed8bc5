#include "node/work.hpp"

#include <chrono>

#include "proto/model_slice.hpp"

namespace graycube {
namespace {

void build(BuildWork work, WorkResult& result) {
  const auto started = std::chrono::steady_clock::now();
  auto decoded = decode_model(work.slice);
  if (const auto* error = std::get_if<ModelError>(&decoded)) {
    result.error = "the macro-region received is broken: " + error->where + ": " + error->why;
    return;
  }
  work.slice = {};
  Model model = std::get<Model>(std::move(decoded));
  if (work.edges) {
    const auto frame = CameraFrame::from(model.settings.camera, model.settings.image);
    MacroGrid grid(frame, std::move(work.edges->columns), std::move(work.edges->rows));
    result.domain = std::make_shared<const Domain>(std::move(grid), work.region, std::move(model));
  } else {
    result.domain = std::make_shared<const Domain>(std::move(model));
  }
  result.build_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
}

}  // namespace

WorkResult run(Work work) {
  WorkResult result;
  result.job = work.job;
  result.epoch = work.epoch;
  if (auto* b = std::get_if<BuildWork>(&work.what)) {
    build(std::move(*b), result);
    return result;
  }
  Evaluator evaluator(*work.domain);
  if (const auto* tile = std::get_if<TileWork>(&work.what)) {
    evaluator.trace_pixels(tile->rect, result.step);
  } else {
    evaluator.trace_rays(std::get<RayWork>(work.what).rays, result.step);
  }
  return result;
}

}  // namespace graycube
