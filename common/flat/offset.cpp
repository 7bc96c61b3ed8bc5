#include "flat/offset.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "flat/pieces.hpp"
#include "flat/side_crossings.hpp"

namespace graycube {
namespace {

/// A side lies on a line if its ends do, to within this share of the largest coordinate: some steps
/// of Clipper's grid.
constexpr double kOnLine = 0x1p-37;
/// Lines that cross at less than this sine don't tell a corner's place.
constexpr double kLeastSine = 1e-3;

FlatPoint moved(const FlatPoint& p, const FlatPoint& n, double distance) {
  return {p.x + distance * n.x, p.y + distance * n.y};
}

template <typename Use>
void for_each_side(const FlatLoops& loops, const Use& use) {
  for (const FlatLoop& loop : loops) {
    for (std::size_t i = 0; i < loop.size(); ++i) use(loop[i], loop[(i + 1) % loop.size()]);
  }
}

std::optional<FlatPoint> crossing(const FlatEdge& a, const FlatEdge& b) {
  const double sine = a.normal.x * b.normal.y - a.normal.y * b.normal.x;
  if (!(std::fabs(sine) >= kLeastSine)) return std::nullopt;
  return FlatPoint{(a.offset * b.normal.y - b.offset * a.normal.y) / sine,
                   (b.offset * a.normal.x - a.offset * b.normal.x) / sine};
}

std::size_t corners_of(const FlatLoops& loops) {
  std::size_t corners = 0;
  for (const FlatLoop& loop : loops) corners += loop.size();
  return corners;
}

double largest_coordinate(const FlatLoops& loops) {
  const auto [lo, hi] = flat_bounds(loops);
  return std::max({std::fabs(lo.x), std::fabs(lo.y), std::fabs(hi.x), std::fabs(hi.y)});
}

class Lines {
 public:
  Lines(const FlatLoops& polygon, double distance, double tolerance) : tolerance_(tolerance) {
    for_each_side(polygon, [&](const FlatPoint& a, const FlatPoint& b) {
      FlatEdge edge = edge_between(a, b);
      lines_.push_back(edge);
      edge.offset += distance;
      lines_.push_back(edge);
    });
  }
  const FlatEdge* through(const FlatPoint& a, const FlatPoint& b) const {
    const auto off = [](const FlatEdge& e, const FlatPoint& p) {
      return std::fabs(e.normal.x * p.x + e.normal.y * p.y - e.offset);
    };
    const FlatEdge* best = nullptr;
    double least = tolerance_;
    for (const FlatEdge& line : lines_) {
      const double distance = std::max(off(line, a), off(line, b));
      if (distance <= least) best = &line, least = distance;
    }
    return best;
  }

 private:
  std::vector<FlatEdge> lines_;
  double tolerance_;
};

void move_corners(FlatLoop& loop, const Lines& lines, const FlatLoop& known, double tolerance) {
  const auto is_known = [&](const FlatPoint& p) {
    return std::find(known.begin(), known.end(), p) != known.end();
  };
  const FlatLoop old = loop;
  const FlatEdge* before = lines.through(old.back(), old.front());
  for (std::size_t i = 0; i < old.size(); ++i) {
    const FlatEdge* after = lines.through(old[i], old[(i + 1) % old.size()]);
    if (before != nullptr && after != nullptr && !is_known(old[i])) {
      const auto p = crossing(*before, *after);
      const double allowed = tolerance / kLeastSine;
      if (p && std::fabs(p->x - old[i].x) <= allowed && std::fabs(p->y - old[i].y) <= allowed)
        loop[i] = *p;
    }
    before = after;
  }
}

}  // namespace

FlatLoops on_lines(FlatLoops result, const FlatLoops& polygon, double distance) {
  if (result.empty() || polygon.empty()) return result;
  if (corners_of(result) * corners_of(polygon) > kMaxLinePairs) return result;
  const double tolerance = kOnLine * (largest_coordinate(polygon) + std::fabs(distance));
  const Lines lines(polygon, distance, tolerance);
  FlatLoop known;
  for (const FlatLoop& loop : polygon) known.insert(known.end(), loop.begin(), loop.end());
  for (FlatLoop& loop : result) move_corners(loop, lines, known, tolerance);
  return result;
}

std::optional<RoundOffset> round_offset(const FlatLoops& loops, double distance) {
  const FlatLoops polygon = resolved(loops);
  if (corners_of(polygon) > kMaxRoundCorners) return std::nullopt;
  // The operands are the polygon, then the area that each side sweeps when it moves.
  std::vector<FlatLoops> operands{polygon};
  for_each_side(polygon, [&](const FlatPoint& a, const FlatPoint& b) {
    const FlatPoint n = edge_between(a, b).normal;
    operands.push_back({{a, b, moved(b, n, distance), moved(a, n, distance)}});
  });
  if (!crossings_are_few(operands)) return std::nullopt;
  RoundOffset result;
  const int rounded_turn = distance > 0 ? 1 : -1;
  for (const FlatLoop& loop : polygon) {
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const FlatPoint &before = loop[(i + loop.size() - 1) % loop.size()],
                      &after = loop[(i + 1) % loop.size()];
      if (orientation(before, loop[i], after) == rounded_turn) result.centers.push_back(loop[i]);
    }
  }
  result.polygon =
      combined(distance > 0 ? FlatOperation::kUnion : FlatOperation::kDifference, operands);
  result.polygon = on_lines(std::move(result.polygon), polygon, distance);
  return result;
}

}  // namespace graycube
