// A node's part in one picture, from when its macro-regions are subdivided: decides which mechanism
// is asked first about rays, tiles and light that come, about work for evaluators and about its
// results.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>

#include "node/parts/borrowing.hpp"
#include "node/parts/ending.hpp"
#include "node/parts/fifo/fifo_apart.hpp"
#include "node/parts/helping.hpp"
#include "node/parts/holding.hpp"
#include "node/parts/light_out.hpp"
#include "node/parts/mail.hpp"
#include "node/parts/ray_flow.hpp"
#include "node/parts/sliding/generations.hpp"
#include "node/parts/sliding/work_done.hpp"
#include "node/tally.hpp"
#include "node/work.hpp"
#include "node/work_queue.hpp"

namespace graycube {

/// Why an evaluator gets no work (design section 6).
enum class WaitReason : std::uint8_t {
  kReady,     ///< it would get some now
  kBlocked,   ///< there are rays that may not go on: the next queue, or what the outboxes may hold,
              ///< is full
  kWindow,    ///< there are only unstarted primary rays, and the window is closed
  kFetching,  ///< a ray is on its way from the FIFO's process
  kIdle,      ///< there is none of these
};
inline constexpr std::size_t kWaitReasons = 5;

class Rendering {
 public:
  Rendering(Holding holding, const control::Load& load, std::size_t slice_bytes);

  const Holding& holding() const { return here_; }
  const BatchLimits& limits() const { return here_.limits; }
  /// All nodes are ready: tracing begins.
  void begin() { has_begun_ = true; }
  bool has_begun() const { return has_begun_; }
  /// Only so many of this node's own tiles are to be traced: the others are whole already.
  void expect_only(std::uint64_t own_tiles) { queue_.expect_only(own_tiles); }
  /// A new epoch: it has yet to begin, and nothing is under way.
  void reset();
  /// A copy that was begun in an epoch before.
  void adopt(Copied& copied, Mail& mail);

  // From the frontal
  void on_assigned(std::span<const std::uint32_t> tiles, Mail& mail);
  void on_relieved(std::uint64_t tiles, Mail& mail);
  void on_all_whole(Mail& mail);
  /// Another node's model, which was asked for; `slice` is empty when there is no room for it.
  void on_lend(Rank owner, const SharedBytes& slice, Mail& mail);
  /// A neighbour's slice.
  void on_copy(Rank owner, const SharedBytes& slice, std::size_t horizon_bytes, Mail& mail);
  /// Boundaries slide: the next generation of the grid; `slice` is empty if it needs no other.
  void on_slide(const control::Slide& m, const SharedBytes& slice, Mail& mail);
  void on_turn(const control::Turn& m, Mail& mail);
  void on_dealt(Mail& mail);
  void on_ping(std::uint64_t ping, Mail& mail);

  // From the neighbour across a link
  void on_rays(std::uint32_t bit, std::span<RayTask> rays, Mail& mail);
  void on_class_rays(std::uint32_t bit, std::span<RayTask> rays, Mail& mail);
  void on_class_credit(std::uint32_t bit, std::span<const std::byte> batch, Mail& mail);
  void on_link_credit(std::uint32_t bit, std::span<const std::byte> batch, Mail& mail);
  void on_tiles(std::uint32_t bit, std::span<const std::byte> batch, Mail& mail);
  void on_sums(std::uint32_t bit, std::span<const std::byte> batch, Mail& mail);
  void on_answers(std::uint32_t bit, std::span<const std::byte> batch, Mail& mail);
  void on_offer(std::uint32_t bit, std::span<const std::byte> batch, BatchType type, Mail& mail);
  void on_token(std::span<const std::byte> batch, Mail& mail);

  /// From the process that holds the FIFO: a received ray whose turn it is.
  void on_handed(std::span<const std::byte> ray, Mail& mail);

  // With evaluators
  std::optional<Work> take_work(Mail& mail);
  void give_result(WorkResult& result, Mail& mail);
  WaitReason wait_reason() const;
  /// Whether rays, primary ones included, or light of the picture are left here.
  bool has_unfinished() const;
  /// Sends other nodes' light that no evaluator will send; called last before mail goes out.
  void before_mail_leaves(Mail& mail);

  void report(control::NodeStats& stats) const;
  /// Fills in what tells whether the node gets on.
  void tell_moves(control::Pong& pong) const {
    pong.moves = moves_;
    pong.working = working_;
  }

 private:
  [[nodiscard]] bool open(std::uint32_t bit, std::span<RayTask> rays, Mail& mail);
  void keep(std::uint32_t bit, std::span<const RayTask> rays, Mail& mail);
  void on_rays_to_help(std::uint32_t bit, std::span<const RayTask> rays);
  std::shared_ptr<const Domain> domain_of(std::uint32_t tile) const;
  std::optional<Work> choose_work(Mail& mail);
  void adopt(Borrowed& borrowed, Mail& mail);
  void adopt(SlidTo& slid, double build_s, Mail& mail);
  void on_assigned_here(std::span<const std::uint32_t> tiles, Mail& mail);
  void give_domains(Work& work) const;
  void tell_work(bool is_idle, Mail& mail);
  void absorb(Traced& traced, Mail& mail);
  void let_leave(const Traced& traced, Mail& mail);
  bool waits_for_model(Rank owner, const RayTask& ray, Mail& mail);
  void leave_copy(std::span<const RayTask> rays, Rank owner);
  void keep_set_aside(Traced& traced);
  void share_work(Mail& mail);
  void give(const Helping::Gift& gift, std::uint32_t bit, Mail& mail);
  bool may_start_tiles() const;
  bool is_fifo_empty() const { return !fifo_ || fifo_->held() == 0; }
  void fetch(Mail& mail);
  std::size_t held() const { return queue_.held() + flow_->held() + (fifo_ ? fifo_->held() : 0); }
  bool all_evaluators_wait() const;
  void send(bool partial, Mail& mail);
  void flush_on_idle(Mail& mail);
  void pass_token(Mail& mail, std::optional<std::uint64_t> ping = std::nullopt);

  Holding here_;
  Generations generations_;
  WorkDone done_;
  std::unique_ptr<RayFlow> flow_;
  WorkQueue queue_;
  /// Nothing unless received rays wait in a process apart; then the queue has one of them at most.
  std::optional<FifoApart> fifo_;
  Helping helping_;
  Borrowing borrowing_;
  LightOut light_;
  /// Nothing in `roth`, where no token goes round.
  std::optional<Ending> ending_;
  bool has_begun_ = false;
  /// Pieces of work that are under way, and that are done.
  unsigned working_ = 0;
  std::uint64_t moves_ = 0;
  Tally tally_;
};

}  // namespace graycube
