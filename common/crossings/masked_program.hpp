// Programs of few literals as operations on the bits of one word, and the few events of such a
// program along a ray, kept sorted. They solve general objects, nearly all of which are small.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "csg/model.hpp"
#include "geometry/spans.hpp"

namespace graycube::crossings {

/// Literals of programs that are solved without taking memory; larger ones take the general way.
inline constexpr std::size_t kMaxFlatLiterals = 32;

/// An operation on bits of a word: the literals' bits come first, then the operations' results.
struct MaskOperation {
  std::uint64_t children = 0;
  bool is_and = true;
  /// The lowest number of the literals below this operation.
  std::uint8_t first_literal = 0;
};

/// The operations of a program in an order in which each comes after its children; the last is the
/// whole.
class MaskedProgram {
 public:
  /// The bits of a word: one for each literal or operation.
  static constexpr std::size_t kMaxNodes = 64;

  MaskedProgram(std::span<const MaskOperation> operations, std::uint64_t inverted,
                std::size_t literal_count)
      : operations_(operations), inverted_(inverted), literal_count_(literal_count) {}

  /// Appends the operations of a tree whose root is one; false, and nothing appended, when it has
  /// too many nodes.
  static bool append(std::span<const TreeNode> tree, std::vector<MaskOperation>& operations);

  /// Membership, when bit i of the flags tells whether the line is inside of literal i's primitive.
  bool is_member(std::uint64_t flags) const {
    return (word_of(flags) >> (literal_count_ + operations_.size() - 1) & 1) != 0;
  }

  /// For a program whose membership changed, the literal reached by descending, at each node, into
  /// the first child whose own membership changed.
  std::size_t changed_literal(std::uint64_t before, std::uint64_t after) const {
    const std::uint64_t changed = word_of(before) ^ word_of(after);
    const std::uint64_t all_literals = (std::uint64_t{1} << literal_count_) - 1;
    for (std::size_t at = operations_.size() - 1;;) {
      const std::uint64_t children = operations_[at].children & changed;
      // The first of a node's child operations has the lowest bit.
      const auto literal = static_cast<std::size_t>(std::countr_zero(children & all_literals));
      const std::uint64_t below = children >> literal_count_;
      if (below == 0) return literal;
      const auto operation = static_cast<std::size_t>(std::countr_zero(below));
      if (literal < operations_[operation].first_literal) return literal;
      at = operation;
    }
  }

 private:
  /// A word that holds the membership of each literal, then of each operation.
  std::uint64_t word_of(std::uint64_t flags) const {
    std::uint64_t word = flags ^ inverted_;
    std::size_t bit = literal_count_;
    for (const MaskOperation& o : operations_) {
      const std::uint64_t of = word & o.children;
      word |= std::uint64_t{o.is_and ? of == o.children : of != 0} << bit++;
    }
    return word;
  }

  std::span<const MaskOperation> operations_;
  std::uint64_t inverted_;
  std::size_t literal_count_;
};

/// The ends of literals' intervals in [t0, t1) in order, and what the ray is inside of at t0.
class FewEvents {
 public:
  FewEvents(double t0, double t1) : t0_(t0), t1_(t1) {}

  void add(std::uint32_t literal, double enter, double leave) {
    if (!(enter < leave)) return;  // both ends at once change nothing
    const std::uint64_t bit = std::uint64_t{1} << literal;
    if (enter < t0_ && !(leave < t0_)) flags_ |= bit;
    if (enter >= t0_ && enter < t1_) insert(enter, bit);
    if (leave >= t0_ && leave < t1_) insert(leave, bit);
  }
  bool is_empty() const { return count_ == 0; }

  /// Calls visit(t, entering, flags before, flags after) where membership changes, events at equal
  /// t taken together, until visit returns false; then returns false.
  template <typename IsMember, typename Visit>
  bool visit_changes(IsMember&& is_member, Visit&& visit) const {
    std::uint64_t before = flags_;
    bool inside = is_member(before);
    for (std::size_t i = 0; i < count_;) {
      const double t = events_[i].t;
      std::uint64_t after = before;
      for (; i < count_ && events_[i].t == t; ++i) after ^= events_[i].bit;
      const bool now = is_member(after);
      if (now != inside && !visit(t, now, before, after)) return false;
      inside = now;
      before = after;
    }
    return true;
  }

 private:
  struct Event {
    double t;
    std::uint64_t bit;
  };

  void insert(double t, std::uint64_t bit) {
    std::size_t at = count_++;
    for (; at > 0 && events_[at - 1].t > t; --at) events_[at] = events_[at - 1];
    events_[at] = {t, bit};
  }

  double t0_, t1_;
  std::uint64_t flags_ = 0;
  std::size_t count_ = 0;
  std::array<Event, 2 * Spans::kMax * kMaxFlatLiterals> events_;
};

}  // namespace graycube::crossings
