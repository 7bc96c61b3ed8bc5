#include "flat/rounded_polygon.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "flat/offset.hpp"
#include "flat/pieces.hpp"
#include "flat/side_crossings.hpp"

namespace graycube {
namespace {

/// Sides that turn by a smaller sine have no corner between them.
constexpr double kLeastTurn = 1e-9;
/// Arcs may take a side's whole length and, for rounding, this share more: two arcs that make a
/// half circle take all of it.
constexpr double kFits = 1e-9;
constexpr int kMaxHalvings = 10;

/// A corner with the sides that end and begin in it.
struct Corner {
  FlatPoint at;
  FlatEdge before, after;

  double sine() const {
    return before.normal.x * after.normal.y - before.normal.y * after.normal.x;
  }
  double cosine() const {
    return before.normal.x * after.normal.x + before.normal.y * after.normal.y;
  }
  bool points_outwards() const { return sine() > 0; }
  bool is_straight() const { return cosine() > 0 && std::fabs(sine()) <= kLeastTurn; }
  /// The length that an arc of that radius takes of each side: radius × tan(turn / 2).
  double taken(double radius) const {
    return radius == 0 ? 0 : radius * std::fabs(sine()) / (1 + cosine());
  }
};

std::vector<Corner> corners_of(const FlatLoop& loop) {
  const std::size_t n = loop.size();
  std::vector<Corner> corners;
  for (std::size_t i = 0; i < n; ++i) {
    corners.push_back({loop[i], edge_between(loop[(i + n - 1) % n], loop[i]),
                       edge_between(loop[i], loop[(i + 1) % n])});
  }
  return corners;
}

FlatPoint shifted(const FlatPoint& p, const FlatPoint& n, double distance) {
  return {p.x + distance * n.x, p.y + distance * n.y};
}

/// The point where the sides cross once both have moved outwards by `distance`.
FlatPoint moved_corner(const Corner& corner, double distance) {
  if (corner.is_straight()) return shifted(corner.at, corner.before.normal, distance);
  const double a = corner.before.offset + distance, b = corner.after.offset + distance,
               sine = corner.sine();
  return {(a * corner.after.normal.y - b * corner.before.normal.y) / sine,
          (b * corner.before.normal.x - a * corner.after.normal.x) / sine};
}

double moved_radius(const Corner& corner, double radius, double distance, bool rounds_corners) {
  if (corner.is_straight() || (radius == 0 && !rounds_corners)) return 0;
  return std::max(0.0, corner.points_outwards() ? radius + distance : radius - distance);
}

bool arcs_fit(const RoundedLoop& loop) {
  const auto corners = corners_of(loop.corners);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const std::size_t next = (i + 1) % corners.size();
    const FlatPoint &a = loop.corners[i], &b = loop.corners[next];
    const double length = std::sqrt((b.x - a.x) * (b.x - a.x) + (b.y - a.y) * (b.y - a.y));
    if (!(corners[i].taken(loop.radii[i]) + corners[next].taken(loop.radii[next]) <=
          length * (1 + kFits)))
      return false;
  }
  return true;
}

bool keeps_directions(const FlatLoop& before, const FlatLoop& after) {
  const std::size_t n = before.size();
  for (std::size_t i = 0; i < n; ++i) {
    const FlatPoint &a = before[i], &b = before[(i + 1) % n], &c = after[i],
                    &d = after[(i + 1) % n];
    if (!((b.x - a.x) * (d.x - c.x) + (b.y - a.y) * (d.y - c.y) > 0)) return false;
  }
  return true;
}

/// The arc at a corner: its centre, and the points where it touches the sides before and after.
struct Arc {
  FlatPoint center, first, last;
};
Arc arc_at(const Corner& corner, double radius) {
  const double inwards = corner.points_outwards() ? -radius : radius;
  const FlatPoint center = moved_corner(corner, inwards);
  return {center, shifted(center, corner.before.normal, -inwards),
          shifted(center, corner.after.normal, -inwards)};
}

/// Unit vectors from the centre to an arc's corners, added by halving until its facets are fine
/// enough. An arc is less than half a circle.
std::vector<FlatPoint> directions_between(const Arc& arc, double radius, double sagitta) {
  const auto direction = [&](const FlatPoint& p) {
    return FlatPoint{(p.x - arc.center.x) / radius, (p.y - arc.center.y) / radius};
  };
  std::vector<FlatPoint> directions{direction(arc.first), direction(arc.last)};
  for (int halvings = 0; halvings < kMaxHalvings; ++halvings) {
    const FlatPoint &a = directions[0], &b = directions[1];
    const double x = 0.5 * (a.x + b.x), y = 0.5 * (a.y + b.y), middle = std::sqrt(x * x + y * y);
    if (radius * (1 - middle) <= sagitta) break;
    std::vector<FlatPoint> finer;
    for (std::size_t i = 0; i + 1 < directions.size(); ++i) {
      const double sx = directions[i].x + directions[i + 1].x,
                   sy = directions[i].y + directions[i + 1].y;
      const double l = std::sqrt(sx * sx + sy * sy);
      finer.push_back(directions[i]);
      if (l > kLeastTurn) finer.push_back({sx / l, sy / l});
    }
    finer.push_back(directions.back());
    directions = std::move(finer);
  }
  return directions;
}

}  // namespace

