// What is done in the pieces of a ray, one for each leaf region that it walks through: looking for
// its first crossing, and letting light through.
//
// A walk is a function that takes `visit(piece, t0, t1)` and calls it for half-open pieces, in
// order, which together cover all of the ray's [t0, t1) in which there may be crossings, until
// `visit` returns false; it then returns false, else true. A piece has `count()` objects, in the
// model's order, and `for_each_crossing(i, t0, t1, visit)`, which calls `visit(Crossing)` for
// object i's crossings with t0 ≤ t < t1, in order of t, until it returns false; then it returns
// false.
#pragma once

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "crossings/cell_programs.hpp"
#include "crossings/crossings.hpp"
#include "crossings/mailbox.hpp"
#include "subdivisions/crossing_search.hpp"

namespace graycube {

/// The piece of a ray in a leaf region that holds programs.
class CellPiece {
 public:
  CellPiece(const CellPrograms& store, ProgramRange range, const Ray& ray, Mailbox& mailbox)
      : store_(store), range_(range), ray_(ray), mailbox_(mailbox) {}

  std::uint32_t count() const { return range_.count; }
  template <typename Visit>
  bool for_each_crossing(std::uint32_t i, double t0, double t1, Visit&& visit) const {
    return graycube::for_each_crossing(store_, store_.programs()[range_.first + i], ray_, t0, t1,
                                       mailbox_, visit);
  }

 private:
  const CellPrograms& store_;
  ProgramRange range_;
  const Ray& ray_;
  Mailbox& mailbox_;
};

/// The first crossing of any object along a walk; at equal t the first object's.
template <typename Walk>
std::optional<Crossing> first_crossing_along(Walk&& walk) {
  std::optional<Crossing> found;
  walk([&](const auto& piece, double from, double to) {
    double before = to;
    for (std::uint32_t i = 0; i < piece.count(); ++i) {
      piece.for_each_crossing(i, from, before, [&](const Crossing& c) {
        found = c;
        before = c.t;
        return false;
      });
    }
    return !found.has_value();
  });
  return found;
}

/// Lets light through the surfaces that a walk crosses, as CrossingSearch::pass_light says.
template <typename Walk>
bool pass_light_along(Walk&& walk, const Model& model, Rgb& light) {
  struct Pane {
    double t;
    double transmit;
  };
  std::vector<Pane> panes;  // stays empty, and unallocated, where nothing is transparent
  return walk([&](const auto& piece, double from, double to) {
    panes.clear();
    for (std::uint32_t i = 0; i < piece.count(); ++i) {
      const bool open = piece.for_each_crossing(i, from, to, [&](const Crossing& c) {
        const double transmit = model.materials[model.primitives[c.primitive].material].transmit;
        if (transmit > 0) panes.push_back({c.t, transmit});
        return transmit > 0;
      });
      if (!open) return false;
    }
    std::stable_sort(panes.begin(), panes.end(),
                     [](const Pane& a, const Pane& b) { return a.t < b.t; });
    for (const Pane& pane : panes) light = pane.transmit * light;
    return true;
  });
}

/// Finds crossings with what can walk: `Cells` has `model()`, `cell_count()`, `memory_bytes()` and
/// `walk(ray, t0, t1, mailbox, visit)`.
template <typename Cells>
class WalkingSearch : public CrossingSearch {
 public:
  explicit WalkingSearch(Cells cells) : cells_(std::move(cells)) {}

  std::optional<Crossing> first_crossing(const Ray& ray, double t0, double t1,
                                         Mailbox& mailbox) const override {
    mailbox.begin_ray();
    return first_crossing_along(
        [&](auto&& visit) { return cells_.walk(ray, t0, t1, mailbox, visit); });
  }
  bool pass_light(const Ray& ray, double t0, double t1, Mailbox& mailbox,
                  Rgb& light) const override {
    mailbox.begin_ray();
    return pass_light_along([&](auto&& visit) { return cells_.walk(ray, t0, t1, mailbox, visit); },
                            cells_.model(), light);
  }
  std::size_t cell_count() const override { return cells_.cell_count(); }
  std::size_t memory_bytes() const override { return cells_.memory_bytes(); }

  const Cells& cells() const { return cells_; }

 private:
  Cells cells_;
};

}  // namespace graycube
