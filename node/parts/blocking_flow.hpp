// The flow of 1987: one ray a message, in order; an evaluator whose ray finds the next node's queue
// full waits, with all that it holds. Evaluators that wait for each other in a circle deadlock,
// which the frontal finds out.
#pragma once

#include <deque>
#include <vector>

#include "node/parts/ray_flow.hpp"

namespace graycube {

class BlockingFlow : public RayFlow {
 public:
  explicit BlockingFlow(const FlowRules& rules);

  Pace pace() const override;
  void leave(std::uint32_t bit, std::span<const RayTask> rays,
             std::optional<std::uint16_t> on_class) override;
  bool pass_on(std::uint32_t from_bit, std::uint32_t to_bit,
               std::span<const RayTask> rays) override;
  bool send(bool partial, Mail& mail) override;
  void flush(Mail& mail) override;
  void give(std::uint32_t bit, std::span<const RayTask> rays, Mail& mail) override;
  std::size_t gift_room(std::uint32_t bit) const override;
  void taken(std::uint32_t bit, std::size_t rays) override;
  void grant(std::uint32_t bit, Mail& mail) override;
  bool was_granted(std::uint32_t bit, std::uint64_t bytes, bool partial, Mail& mail) override;
  bool is_stalled() const override { return !stalled_.empty(); }
  bool is_empty() const override { return RayFlow::is_empty() && !is_stalled(); }
  void has_moved() override { ++moves_; }
  void answer_ping(std::uint64_t ping, Mail& mail) const override;
  void report(control::NodeStats& stats) const override { counts_.report(stats); }
  void reset() override;

 private:
  /// All members count bytes of ray records.
  struct Link {
    /// Room in the neighbour's queue; and room here that the neighbour was not told of yet.
    std::uint64_t send_credit = 0, ungranted = 0;
    /// The sums of all that was granted to the neighbour, and of all that it granted.
    std::uint64_t granted = 0, received = 0;
  };
  struct Stalled {
    RayTask ray;
    std::uint32_t bit;
  };

  std::uint64_t link_credit_;
  std::vector<Link> links_;  // by bit
  /// Oldest first: a full queue holds up all that is behind.
  std::deque<Stalled> stalled_;
  /// Pieces of work done in this job.
  std::uint64_t moves_ = 0;
  FlowCounts counts_;
};

}  // namespace graycube