RoundedPolygon sharp_polygon(const FlatLoops& loops) {
  std::size_t corners = 0;
  for (const FlatLoop& loop : loops) corners += loop.size();
  if (corners > kMaxRoundCorners) return {};
  RoundedPolygon polygon;
  for (const FlatLoop& loop : loops)
    polygon.push_back({loop, std::vector<double>(loop.size(), 0.0)});
  return polygon;
}

std::optional<RoundedPolygon> moved(const RoundedPolygon& polygon, double distance,
                                    bool rounds_corners) {
  RoundedPolygon result;
  for (const RoundedLoop& loop : polygon) {
    RoundedLoop next;
    const auto corners = corners_of(loop.corners);
    for (std::size_t i = 0; i < corners.size(); ++i) {
      // A side that turns straight back has no place to move to.
      if (!(1 + corners[i].cosine() > kLeastTurn)) return std::nullopt;
      next.corners.push_back(moved_corner(corners[i], distance));
      next.radii.push_back(moved_radius(corners[i], loop.radii[i], distance, rounds_corners));
    }
    if (!keeps_directions(loop.corners, next.corners) || !arcs_fit(next)) return std::nullopt;
    result.push_back(std::move(next));
  }
  return result;
}

namespace {

/// Calls sharp(corner) and round(corner's turn, arc, radius) along the loop.
template <typename Sharp, typename Round>
void for_each_corner(const RoundedLoop& loop, const Sharp& sharp, const Round& round) {
  const auto corners = corners_of(loop.corners);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const double radius = loop.radii[i];
    if (radius == 0) {
      sharp(loop.corners[i]);
    } else {
      round(corners[i], arc_at(corners[i], radius), radius);
    }
  }
}

}  // namespace

RoundedParts parts_of(const RoundedPolygon& polygon, int sides) {
  RoundedParts parts;
  for (const RoundedLoop& loop : polygon) {
    FlatLoop outline;
    const auto sharp = [&](const FlatPoint& corner) { outline.push_back(corner); };
    for_each_corner(loop, sharp, [&](const auto& corner, const Arc& arc, double radius) {
      outline.push_back(arc.first);
      outline.push_back(arc.last);
      (corner.points_outwards() ? parts.added : parts.removed)
          .push_back({arc.center, radius, sides});
    });
    parts.polygon.push_back(std::move(outline));
  }
  return parts;
}

FlatLoops outline_of(const RoundedPolygon& polygon, double sagitta) {
  FlatLoops loops;
  for (const RoundedLoop& loop : polygon) {
    FlatLoop& outline = loops.emplace_back();
    const auto sharp = [&](const FlatPoint& corner) { outline.push_back(corner); };
    for_each_corner(loop, sharp, [&](const auto&, const Arc& arc, double radius) {
      for (const FlatPoint& n : directions_between(arc, radius, sagitta)) {
        outline.push_back(shifted(arc.center, n, radius));
      }
    });
  }
  return loops;
}

bool are_alike(const FlatLoops& a, const FlatLoops& b, double width) {
  for (const auto& [first, second] : {std::pair{&a, &b}, std::pair{&b, &a}}) {
    if (first->empty()) continue;
    // One outline is shrunk, since Clipper is slow with outlines that cross all along.
    const FlatLoops core[] = {offset_simple(*first, -0.5 * width, FlatJoin::kMiter, width),
                              *second};
    if (core[0].empty()) continue;
    if (!crossings_are_few(core) || !is_covered(core[0], core[1])) return false;
  }
  return true;
}

}  // namespace graycube
