#include "node/work.hpp"

#include <algorithm>
#include <span>

#include "overloaded.hpp"
#include "proto/bounds_bytes.hpp"
#include "proto/horizon_bytes.hpp"
#include "proto/model_slice.hpp"

namespace graycube {
namespace {

/// A node's slice: its model, its foreign bounds and its foreign horizons; null when it has none.
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
                                                      const Model& model, std::string& error) {
  auto decoded = decode_horizons(bytes, model.settings.lights.size());
  if (decoded) return std::make_shared<const LightHorizons>(*std::move(decoded));
  error = "the light horizons received are broken";
  return nullptr;
}

/// Decodes a slice without the light horizons at its end, which are `horizon_bytes` long.
std::optional<Slice> decoded_slice(std::span<const std::byte> bytes, std::size_t horizon_bytes,
                                   std::string& error) {
  if (horizon_bytes > bytes.size()) {
    error = "less came than was announced";
    return std::nullopt;
  }
  bytes = bytes.first(bytes.size() - horizon_bytes);
  auto decoded = take_model(bytes);
  if (const auto* broken = std::get_if<ModelError>(&decoded)) {
    error = "the macro-region received is broken: " + broken->where + ": " + broken->why;
    return std::nullopt;
  }
  Slice slice{std::get<Model>(std::move(decoded)), nullptr, nullptr};
  if (begins_with_bounds(bytes)) {
    auto bounds = take_bounds(bytes);
    if (!bounds) {
      error = "the foreign bounds received are broken";
      return std::nullopt;
    }
    slice.foreign_bounds = std::make_shared<const ForeignBounds>(*std::move(bounds));
  }
  if (bytes.empty()) return slice;
  slice.foreign_horizons = decoded_horizons(bytes, slice.model, error);
  if (!slice.foreign_horizons) return std::nullopt;
  return slice;
}

Built build(BuildWork work) {
  Built built;
  const std::span<const std::byte> bytes = work.slice.bytes();
  auto slice = decoded_slice(bytes, work.horizon_bytes, built.error);
  if (!slice) return built;
  std::shared_ptr<const LightHorizons> horizons;
  if (work.horizon_bytes > 0) {
    horizons = decoded_horizons(bytes.last(work.horizon_bytes), slice->model, built.error);
    if (!horizons) return built;
  }
  work.slice = {};
  std::shared_ptr<Domain> domain;
  if (work.edges) {
    const auto frame = CameraFrame::from(slice->model.settings.camera, slice->model.settings.image);
    MacroGrid grid(frame, std::move(work.edges->columns), std::move(work.edges->rows));
    domain = std::make_shared<Domain>(std::move(grid), work.share, std::move(slice->model),
                                      work.subdivision);
  } else {
    domain = std::make_shared<Domain>(std::move(slice->model), work.subdivision);
  }
  domain->set_horizons(std::move(horizons));
  slice->set_foreign(*domain);
  if (work.is_replica) domain->set_replica();
  built.domain = std::move(domain);
  return built;
}

Borrowed borrow(const BorrowWork& work, const Domain& own) {
  Borrowed borrowed{work.from, nullptr, {}};
  auto slice = decoded_slice(work.slice.bytes(), 0, borrowed.error);
  if (slice) borrowed.model = Territory::of(std::move(slice->model), own.subdivision());
  return borrowed;
}

Copied copy(const CopyWork& work, const Domain& own) {
  Copied copied{work.from, nullptr, {}};
  auto slice = decoded_slice(work.slice.bytes(), work.horizon_bytes, copied.error);
  if (!slice) return copied;
  const auto domain = own.of_neighbour(work.share, std::move(slice->model));
  slice->set_foreign(*domain);
  copied.domain = domain;
  return copied;
}

SlidTo slide(SlideWork work, const Domain& own) {
  SlidTo slid{work.generation, nullptr, {}};
  MacroGrid grid(own.frame(), std::move(work.edges.columns), std::move(work.edges.rows));
  if (work.slice.empty()) {
    slid.domain = std::make_shared<Domain>(
        own.restricted_to(grid, work.share).of_generation(work.generation));
    return slid;
  }
  auto slice = decoded_slice(work.slice.bytes(), 0, slid.error);
  if (!slice) return slid;
  work.slice = {};
  const auto domain = own.of_neighbour(work.share, std::move(slice->model));
  slid.domain = std::make_shared<Domain>(
      domain->restricted_to(grid, work.share).of_generation(work.generation));
  return slid;
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

Evaluator& Workbench::evaluator_for(const Work& work, std::uint32_t generation) {
  return evaluator_for(work.generations[generation] ? work.generations[generation] : work.domain);
}

/// Traces the primary rays of `pixels`; or `rays`, when `pixels` is null.
Traced Workbench::trace(Work& work, const PixelRect* pixels, std::span<const RayTask> rays) {
  Traced traced{work.helped, work.on_class, std::nullopt, {}, {}};
  const auto in_step = [&](Evaluator& evaluator, auto&& trace) {
    evaluator.stop_after(work.most_leaving);
    const WalkCounts before = evaluator.walk_counts();
    trace(evaluator);
    traced.walk.add(evaluator.walk_counts().since(before));
  };
  if (pixels != nullptr) {
    in_step(evaluator_for(work.domain),
            [&](Evaluator& evaluator) { evaluator.trace_pixels(*pixels, traced.step); });
  }
  for_each_run(
      rays, [](const RayTask& ray) { return ray.generation; },
      [&](std::uint32_t generation, std::span<const RayTask> run) {
        in_step(evaluator_for(work, generation),
                [&](Evaluator& evaluator) { evaluator.trace_rays(run, traced.step); });
      });
  return traced;
}

WorkResult Workbench::run(Work work) {
  WorkResult result{work.job, work.epoch, 0, {}};
  std::visit(Overloaded{
                 [&](BuildWork& build_work) { result.what = build(std::move(build_work)); },
                 [&](BorrowWork& borrow_work) { result.what = borrow(borrow_work, *work.domain); },
                 [&](CopyWork& copy_work) { result.what = copy(copy_work, *work.domain); },
                 [&](SlideWork& to) { result.what = slide(std::move(to), *work.domain); },
                 [&](TileWork& tile) {
                   result.what = trace(work, &tile.rect, {});
                   std::get<Traced>(result.what).tile = tile.tile;
                 },
                 [&](RayWork& rays) { result.what = trace(work, nullptr, rays.rays); },
             },
             work.what);
  return result;
}

}  // namespace graycube
