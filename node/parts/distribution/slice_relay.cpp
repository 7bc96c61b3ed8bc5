#include "node/parts/distribution/slice_relay.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "proto/batch.hpp"
#include "topology/slice_way.hpp"

namespace graycube {

std::optional<SliceRelay> SliceRelay::of(const Seat& seat, const control::Load& load) {
  const auto tree = slice_way(seat.cube, load.mesh);
  if (!tree) return std::nullopt;
  return SliceRelay(seat, *tree);
}

void SliceRelay::hand_on(Rank to, std::span<const std::byte> slice, Mail& mail) {
  for (std::size_t at = 0; at < slice.size(); at += kPartBytes) {
    send({to.value, at, slice.size(), slice.subspan(at, std::min(kPartBytes, slice.size() - at))},
         mail);
  }
}

void SliceRelay::send(const SlicePart& part, Mail& mail) {
  const auto child = tree_.child_towards(seat_.rank, Rank{part.rank});
  if (!child)
    return mail.fail("a slice came for node " + std::to_string(part.rank) +
                     ", which is not on the way from here");
  ++parts_sent_;
  bytes_sent_ += mail.to_neighbour(seat_.bit_of(*child), [&](const BatchStamp& stamp) {
    return encode_slice_part(stamp, part);
  });
}

std::optional<SharedBytes> SliceRelay::on_part(std::uint32_t bit, std::span<const std::byte> batch,
                                               Mail& mail) {
  BatchLimits limits;
  limits.nodes = seat_.cube.nodes();
  SlicePart part;
  const auto result = decode_slice_part(batch, limits, part);
  const auto* error = std::get_if<BatchError>(&result);
  if (error == nullptr && tree_.parent(seat_.rank) == mail.peer(bit)) {
    if (part.rank == seat_.rank.value) return keep(part, bit, mail);
    send(part, mail);
    return std::nullopt;
  }
  mail.drop("slice part", error != nullptr ? to_string(*error) : "not from the node before");
  mail.fail("a broken part of a slice came from node " + std::to_string(mail.peer(bit).value));
  return std::nullopt;
}

std::optional<SharedBytes> SliceRelay::keep(const SlicePart& part, std::uint32_t bit, Mail& mail) {
  if (is_own_whole_ || part.offset != own_.size()) {
    mail.fail("a part of the slice that came from node " + std::to_string(mail.peer(bit).value) +
              (is_own_whole_ ? " came twice" : " is missing"));
    return std::nullopt;
  }
  own_.insert(own_.end(), part.bytes.begin(), part.bytes.end());
  if (own_.size() < part.total) return std::nullopt;
  is_own_whole_ = true;
  return SharedBytes(std::exchange(own_, {}));
}

void SliceRelay::report(control::NodeStats& stats) const {
  stats.slice_batches = parts_sent_;
  stats.slice_bytes = bytes_sent_;
}

}  // namespace graycube
