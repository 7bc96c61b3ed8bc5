// What a node's brain gives its evaluators to do, and what becomes of the results.
#include <algorithm>
#include <utility>

#include "geometry/check.hpp"
#include "node/node.hpp"
#include "overloaded.hpp"
#include "proto/control.hpp"
#include "proto/share_of.hpp"
#include "proto/tile_shape.hpp"
#include "trace/work_cost.hpp"

namespace graycube {

namespace {

/// No primary rays are started while so many rays wait to be sent.
constexpr std::uint64_t kLongOutboxes = 8192;

}  // namespace

std::optional<Work> Node::take_work() {
  Work work;
  work.job = job_;
  work.epoch = epoch_;
  work.domain = domain_;
  if (state_ == State::kBuilding && unbuilt_slice_) {
    BuildWork build{std::move(*unbuilt_slice_), load_.horizon_bytes, load_.is_replica, std::nullopt, {}};
    unbuilt_slice_.reset();
    if (load_.algorithm == Algorithm::kMacro) {
      build.edges = GridEdges{load_.grid.column_edges, load_.grid.row_edges};
      build.share = share_of(*cube_, id_.rank);
    }
    work.what = std::move(build);
    return work;
  }
  if (state_ != State::kRendering) return std::nullopt;
  if (!stalled_.empty()) {
    flush_on_idle();
    return std::nullopt;
  }
  pass_on_what_waits();
  if (!choose_work(work)) {
    flush_on_idle();
    return std::nullopt;
  }
  ++working_;
  return work;
}

/// False when there is nothing that may be done now.
bool Node::choose_work(Work& work) {
  const std::size_t most_rays = is_blocking() ? 1 : kMaxRaysPerWork;
  if (!is_blocking()) work.most_leaving = std::max<std::uint64_t>(1, load_.outbox_rays / kWorksPerOutboxes);
  if (!lent_.empty()) {
    std::visit([&](auto& model) { work.what = std::move(model); }, lent_.front());
    lent_.pop_front();
    return true;
  }
  if (take_class_rays(work)) return true;
  if (is_full()) return false;
  if (!own_rays_.is_empty()) {
    work.what = RayWork{own_rays_.take(most_rays, [](std::uint32_t, std::size_t) {})};
  } else if (!rays_.is_empty()) {
    RayWork batch;
    batch.rays = rays_.take(most_rays, [this](std::uint32_t bit, std::size_t count) { take_from(bit, count); });
    for (Link& link : links_) grant_credit(link, is_blocking() ? 1 : half_credit());
    work.what = std::move(batch);
  } else if (!helped_.empty()) {
    work.helped = helped_.front().owner;
    work.domain = copies_[bit_of(*work.helped)];
    if (helped_.front().is_received) take_from(bit_of(*work.helped), helped_.front().rays.size());
    work.what = RayWork{std::move(helped_.front().rays)};
    helped_.pop_front();
  } else if (const auto pixels = may_start_tiles() ? next_pixels() : std::nullopt) {
    const std::uint32_t tile = plan_->tile_of_pixel(pixels->y0 * domain_->settings().image.width + pixels->x0);
    work.domain = domain_of(tile);
    if (work.domain != domain_) work.helped = owner_of(plan_->owner_of_tile(tile));
    work.what = TileWork{*pixels, tile};
  } else {
    return false;
  }
  return true;
}

/// Rays that came across a link are taken from the store: their credit is the peer's again.
void Node::take_from(std::uint32_t bit, std::size_t rays) {
  if (bit < links_.size()) links_[bit].ungranted += rays * kRayBytes;
}

/// Primary rays for an evaluator: a tile of them, or a pixel's where flow is blocking.
std::optional<PixelRect> Node::next_pixels() {
  if (!open_tile_) {
    if (tiles_.empty()) return std::nullopt;
    open_tile_ = plan_->rect(tiles_.front());
    tiles_.pop_front();
    open_pixel_ = 0;
  }
  const PixelRect tile = *open_tile_;
  if (!is_blocking()) {
    open_tile_.reset();
    return tile;
  }
  const std::uint32_t width = tile.x1 - tile.x0;
  const std::uint32_t x = tile.x0 + open_pixel_ % width, y = tile.y0 + open_pixel_ / width;
  if (++open_pixel_ == width * (tile.y1 - tile.y0)) open_tile_.reset();
  return PixelRect{x, y, x + 1, y + 1};
}

void Node::give_result(WorkResult result) {
  if (result.job != job_ || result.epoch != epoch_ || state_ == State::kNoJob) return;
  if (auto* built = std::get_if<Built>(&result.what)) return adopt_domain(*built, result.build_s);
  GRAYCUBE_CHECK(working_ > 0, "a result without work");
  --working_;
  ++moves_;
  std::visit(Overloaded{
                 [](Built&) {},
                 [this](Borrowed& borrowed) { adopt_borrowed(borrowed); },
                 [this](Copied& copied) { adopt_copy(copied); },
                 [this](Traced& traced) {
                   absorb(traced);
                   // Of each tile more is known of what the others take.
                   if (traced.tile) share_work();
                 },
             },
             result.what);
  pass_token();
}

void Node::adopt_domain(Built& built, double build_s) {
  if (state_ != State::kBuilding) return;
  if (!built.domain) return send_control(control::NodeError{job_, built.error});
  domain_ = std::move(built.domain);
  build_s_ = build_s;
  const RenderSettings& settings = domain_->settings();
  const TileShape shape = tile_shape(load_.grain, load_.tile_size, settings.image);
  if (domain_->grid() != nullptr) {
    plan_.emplace(settings.image, shape, *domain_->grid(), load_.grid.own_edges);
  } else {
    plan_.emplace(settings.image, shape);
  }
  limits_.pixel_count = std::uint64_t{settings.image.width} * settings.image.height;
  limits_.tile_count = plan_->tile_count();
  limits_.max_depth = settings.max_depth;
  limits_.lights = std::max(1u, static_cast<std::uint32_t>(settings.lights.size()));
  own_tiles_ = 0;
  if (domain_->grid() != nullptr) own_tiles_ = plan_->tiles_of(share_of(*cube_, id_.rank)).size();
  limits_.columns = domain_->grid() != nullptr ? domain_->grid()->columns() : 1;
  limits_.rows = domain_->grid() != nullptr ? domain_->grid()->rows() : 1;
  limits_.nodes = cube_->nodes();
  limits_.max_hops = static_cast<std::uint32_t>(
      std::min<std::uint64_t>(most_hops(limits_.max_depth, limits_.columns, limits_.rows), kMaxHops));
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

void Node::absorb(Traced& traced) {
  const Step& step = traced.step;
  const auto& created = step.rays.created;
  work_done_ += work_cost(created, traced.walk);
  if (traced.tile) ++tiles_traced_;
  stats_.primary += created[static_cast<std::size_t>(RayKind::kPrimary)];
  stats_.shadow += created[static_cast<std::size_t>(RayKind::kShadow)];
  stats_.reflection += created[static_cast<std::size_t>(RayKind::kReflection)];
  stats_.refraction += created[static_cast<std::size_t>(RayKind::kRefraction)];
  stats_.skipped_by_horizon += step.rays.skipped_by_horizon;
  stats_.non_finite += step.rounding.non_finite;
  stats_.clamped += step.rounding.clamped;
  absorb_rays(traced);
  std::span<const PixelReturn> returns = step.returns;
  while (!returns.empty()) {
    // Where children's light for the same pixels will come, each has its one place.
    returns = returns.subspan(traced.tile && !has_children_
                                  ? merge_.add_tile(returns, *traced.tile, *plan_)
                                  : merge_.add(returns, *plan_));
    if (merge_.is_full()) flush_contributions();
  }
  if (is_blocking()) {
    send_stalled();
  } else if (!step.leaving.empty() || !step.lacking.empty()) {
    for (Link& link : links_) send_rays(link, false);
  }
}

/// The rays of a step: those that leave, those that lack a model, those that were set aside.
void Node::absorb_rays(Traced& traced) {
  const Step& step = traced.step;
  if (traced.on_class) release_room_after(*traced.on_class);
  for_each_region(step.leaving, [&](RegionIndex region, std::span<const RayTask> rays) {
    if (traced.helped) return leave_copy(rays, *traced.helped);
    const std::uint32_t bit = bit_towards(region);
    if (load_.shadows != ShadowMode::kLocal) return leave(traced.on_class, bit, rays);
    for (const RayTask& ray : rays) {
      if (ray.kind == RayKind::kShadow && waits_for_model(owner_of(region), ray)) continue;
      leave(traced.on_class, bit, {&ray, 1});
    }
  });
  for (const Step::Lacking& l : step.lacking) {
    if (waits_for_model(owner_of(l.region), l.task)) continue;
    leave(traced.on_class, bit_of(owner_of(l.task.region)), {&l.task, 1});
  }
  if (step.set_aside.empty()) return;
  if (traced.on_class) {
    class_rays_.add_own(step.set_aside);
  } else if (traced.helped) {
    helped_.push_front({*traced.helped, std::move(traced.step.set_aside), false});
  } else {
    own_rays_.add(step.set_aside, kNoLink);
  }
}

void Node::count_forwarded(std::uint32_t bit, std::span<const RayTask> rays) {
  GRAYCUBE_CHECK(bit < links_.size(), "a ray left for a node that is no neighbour");
  for (const RayTask& ray : rays) {
    ++(ray.kind == RayKind::kShadow ? stats_.forwarded_shadow : stats_.forwarded_secondary);
  }
}

void Node::forward_across(std::uint32_t bit, std::span<const RayTask> rays) {
  count_forwarded(bit, rays);
  if (is_blocking()) {
    stalled_.insert(stalled_.end(), rays.begin(), rays.end());
    stats_.outbox_peak = std::max<std::uint64_t>(stats_.outbox_peak, stalled_.size());
    return;
  }
  links_[bit].outbox.add(rays);
  outbox_rays_ += rays.size();
  stats_.outbox_peak = std::max(stats_.outbox_peak, outbox_rays_);
}

/// What has arrived is always traced, so the neighbours' inboxes and with them the outboxes empty themselves.
bool Node::may_start_tiles() const { return outbox_rays_ < kLongOutboxes && !is_full(); }

WaitReason Node::wait_reason() const {
  if (!stalled_.empty()) return WaitReason::kBlocked;
  if (!lent_.empty() || has_class_ray_to_take()) return WaitReason::kReady;
  const bool has_rays = !rays_.is_empty() || !own_rays_.is_empty() || !helped_.empty() || !passing_.empty() ||
                        !class_rays_.is_empty();
  if (has_rays) return is_full() ? WaitReason::kBlocked : WaitReason::kReady;
  if (!tiles_.empty() || open_tile_) return may_start_tiles() ? WaitReason::kReady : WaitReason::kWindow;
  return unassigned_tiles_ > 0 ? WaitReason::kWindow : WaitReason::kIdle;
}

bool Node::may_have_work() const {
  if (state_ == State::kBuilding) return unbuilt_slice_.has_value();
  return state_ == State::kRendering && wait_reason() == WaitReason::kReady;
}

}  // namespace graycube
