// Slices that come over links instead of from the frontal, as on a hypercube whose first corner
// alone is linked to the host: rank 0 gets the slices of all nodes and sends each on its way along
// a tree, in parts; nodes between hand them on as they come.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "node/parts/mail.hpp"
#include "node/parts/seat.hpp"
#include "proto/messages.hpp"
#include "topology/spanning_tree.hpp"
#include "transport/message.hpp"

namespace graycube {

class SliceRelay {
 public:
  /// Bytes of a slice in each part but the last: so that nodes along a way work at the same time,
  /// and messages cost little beside what they carry.
  static constexpr std::size_t kPartBytes = std::size_t{64} << 10;

  /// Nothing if slices don't come over links in such a job.
  static std::optional<SliceRelay> of(const Seat& seat, const control::Load& load);

  /// Rank 0: sends another node's slice on its way.
  void hand_on(Rank to, std::span<const std::byte> slice, Mail& mail);
  /// Takes a part of a slice that came across a link: hands it on, or returns the node's own slice
  /// when that is whole. A part that can't be has the job fail.
  std::optional<SharedBytes> on_part(std::uint32_t bit, std::span<const std::byte> batch,
                                     Mail& mail);

  /// Adds the numbers of parts and bytes sent in this job.
  void report(control::NodeStats& stats) const;

 private:
  SliceRelay(const Seat& seat, const SpanningTree& tree) : seat_(seat), tree_(tree) {}
  void send(const SlicePart& part, Mail& mail);
  std::optional<SharedBytes> keep(const SlicePart& part, std::uint32_t bit, Mail& mail);

  Seat seat_;
  SpanningTree tree_;
  /// What has come of the node's own slice.
  Bytes own_;
  bool is_own_whole_ = false;
  std::uint64_t parts_sent_ = 0, bytes_sent_ = 0;
};

}  // namespace graycube
