// Cells by their names (Glassner 1984): the root's name is 1, and a cell's eight parts are called
// by its own name with a digit from 1 to 8 behind it. A hash table leads from names to cells, so
// that no cell needs a pointer to another. Cells that hold nothing aren't in it.
#pragma once

#include <bit>
#include <cstdint>
#include <vector>

#include "crossings/cell_programs.hpp"

namespace graycube {

/// Of up to 19 decimal digits.
using CellName = std::uint64_t;
inline constexpr CellName kRootName = 1;
/// The deepest cells that have names.
inline constexpr int kMostNameDigits = 19;

/// The name of part number 0 … 7: bit a tells whether it is the upper one on axis a.
constexpr CellName part_of(CellName cell, unsigned part) { return cell * 10 + part + 1; }

class NameTable {
 public:
  struct Entry {
    /// 0 where the place is free.
    CellName name = 0;
    /// Leaf regions only.
    ProgramRange programs;
    bool is_cut = false;
  };

  /// For a name that isn't in the table yet.
  void add(const Entry& entry) {
    if (2 * (count_ + 1) > places_.size()) grow();
    ++count_;
    put(entry);
  }
  /// Null where the cell holds nothing.
  const Entry* find(CellName name) const {
    if (places_.empty()) return nullptr;
    for (std::size_t i = place_of(name);; i = (i + 1) & (places_.size() - 1)) {
      if (places_[i].name == name) return &places_[i];
      if (places_[i].name == 0) return nullptr;
    }
  }
  std::size_t memory_bytes() const { return places_.capacity() * sizeof(Entry); }

 private:
  /// The upper bits of a product with 2⁶⁴ / golden ratio spread neighbouring names evenly (Knuth,
  /// The Art of Computer Programming 3, 6.4).
  std::size_t place_of(CellName name) const {
    constexpr std::uint64_t kGolden = 0x9E3779B97F4A7C15u;
    return static_cast<std::size_t>((name * kGolden) >> (64 - std::bit_width(places_.size() - 1)));
  }
  void put(const Entry& entry) {
    std::size_t i = place_of(entry.name);
    while (places_[i].name != 0) i = (i + 1) & (places_.size() - 1);
    places_[i] = entry;
  }
  /// Keeps at least half of the places free; their number is a power of two.
  void grow() {
    std::vector<Entry> old(places_.empty() ? 16 : 2 * places_.size());
    old.swap(places_);
    for (const Entry& e : old) {
      if (e.name != 0) put(e);
    }
  }

  std::vector<Entry> places_;
  std::size_t count_ = 0;
};

}  // namespace graycube
