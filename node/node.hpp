// A node's brain: a state machine. Messages, results of work and the request for work go in; messages and
// work come out. It knows no socket, thread or clock: main.cpp wires those on, the simulation others.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "coordination/termination.hpp"
#include "node/class_store.hpp"
#include "node/link.hpp"
#include "node/merge_buffer.hpp"
#include "node/ray_store.hpp"
#include "node/work.hpp"
#include "proto/batch.hpp"
#include "proto/messages.hpp"
#include "topology/hypercube.hpp"
#include "transport/message.hpp"

namespace graycube {

struct NodeIdentity {
  Rank rank;
  /// The node's start number, given by whoever started it.
  std::uint32_t incarnation = 0;
  std::uint64_t pid = 0;
  std::string endpoint;
  std::uint32_t threads = 1;
  std::string version;
};

/// Why an evaluator gets no work (design section 6).
enum class WaitReason : std::uint8_t {
  kReady,    ///< it would get some now
  kBlocked,  ///< there are rays that may not go on: the next queue, or what the outboxes may hold, is full
  kWindow,   ///< there are only unstarted primary rays, and the window is closed
  kIdle,     ///< there is neither
};

/// Received rays handed to an evaluator in one piece.
inline constexpr std::size_t kMaxRaysPerWork = 256;
/// Once this part of what the outboxes may hold has left in a piece of work, the rest of it is set aside.
inline constexpr std::uint64_t kWorksPerOutboxes = 16;

/// Of two neighbours one connects to the other, and greets it each time that the frontal welcomes the nodes.
inline bool connects_to(Rank from, Rank to) { return from < to; }

class Node {
 public:
  struct Outgoing {
    /// Nothing: the frontal.
    std::optional<Rank> to;
    Message message;
  };

  explicit Node(NodeIdentity identity);

  /// The first message, to be sent when the frontal can be reached.
  Message hello() const;

  void on_frontal(const Message& message);
  /// A batch from a neighbour's inbox link. The sender is read from it and checked.
  void on_neighbour(std::span<const std::byte> batch);

  /// Something for an evaluator to do, if there is. When there isn't, whatever waits to be sent goes out.
  std::optional<Work> take_work();
  void give_result(WorkResult result);
  WaitReason wait_reason() const;
  /// False only when take_work() would certainly give nothing.
  bool may_have_work() const;
  /// Evaluators that the job is to have; those of the node when there is none.
  std::uint32_t threads() const { return state_ == State::kNoJob ? id_.threads : load_.threads; }
  /// Whether rays, primary ones included, or light of the picture are left here.
  bool has_unfinished() const;
  bool has_job() const { return state_ != State::kNoJob; }
  /// Between start and the end of a picture: what evaluators' waiting time is measured over.
  bool is_rendering() const { return state_ == State::kRendering; }

  /// What is to be sent, in order; the caller sends all of it. Ask when all messages at hand are taken in.
  std::vector<Outgoing> take_outgoing();
  bool has_outgoing() const { return !outgoing_.empty(); }
  bool is_shut_down() const { return shut_down_; }
  /// Where each neighbour's inbox is; by rank, empty until the frontal has told.
  const std::vector<std::string>& endpoints() const { return endpoints_; }

  /// Fills in the times and memory of a report; the brain has no clock.
  std::function<void(control::NodeStats&)> measure;

 private:
  /// Of rays that came across no link, or whose credit is no matter any more.
  static constexpr std::uint32_t kNoLink = 0xFFFFFFFF;

  enum class State : std::uint8_t { kNoJob, kBuilding, kReady, kRendering };

