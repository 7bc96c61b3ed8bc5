// The ways to find a ray's crossings: today's, the report's, and those that the report compares
// itself with. All find the same crossings, bit for bit.
#pragma once

#include <cstdint>

namespace graycube {

enum class Subdivision : std::uint8_t {
  kSurfaces,  ///< today's: a hierarchy of bounding volumes over the surfaces, packets of rays
  kRoth,      ///< none: the CSG tree with a box and a sphere around each node (Roth 1982)
  kLinked,    ///< a BSP by cost, whose leaf regions are linked to their neighbours
  kArnaldi,   ///< the report's: a BSP of the screen, cut in depth, linked (Arnaldi et al. 1987)
  kOctree,    ///< cells halved in all three axes, found by their names (Glassner 1984)
  kKaplan,    ///< cells halved in one axis, found from the root at each step (Kaplan 1985)
};

/// How a ray finds the leaf region that it begins in, where leaf regions are linked.
enum class Entry : std::uint8_t {
  kUsual,     ///< kExtremal for kArnaldi, kDescent for kLinked
  kDescent,   ///< from the root of the BSP
  kExtremal,  ///< by links, from the nearer of the BSP's two outermost leaf regions (report, 3.3.3)
};

/// What of it a job chooses.
struct SubdivisionChoice {
  Subdivision way = Subdivision::kSurfaces;
  Entry entry = Entry::kUsual;

  friend bool operator==(const SubdivisionChoice&, const SubdivisionChoice&) = default;
};

/// The entry that is meant where the choice leaves it open.
constexpr Entry entry_of(const SubdivisionChoice& choice) {
  if (choice.entry != Entry::kUsual) return choice.entry;
  return choice.way == Subdivision::kArnaldi ? Entry::kExtremal : Entry::kDescent;
}

/// Whether a subdivision has linked leaf regions, so that an entry can be chosen.
constexpr bool has_links(Subdivision way) {
  return way == Subdivision::kLinked || way == Subdivision::kArnaldi;
}

}  // namespace graycube
