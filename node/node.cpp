#include "node/node.hpp"

#include <algorithm>
#include <utility>

#include "geometry/check.hpp"
#include "proto/control.hpp"
#include "proto/tile_shape.hpp"

namespace graycube {
namespace {

/// White rounds with the same non-zero sum that are taken for a loss. A batch may be slow while the token
/// goes round quickly, so after kFreeRounds of them each further round waits for the frontal's next ping.
constexpr std::uint32_t kRoundsUntilLossHere = 32;
constexpr std::uint32_t kFreeRounds = 1;
/// A batch this small still goes out at once when its link is empty.
constexpr std::size_t kLeastEagerRays = 32;

TerminationRing::Role role_of(Rank rank) {
  return rank.value == 0 ? TerminationRing::Role::kInitiator : TerminationRing::Role::kMember;
}

}  // namespace

Node::Node(NodeIdentity identity)
    : id_(std::move(identity)), ring_(role_of(id_.rank), kRoundsUntilLossHere) {}

Message Node::hello() const {
  control::Hello m;
  m.rank = id_.rank.value;
  m.pid = id_.pid;
  m.incarnation = id_.incarnation;
  m.endpoint = id_.endpoint;
  m.threads = id_.threads;
  m.version = id_.version;
  return Message::of_text(encode(m));
}

// ---- messages from the frontal

void Node::on_frontal(const Message& message) {
  if (looks_like_batch(message.frame)) {
    on_frontal_batch(message.frame);
  } else {
    on_control(message);
  }
}

void Node::on_control(const Message& message) {
  auto decoded = decode(message.text());
  if (const auto* error = std::get_if<ControlError>(&decoded)) {
    drop("control message", error->field + ": " + error->why);
    return;
  }
  const auto& m = std::get<ControlMessage>(decoded);
  if (const auto* welcome = std::get_if<control::Welcome>(&m)) return on_welcome(*welcome);
  if (const auto* load = std::get_if<control::Load>(&m)) return on_load(*load, message.payload);
  if (const auto* prepare = std::get_if<control::Prepare>(&m)) return on_prepare(*prepare);
  if (const auto* start = std::get_if<control::Start>(&m)) return on_start(*start);
  if (const auto* finish = std::get_if<control::Finish>(&m)) return on_finish(*finish);
  if (const auto* ping = std::get_if<control::Ping>(&m)) {
    send_control(control::Pong{ping->sequence});
    return pass_token(true);
  }
  if (std::holds_alternative<control::Shutdown>(m)) {
    send_control(control::Goodbye{});
    shut_down_ = true;
    return;
  }
  drop("control message", "not for a node");
}

void Node::on_welcome(const control::Welcome& m) {
  const auto cube = Hypercube::of_size(m.nodes);
  if (!cube || !cube->has(id_.rank) || m.endpoints.size() != m.nodes) {
    return drop("welcome", "the number of nodes is not this node's");
  }
  cube_ = cube;
  endpoints_ = m.endpoints;
  links_.resize(cube->dimension());
  for (std::uint32_t bit = 0; bit < cube->dimension(); ++bit) {
    links_[bit].peer = cube->neighbour(id_.rank, bit);
    links_[bit].is_greeted = false;
    if (endpoints_[links_[bit].peer.value].empty()) continue;
    outgoing_.push_back(
        {links_[bit].peer, Message::of_batch(encode_signal(stamp(0), BatchType::kGreeting))});
  }
  for (const Bytes& greeting : std::exchange(early_greetings_, {})) on_neighbour(greeting);
}

void Node::on_load(const control::Load& m, const Bytes& slice) {
  if (!cube_) return drop("load", "before welcome");
  if (m.grid.columns != std::uint64_t{cube_->columns()} * m.grid.scatter ||
      m.grid.rows != std::uint64_t{cube_->rows()} * m.grid.scatter) {
    return drop("load", "the grid is not the hypercube's");
  }
  load_ = m;
  job_ = m.job;
  epoch_ = m.epoch;
  state_ = State::kBuilding;
  is_ready_sent_ = false;
  domain_.reset();
  plan_.reset();
  unbuilt_slice_ = slice;
  incarnations_.clear();
  stats_ = {};
  forget_rays();
}

void Node::on_prepare(const control::Prepare& m) {
  if (m.job != job_ || state_ == State::kNoJob || m.epoch < epoch_) return;
  epoch_ = m.epoch;
  forget_rays();
  if (state_ == State::kRendering) state_ = State::kReady;
  send_control(control::EpochAck{job_, epoch_});
}

void Node::on_start(const control::Start& m) {
  if (m.job != job_ || m.epoch != epoch_ || state_ != State::kReady) return;
  incarnations_ = m.incarnations;
  state_ = State::kRendering;
}

void Node::on_finish(const control::Finish& m) {
  if (m.job != job_ || state_ == State::kNoJob) return;
  stats_.rank = id_.rank.value;
  stats_.gray = cube_->label_of(id_.rank).value;
  stats_.pid = id_.pid;
  stats_.malformed_drops = drops_;
  if (domain_) stats_.primitives = domain_->model().primitives.size();
  if (measure) measure(stats_);
  send_control(control::NodeReport{job_, epoch_, stats_});
  // Late grants of credit are stale from here on.
  state_ = State::kNoJob;
  unbuilt_slice_.reset();
  domain_.reset();
  plan_.reset();
  forget_rays();
}

/// Everything of the epoch that ends here: rays, outboxes, unsent contributions, token, sequences, credit.
void Node::forget_rays() {
  tiles_.clear();
  rays_.clear();
  merge_.clear();
  ring_.reset();
  working_ = 0;
  contribution_sequence_ = 0;
  assignment_sequence_ = 0;
  for (Link& link : links_) link.reset(load_.link_credit_bytes);
  unassigned_tiles_ = 0;
  if (plan_ && domain_ && domain_->grid() != nullptr) {
    unassigned_tiles_ = plan_->tile_count_of(id_.rank.value);
  }
}

void Node::on_frontal_batch(const Bytes& batch) {
  std::vector<std::uint32_t> tiles;
  const auto result = decode_assignment(batch, limits_, tiles);
  if (const auto* error = std::get_if<BatchError>(&result)) {
    return drop("assignment", to_string(*error));
  }
  const auto& s = std::get<BatchHeader>(result).stamp;
  if (s.job != job_ || s.epoch != epoch_ || s.sender != kFrontalRank || !plan_) return;
  if (s.sequence != assignment_sequence_++) {
    return send_control(control::NodeError{job_, "an assignment of tiles was lost"});
  }
  tiles_.insert(tiles_.end(), tiles.begin(), tiles.end());
  unassigned_tiles_ -= std::min<std::uint64_t>(unassigned_tiles_, tiles.size());
}

// ---- messages from neighbours

void Node::on_neighbour(const Bytes& batch) {
  const auto peeked = peek_header(batch);
  if (const auto* error = std::get_if<BatchError>(&peeked)) {
    return drop("batch", to_string(*error));
  }
  const auto& header = std::get<BatchHeader>(peeked);
  if (!cube_) {
    // A neighbour may have heard the frontal's welcome first. Anything else is for a dead predecessor.
    const bool keep = header.type == BatchType::kGreeting && early_greetings_.size() < kMaxDimension;
    if (keep) early_greetings_.push_back(batch);
    return;
  }
  const std::uint32_t bit = bit_of(Rank{header.stamp.sender});
  if (bit >= links_.size()) return drop("batch", "not from a neighbour");
  Link& link = links_[bit];
  if (header.type == BatchType::kGreeting || header.type == BatchType::kGreetingAck) {
    return on_signal(link, header);
  }
  const BatchStamp& s = header.stamp;
  const bool stale = s.job != job_ || s.epoch != epoch_ || !plan_ ||
                     (!incarnations_.empty() && incarnations_.size() > s.sender &&
                      incarnations_[s.sender] != s.incarnation);
  if (stale) return;
  if (s.sequence != link.expected_sequence++) {
    return send_control(control::NodeError{
        job_, "a batch from node " + std::to_string(s.sender) + " was lost on its link"});
  }
  if (header.type == BatchType::kRays) return on_rays(link, bit, batch, header);
  if (header.type == BatchType::kLinkCredit) {
    std::uint64_t bytes = 0;
    const auto result = decode_link_credit(batch, limits_, bytes);
    if (std::holds_alternative<BatchError>(result)) return drop("grant", "malformed");
    link.send_credit += bytes;
    return send_rays(link, false);
  }
  if (header.type == BatchType::kToken) {
    TokenRecord r;
    const auto result = decode_token(batch, limits_, r);
    if (std::holds_alternative<BatchError>(result)) return drop("token", "malformed");
    if (!ring_.token_arrived({r.black, r.count, r.round, r.hops, r.contribution_batches})) {
      return drop("token", "none was due");
    }
    if (id_.rank.value == 0) {
      send_control(control::TokenRound{job_, epoch_, r.round, r.hops, r.black, r.count});
    }
    return pass_token();
  }
  drop("batch", to_string(header.type));
}

void Node::on_rays(Link& link, std::uint32_t bit, const Bytes& batch, const BatchHeader& header) {
  std::vector<RayTask> rays;
  const auto result = decode_rays(batch, limits_, rays);
  if (const auto* error = std::get_if<BatchError>(&result)) {
    // A broken batch can't be repaired, and what was in it is missing from the picture.
    drop("rays", to_string(*error));
    return send_control(control::NodeError{
        job_, "a broken batch of rays came from node " + std::to_string(link.peer.value)});
  }
  const bool mine = std::all_of(rays.begin(), rays.end(),
                                [&](const RayTask& r) { return domain_->holds(r.region); });
  if (!mine) {
    drop("rays", "for another macro-region");
    return send_control(control::NodeError{
        job_, "node " + std::to_string(link.peer.value) + " sent rays for another node"});
  }
  ring_.message_received();
  stats_.rays_in += header.count;
  for (const RayTask& ray : rays) rays_.add(ray, bit);
  stats_.queue_peak = std::max<std::uint64_t>(stats_.queue_peak, rays_.size());
}

void Node::on_signal(Link& link, const BatchHeader& header) {
  if (header.type == BatchType::kGreeting) {
    outgoing_.push_back(
        {link.peer, Message::of_batch(encode_signal(stamp(0), BatchType::kGreetingAck))});
    return;
  }
  link.is_greeted = true;
  send_ready_when_complete();
}

std::uint32_t Node::bit_of(Rank peer) const {
  for (std::uint32_t bit = 0; bit < links_.size(); ++bit) {
    if (links_[bit].peer == peer) return bit;
  }
  return static_cast<std::uint32_t>(links_.size());
}

void Node::drop(const char* what, std::string_view why) {
  ++drops_;
  std::fprintf(stderr, "graycube-node: node %u: dropped: %s: %.*s\n", id_.rank.value, what,
               static_cast<int>(why.size()), why.data());
}

// ---- work

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

// ---- what goes out

BatchStamp Node::stamp(std::uint64_t sequence) const {
  return {job_, epoch_, id_.rank.value, id_.incarnation, sequence};
}

void Node::send_control(const ControlMessage& message) {
  outgoing_.push_back({std::nullopt, Message::of_text(encode(message))});
}

/// Sends what the link's credit allows: full batches, and with `partial`, or while nothing is under way on
/// the link, smaller ones.
void Node::send_rays(Link& link, bool partial) {
  const std::size_t full = std::clamp<std::size_t>(load_.batch_bytes / kRayBytes, 1, kMaxRaysPerBatch);
  std::size_t sent = 0;
  for (;;) {
    const std::size_t waiting = link.outbox.size() - sent;
    const std::size_t allowed = static_cast<std::size_t>(link.send_credit / kRayBytes);
    const std::size_t count = std::min({waiting, allowed, full});
    const bool eager = link.send_credit == load_.link_credit_bytes && waiting >= kLeastEagerRays;
    if (count == 0 || (count < full && !partial && !eager)) break;
    const std::span<const RayTask> rays{link.outbox.data() + sent, count};
    Bytes batch = encode_rays(stamp(link.next_sequence++), rays);
    ring_.message_sent();
    ++stats_.ray_batches;
    stats_.ray_bytes += batch.size();
    stats_.rays_out += count;
    link.send_credit -= count * kRayBytes;
    outgoing_.push_back({link.peer, Message::of_batch(std::move(batch))});
    sent += count;
  }
  link.outbox.erase(link.outbox.begin(), link.outbox.begin() + static_cast<std::ptrdiff_t>(sent));
}

void Node::grant_credit(Link& link) {
  if (link.ungranted == 0) return;
  outgoing_.push_back({link.peer, Message::of_batch(encode_link_credit(stamp(link.next_sequence++),
                                                                       link.ungranted))});
  link.ungranted = 0;
}

void Node::flush_contributions() {
  while (!merge_.is_empty()) {
    const MergeBuffer::Merged merged = merge_.take(*plan_);
    Bytes batch =
        encode_contributions(stamp(contribution_sequence_++), merged.credits, merged.contributions);
    ring_.contribution_batch_sent();
    ++stats_.contribution_batches;
    stats_.contribution_bytes += batch.size();
    outgoing_.push_back({std::nullopt, Message::of_batch(std::move(batch))});
  }
}

void Node::flush_on_idle() {
  for (Link& link : links_) {
    send_rays(link, true);
    grant_credit(link);
  }
  flush_contributions();
  pass_token();
}

bool Node::is_passive() const {
  return state_ == State::kRendering && rays_.is_empty() && tiles_.empty() &&
         unassigned_tiles_ == 0 && working_ == 0 && merge_.is_empty() &&
         std::all_of(links_.begin(), links_.end(), [](const Link& l) { return l.outbox.empty(); });
}

void Node::pass_token(bool is_pinged) {
  if (load_.algorithm != Algorithm::kMacro || state_ != State::kRendering) return;
  if (ring_.stalled_rounds() > kFreeRounds && !is_pinged) return;
  const bool had_verdict = ring_.verdict().has_value();
  while (const auto token = ring_.try_pass(is_passive())) {
    const Rank next = cube_->ring_next(id_.rank);
    if (next == id_.rank) {
      GRAYCUBE_CHECK(ring_.token_arrived(*token), "a ring of one lost its token");
      send_control(control::TokenRound{job_, epoch_, token->round, token->hops, token->black,
                                       token->count});
      continue;
    }
    Link& link = links_[bit_of(next)];
    const TokenRecord record{token->black, token->count, token->round, token->hops,
                             token->contribution_batches};
    outgoing_.push_back(
        {next, Message::of_batch(encode_token(stamp(link.next_sequence++), record))});
  }
  if (had_verdict || !ring_.verdict()) return;
  const Verdict& v = *ring_.verdict();
  if (v.outcome == Verdict::Outcome::kLost) {
    send_control(control::NodeError{
        job_, "the token counts " + std::to_string(v.missing) + " batches sent but never received"});
    return;
  }
  send_control(control::Terminated{job_, epoch_, v.rounds, v.hops, v.contribution_batches});
}

std::vector<Node::Outgoing> Node::take_outgoing() { return std::exchange(outgoing_, {}); }

}  // namespace graycube
