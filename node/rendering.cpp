#include "node/rendering.hpp"

#include <algorithm>
#include <utility>

#include "check.hpp"
#include "overloaded.hpp"
#include "trace/work_cost.hpp"

namespace graycube {

namespace {

/// Null unless light goes back along the rays' ways.
std::unique_ptr<LightBack> back_of(const Holding& here) {
  if (!here.limits.are_rays_numbered) return nullptr;
  return std::make_unique<LightBack>(here.seat.links(), here.plan.pixel_count());
}

/// Nothing where received rays wait in this process.
std::optional<FifoApart> fifo_of(const Holding& here, const control::Load& load) {
  const std::uint32_t links = here.seat.links();
  if (!is_fifo_apart(load, links)) return std::nullopt;
  return FifoApart(links, fifo_places(load, links));
}

/// Where boundaries slide a node is not told how many of its own tiles are yet to come, but only
/// when none is: until then it counts on this many.
constexpr std::uint64_t kTilesToBeDealt = 1;

}  // namespace

Rendering::Rendering(Holding holding, const control::Load& load, std::size_t slice_bytes)
    : here_(std::move(holding)),
      generations_(here_.domain, here_.plan.tile_count(),
                   load.boundaries == BoundariesMode::kSliding),
      done_(here_.domain->settings().image.primary_rays() / here_.seat.cube.nodes()),
      flow_(make_flow(load.flow, FlowRules::of(load, here_))),
      queue_(generations_.is_on() ? kTilesToBeDealt : here_.own_tiles(),
             flow_->pace().is_one_by_one),
      fifo_(fifo_of(here_, load)),
      helping_(here_.seat.links(), {load.makes_copies, slice_bytes}),
      borrowing_(here_.seat.cube.nodes(), load.shadows == ShadowMode::kLocal, load.borrow_bytes),
      light_(here_.seat, load.sums, back_of(here_)) {
  flow_->number_by(light_.back());
  if (load.algorithm == Algorithm::kMacro)
    ending_.emplace(here_.seat, flow_->pace().token_never_rests);
}

void Rendering::reset() {
  generations_.reset();
  done_.reset();
  flow_->reset();
  queue_.reset();
  if (fifo_) fifo_->reset();
  helping_.reset();
  borrowing_.reset();
  light_.reset();
  if (ending_) ending_->reset();
  has_begun_ = false;
  working_ = 0;
}

// ---- work

/// The domain in which the tile is traced: in `roth` and in replicas this node's for every tile;
/// null when the tile's regions are not held here.
std::shared_ptr<const Domain> Rendering::domain_of(std::uint32_t tile) const {
  if (here_.is_own_tile(tile) || here_.domain->is_replica()) return here_.domain;
  return helping_.copy_of(here_.seat.bit_of(here_.owner_of_tile(tile)));
}

/// When there is no work, whatever waits to be sent goes out.
std::optional<Work> Rendering::take_work(Mail& mail) {
  if (!has_begun_) return std::nullopt;
  if (!flow_->is_stalled()) {
    flow_->pass_on_what_waits();
    if (auto work = choose_work(mail)) {
      ++working_;
      return work;
    }
    // The evaluator comes by again when the ray is here: until then what it sends can wait.
    if (wait_reason() == WaitReason::kFetching) return std::nullopt;
  }
  flush_on_idle(mail);
  return std::nullopt;
}

std::optional<Work> Rendering::choose_work(Mail& mail) {
  const Pace pace = flow_->pace();
  Work work;
  work.domain = here_.domain;
  work.most_leaving = pace.most_leaving;
  if (auto model = queue_.take_model()) {
    std::visit([&](auto& m) { work.what = std::move(m); }, *model);
    return work;
  }
  const auto route = [this](const RegionIndex& region) { return here_.next_link(region); };
  if (auto taken = flow_->take_class_work(route, mail)) {
    work.on_class = taken->on_class;
    if (work.on_class) work.most_leaving = 1;
    work.what = RayWork{std::move(taken->rays)};
    give_domains(work);
    return work;
  }
  if (flow_->is_full()) return std::nullopt;
  auto piece =
      queue_.take(pace, may_start_tiles(), here_.plan,
                  [this](std::uint32_t bit, std::size_t rays) { flow_->taken(bit, rays); });
  if (!piece) return std::nullopt;
  for (std::uint32_t bit = 0; piece->is_received && bit < here_.seat.links(); ++bit)
    flow_->grant(bit, mail);
  fetch(mail);
  work.helped = piece->helped;
  if (work.helped) work.domain = helping_.copy_of(here_.seat.bit_of(*work.helped));
  if (const auto* pixels = std::get_if<TileWork>(&piece->what); pixels && !generations_.is_on()) {
    work.domain = domain_of(pixels->tile);
    if (work.domain != here_.domain) work.helped = here_.owner_of_tile(pixels->tile);
  }
  std::visit([&](auto& what) { work.what = std::move(what); }, piece->what);
  give_domains(work);
  return work;
}

/// Where boundaries slide, gives a piece of work the domains of its rays' generations.
void Rendering::give_domains(Work& work) const {
  if (!generations_.is_on()) return;
  if (auto* rays = std::get_if<RayWork>(&work.what)) {
    work.generations = generations_.domains();
    std::ranges::stable_sort(rays->rays, {}, [](const RayTask& r) { return +r.generation; });
  } else if (const auto* tile = std::get_if<TileWork>(&work.what)) {
    work.domain = generations_.domain_of_tile(tile->tile);
  }
}

// ---- results

void Rendering::give_result(WorkResult& result, Mail& mail) {
  GRAYCUBE_CHECK(working_ > 0, "a result without work");
  --working_;
  ++moves_;
  flow_->has_moved();
  std::visit(Overloaded{
                 [](Built&) { GRAYCUBE_CHECK(false, "what is being rendered was built again"); },
                 [&](Borrowed& borrowed) { adopt(borrowed, mail); },
                 [&](Copied& copied) { adopt(copied, mail); },
                 [&](SlidTo& slid) { adopt(slid, result.build_s, mail); },
                 [&](Traced& traced) { absorb(traced, mail); },
             },
             result.what);
  pass_token(mail);
}

void Rendering::adopt(Borrowed& borrowed, Mail& mail) {
  if (!borrowed.model) return mail.fail_for_good(borrowed.error);
  const std::vector<RayTask> waited =
      borrowing_.came(borrowed.from, borrowed.model->memory_bytes());
  here_.domain =
      here_.domain->with_borrowed(here_.seat.share_of(borrowed.from), std::move(borrowed.model));
  flow_->release(waited.size());
  queue_.add_own(waited);
}

void Rendering::adopt(Copied& copied, Mail& mail) {
  if (!copied.domain) return mail.fail_for_good(copied.error);
  helping_.adopt(here_.seat.bit_of(copied.from), std::move(copied.domain));
}

void Rendering::adopt(SlidTo& slid, double build_s, Mail& mail) {
  if (!slid.domain) return mail.fail_for_good(slid.error);
  generations_.add(slid.generation, std::move(slid.domain));
  mail.to_frontal(control::Slid{mail.job(), mail.epoch(), slid.generation, build_s});
}

/// Where boundaries slide, tells the frontal what was done here, once that is worth a message.
void Rendering::tell_work(bool is_idle, Mail& mail) {
  if (!generations_.is_on()) return;
  const bool is_often = generations_.holds_two();
  if (is_idle ? !done_.has_news() : !done_.is_worth_telling(queue_.tiles(), is_often)) return;
  if (done_.has_many_rays(is_often)) light_.send(mail);
  mail.to_frontal(done_.tell(mail.job(), mail.epoch(), queue_.tiles()));
}

void Rendering::absorb(Traced& traced, Mail& mail) {
  const Step& step = traced.step;
  tally_.add(step, traced.walk);
  const double cost = work_cost(step.rays.created, traced.walk, here_.domain->subdivision().way);
  helping_.has_traced(cost, traced.tile.has_value());
  done_.add(cost, step.returns.size() + step.leaving.size());
  let_leave(traced, mail);
  keep_set_aside(traced);
  light_.add(step.returns, traced.tile, here_.plan, mail);
  if (!step.leaving.empty() || !step.lacking.empty()) send(false, mail);
  // After each tile it is better known how much work the other tiles are.
  if (traced.tile) share_work(mail);
  tell_work(false, mail);
}

/// The rays of a step that leave, or wait for a model that they lack.
void Rendering::let_leave(const Traced& traced, Mail& mail) {
  for_each_region(traced.step.leaving, [&](RegionIndex region, std::span<const RayTask> rays) {
    if (traced.helped) return leave_copy(rays, *traced.helped);
    const std::uint32_t bit = here_.seat.bit_towards(region);
    if (!borrowing_.is_on()) return flow_->leave(bit, rays, traced.on_class);
    for (const RayTask& ray : rays) {
      if (ray.kind == RayKind::kShadow && waits_for_model(here_.seat.owner_of(region), ray, mail))
        continue;
      flow_->leave(bit, {&ray, 1}, traced.on_class);
    }
  });
  for (const Step::Lacking& l : traced.step.lacking) {
    if (waits_for_model(here_.seat.owner_of(l.region), l.task, mail)) continue;
    flow_->leave(here_.seat.bit_of(here_.seat.owner_of(l.task.region)), {&l.task, 1},
                 traced.on_class);
  }
}

/// Makes a shadow ray wait for the model that it lacks. False when there is no memory for that
/// model: then the ray goes on with the neighbour whose region it has entered.
bool Rendering::waits_for_model(Rank owner, const RayTask& ray, Mail& mail) {
  const Borrowing::Place place = borrowing_.place_of(owner, ray, mail);
  if (place == Borrowing::Place::kHere) queue_.add_own({&ray, 1});
  if (place == Borrowing::Place::kWaits) flow_->reserve(1);
  return place != Borrowing::Place::kThere;
}

/// Rays leave a neighbour's regions, of which this node holds a copy; all enter the same region.
void Rendering::leave_copy(std::span<const RayTask> rays, Rank owner) {
  const Rank next = here_.seat.owner_of(rays.front().region);
  if (next == here_.seat.rank) return queue_.add_own(rays);
  flow_->leave(here_.seat.bit_for_helped(owner, next), rays);
}

void Rendering::keep_set_aside(Traced& traced) {
  std::vector<RayTask>& rays = traced.step.set_aside;
  if (traced.on_class) return flow_->class_work_ended(*traced.on_class, rays);
  if (rays.empty()) return;
  if (traced.helped) return queue_.add_helped_again(*traced.helped, std::move(rays));
  queue_.add_own(rays);
}

/// Gives neighbours that have nothing to do something of what waits here.
void Rendering::share_work(Mail& mail) {
  if (!helping_.is_on()) return;
  for (std::uint32_t bit = 0; bit < here_.seat.links(); ++bit) {
    if (!helping_.has_offer(bit)) continue;
    const auto is_own = [this](std::uint32_t tile) { return here_.is_own_tile(tile); };
    const Helping::Supply supply{queue_.tiles(),
                                 queue_.own_tiles_at_end(Helping::kMostTiles, is_own),
                                 queue_.unassigned(), queue_.received()};
    give(helping_.gift_for(bit, supply, flow_->gift_room(bit)), bit, mail);
  }
}

void Rendering::give(const Helping::Gift& gift, std::uint32_t bit, Mail& mail) {
  const auto take_from = [this](std::uint32_t from, std::size_t rays) { flow_->taken(from, rays); };
  const auto tiles = [&](const BatchStamp& stamp) {
    return encode_assignment(stamp, queue_.give_tiles(gift.most));
  };
  switch (gift.kind) {
    case Helping::Gift::Kind::kNothing: return;
    case Helping::Gift::Kind::kCopy:
      return mail.to_frontal(control::Share{mail.job(), mail.epoch(), mail.peer(bit).value});
    case Helping::Gift::Kind::kTiles: mail.work_to_neighbour(bit, tiles); return;
    case Helping::Gift::Kind::kRays:
      return flow_->give(bit, queue_.give_rays(gift.most, take_from), mail);
  }
}

// ---- sending, and the end

void Rendering::send(bool partial, Mail& mail) {
  if (flow_->send(partial, mail) && all_evaluators_wait()) flush_on_idle(mail);
}

void Rendering::flush_on_idle(Mail& mail) {
  flow_->flush(mail);
  light_.send(mail);
  tell_work(true, mail);
  const bool is_dry = has_begun_ && !queue_.tiles() && queue_.unassigned() == 0 &&
                      !flow_->is_full() && all_evaluators_wait();
  if (is_dry) helping_.offer(mail);
  pass_token(mail);
}

/// When all evaluators wait, none will come by to send on the light that others sent here.
void Rendering::before_mail_leaves(Mail& mail) {
  if (has_begun_ && light_.holds_others_light() && all_evaluators_wait()) flush_on_idle(mail);
}

void Rendering::pass_token(Mail& mail, std::optional<std::uint64_t> ping) {
  const bool is_passive = working_ == 0 && !queue_.has_models() && !has_unfinished();
  if (has_begun_ && ending_) ending_->pass(is_passive, ping, mail);
}

/// Asks for the next received ray while this one is traced, so that it is here when its turn comes.
void Rendering::fetch(Mail& mail) {
  if (fifo_ && queue_.received() == 0) fifo_->ask(mail);
}

/// Received rays come before primary ones, wherever they wait.
bool Rendering::may_start_tiles() const {
  return is_fifo_empty() && flow_->may_start_tiles() &&
         (light_.back() == nullptr || light_.back()->may_start_tiles());
}

bool Rendering::has_unfinished() const {
  return !queue_.is_empty() || !is_fifo_empty() || !flow_->is_empty() || !light_.is_empty();
}

/// Whether none is at work, nor will be before something comes from outside this node.
bool Rendering::all_evaluators_wait() const {
  const WaitReason reason = wait_reason();
  return working_ == 0 && reason != WaitReason::kReady && reason != WaitReason::kFetching;
}

WaitReason Rendering::wait_reason() const {
  if (flow_->is_stalled()) return WaitReason::kBlocked;
  if (queue_.has_models() || flow_->has_class_work()) return WaitReason::kReady;
  if (queue_.has_rays() || flow_->held() > 0) {
    return flow_->is_full() ? WaitReason::kBlocked : WaitReason::kReady;
  }
  if (!is_fifo_empty()) return WaitReason::kFetching;
  if (queue_.has_tiles()) return may_start_tiles() ? WaitReason::kReady : WaitReason::kWindow;
  return queue_.unassigned() > 0 ? WaitReason::kWindow : WaitReason::kIdle;
}

void Rendering::report(control::NodeStats& stats) const {
  here_.report(stats);
  tally_.report(stats);
  generations_.report(stats);
  flow_->report(stats);
  helping_.report(stats);
  borrowing_.report(stats);
  light_.report(stats);
  if (fifo_) fifo_->report(stats);
}

}  // namespace graycube
