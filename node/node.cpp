#include "node/node.hpp"

#include <algorithm>
#include <utility>

#include "proto/control.hpp"

namespace graycube {
namespace {

/// White rounds with the same non-zero sum that are taken for a loss; see Node::pass_token.
constexpr std::uint32_t kRoundsUntilLossHere = 32;

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
  if (const auto* copy = std::get_if<control::Copy>(&m)) return on_copy(*copy, message.payload);
  if (const auto* relieved = std::get_if<control::Relieved>(&m)) return on_relieved(*relieved);
  if (const auto* whole = std::get_if<control::AllWhole>(&m)) return on_all_whole(*whole);
  if (const auto* lend = std::get_if<control::Lend>(&m)) return on_lend(*lend, message.payload);
  if (const auto* ping = std::get_if<control::Ping>(&m)) return on_ping(*ping);
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
    // Also those that know this node: there is a new welcome because some node is new.
    if (!connects_to(id_.rank, links_[bit].peer) || endpoints_[links_[bit].peer.value].empty()) continue;
    outgoing_.push_back(
        {links_[bit].peer, Message::of_batch(encode_signal(stamp(0), BatchType::kGreeting))});
  }
  for (const Bytes& greeting : std::exchange(early_greetings_, {})) on_neighbour(greeting);
}

void Node::on_load(const control::Load& m, const SharedBytes& slice) {
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
  own_tiles_ = 0;
  borrowed_.assign(cube_->nodes(), {});
  copies_.assign(links_.size(), nullptr);
  lent_.clear();
  borrowed_bytes_ = 0;
  moves_ = 0;
  unbuilt_slice_ = slice;
  slice_bytes_ = slice.size();
  incarnations_.clear();
  const bool is_tree = m.sums == SumsMode::kTree;
  parent_ = is_tree ? cube_->tree_parent(id_.rank) : std::nullopt;
  has_children_ = is_tree && !cube_->tree_children(id_.rank).empty();
  merge_.expect_others(has_children_);
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
  if (domain_) {
    stats_.primitives = domain_->model().primitives.size();
    stats_.memory_bytes = domain_->memory_bytes();
    for (const auto& copy : copies_) stats_.memory_bytes += copy ? copy->memory_bytes() : 0;
  }
  if (measure) measure(stats_);
  send_control(control::NodeReport{job_, epoch_, stats_});
  // Late grants of credit are stale from here on.
  state_ = State::kNoJob;
  unbuilt_slice_.reset();
  domain_.reset();
  plan_.reset();
  own_tiles_ = 0;
  borrowed_.clear();
  copies_.clear();
  lent_.clear();
  forget_rays();
}

/// Everything of the epoch that ends here: rays, outboxes, unsent contributions, token, sequences, credit.
void Node::forget_rays() {
  tiles_.clear();
  open_tile_.reset();
  work_done_ = 0;
  tiles_traced_ = 0;
  rays_.clear();
  own_rays_.clear();
  class_rays_.clear();
  class_outbox_rays_.clear();
  passing_.clear();
  rays_.set_fifo(is_blocking());
  stalled_.clear();
  for (Loan& b : borrowed_) b.waiting.clear();
  rays_in_wait_ = 0;
  helped_.clear();
  outbox_rays_ = 0;
  merge_.clear();
  holds_others_light_ = false;
  ring_.reset();
  working_ = 0;
  contribution_sequence_ = 0;
  assignment_sequence_ = 0;
  for (Link& link : links_) link.reset(load_.link_credit_bytes);
  unassigned_tiles_ = own_tiles_;
  all_are_whole_ = false;
}

void Node::on_ping(const control::Ping& m) {
  send_control(control::Pong{m.sequence});
  pass_token(m.sequence);
  if (state_ != State::kRendering || !is_blocking()) return;
  control::WaitReport report;
  report.job = job_;
  report.epoch = epoch_;
  report.ping = m.sequence;
  report.is_stalled = !stalled_.empty();
  report.moves = moves_;
  if (report.is_stalled) {
    const RegionIndex next = stalled_.front().region;
    report.waits_for = bit_of(owner_of(next));
  }
  for (const Link& link : links_) {
    report.granted.push_back(link.granted);
    report.received.push_back(link.received);
  }
  send_control(report);
}

void Node::on_frontal_batch(std::span<const std::byte> batch) {
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
  for (const std::uint32_t tile : tiles) {
    if (is_own_tile(tile)) {
      unassigned_tiles_ -= std::min<std::uint64_t>(unassigned_tiles_, 1);
    } else if (!domain_of(tile)) {
      return send_control(control::NodeError{job_, "a tile of another macro-region was assigned"});
    } else {
      ++stats_.tiles_taken_over;
    }
  }
  share_work();
}

/// In `roth` all tiles are everybody's.
bool Node::is_own_tile(std::uint32_t tile) const {
  return domain_->holds(plan_->owner_of_tile(tile));
}

/// What a tile is traced in; null where nothing here is good for it.
const std::shared_ptr<const Domain>& Node::domain_of(std::uint32_t tile) const {
  static const std::shared_ptr<const Domain> kNone;
  if (is_own_tile(tile) || domain_->is_replica()) return domain_;
  const std::uint32_t bit = bit_of(owner_of(plan_->owner_of_tile(tile)));
  return bit < copies_.size() ? copies_[bit] : kNone;
}

void Node::on_relieved(const control::Relieved& m) {
  if (m.job != job_ || m.epoch != epoch_ || state_ != State::kRendering) return;
  unassigned_tiles_ -= std::min<std::uint64_t>(unassigned_tiles_, m.tiles);
  ring_.work_was_taken();
  pass_token();
}

void Node::on_all_whole(const control::AllWhole& m) {
  if (m.job != job_ || m.epoch != epoch_ || state_ != State::kRendering) return;
  all_are_whole_ = true;
  pass_token();
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

}  // namespace graycube