  void on_control(const Message& message);
  void on_welcome(const control::Welcome& m);
  void on_load(const control::Load& m, const SharedBytes& slice);
  void on_prepare(const control::Prepare& m);
  void on_start(const control::Start& m);
  void on_finish(const control::Finish& m);
  void on_lend(const control::Lend& m, const SharedBytes& slice);
  void on_relieved(const control::Relieved& m);
  void on_all_whole(const control::AllWhole& m);
  void on_ping(const control::Ping& m);
  void on_frontal_batch(std::span<const std::byte> batch);
  void on_rays(Link& link, std::uint32_t bit, std::span<const std::byte> batch, const BatchHeader& header);
  void on_sums(const Link& link, std::span<const std::byte> batch);
  void on_signal(Link& link, const BatchHeader& header);
  void drop(const char* what, std::string_view why);

  std::uint32_t bit_of(Rank peer) const;
  /// Across which rays in another node's region go.
  std::uint32_t bit_towards(const RegionIndex& region) const { return cube_->first_bit(id_.rank, owner_of(region)); }
  void send_control(const ControlMessage& message);
  bool choose_work(Work& work);
  void adopt_domain(Built& built, double build_s);
  void send_ready_when_complete();
  BatchStamp stamp(std::uint64_t sequence) const;

  bool is_blocking() const { return load_.flow == FlowMode::kBlocking; }
  bool is_own_tile(std::uint32_t tile) const;
  Rank owner_of(const RegionIndex& region) const { return cube_->owner_of(region.column, region.row); }
  const std::shared_ptr<const Domain>& domain_of(std::uint32_t tile) const;
  std::optional<PixelRect> next_pixels();
  void absorb(Traced& traced);
  void absorb_rays(Traced& traced);
  void forward_across(std::uint32_t bit, std::span<const RayTask> rays);
  void count_forwarded(std::uint32_t bit, std::span<const RayTask> rays);
  bool may_start_tiles() const;
  bool is_due_here(const RegionIndex& region) const;
  void note_queue();
  void take_from(std::uint32_t bit, std::size_t rays);
  bool all_evaluators_wait() const { return working_ == 0 && wait_reason() != WaitReason::kReady; }
  void send_stalled();
  void send_batch(Link& link, std::span<const RayTask> rays, BatchType type = BatchType::kRays);
  void send_rays(Link& link, bool partial);
  void flush_contributions();
  void grant_credit(Link& link, std::uint64_t least);
  /// How much a node at work gives back at once.
  std::uint64_t half_credit() const { return load_.link_credit_bytes / 2; }
  void flush_on_idle();
  void pass_token(std::optional<std::uint64_t> ping = std::nullopt);
  bool is_passive() const;

  // node_borrowing.cpp
  [[nodiscard]] bool waits_for_model(Rank owner, const RayTask& ray);
  void adopt_borrowed(Borrowed& borrowed);

  // node_classes.cpp
  bool is_full() const;
  std::uint32_t most_children() const;
  std::uint64_t rays_per_class_work() const;
  bool has_room_after(std::uint16_t of_class) const;
  bool has_class_ray_to_take() const;
  bool take_class_rays(Work& work);
  void release_room_after(std::uint16_t of_class);
  void give_back_classes(Link& link, std::span<const std::uint16_t> classes);
  void leave(std::optional<std::uint16_t> on_class, std::uint32_t bit, std::span<const RayTask> rays);
  void forget_class_ray(const RayTask& ray);
  void send_class_outbox(Link& link);
  void send_on_class(Link& link);
  void on_class_rays(Link& link, std::uint32_t bit, std::span<const std::byte> batch);
  void on_class_credit(Link& link, std::span<const std::byte> batch);
  void pass_on(std::uint32_t from_bit, std::span<const RayTask> rays);
  void pass_on_what_waits();

  // node_sharing.cpp
  void on_copy(const control::Copy& m, const SharedBytes& slice);
  void adopt_copy(Copied& copied);
  void leave_copy(std::span<const RayTask> rays, Rank owner);
  void offer_help();
  void on_offer(Link& link, std::span<const std::byte> batch, Link::Offer offer);
  void share_work();
  double work_to_spare(const Link& link) const;
  double work_of_a_tile() const;
  bool share_with(Link& link);
  void on_tiles(Link& link, std::span<const std::byte> batch);
  void forget_rays();

