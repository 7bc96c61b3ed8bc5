// The flow of rays by credit (docs/design/flow.md): batches go out as far as the neighbours'
// credit reaches, what waits for it lies in outboxes, and where these hold all that they may, the
// node is full. Then evaluators trace only rays that came on the credit of their classes, of one
// class at a time, and only while there is room for what may descend from them: its class is one
// higher. The highest class sends nothing on, so that every class finds room in the end.
#pragma once

#include <deque>
#include <map>
#include <vector>

#include "node/parts/class_store.hpp"
#include "node/parts/link.hpp"
#include "node/parts/ray_flow.hpp"

namespace graycube {

class CreditFlow : public RayFlow {
 public:
  explicit CreditFlow(const FlowRules& rules);

  Pace pace() const override;
  void leave(std::uint32_t bit, std::span<const RayTask> rays,
             std::optional<std::uint16_t> on_class) override;
  bool pass_on(std::uint32_t from_bit, std::uint32_t to_bit,
               std::span<const RayTask> rays) override;
  void pass_on_what_waits() override;
  bool send(bool partial, Mail& mail) override;
  void flush(Mail& mail) override;
  void give(std::uint32_t bit, std::span<const RayTask> rays, Mail& mail) override;
  std::size_t gift_room(std::uint32_t bit) const override;
  void taken(std::uint32_t bit, std::size_t rays) override;
  void grant(std::uint32_t bit, Mail& mail) override;
  bool was_granted(std::uint32_t bit, std::uint64_t bytes, bool partial, Mail& mail) override;

  [[nodiscard]] bool add_class_rays(std::uint32_t bit, std::span<const RayTask> rays) override;
  void was_given_places(std::uint32_t bit, std::span<const std::uint16_t> classes, bool partial,
                        Mail& mail) override;
  bool has_class_work() const override;
  std::optional<ClassWork> take_class_work(const Route& route, Mail& mail) override;
  void class_work_ended(std::uint16_t on_class, std::span<const RayTask> set_aside) override;

  bool is_full() const override;
  bool may_start_tiles() const override;
  std::size_t held() const override;
  bool is_empty() const override;
  void report(control::NodeStats& stats) const override { counts_.report(stats); }
  void reset() override;

 private:
  /// Rays on their way between neighbours, which came while this node was full.
  struct Passing {
    std::uint32_t from_bit, to_bit;
    std::vector<RayTask> rays;
  };

  void note_outbox() { counts_.outbox_peak = std::max(counts_.outbox_peak, outbox_rays_); }
  std::uint64_t children_per_class_work() const;
  std::uint64_t rays_per_class_work() const;
  bool has_room_after(std::uint16_t of_class) const;
  std::optional<std::uint16_t> next_class(bool is_full, const std::vector<RayTask>& begun) const;
  void give_back_classes(std::uint32_t bit, std::span<const std::uint16_t> classes, Mail& mail);
  void grant_from(std::uint32_t bit, std::uint64_t least, Mail& mail);
  void send_link(std::uint32_t bit, bool partial, Mail& mail);
  void send_class_outbox(std::uint32_t bit, Mail& mail);
  void send_on_class(std::uint32_t bit, Mail& mail);
  void forget_class_ray(const RayTask& ray);

  FlowRules rules_;
  std::vector<Link> links_;  // by bit
  /// Number of rays in all outboxes and class outboxes.
  std::uint64_t outbox_rays_ = 0;
  ClassStore class_rays_;
  /// Rays of each class in the class outboxes, and those that evaluators may add.
  std::map<std::uint16_t, std::uint64_t> class_outbox_rays_;
  std::deque<Passing> passing_;
  FlowCounts counts_;
};

}  // namespace graycube
