#include "frontal/rendering/render_job.hpp"

#include <algorithm>
#include <utility>

namespace graycube {

RenderJob::RenderJob(std::uint32_t job, PreparedScene scene, const Hypercube& cube,
                     std::uint32_t threads, const FlowLimits& limits, SumsMode sums,
                     std::uint32_t retries)
    : job_(job),
      scene_(std::move(scene)),
      cube_(cube),
      threads_(threads),
      limits_(limits),
      sums_(sums),
      slices_(cube_, std::move(scene_.slices), {lends(), scene_.makes_copies, scene_.copy_room}),
      light_(job_, scene_.settings, *scene_.plan, cube_.nodes()),
      retries_(retries, cube_.nodes()),
      tiles_({cube_, scene_.mesh}, *scene_.plan, light_.tiles(), way(),
             {scene_, cube_.nodes(), threads_, limits_}),
      loaded_(cube_.nodes()),
      barrier_(cube_.nodes(), has_links()),
      reports_(cube_) {
  if (scene_.boundaries == BoundariesMode::kSliding)
    sliding_.emplace(job_, cube_, scene_, threads_, limits_.sliding);
}

TileHandout::Way RenderJob::way() const {
  if (is_roth()) return TileHandout::Way::kAny;
  if (scene_.boundaries == BoundariesMode::kSliding) return TileHandout::Way::kSliding;
  return scene_.has_replicas ? TileHandout::Way::kHelp : TileHandout::Way::kOwn;
}

RenderJob::Damage RenderJob::note_loss(std::span<const Rank> nodes, bool are_gone) {
  const std::vector<std::uint32_t> under_way = tiles_.under_way();
  Damage damage{static_cast<std::uint32_t>(under_way.size()), {}};
  // In `roth` a tile's rays stay with the node that has it, so that only its tiles can be at fault.
  const bool are_theirs_alone = is_roth() && !nodes.empty();
  std::vector<std::uint32_t> suspects;
  for (const Rank rank : nodes) {
    const bool was_building = barrier_.is_building(rank);
    if (are_gone) {
      barrier_.lose(rank);
      slices_.lose(rank);
    }
    if (was_building && retries_.note_loss_before_it_could_trace(rank))
      damage.culprit = "its part of the scene was being subdivided";
    const std::vector<std::uint32_t> own = tiles_.under_way(rank);
    suspects.insert(suspects.end(), own.begin(), own.end());
  }
  const auto tile = retries_.note_loss(are_theirs_alone ? suspects : under_way,
                                       static_cast<std::uint32_t>(tiles()));
  if (tile) damage.culprit = culprit(*tile);
  return damage;
}

std::string RenderJob::culprit(std::uint32_t tile) const {
  const PixelRect r = scene_.plan->rect(tile);
  const auto span = [](std::uint32_t from, std::uint32_t to) {
    return std::to_string(from) + " to " + std::to_string(to - 1);
  };
  return "tile " + std::to_string(tile) + " (pixels x " + span(r.x0, r.x1) + ", y " +
         span(r.y0, r.y1) + ") was under way";
}

void RenderJob::begin_next_epoch() {
  ++epoch_;
  light_.reopen(*scene_.plan);
  tiles_.reopen(retries_);
  verdict_.reset();
  token_ = {};
  barrier_.begin(epoch_);
  if (!loads_all_again()) return;
  barrier_.load_all();
  loaded_ = RollCall(cube_.nodes());
  if (!sliding_) return;
  sliding_.emplace(job_, cube_, scene_, threads_, limits_.sliding);
  for (std::uint32_t tile = 0; tile < tiles(); ++tile) {
    if (light_.tiles().is_whole(tile)) sliding_->was_whole(tile);
  }
}

std::uint32_t RenderJob::restore(std::span<const std::byte> records) {
  if (sliding_) return 0;
  const std::uint32_t restored = light_.restore(records, *scene_.plan);
  if (restored > 0) tiles_.reopen(retries_);
  return restored;
}

std::vector<std::uint32_t> RenderJob::open_tiles() const {
  if (is_roth() || sliding_ || (epoch_ == 0 && tiles_whole() == 0)) return {};
  return tiles_.left_by_rank();
}

std::vector<std::uint32_t> RenderJob::next_tiles(Rank rank) {
  if (!sliding_) return tiles_.next(rank);
  std::vector<std::uint32_t> tiles =
      tiles_.next(rank, sliding_->room_ahead(rank, tiles_.left(rank)));
  for (const std::uint32_t tile : tiles) sliding_->was_handed_out(tile, rank);
  return tiles;
}

control::Load RenderJob::load() const {
  control::Load m;
  m.job = job_;
  m.epoch = epoch_;
  m.algorithm = scene_.algorithm;
  m.threads = threads_;
  m.grid = scene_.grid;
  m.grain = scene_.grain;
  m.tile_size = scene_.tile_side;
  m.shadows = scene_.shadows;
  m.flow = scene_.flow;
  m.queue = scene_.queue;
  m.fifo = scene_.fifo;
  m.horizon_bytes = scene_.horizon_bytes;
  m.borrow_bytes = lends() ? kBorrowBytes : 0;
  m.is_replica = scene_.has_replicas;
  m.makes_copies = scene_.makes_copies;
  m.sums = sums_;
  m.subdivision = scene_.subdivision;
  m.returns = scene_.returns;
  m.mesh = scene_.mesh;
  m.boundaries = scene_.boundaries;
  m.link_credit_bytes = limits_.link_credit_bytes;
  m.window_tiles = tiles_.window().first_size();
  m.batch_bytes = limits_.batch_bytes;
  set_class_places(m);
  if (scene_.flow == FlowMode::kBlocking) {
    // One evaluator a node, one ray a message, and the queue's places shared out among the links.
    m.threads = 1;
    m.batch_bytes = kRayBytes;
    m.link_credit_bytes = kRayBytes * std::max(1u, scene_.queue / std::max(1u, cube_.dimension()));
  }
  return m;
}

void RenderJob::set_class_places(control::Load& m) const {
  const std::uint64_t classes =
      most_hops(scene_.settings.max_depth, scene_.grid.columns, scene_.grid.rows,
                static_cast<std::uint32_t>(scene_.grid.slab_depths.size() + 1));
  // Classes beyond the last would share its places and could wait for themselves.
  if (classes < kMaxHops) m.outbox_rays = limits_.outbox_rays;
  m.class_places = static_cast<std::uint32_t>(std::max<std::uint64_t>(
      1, limits_.outbox_rays / (4 * classes * std::max(1u, cube_.dimension()))));
}

LightIntake::Taken RenderJob::add_contributions(std::span<const std::byte> batch,
                                                std::vector<Rank>& opened) {
  LightIntake::Taken taken = light_.take(batch, epoch_);
  for (const std::uint32_t tile : taken.whole) {
    opened.push_back(tiles_.is_whole(tile));
    if (sliding_) sliding_->is_whole(tile);
  }
  return taken;
}

bool RenderJob::is_complete() const {
  return light_.tiles().all_whole() && (is_roth() || all_batches_in());
}

std::string RenderJob::contradiction() const {
  if (is_roth() || !all_batches_in() || light_.tiles().all_whole()) return {};
  return "internal error: no node has anything left to do, but " +
         std::to_string(tiles() - tiles_whole()) + " parts of the picture are not final";
}

}  // namespace graycube
