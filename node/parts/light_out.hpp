// Light on its way to the picture: gathered here, sent to the frontal or to the parent in the tree
// of sums; or, where it goes back along the rays' ways, to the neighbours that sent the rays.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "node/parts/mail.hpp"
#include "node/parts/merge_buffer.hpp"
#include "node/parts/returns/light_back.hpp"
#include "node/parts/seat.hpp"

namespace graycube {

class LightOut {
 public:
  /// `back`: null unless light goes back along the rays' ways.
  LightOut(const Seat& seat, SumsMode sums, std::unique_ptr<LightBack> back = nullptr);
  /// Null unless light goes back along the rays' ways.
  LightBack* back() const { return back_.get(); }

  /// Gathers light: of the primary rays of `tile`, or when there is none, of rays from anywhere.
  void add(std::span<const PixelReturn> returns, std::optional<std::uint32_t> tile,
           const TilePlan& plan, Mail& mail);
  /// Light that a child in the tree of sums has gathered. It goes on with this node's own, at the
  /// latest when nobody here is at work. False when the batch is broken or nobody's child sent it:
  /// the job has failed then.
  [[nodiscard]] bool on_sums(std::uint32_t bit, std::span<const std::byte> batch,
                             const BatchLimits& limits, Mail& mail);
  /// Answers to rays that were sent to a neighbour. They, too, go on when nobody here is at work.
  /// False when they are of no use: the job has failed then.
  [[nodiscard]] bool on_answers(std::uint32_t bit, std::span<const std::byte> batch,
                                const BatchLimits& limits, const TilePlan& plan, Mail& mail);
  /// Sends all light that is gathered here.
  void send(Mail& mail);
  bool is_empty() const { return merged_.is_empty() && (!back_ || back_->is_empty()); }
  bool holds_others_light() const { return holds_others_light_; }

  /// Adds the numbers of batches and bytes sent in this job.
  void report(control::NodeStats& stats) const;
  /// A new epoch.
  void reset();

 private:
  struct Sent {
    std::uint64_t batches = 0, bytes = 0;
  };

  void gather(std::span<const PixelReturn> returns, std::optional<std::uint32_t> tile,
              const TilePlan& plan, Mail& mail);
  void send_merged(Mail& mail);

  std::unique_ptr<LightBack> back_;
  MergeBuffer merged_;
  std::optional<std::uint32_t> parent_bit_;
  /// Whether the neighbour is a child in the tree of sums, indexed by bit.
  std::vector<bool> is_child_;
  bool has_children_ = false;
  bool holds_others_light_ = false;
  Sent to_frontal_, to_parent_;
};

}  // namespace graycube
