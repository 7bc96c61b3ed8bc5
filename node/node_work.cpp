// What a node's brain gives its evaluators to do, and what becomes of the results.
#include <algorithm>

#include "geometry/check.hpp"
#include "node/node.hpp"
#include "proto/tile_shape.hpp"

namespace graycube {

std::optional<Work> Node::take_work() {
  Work work{job_, epoch_, domain_, {}};
  if (state_ == State::kBuilding && unbuilt_slice_) {
    BuildWork build{std::move(*unbuilt_slice_), std::nullopt, {}};
    unbuilt_slice_.reset();
    if (load_.algorithm == Algorithm::kMacro) {
      build.edges = GridEdges{load_.grid.column_edges, load_.grid.row_edges};
      build.region = {static_cast<std::uint16_t>(cube_->column_of(id_.rank)),
                      static_cast<std::uint16_t>(cube_->row_of(id_.rank))};
    }
    work.what = std::move(build);
    return work;
  }
  if (state_ != State::kRendering) return std::nullopt;
  if (!rays_.is_empty()) {
    RayWork batch;
    batch.rays = rays_.take(kMaxRaysPerWork,
                            [&](std::uint32_t bit) { links_[bit].ungranted += kRayBytes; });
    for (Link& link : links_) {
      if (2 * link.ungranted >= load_.link_credit_bytes) grant_credit(link);
    }
    work.what = std::move(batch);
  } else if (!tiles_.empty()) {
    work.what = TileWork{plan_->rect(tiles_.front())};
    tiles_.pop_front();
  } else {
    flush_on_idle();
    return std::nullopt;
  }
  ++working_;
  return work;
}

void Node::give_result(WorkResult result) {
  if (result.job != job_ || result.epoch != epoch_ || state_ == State::kNoJob) return;
  if (state_ == State::kBuilding) return adopt_domain(result);
  GRAYCUBE_CHECK(working_ > 0, "a result without work");
  --working_;
  absorb(result.step);
  pass_token();
}

void Node::adopt_domain(WorkResult& result) {
  if (!result.domain) {
    send_control(control::NodeError{job_, result.error});
    return;
  }
  domain_ = std::move(result.domain);
  build_s_ = result.build_s;
  const RenderSettings& settings = domain_->settings();
  const TileShape shape = tile_shape(load_.grain, load_.tile_size, settings.image);
  if (domain_->grid() != nullptr) {
    plan_.emplace(settings.image, shape, *domain_->grid());
  } else {
    plan_.emplace(settings.image, shape);
  }
  limits_.pixel_count = std::uint64_t{settings.image.width} * settings.image.height;
  limits_.tile_count = plan_->tile_count();
  limits_.max_depth = settings.max_depth;
  limits_.columns = domain_->grid() != nullptr ? domain_->grid()->columns() : 1;
  limits_.rows = domain_->grid() != nullptr ? domain_->grid()->rows() : 1;
  limits_.nodes = cube_->nodes();
  state_ = State::kReady;
  forget_rays();
  send_ready_when_complete();
}

void Node::send_ready_when_complete() {
  const bool linked =
      std::all_of(links_.begin(), links_.end(), [](const Link& l) { return l.is_greeted; });
  if (state_ != State::kReady || is_ready_sent_ || !linked) return;
  is_ready_sent_ = true;
  const Model& model = domain_->model();
  send_control(control::Ready{job_, epoch_, model.primitives.size(), model.objects.size(),
                              domain_->cell_count(), build_s_});
}

void Node::absorb(Step& step) {
  const auto& created = step.rays.created;
  stats_.primary += created[static_cast<std::size_t>(RayKind::kPrimary)];
  stats_.shadow += created[static_cast<std::size_t>(RayKind::kShadow)];
  stats_.reflection += created[static_cast<std::size_t>(RayKind::kReflection)];
  stats_.refraction += created[static_cast<std::size_t>(RayKind::kRefraction)];
  stats_.skipped_by_horizon += step.rays.skipped_by_horizon;
  stats_.non_finite += step.rounding.non_finite;
  stats_.clamped += step.rounding.clamped;
  for (const RayTask& ray : step.leaving) {
    const std::uint32_t bit = bit_of(cube_->owner_of(ray.region.column, ray.region.row));
    GRAYCUBE_CHECK(bit < links_.size(), "a ray left for a node that is no neighbour");
    links_[bit].outbox.push_back(ray);
    ++(ray.kind == RayKind::kShadow ? stats_.forwarded_shadow : stats_.forwarded_secondary);
  }
  if (!step.leaving.empty()) {
    for (Link& link : links_) send_rays(link, false);
  }
  merge_.add(step.returns);
  if (merge_.is_full()) flush_contributions();
}

WaitReason Node::wait_reason() const {
  if (!rays_.is_empty() || !tiles_.empty()) return WaitReason::kReady;
  return unassigned_tiles_ > 0 ? WaitReason::kWindow : WaitReason::kIdle;
}

bool Node::may_have_work() const {
  if (state_ == State::kBuilding) return unbuilt_slice_.has_value();
  return state_ == State::kRendering && wait_reason() == WaitReason::kReady;
}

}  // namespace graycube