  NodeIdentity id_;
  std::optional<Hypercube> cube_;
  std::vector<std::string> endpoints_;
  std::vector<Link> links_;  // by bit
  std::vector<Bytes> early_greetings_;
  std::vector<std::uint32_t> incarnations_;
  std::vector<Outgoing> outgoing_;
  bool shut_down_ = false;
  std::uint64_t drops_ = 0;

  State state_ = State::kNoJob;
  control::Load load_;
  std::uint32_t job_ = 0, epoch_ = 0;
  std::optional<SharedBytes> unbuilt_slice_;
  /// Of the model alone.
  std::size_t slice_bytes_ = 0;
  std::shared_ptr<const Domain> domain_;
  double build_s_ = 0;
  bool is_ready_sent_ = false;
  std::optional<TilePlan> plan_;
  BatchLimits limits_;
  std::deque<std::uint32_t> tiles_;
  std::uint64_t own_tiles_ = 0;
  /// In this epoch: what was traced, in tests of a primitive, and how many tiles of anybody's.
  double work_done_ = 0;
  std::uint64_t tiles_traced_ = 0;
  /// Own tiles that the frontal has not handed out yet; `macro` only.
  std::uint64_t unassigned_tiles_ = 0;
  /// Rank 0's: no ray is left anywhere.
  bool all_are_whole_ = false;
  RayStore rays_;
  /// Rays in this node's own regions that came across no link, or came long ago: work was set aside.
  RayStore own_rays_;
  ClassStore class_rays_;
  /// Rays of each class in the class outboxes, and those that evaluators may add.
  std::map<std::uint16_t, std::uint64_t> class_outbox_rays_;
  /// Rays on their way between neighbours, which came while this node was full; and across which bit.
  struct Passing {
    std::uint32_t bit;
    std::vector<RayTask> rays;
  };
  std::deque<Passing> passing_;
  /// The batch of rays that came last; here so that its memory serves the next.
  std::vector<RayTask> received_;
  /// Flow blocking: the tile that is being traced pixel by pixel, and the rays of the evaluator that wait for
  /// room in the next node's queue, oldest first.
  std::optional<PixelRect> open_tile_;
  std::uint32_t open_pixel_ = 0;
  std::deque<RayTask> stalled_;
  std::uint64_t moves_ = 0;
  /// Shadows local: what has become of each other node's model.
  struct Loan {
    enum class State : std::uint8_t { kUnasked, kAsked, kHeld, kRefused };
    State state = State::kUnasked;
    std::vector<RayTask> waiting;
  };
  std::vector<Loan> borrowed_;  // by rank
  /// Copies of neighbours' regions, by bit: their tiles and rays may come here.
  std::vector<std::shared_ptr<const Domain>> copies_;
  struct Helped {
    Rank owner;
    std::vector<RayTask> rays;
    /// Whether they came by their owner's link, and take up its credit.
    bool is_received = true;
  };
  /// Rays in neighbours' regions.
  std::deque<Helped> helped_;
  /// Other nodes' models that came and are not subdivided yet.
  std::deque<std::variant<BorrowWork, CopyWork>> lent_;
  std::uint64_t borrowed_bytes_ = 0, rays_in_wait_ = 0;
  /// In outboxes and class outboxes.
  std::uint64_t outbox_rays_ = 0;
  MergeBuffer merge_;
  /// The tree of sums: where contributions go instead of to the frontal, and whether other nodes' come here.
  std::optional<Rank> parent_;
  bool has_children_ = false;
  bool holds_others_light_ = false;
  TerminationRing ring_;
  unsigned working_ = 0;
  std::uint64_t contribution_sequence_ = 0;
  std::uint64_t assignment_sequence_ = 0;
  control::NodeStats stats_;
};

}  // namespace graycube
