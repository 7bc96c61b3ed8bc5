#include "frontal/rendering/slice_stock.hpp"

#include <numeric>
#include <utility>

namespace graycube {

SliceStock::SliceStock(const Hypercube& cube, std::vector<SharedBytes> slices, const Rules& rules)
    : cube_(cube), slices_(std::move(slices)), rules_(rules), copies_(cube.nodes(), 0) {
  for (const SharedBytes& slice : slices_) slice_bytes_.push_back(slice.size());
  held_bytes_ = slice_bytes_;
}

std::uint64_t SliceStock::own_bytes() const {
  if (slice_bytes_.size() == 1) return slice_bytes_.front() * cube_.nodes();
  return std::accumulate(slice_bytes_.begin(), slice_bytes_.end(), std::uint64_t{0});
}

const SharedBytes& SliceStock::of(Rank rank) const {
  return slices_.size() == 1 ? slices_.front() : slices_[rank.value];
}

void SliceStock::lose(Rank rank) {
  copies_[rank.value] = 0;
  if (slice_bytes_.size() > 1) held_bytes_[rank.value] = slice_bytes_[rank.value];
}

const SharedBytes* SliceStock::to_lend(std::uint32_t rank) const {
  return rules_.are_lent && rank < slices_.size() ? &slices_[rank] : nullptr;
}

bool SliceStock::has_room(Rank helper, Rank owner) const {
  return held_bytes_[helper.value] + slice_bytes_[owner.value] <= rules_.room;
}

const SharedBytes* SliceStock::to_copy(Rank owner, Rank helper) {
  const auto bit = cube_.link_between(helper, owner);
  if (!rules_.are_copied || !bit || (copies_[helper.value] >> *bit & 1) != 0) return nullptr;
  if (!has_room(helper, owner)) return nullptr;
  copies_[helper.value] |= 1u << *bit;
  held_bytes_[helper.value] += slice_bytes_[owner.value];
  return &slices_[owner.value];
}

}  // namespace graycube
