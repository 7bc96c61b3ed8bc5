// An evaluator's memory of its current ray: a small direct-mapped cache of intersections, so that a
// primitive that reaches into several leaf regions is intersected once (Arnaldi's mailbox), and
// scratch space. Each thread has its own; nothing in it is shared, or valid for another ray.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "csg/kinds.hpp"
#include "csg/model.hpp"

namespace graycube {

/// Work done, for benchmarks and guards that count instead of timing.
struct WalkCounts {
  /// Nodes of a surface tree; leaf regions where rays walk through those.
  std::uint64_t cells_visited = 0;
  std::uint64_t primitives_tested = 0;
  /// Those tests among them that solved a quartic equation.
  std::uint64_t quartics_solved = 0;
  /// Intersections that the mailbox still held.
  std::uint64_t tests_saved = 0;
  /// Bounding volumes of a CSG tree's nodes, and those among them that the ray missed.
  std::uint64_t boxes_tested = 0;
  std::uint64_t boxes_rejected = 0;
  std::uint64_t spheres_tested = 0;
  std::uint64_t spheres_rejected = 0;
  /// Nodes of a tree passed on the way down to leaf regions.
  std::uint64_t nodes_descended = 0;
  /// Links followed from an outermost leaf region to the one in which a ray begins.
  std::uint64_t entry_links = 0;
  /// Primary rays through regions of the screen in which nothing shows.
  std::uint64_t rays_not_shot = 0;

  void count_test(PrimitiveKind kind, std::uint64_t rays = 1) {
    primitives_tested += rays;
    constexpr std::uint32_t kQuartics = csg::kinds_with(&csg::KindTraits::is_quartic);
    if (csg::is_among(kind, kQuartics)) quartics_solved += rays;
  }
  /// All that was done between tests, in cells visited: nodes and links by what they cost beside a
  /// cell (docs/lab/2026-11-30-subdivisions.md).
  double visits() const {
    return static_cast<double>(cells_visited) + 0.5 * static_cast<double>(nodes_descended) +
           static_cast<double>(entry_links);
  }
  /// All tests, in primitives tested: boxes and spheres by what they cost beside a primitive.
  double tests() const {
    return static_cast<double>(primitives_tested) +
           0.4 * static_cast<double>(boxes_tested + spheres_tested);
  }
  inline void add(const WalkCounts& o);
  inline WalkCounts since(const WalkCounts& before) const;
};

/// All counts, for sums and differences.
inline constexpr std::array kAllWalkCounts{
    &WalkCounts::cells_visited,  &WalkCounts::primitives_tested, &WalkCounts::quartics_solved,
    &WalkCounts::tests_saved,    &WalkCounts::boxes_tested,      &WalkCounts::boxes_rejected,
    &WalkCounts::spheres_tested, &WalkCounts::spheres_rejected,  &WalkCounts::nodes_descended,
    &WalkCounts::entry_links,    &WalkCounts::rays_not_shot};
static_assert(sizeof(WalkCounts) == kAllWalkCounts.size() * sizeof(std::uint64_t));

inline void WalkCounts::add(const WalkCounts& o) {
  for (const auto count : kAllWalkCounts) this->*count += o.*count;
}
inline WalkCounts WalkCounts::since(const WalkCounts& before) const {
  WalkCounts work = *this;
  for (const auto count : kAllWalkCounts) work.*count -= before.*count;
  return work;
}

/// The end of an interval of a ray inside a solid, and the primitive whose surface is crossed.
struct SpanEnd {
  double t;
  /// Index into Model::primitives.
  std::uint32_t primitive;
};

class Mailbox {
 public:
  /// Forgets all intersections: call before each new ray.
  void begin_ray() {
    if (++ray_ == 0) [[unlikely]] {
      entries_.fill({});
      ray_ = 1;
    }
  }

  /// The intervals of a primitive along the current ray.
  const Spans& spans(const Model& model, std::uint32_t primitive, const Ray& ray) {
    Entry& e = entries_[primitive % kEntries];
    if (e.ray != ray_ || e.primitive != primitive) {
      e.ray = ray_;
      e.primitive = primitive;
      e.spans = spans_along(model.primitives[primitive], model.data(), ray);
      counts.count_test(model.primitives[primitive].kind);
    } else {
      ++counts.tests_saved;
    }
    return e.spans;
  }

  WalkCounts counts;

  /// A crossing of one literal of a program.
  struct Event {
    double t;
    std::uint32_t literal;
  };
  std::vector<Event> events;
  /// One bit for each literal: whether the ray is inside its primitive.
  std::vector<std::uint64_t> flags_before, flags_after;
  /// Where intervals are combined up a CSG tree: the stack of their ends.
  std::vector<SpanEnd> span_ends;

 private:
  static constexpr std::size_t kEntries = 128;
  struct Entry {
    std::uint32_t ray = 0;
    std::uint32_t primitive = 0;
    Spans spans;
  };
  std::array<Entry, kEntries> entries_{};
  std::uint32_t ray_ = 0;
};

}  // namespace graycube
