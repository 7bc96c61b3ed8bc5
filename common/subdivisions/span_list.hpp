// A solid along a ray as Roth (1982) has it: the list of the ray's intervals inside the solid, each
// end with the primitive whose surface is crossed there; and the set operations on two such lists.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "crossings/mailbox.hpp"
#include "geometry/spans.hpp"

namespace graycube {

/// The ends of one solid's intervals with t0 ≤ t < t1, in strictly increasing order: a range of a
/// stack of ends. At each of them the ray goes in or out, in turn.
struct SpanList {
  /// Whether the ray is inside the solid just before t0.
  bool begins_inside = false;
  std::size_t first = 0;
  std::size_t end = 0;

  bool is_always(bool inside) const { return first == end && begins_inside == inside; }
};

/// Lists are made on top of the stack, and two at the top are combined in their place.
using SpanStack = std::vector<SpanEnd>;

/// Pushes the list of a primitive, or of its complement. Ends at equal t are one change if their
/// number is odd, none if it is even.
SpanList push_spans(SpanStack& stack, const Spans& spans, std::uint32_t primitive, bool is_inverted,
                    double t0, double t1);

/// Combines the two lists on top of the stack, `b` on top of `a`, to the list of a ∧ b or a ∨ b.
/// Ends at equal t are taken together: the result changes where it differs before and after both;
/// the primitive is a's if a changed there, else b's. Children combined from left to right thus
/// name the primitive that crossings::changed_primitive does: where a ∧ b ∧ c changes, all that
/// changed among a, b and c changed the same way, and so did a ∧ b if a or b did.
SpanList combine(SpanStack& stack, const SpanList& a, const SpanList& b, bool is_and);

}  // namespace graycube
