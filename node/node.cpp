#include "node/node.hpp"

#include <string>
#include <utility>

#include "overloaded.hpp"
#include "proto/control.hpp"

namespace graycube {

Node::Node(NodeIdentity identity) : membership_(std::move(identity)), mail_(membership_.stamp()) {}

Message Node::hello() const { return Message::of_text(encode(membership_.hello())); }

// ---- messages from the frontal

void Node::on_frontal(const Message& message) {
  if (looks_like_batch(message.frame)) return on_assignment(message.frame);
  on_control(message);
}

/// The rendering of that job and epoch, when it has begun; null otherwise.
Rendering* Node::rendering_of(std::uint32_t job, std::uint32_t epoch) {
  return is_rendering() && membership_.is_now(job, epoch) ? &*rendering_ : nullptr;
}

void Node::on_control(const Message& message) {
  auto decoded = decode(message.text());
  if (const auto* error = std::get_if<ControlError>(&decoded)) {
    return mail_.drop("control message", error->field + ": " + error->why);
  }
  const auto to_rendering = [this](const auto& m, auto&& f) {
    if (Rendering* rendering = rendering_of(m.job, m.epoch)) f(*rendering);
  };
  std::visit(Overloaded{
                 [&](const control::Welcome& m) { on_welcome(m); },
                 [&](const control::Load& m) { on_load(m, message.payload); },
                 [&](const control::HandOn& m) { on_hand_on(m, message.payload); },
                 [&](const control::Prepare& m) { on_prepare(m); },
                 [&](control::Start& m) { on_start(std::move(m)); },
                 [&](const control::Finish& m) { on_finish(m); },
                 [&](const control::Copy& m) {
                   to_rendering(m, [&](Rendering& r) {
                     r.on_copy(Rank{m.rank}, message.payload, load_.horizon_bytes, mail_);
                   });
                 },
                 [&](const control::Lend& m) {
                   to_rendering(
                       m, [&](Rendering& r) { r.on_lend(Rank{m.rank}, message.payload, mail_); });
                 },
                 [&](const control::Relieved& m) {
                   to_rendering(m, [&](Rendering& r) { r.on_relieved(m.tiles, mail_); });
                 },
                 [&](const control::Slide& m) {
                   to_rendering(m, [&](Rendering& r) { r.on_slide(m, message.payload, mail_); });
                 },
                 [&](const control::Turn& m) {
                   to_rendering(m, [&](Rendering& r) { r.on_turn(m, mail_); });
                 },
                 [&](const control::Dealt& m) {
                   to_rendering(m, [&](Rendering& r) { r.on_dealt(mail_); });
                 },
                 [&](const control::AllWhole& m) {
                   to_rendering(m, [&](Rendering& r) { r.on_all_whole(mail_); });
                 },
                 [&](const control::Ping& m) { on_ping(m); },
                 [&](const control::Host& m) { on_host(m); },
                 [&](const control::Shutdown&) {
                   mail_.to_frontal(control::Goodbye{});
                   is_shut_down_ = true;
                 },
                 [&](const auto&) { mail_.drop("control message", "not for a node"); },
             },
             std::get<ControlMessage>(decoded));
}

void Node::on_welcome(const control::Welcome& m) {
  if (!membership_.join(m)) return mail_.drop("welcome", "the number of nodes is not this node's");
  mail_.set_peers(membership_.peers());
  greet();
  for (const Bytes& greeting : membership_.take_early()) on_neighbour(greeting);
}

void Node::on_load(const control::Load& m, const SharedBytes& slice) {
  if (!membership_.has_joined()) return mail_.drop("load", "before welcome");
  const NodeMesh mesh(membership_.seat().cube, m.mesh);
  if (m.grid.columns != std::uint64_t{mesh.columns()} * m.grid.scatter ||
      m.grid.rows != std::uint64_t{mesh.rows()} * m.grid.scatter ||
      m.grid.slab_depths.size() + 1 != mesh.slabs()) {
    return mail_.drop("load", "the grid is not the hypercube's");
  }
  load_ = m;
  membership_.begin(m.job, m.epoch);
  mail_.begin(membership_.stamp());
  has_job_ = true;
  is_ready_sent_ = false;
  rendering_.reset();
  relay_ = SliceRelay::of(seat(), load_);
  unbuilt_slice_.reset();
  if (!relay_ || seat().rank == Rank{0}) take_slice(slice);
  is_load_acknowledged_ = !relay_;
  acknowledge_load_when_greeted();
}

void Node::take_slice(const SharedBytes& slice) {
  unbuilt_slice_ = slice;
  slice_bytes_ = slice.size();
}

/// Slices may come from neighbours as soon as all nodes have said so. To neighbours that haven't
/// greeted nothing can be sent.
void Node::acknowledge_load_when_greeted() {
  if (!has_job_ || is_load_acknowledged_ || !membership_.have_all_greeted()) return;
  is_load_acknowledged_ = true;
  mail_.to_frontal(control::EpochAck{membership_.job(), membership_.epoch()});
}

void Node::on_hand_on(const control::HandOn& m, const SharedBytes& slice) {
  if (!membership_.is_now(m.job, m.epoch) || !has_job_) return;
  if (!relay_) return mail_.drop("hand_on", "slices don't come over links");
  relay_->hand_on(Rank{m.rank}, slice.bytes(), mail_);
}

void Node::on_slice_part(std::uint32_t bit, std::span<const std::byte> batch) {
  if (const auto slice = relay_->on_part(bit, batch, mail_)) take_slice(*slice);
}

void Node::on_prepare(const control::Prepare& m) {
  if (m.job != membership_.job() || !has_job_ || m.epoch < membership_.epoch()) return;
  membership_.begin_epoch(m.epoch);
  mail_.begin(membership_.stamp());
  if (rendering_) rendering_->reset();
  mail_.to_frontal(control::EpochAck{m.job, m.epoch});
}

void Node::on_start(control::Start m) {
  if (!membership_.is_now(m.job, m.epoch) || !rendering_ || rendering_->has_begun()) return;
  const std::uint32_t rank = seat().rank.value;
  membership_.accept_only(std::move(m.incarnations));
  if (rank < m.open_tiles.size()) rendering_->expect_only(m.open_tiles[rank]);
  rendering_->begin();
}

void Node::on_finish(const control::Finish& m) {
  if (m.job != membership_.job() || !has_job_) return;
  control::NodeStats stats;
  if (rendering_) rendering_->report(stats);
  if (relay_) relay_->report(stats);
  membership_.report(stats);
  stats.malformed_drops = mail_.drops();
  if (measure) measure(stats);
  mail_.to_frontal(control::NodeReport{m.job, membership_.epoch(), stats});
  // Late grants of credit are of no use from here on.
  has_job_ = false;
  relay_.reset();
  unbuilt_slice_.reset();
  rendering_.reset();
}

void Node::greet() {
  for (std::uint32_t bit = 0; bit < membership_.seat().links(); ++bit) {
    if (membership_.is_to_greet(bit)) mail_.signal(bit, BatchType::kGreeting);
  }
}

void Node::on_ping(const control::Ping& m) {
  // A greeting, or its answer, may have been lost: then the job waits for it.
  if (has_job_ && !is_rendering()) greet();
  control::Pong pong{m.sequence};
  if (rendering_) rendering_->tell_moves(pong);
  mail_.to_frontal(pong);
  if (rendering_) rendering_->on_ping(m.sequence, mail_);
}

/// The node may be new itself, and not know the farm yet.
void Node::on_host(const control::Host& m) {
  if (Rank{m.rank} == membership_.id().rank) return mail_.drop("host", "it names this node");
  guests_.push_back(m);
}

void Node::on_assignment(std::span<const std::byte> batch) {
  if (!rendering_) return;
  std::vector<std::uint32_t> tiles;
  const auto result = decode_assignment(batch, rendering_->limits(), tiles);
  if (const auto* error = std::get_if<BatchError>(&result))
    return mail_.drop("assignment", to_string(*error));
  const auto& s = std::get<BatchHeader>(result).stamp;
  if (!membership_.is_now(s.job, s.epoch) || s.sender != kFrontalRank) return;
  if (!mail_.is_next_from_frontal(s.sequence)) return mail_.fail("an assignment of tiles was lost");
  rendering_->on_assigned(tiles, mail_);
}

// ---- batches from neighbours

void Node::on_neighbour(std::span<const std::byte> batch) {
  const auto peeked = peek_header(batch);
  if (const auto* error = std::get_if<BatchError>(&peeked))
    return mail_.drop("batch", to_string(*error));
  const auto& header = std::get<BatchHeader>(peeked);
  if (!membership_.has_joined()) {
    // Anything but a greeting is for a dead predecessor.
    if (header.type == BatchType::kGreeting) membership_.keep_early(batch);
    return;
  }
  const std::uint32_t bit = membership_.seat().bit_of(Rank{header.stamp.sender});
  if (bit == membership_.seat().links()) return mail_.drop("batch", "not from a neighbour");
  if (header.type == BatchType::kGreeting || header.type == BatchType::kGreetingAck)
    return on_signal(bit, header.type);
  const bool is_slice_part = header.type == BatchType::kSlicePart;
  const bool is_expected = is_slice_part ? relay_.has_value() : rendering_.has_value();
  if (!is_expected || !membership_.is_of_now(header.stamp)) return;
  if (mail_.is_next_from(bit, header.stamp.sequence)) return on_batch(bit, header.type, batch);
  mail_.fail("a batch from node " + std::to_string(header.stamp.sender) + " was lost on its link");
}

void Node::on_signal(std::uint32_t bit, BatchType type) {
  if (type == BatchType::kGreeting) mail_.signal(bit, BatchType::kGreetingAck);
  membership_.has_greeted(bit);
  acknowledge_load_when_greeted();
  send_ready_when_complete();
}

void Node::on_batch(std::uint32_t bit, BatchType type, std::span<const std::byte> batch) {
  switch (type) {
    case BatchType::kRays:
    case BatchType::kClassRays: return on_rays(bit, type, batch);
    case BatchType::kSlicePart: return on_slice_part(bit, batch);
    case BatchType::kAssignment: return rendering_->on_tiles(bit, batch, mail_);
    case BatchType::kContributions: return rendering_->on_sums(bit, batch, mail_);
    case BatchType::kAnswers: return rendering_->on_answers(bit, batch, mail_);
    case BatchType::kToken: return rendering_->on_token(batch, mail_);
    case BatchType::kIdle:
    case BatchType::kIdleWithCopy: return rendering_->on_offer(bit, batch, type, mail_);
    case BatchType::kLinkCredit: return rendering_->on_link_credit(bit, batch, mail_);
    case BatchType::kClassCredit: return rendering_->on_class_credit(bit, batch, mail_);
    default: return mail_.drop("batch", to_string(type));
  }
}

/// A broken batch can't be repaired, and its rays are missing from the picture: the job fails.
void Node::on_rays(std::uint32_t bit, BatchType type, std::span<const std::byte> batch) {
  const bool on_class = type == BatchType::kClassRays;
  const auto result = decode_rays(batch, rendering_->limits(), received_, type);
  if (const auto* error = std::get_if<BatchError>(&result)) {
    mail_.drop(on_class ? "class rays" : "rays", to_string(*error));
    return mail_.fail(std::string("a broken batch of ") + (on_class ? "class rays" : "rays") +
                      " came from node " + std::to_string(mail_.peer(bit).value));
  }
  if (on_class) return rendering_->on_class_rays(bit, received_, mail_);
  rendering_->on_rays(bit, received_, mail_);
}

// ---- the FIFO's process

std::optional<FifoOrder> Node::fifo_order() const {
  if (!has_job_) return std::nullopt;
  const std::uint32_t links = membership_.seat().links();
  if (!is_fifo_apart(load_, links)) return std::nullopt;
  return FifoOrder{membership_.job(), membership_.epoch(), fifo_places(load_, links)};
}

void Node::on_fifo(std::span<const std::byte> ray) {
  if (rendering_) rendering_->on_handed(ray, mail_);
}

void Node::on_fifo_end(std::string why) {
  if (fifo_order()) mail_.fail(std::move(why));
}

// ---- evaluators

std::optional<Work> Node::take_work() {
  std::optional<Work> work;
  if (unbuilt_slice_) {
    work.emplace().what = build_work();
  } else if (rendering_) {
    work = rendering_->take_work(mail_);
  }
  if (work) {
    work->job = membership_.job();
    work->epoch = membership_.epoch();
  }
  return work;
}

BuildWork Node::build_work() {
  BuildWork build{*std::exchange(unbuilt_slice_, std::nullopt),
                  load_.horizon_bytes,
                  load_.is_replica,
                  load_.subdivision,
                  {},
                  {}};
  if (load_.algorithm == Algorithm::kMacro) {
    build.edges = GridEdges{load_.grid.column_edges, load_.grid.row_edges, load_.grid.slab_depths};
    build.share = seat().share();
  }
  return build;
}

Seat Node::seat() const {
  Seat seat = membership_.seat();
  seat.mode = load_.mesh;
  return seat;
}

void Node::give_result(WorkResult result) {
  if (!has_job_ || result.job != membership_.job()) return;
  // What was built of a slice since the job was loaded is as good in a later epoch.
  const bool is_of_load = result.epoch >= load_.epoch;
  auto* const built = std::get_if<Built>(&result.what);
  if (built != nullptr && is_of_load) return adopt(*built, result.build_s);
  if (!rendering_) return;
  if (result.epoch == membership_.epoch()) return rendering_->give_result(result, mail_);
  auto* const copied = std::get_if<Copied>(&result.what);
  if (copied != nullptr && is_of_load) rendering_->adopt(*copied, mail_);
}

void Node::adopt(Built& built, double build_s) {
  if (!built.domain) return mail_.fail_for_good(built.error);
  build_s_ = build_s;
  rendering_.emplace(Holding::of(seat(), load_, std::move(built.domain)), load_, slice_bytes_);
  send_ready_when_complete();
}

void Node::send_ready_when_complete() {
  if (!rendering_ || is_ready_sent_ || !membership_.have_all_greeted()) return;
  is_ready_sent_ = true;
  const Domain& domain = *rendering_->holding().domain;
  mail_.to_frontal(control::Ready{membership_.job(), membership_.epoch(),
                                  domain.model().primitives.size(), domain.model().objects.size(),
                                  domain.cell_count(), build_s_});
}

bool Node::may_have_work() const {
  return unbuilt_slice_ || (is_rendering() && wait_reason() == WaitReason::kReady);
}

std::vector<Node::Outgoing> Node::take_outgoing() {
  if (rendering_) rendering_->before_mail_leaves(mail_);
  return mail_.take();
}

}  // namespace graycube
