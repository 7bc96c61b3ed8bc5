// The rays that have left this node and have not been answered: each is known by the number that it
// carries across the link, so that an answer can be told from nonsense.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "node/parts/returns/slot_table.hpp"

namespace graycube {

class AwaitedAnswers {
 public:
  /// The most rays that may be awaited at a time: their numbers are slots, in the lower bits. The
  /// bits above count how often a slot was taken, so that an old number is known as such.
  static constexpr std::uint32_t kSlotBits = 24;
  static constexpr std::size_t kMost = std::size_t{1} << kSlotBits;

  struct Awaited {
    /// What the light belongs to: a pixel, or the key of a ray that came here.
    std::uint32_t key = 0;
    /// The bit of the link across which the ray left, and across which the answer must come.
    std::uint8_t bit = 0;
    /// The ray holds 2^-exponent of its tree's credit.
    std::uint8_t exponent = 0;
    std::uint8_t times_taken = 0;
    bool is_open = false;
  };

  explicit AwaitedAnswers(std::size_t most = kMost) : table_(most) {}

  /// The number for a ray that leaves; nothing when too many are awaited.
  std::optional<std::uint32_t> expect(std::uint32_t key, std::uint32_t bit, std::uint8_t exponent) {
    const auto slot = table_.take();
    if (!slot) return std::nullopt;
    Awaited& a = table_[*slot];
    const auto times = static_cast<std::uint8_t>(a.times_taken + 1);
    a = {key, static_cast<std::uint8_t>(bit), exponent, times, true};
    return std::uint32_t{times} << kSlotBits | *slot;
  }
  /// The ray with that number; null if none is awaited from that link.
  const Awaited* find(std::uint32_t number, std::uint32_t bit) const {
    const std::uint32_t slot = slot_of(number);
    if (!table_.has(slot)) return nullptr;
    const Awaited& a = table_[slot];
    return a.is_open && a.bit == bit && a.times_taken == number >> kSlotBits ? &a : nullptr;
  }
  /// The last answer to the ray has come; find() has found it.
  void came(std::uint32_t number) {
    table_[slot_of(number)].is_open = false;
    table_.give_up(slot_of(number));
  }
  std::size_t size() const { return table_.taken(); }
  void clear() { table_.clear(); }

 private:
  static std::uint32_t slot_of(std::uint32_t number) { return number & (kMost - 1); }

  SlotTable<Awaited> table_;
};

}  // namespace graycube
