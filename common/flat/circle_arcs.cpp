#include "flat/circle_arcs.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace graycube {
namespace {

double position_of(const FlatPoint& p) {
  const double along = p.x / (std::fabs(p.x) + std::fabs(p.y));
  return p.y >= 0 ? 1 - along : 3 + along;
}

}  // namespace

void CircleArcs::keep(double a, double b, double c, double tolerance, std::size_t cutter) {
  const double slope = std::sqrt(a * a + b * b);
  if (c >= slope - tolerance) return;
  if (c <= tolerance - slope || !(slope > tolerance)) {
    arcs_.clear();
    return;
  }
  // The two points of the circle on the half-plane's line, to the left and right of its normal.
  const FlatPoint out{a / slope, b / slope};
  const double cosine = c / slope, sine = std::sqrt(std::max(0.0, (1 - cosine) * (1 + cosine)));
  const FlatPoint left{cosine * out.x - sine * out.y, cosine * out.y + sine * out.x};
  const FlatPoint right{cosine * out.x + sine * out.y, cosine * out.y - sine * out.x};
  keep_between({position_of(left), left, cutter}, {position_of(right), right, cutter});
}

void CircleArcs::keep_between(const End& from, const End& to) {
  const double length =
      to.position > from.position ? to.position - from.position : to.position + 4 - from.position;
  std::vector<Arc> kept;
  for (const Arc& arc : arcs_) {
    if (arc.is_whole()) {
      kept.push_back({from, {from.position + length, to.direction, to.cutter}});
      continue;
    }
    for (const double turn : {-4.0, 0.0, 4.0}) {
      const double begin = from.position + turn, end = begin + length;
      Arc part = arc;
      if (begin > arc.from.position) part.from = {begin, from.direction, from.cutter};
      if (end < arc.to.position) part.to = {end, to.direction, to.cutter};
      if (part.to.position - part.from.position >= kLeastArc) kept.push_back(part);
    }
  }
  std::erase_if(kept,
                [](const Arc& arc) { return arc.to.position - arc.from.position < kLeastArc; });
  arcs_ = std::move(kept);
}

}  // namespace graycube
