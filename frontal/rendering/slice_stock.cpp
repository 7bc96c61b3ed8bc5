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

SharedBytes SliceStock::take(Rank rank) {
  if (slices_.size() == 1) return slices_.front();
  SharedBytes& held = slices_[rank.value];
  return rules_.are_lent || may_be_copied(rank) ? held : std::exchange(held, {});
}

const SharedBytes* SliceStock::to_lend(std::uint32_t rank) const {
  return rules_.are_lent && rank < slices_.size() ? &slices_[rank] : nullptr;
}

bool SliceStock::has_room(Rank helper, Rank owner) const {
  return held_bytes_[helper.value] + slice_bytes_[owner.value] <= rules_.room;
}

bool SliceStock::may_be_copied(Rank owner) const {
  for (std::uint32_t bit = 0; rules_.are_copied && bit < cube_.dimension(); ++bit) {
    if (has_room(cube_.neighbour(owner, bit), owner)) return true;
  }
  return false;
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
