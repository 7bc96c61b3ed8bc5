// Values in numbered slots: a slot that is given up is used again, the last one given up first.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace graycube {

template <typename T>
class SlotTable {
 public:
  /// `most`: slots that may be taken at a time, at most 2^32.
  explicit SlotTable(std::size_t most) : most_(most) {}

  /// A free slot, in which lies what it held last; nothing when all are taken.
  std::optional<std::uint32_t> take() {
    if (taken() == most_) return std::nullopt;
    if (free_.empty()) {
      slots_.emplace_back();
      return static_cast<std::uint32_t>(slots_.size() - 1);
    }
    const std::uint32_t slot = free_.back();
    free_.pop_back();
    return slot;
  }
  /// The slot must be taken.
  void give_up(std::uint32_t slot) { free_.push_back(slot); }
  /// Whether a slot with that number has ever been taken.
  bool has(std::uint32_t slot) const { return slot < slots_.size(); }
  T& operator[](std::uint32_t slot) { return slots_[slot]; }
  const T& operator[](std::uint32_t slot) const { return slots_[slot]; }
  std::size_t taken() const { return slots_.size() - free_.size(); }
  void clear() {
    slots_.clear();
    free_.clear();
  }

 private:
  std::size_t most_;
  std::vector<T> slots_;
  std::vector<std::uint32_t> free_;
};

}  // namespace graycube
