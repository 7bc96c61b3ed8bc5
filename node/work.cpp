#include "node/work.hpp"

#include <algorithm>
#include <chrono>
#include <span>

#include "proto/bounds_bytes.hpp"
#include "proto/horizon_bytes.hpp"
#include "proto/model_slice.hpp"

namespace graycube {
namespace {

/// A node's slice: its model, and where it has any, its foreign bounds and foreign horizons.
struct Slice {
  Model model;
  std::shared_ptr<const ForeignBounds> foreign_bounds;
  std::shared_ptr<const LightHorizons> foreign_horizons;

  void set_foreign(Domain& domain) {
    domain.set_foreign_bounds(std::move(foreign_bounds));
    domain.set_foreign_horizons(std::move(foreign_horizons));
  }
};

std::shared_ptr<const LightHorizons> decoded_horizons(std::span<const std::byte> bytes,
                                                      const Model& model, WorkResult& result) {
  auto decoded = decode_horizons(bytes, model.settings.lights.size());
  if (decoded) return std::make_shared<const LightHorizons>(*std::move(decoded));
  result.error = "the light horizons received are broken";
  return nullptr;
}

/// Of a slice without the light horizons at its end.
std::optional<Slice> decoded_slice(std::span<const std::byte> bytes, std::size_t horizon_bytes,
                                   WorkResult& result) {
  if (horizon_bytes > bytes.size()) {
    result.error = "less came than was announced";
    return std::nullopt;
  }
  bytes = bytes.first(bytes.size() - horizon_bytes);
  auto decoded = take_model(bytes);
  if (const auto* error = std::get_if<ModelError>(&decoded)) {
    result.error = "the macro-region received is broken: " + error->where + ": " + error->why;
    return std::nullopt;
  }
  Slice slice{std::get<Model>(std::move(decoded)), nullptr, nullptr};
  if (begins_with_bounds(bytes)) {
    auto bounds = take_bounds(bytes);
    if (!bounds) {
      result.error = "the foreign bounds received are broken";
      return std::nullopt;
    }
    slice.foreign_bounds = std::make_shared<const ForeignBounds>(*std::move(bounds));
  }
  if (bytes.empty()) return slice;
  slice.foreign_horizons = decoded_horizons(bytes, slice.model, result);
  if (!slice.foreign_horizons) return std::nullopt;
  return slice;
}

void build(BuildWork work, WorkResult& result) {
  const auto started = std::chrono::steady_clock::now();
  const std::span<const std::byte> bytes = work.slice.bytes();
  auto slice = decoded_slice(bytes, work.horizon_bytes, result);
  if (!slice) return;
  std::shared_ptr<const LightHorizons> horizons;
  if (work.horizon_bytes > 0) {
    horizons = decoded_horizons(bytes.last(work.horizon_bytes), slice->model, result);
    if (!horizons) return;
  }
  work.slice = {};
  std::shared_ptr<Domain> domain;
  if (work.edges) {
    const auto frame = CameraFrame::from(slice->model.settings.camera, slice->model.settings.image);
    MacroGrid grid(frame, std::move(work.edges->columns), std::move(work.edges->rows));
    domain = std::make_shared<Domain>(std::move(grid), work.share, std::move(slice->model));
  } else {
    domain = std::make_shared<Domain>(std::move(slice->model));
  }
  domain->set_horizons(std::move(horizons));
  slice->set_foreign(*domain);
  if (work.is_replica) domain->set_replica();
  result.domain = std::move(domain);
  result.build_s =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
}

}  // namespace

void Workbench::clear() { places_ = {}; }

Evaluator& Workbench::evaluator_for(std::shared_ptr<const Domain> domain) {
  auto& [first, second] = places_;
  if (first.domain != domain) std::swap(first, second);
  if (first.domain != domain) {
    first.evaluator = std::make_unique<Evaluator>(*domain);
    first.domain = std::move(domain);
  }
  return *first.evaluator;
}

WorkResult Workbench::run(Work work) {
  WorkResult result;
  result.job = work.job;
  result.epoch = work.epoch;
  result.helped = work.helped;
  result.on_class = work.on_class;
  if (auto* b = std::get_if<BuildWork>(&work.what)) {
    build(std::move(*b), result);
    return result;
  }
  if (const auto* b = std::get_if<BorrowWork>(&work.what)) {
    result.borrowed_from = b->from;
    if (auto slice = decoded_slice(b->slice.bytes(), 0, result))
      result.borrowed = Territory::of(std::move(slice->model));
    return result;
  }
  if (auto* c = std::get_if<CopyWork>(&work.what)) {
    result.copied_from = c->from;
    if (auto slice = decoded_slice(c->slice.bytes(), c->horizon_bytes, result)) {
      const auto domain = work.domain->of_neighbour(c->share, std::move(slice->model));
      slice->set_foreign(*domain);
      result.domain = domain;
    }
    return result;
  }
  Evaluator& evaluator = evaluator_for(std::move(work.domain));
  evaluator.stop_after(work.most_leaving);
  const WalkCounts before = evaluator.walk_counts();
  if (const auto* tile = std::get_if<TileWork>(&work.what)) {
    evaluator.trace_pixels(tile->rect, result.step);
    result.tile = tile->tile;
  } else {
    evaluator.trace_rays(std::get<RayWork>(work.what).rays, result.step);
  }
  result.walk = evaluator.walk_counts().since(before);
  return result;
}

}  // namespace graycube
