#include "coincidence/levels.hpp"

#include <algorithm>
#include <array>
#include <tuple>
#include <utility>

#include "geometry/infinity.hpp"

namespace graycube::csg {
namespace {

/// Finds the least distance above 0 between faces of one primitive that look opposite ways. Faces
/// are added in order of their offsets.
class ThicknessFinder {
 public:
  void add(const Level& f) {
    const auto own = static_cast<std::size_t>(f.is_backward), other = 1 - own;
    for (const double seen : {last_[other], before_[other]}) {
      if (seen < f.offset) least_ = std::min(least_, f.offset - seen);
    }
    if (f.offset > last_[own]) before_[own] = std::exchange(last_[own], f.offset);
  }
  double least() const { return least_; }

 private:
  /// The greatest offset so far, and the greatest below it, of forward [0] and backward faces [1].
  std::array<double, 2> last_{-kInf, -kInf}, before_{-kInf, -kInf};
  double least_ = kInf;
};

double least_thickness(std::span<const Extent> run, const std::vector<Level>& given) {
  if (run.size() < 2) return kInf;
  std::vector<const Level*> sides;
  for (const Extent& e : run) sides.push_back(&given[e.item]);
  std::sort(sides.begin(), sides.end(), [](const Level* a, const Level* b) {
    return std::tie(a->primitive, a->offset) < std::tie(b->primitive, b->offset);
  });
  double least = kInf;
  for (std::size_t first = 0; first < sides.size();) {
    ThicknessFinder finder;
    std::size_t i = first;
    for (; i < sides.size() && sides[i]->primitive == sides[first]->primitive; ++i)
      finder.add(*sides[i]);
    least = std::min(least, finder.least());
    first = i;
  }
  return least;
}

}  // namespace

bool is_shared(std::span<const Level> levels) {
  return std::any_of(levels.begin(), levels.end(),
                     [&](const Level& f) { return f.primitive != levels.front().primitive; });
}

Planes::Planes(std::vector<Level> levels) {
  std::vector<Extent> extents;
  extents.reserve(levels.size());
  for (std::uint32_t i = 0; i < levels.size(); ++i) {
    extents.push_back(
        {levels[i].offset - levels[i].tolerance, levels[i].offset + levels[i].tolerance, i});
  }
  levels_.reserve(levels.size());
  for_each_run(std::span(extents), [&](std::span<Extent> run) { add_run(run, levels); });
}

void Planes::add_run(std::span<const Extent> run, const std::vector<Level>& given) {
  const double gap = least_thickness(run, given);
  if (!(gap < kInf)) return add_plane(run, given);
  constexpr double kShareOfGap = 1.0 / 8;
  std::vector<Extent> narrower(run.begin(), run.end());
  for (Extent& e : narrower) {
    const Level& f = given[e.item];
    const double tolerance = std::min(f.tolerance, kShareOfGap * gap);
    e.lo = f.offset - tolerance;
    e.hi = f.offset + tolerance;
  }
  for_each_run(std::span(narrower), [&](std::span<Extent> plane) { add_plane(plane, given); });
}

void Planes::add_plane(std::span<const Extent> plane, const std::vector<Level>& given) {
  const std::size_t first = levels_.size();
  for (const Extent& e : plane) levels_.push_back(given[e.item]);
  ends_.push_back(levels_.size());
  const auto added = std::span(levels_).subspan(first);
  const bool is_equal = std::all_of(added.begin(), added.end(), [&](const Level& f) {
    return f.own == added.front().own && !f.is_of_mesh;
  });
  has_unequal_ = has_unequal_ || (!is_equal && is_shared(added));
}

double Planes::best_offset(std::span<const Level> plane) {
  return std::min_element(plane.begin(), plane.end(),
                          [](const Level& a, const Level& b) {
                            return std::tie(a.tolerance, a.offset) <
                                   std::tie(b.tolerance, b.offset);
                          })
      ->offset;
}

}  // namespace graycube::csg
