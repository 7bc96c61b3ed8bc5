// The generations of the grid that a node holds where boundaries slide (docs/design/sliding.md),
// and which of its tiles belongs to which.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "proto/messages.hpp"
#include "trace/domain.hpp"
#include "trace/ray_task.hpp"

namespace graycube {

class Generations {
 public:
  using Domains = std::array<std::shared_ptr<const Domain>, kMostGenerations>;

  /// `first`: the domain of generation 0. `is_on`: whether boundaries slide.
  Generations(std::shared_ptr<const Domain> first, std::uint32_t tiles, bool is_on);
  bool is_on() const { return is_on_; }

  /// The domains in use, by RayTask::generation; null where boundaries stay.
  const Domains& domains() const { return domains_; }
  /// Whether all these rays are of generations that are held.
  bool hold(std::span<const RayTask> rays) const;
  bool holds_two() const { return domains_[0] != nullptr && domains_[1] != nullptr; }
  /// The generation whose tiles are assigned, and its domain.
  std::uint32_t current() const { return current_; }
  const std::shared_ptr<const Domain>& current_domain() const { return domain_of(current_); }

  /// Whether there is room for the next generation, and these boundaries fit the picture.
  bool may_add(const control::Slide& m) const;
  void add(std::uint32_t generation, std::shared_ptr<const Domain> domain);
  /// False when that generation is not held, or the message makes no sense.
  [[nodiscard]] bool turn(const control::Turn& m);

  /// A tile was assigned: it is of the current generation.
  void assigned(std::uint32_t tile) { parity_[tile] = current_ % kMostGenerations != 0; }
  const std::shared_ptr<const Domain>& domain_of_tile(std::uint32_t tile) const {
    return domains_[parity_[tile]];
  }

  void report(control::NodeStats& stats) const;
  /// A new epoch: of the generations only the newest stays.
  void reset();

 private:
  const std::shared_ptr<const Domain>& domain_of(std::uint32_t generation) const {
    return domains_[generation % kMostGenerations];
  }

  bool is_on_;
  Domains domains_;
  std::uint32_t current_ = 0;
  std::vector<bool> parity_;  // by tile
  std::uint64_t memory_peak_ = 0;
};

}  // namespace graycube
