// How rays go from node to node, so that neither memory nor the farm's progress is lost: by credit,
// or as in 1987 by queues that block. Both have the interface that is here; credit_flow.hpp and
// blocking_flow.hpp implement it.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "node/parts/holding.hpp"
#include "node/parts/mail.hpp"
#include "node/parts/pace.hpp"
#include "node/parts/returns/light_back.hpp"
#include "trace/ray_task.hpp"

namespace graycube {

/// The limits that a job sets, and its numbers on which the flow depends.
struct FlowRules {
  std::uint32_t links = 0;
  std::uint64_t link_credit_bytes = 0, batch_bytes = 0;
  /// A node with that many rays in its outboxes is full.
  std::uint64_t outbox_rays = 0;
  /// Rays of each class that a link has places for beside its credit; and how many classes there
  /// are.
  std::uint32_t class_places = 1;
  std::uint64_t classes = 1;
  std::uint32_t threads = 1;
  /// The most rays that one hit may send out.
  std::uint32_t most_children = 2;

  static FlowRules of(const control::Load& load, const Holding& here);
};

/// Counts of the rays that have left this node, for the report.
struct FlowCounts {
  std::uint64_t forwarded_shadow = 0, forwarded_secondary = 0, forwarded_primary = 0;
  std::uint64_t batches = 0, bytes = 0, rays = 0;
  std::uint64_t outbox_peak = 0;

  void count_forwarded(std::span<const RayTask> left);
  void report(control::NodeStats& stats) const;
};

class RayFlow {
 public:
  /// The link across which a ray in that region goes on; nothing when it is traced on this node.
  using Route = std::function<std::optional<std::uint32_t>(const RegionIndex&)>;
  /// Rays on class credit. If `on_class` is set, all are of that class, and the node is full.
  struct ClassWork {
    std::vector<RayTask> rays;
    std::optional<std::uint16_t> on_class;
  };

  virtual ~RayFlow() = default;
  virtual Pace pace() const = 0;

  /// Each ray that is sent gets its number there, if there is such a part.
  void number_by(LightBack* light_back) { light_back_ = light_back; }
  /// Rays leave across a link. `on_class`: the class of the work in which they were sent, if a full
  /// node did that work.
  virtual void leave(std::uint32_t bit, std::span<const RayTask> rays,
                     std::optional<std::uint16_t> on_class = std::nullopt) = 0;
  /// Rays came across one link and leave across another: at once, or when there is room. True when
  /// an outbox got them.
  virtual bool pass_on(std::uint32_t from_bit, std::uint32_t to_bit,
                       std::span<const RayTask> rays) = 0;
  virtual void pass_on_what_waits() {}
  /// Sends what may go now; with `partial` also what doesn't fill a batch. True when rays were
  /// stalled and no longer are.
  virtual bool send(bool partial, Mail& mail) = 0;
  /// There is nothing to do here: sends all that may go, and gives back credit that is worth a
  /// message.
  virtual void flush(Mail& mail) = 0;
  /// Sends a gift of at most gift_room() rays at once.
  virtual void give(std::uint32_t bit, std::span<const RayTask> rays, Mail& mail) = 0;
  virtual std::size_t gift_room(std::uint32_t bit) const = 0;

  /// Evaluators took received rays: the neighbour may have their credit again.
  virtual void taken(std::uint32_t bit, std::size_t rays) = 0;
  /// Gives free credit back, if that is worth a message while there is work.
  virtual void grant(std::uint32_t bit, Mail& mail) = 0;
  /// A neighbour gives credit back. Sends, and returns, like send(), but for that link only.
  virtual bool was_granted(std::uint32_t bit, std::uint64_t bytes, bool partial, Mail& mail) = 0;
  bool on_link_credit(std::uint32_t bit, std::span<const std::byte> batch,
                      const BatchLimits& limits, bool partial, Mail& mail);

  /// Rays on the credit of their classes came. False when there was no place for one of them.
  [[nodiscard]] virtual bool add_class_rays(std::uint32_t, std::span<const RayTask>) {
    return false;
  }
  /// A neighbour has places again. Sends like send(), but for that link only.
  virtual void was_given_places(std::uint32_t, std::span<const std::uint16_t>, bool, Mail& mail) {
    mail.drop("class credit", "of a class that it was not due for");
  }
  void on_class_credit(std::uint32_t bit, std::span<const std::byte> batch,
                       const BatchLimits& limits, bool partial, Mail& mail);
  virtual bool has_class_work() const { return false; }
  /// Takes rays to trace; those that only pass through go on at once. Nothing when none is left.
  virtual std::optional<ClassWork> take_class_work(const Route&, Mail&) { return std::nullopt; }
  /// The work on that class is done, but for the rays that were set aside.
  virtual void class_work_ended(std::uint16_t, std::span<const RayTask>) {}

  /// Counts rays that wait here for a model on its way; then they leave, or are traced here.
  void reserve(std::uint64_t rays) { reserved_ += rays; }
  void release(std::uint64_t rays) { reserved_ -= rays; }

  virtual bool is_full() const { return false; }
  virtual bool may_start_tiles() const { return true; }
  /// Evaluators' rays are held up, and so are the evaluators.
  virtual bool is_stalled() const { return false; }
  /// The number of rays that came across links and are kept here.
  virtual std::size_t held() const { return 0; }
  virtual bool is_empty() const { return reserved_ == 0; }

  /// A piece of work is done.
  virtual void has_moved() {}
  /// Tells the frontal, which watches for deadlocks, who waits for whom.
  virtual void answer_ping(std::uint64_t /*ping*/, Mail&) const {}
  virtual void report(control::NodeStats& stats) const = 0;
  /// A new epoch.
  virtual void reset() { reserved_ = 0; }

 protected:
  std::uint64_t reserved() const { return reserved_; }
  void post_rays(std::uint32_t bit, std::span<const RayTask> rays, BatchType type,
                 FlowCounts& counts, Mail& mail);

 private:
  std::uint64_t reserved_ = 0;
  LightBack* light_back_ = nullptr;
  /// Rays with their numbers; a member so that its memory serves the next batch.
  std::vector<RayTask> numbered_;
};

std::unique_ptr<RayFlow> make_flow(FlowMode mode, const FlowRules& rules);

}  // namespace graycube
