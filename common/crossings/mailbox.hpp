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
  std::uint64_t cells_visited = 0;
  std::uint64_t primitives_tested = 0;
  /// Those tests among them that solved a quartic equation.
  std::uint64_t quartics_solved = 0;

  void count_test(PrimitiveKind kind, std::uint64_t rays = 1) {
    primitives_tested += rays;
    constexpr std::uint32_t kQuartics = csg::kinds_with(&csg::KindTraits::is_quartic);
    if (csg::is_among(kind, kQuartics)) quartics_solved += rays;
  }
  void add(const WalkCounts& o) {
    cells_visited += o.cells_visited;
    primitives_tested += o.primitives_tested;
    quartics_solved += o.quartics_solved;
  }
  WalkCounts since(const WalkCounts& before) const {
    return {cells_visited - before.cells_visited, primitives_tested - before.primitives_tested,
            quartics_solved - before.quartics_solved};
  }
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
