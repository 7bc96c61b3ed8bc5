#include "regions/macro_grid.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "check.hpp"
#include "geometry/infinity.hpp"

namespace graycube {

namespace {

/// BoundaryPlane::flat of parallel planes: the camera's axes are orthogonal only to within
/// rounding, and a primary ray must not drift through a boundary. Over a scene of size s the ray
/// strays by 1e-14 s, far less than the 1e-9 s by which regions are grown.
constexpr double kFlatOrthographic = 1e-14;
/// A generous bound of the relative rounding error of f (BoundaryPlane::at).
constexpr double kRounding = 64 * std::numeric_limits<double>::epsilon();

std::vector<std::int64_t> even_edges(std::uint32_t cells, std::uint32_t pixels) {
  GRAYCUBE_CHECK(cells >= 1 && cells <= kMaxGridSide, "%u cells", cells);
  std::vector<std::int64_t> edges;
  edges.reserve(cells - 1);
  for (std::int64_t i = 1; i < cells; ++i) {
    // If cells outnumber pixels, each is one pixel wide, and the picture lies in the middle.
    edges.push_back(cells <= pixels ? i * pixels / cells : i - (std::int64_t{cells} - pixels) / 2);
  }
  return edges;
}

void check_edges(const std::vector<std::int64_t>& edges, std::uint32_t pixels) {
  GRAYCUBE_CHECK(edges.size() < kMaxGridSide, "%zu boundaries", edges.size());
  for (std::size_t i = 0; i < edges.size(); ++i) {
    GRAYCUBE_CHECK(edges[i] >= -kMaxEdgeDistance && edges[i] <= pixels + kMaxEdgeDistance,
                   "boundary at pixel edge %lld", static_cast<long long>(edges[i]));
    GRAYCUBE_CHECK(i == 0 || edges[i - 1] < edges[i], "boundaries must increase, number %zu", i);
  }
}

void check_depths(const std::vector<double>& depths) {
  GRAYCUBE_CHECK(depths.size() < kMaxSlabs, "%zu boundaries of slabs", depths.size());
  double last = 0;
  for (const double depth : depths) {
    GRAYCUBE_CHECK(depth > last && depth < kInf, "a slab from depth %g to %g", last, depth);
    last = depth;
  }
}

/// The pixels between boundaries `cell` and `cell` + 1, clipped to 0 … pixels.
std::pair<std::uint32_t, std::uint32_t> pixel_range(const std::vector<std::int64_t>& edges,
                                                    std::size_t cell, std::uint32_t pixels) {
  const auto clip = [pixels](std::int64_t edge) {
    return static_cast<std::uint32_t>(std::clamp<std::int64_t>(edge, 0, pixels));
  };
  return {cell == 0 ? 0 : clip(edges[cell - 1]), cell == edges.size() ? pixels : clip(edges[cell])};
}

/// The largest value of normal · (p − eye) over the box, and the size of the terms it is summed
/// from. Infinite sides count only where the normal looks at them: 0 · ∞ is no number.
std::pair<double, double> support(const Aabb& box, const Vec3& eye, const Vec3& normal) {
  double sum = 0, magnitude = 0;
  for (int axis = 0; axis < 3; ++axis) {
    if (normal[axis] == 0) continue;
    const double corner = normal[axis] > 0 ? box.hi[axis] : box.lo[axis];
    sum += normal[axis] * (corner - eye[axis]);
    magnitude += std::fabs(corner) + std::fabs(eye[axis]);
  }
  return {sum, magnitude};
}

}  // namespace

MacroGrid MacroGrid::regular(const CameraFrame& frame, std::uint32_t columns, std::uint32_t rows,
                             std::vector<double> slab_depths) {
  return {frame, even_edges(columns, frame.image.width), even_edges(rows, frame.image.height),
          std::move(slab_depths)};
}

MacroGrid::MacroGrid(const CameraFrame& frame, std::vector<std::int64_t> column_edges,
                     std::vector<std::int64_t> row_edges, std::vector<double> slab_depths)
    : image_(frame.image), eye_(frame.eye), slabs_(make_slabs(frame, slab_depths)) {
  check_edges(column_edges, frame.image.width);
  check_edges(row_edges, frame.image.height);
  columns_ = make_fan(frame, frame.right, 0.5 * frame.image.width, std::move(column_edges));
  rows_ = make_fan(frame, frame.down, 0.5 * frame.image.height, std::move(row_edges));
}

MacroGrid::Fan MacroGrid::make_fan(const CameraFrame& frame, const Vec3& axis, double middle,
                                   std::vector<std::int64_t> edges) {
  const bool perspective = frame.projection == Projection::kPerspective;
  Fan fan;
  fan.planes.reserve(edges.size());
  for (const std::int64_t edge : edges) {
    const double c = (static_cast<double>(edge) - middle) * frame.pixel_size;
    fan.planes.push_back(perspective ? BoundaryPlane{normalized(axis - c * frame.forward), 0, 0}
                                     : BoundaryPlane{axis, c, kFlatOrthographic});
  }
  fan.edges = std::move(edges);
  link_cells(fan, perspective);
  return fan;
}

/// All planes across the view are parallel, with either camera.
MacroGrid::Fan MacroGrid::make_slabs(const CameraFrame& frame, const std::vector<double>& depths) {
  check_depths(depths);
  Fan fan;
  for (const double depth : depths) fan.planes.push_back({frame.forward, depth, 0});
  link_cells(fan, false);
  return fan;
}

std::vector<double> MacroGrid::slab_depths() const {
  std::vector<double> depths;
  for (const BoundaryPlane& plane : slabs_.planes) depths.push_back(plane.offset);
  return depths;
}

void MacroGrid::link_cells(Fan& fan, bool wraps) {
  const std::size_t cells = fan.planes.size() + 1;
  fan.cells.resize(cells);
  if (cells == 1) return;
  const auto number = [](std::size_t cell) { return static_cast<std::uint16_t>(cell); };
  for (std::size_t k = 0; k < cells; ++k) {
    if (k > 0) fan.cells[k].add({fan.planes[k - 1], true, false, number(k - 1)});
    if (k + 1 < cells) fan.cells[k].add({fan.planes[k], false, false, number(k + 1)});
  }
  if (!wraps || cells == 2) return;  // both halves of a single plane lead to the same neighbour
  const BoundaryPlane& root = fan.planes[cells / 2 - 1];
  if (cells == 3) {
    fan.cells[0].sides[0].forks = true;  // the root bounds cell 0 already
  } else {
    fan.cells[0].add({root, false, false, number(cells - 1)});
  }
  fan.cells[cells - 1].add({root, true, false, 0});
}

std::uint16_t MacroGrid::Fan::cell_of_edge_position(std::uint32_t pixel) const {
  return static_cast<std::uint16_t>(
      std::upper_bound(edges.begin(), edges.end(), std::int64_t{pixel}) - edges.begin());
}

std::uint16_t MacroGrid::Fan::cell_of_point(const Vec3& relative) const {
  // Within either half of the root the other boundaries are nested, also behind the eye, so
  // bisection works. The point is beyond boundaries up to number `low`, and before those above
  // `high`.
  std::size_t low = 0, high = planes.size();
  for (std::size_t middle = cells.size() / 2; low < high; middle = (low + high + 1) / 2) {
    if (planes[middle - 1].at(relative) >= 0) {
      low = middle;
    } else {
      high = middle - 1;
    }
  }
  return static_cast<std::uint16_t>(low);
}

PixelRect MacroGrid::pixels_of(RegionIndex region) const {
  const auto [x0, x1] = pixel_range(columns_.edges, region.column, image_.width);
  const auto [y0, y1] = pixel_range(rows_.edges, region.row, image_.height);
  return {x0, y0, x1, y1};
}

RegionIndex MacroGrid::region_of_pixel(std::uint32_t x, std::uint32_t y) const {
  return {columns_.cell_of_edge_position(x), rows_.cell_of_edge_position(y)};
}

RegionIndex MacroGrid::region_of_point(const Vec3& p) const {
  const Vec3 q = p - eye_;
  return {columns_.cell_of_point(q), rows_.cell_of_point(q), slabs_.cell_of_point(q)};
}

bool MacroGrid::contains(RegionIndex region, const Vec3& p) const {
  const Vec3 q = p - eye_;
  const auto holds = [&](const Cell& cell) {
    return std::ranges::all_of(
        cell.list(), [&](const RegionSide& side) { return (side.plane.at(q) >= 0) == side.far; });
  };
  return holds(columns_.cells[region.column]) && holds(rows_.cells[region.row]) &&
         holds(slabs_.cells[region.slab]);
}

/// The parameter at which the ray leaves through the side: −∞ when it runs parallel on the wrong
/// side of it, +∞ when never.
double MacroGrid::passage(const RegionSide& side, const Ray& relative) {
  const double b = dot(side.plane.normal, relative.direction);
  const bool parallel = std::fabs(b) <= side.plane.flat;
  if (!parallel && (b < 0) != side.far) return kInf;
  const double a = side.plane.at(relative.origin);
  if (parallel) return (a >= 0) == side.far ? kInf : -kInf;
  return -a / b;
}

std::uint16_t MacroGrid::Fan::next_of(const RegionSide& side, const Ray& relative, double t) const {
  if (!side.forks) [[likely]]
    return side.next;
  const BoundaryPlane& second = planes[1];
  const double a = second.at(relative.origin);
  const double b = dot(second.normal, relative.direction);
  const bool far = b > 0 ? t >= -a / b : b < 0 ? t < -a / b : a >= 0;
  return far ? 2 : 1;
}

std::optional<RegionExit> MacroGrid::exit(RegionIndex region, const Ray& ray, double t) const {
  const Ray relative{ray.origin - eye_, ray.direction};
  double first = kInf;
  const RegionSide* through = nullptr;
  const Fan* passed = nullptr;
  std::uint16_t* number = nullptr;
  const auto consider = [&](const Fan& fan, std::uint16_t& cell) {
    for (const RegionSide& side : fan.cells[cell].list()) {
      double at = passage(side, relative);
      if (at < t) at = t;
      if (at < first) {
        first = at;
        through = &side;
        passed = &fan;
        number = &cell;
      }
    }
  };
  consider(columns_, region.column);
  consider(rows_, region.row);
  consider(slabs_, region.slab);
  if (through == nullptr) return std::nullopt;
  *number = passed->next_of(*through, relative, first);
  return RegionExit{first, region};
}

RayPacket::Mask MacroGrid::shorten_to_exits(RegionIndex region, RayPacket& packet,
                                            std::span<RegionExit, RayPacket::kSize> exits) const {
  const auto columns = columns_.cells[region.column].list(), rows = rows_.cells[region.row].list(),
             slabs = slabs_.cells[region.slab].list();
  std::array<const RegionSide*, kMostSides> sides;
  std::size_t count = 0;
  for (const RegionSide& side : columns) sides[count++] = &side;
  for (const RegionSide& side : rows) sides[count++] = &side;
  for (const RegionSide& side : slabs) sides[count++] = &side;
  FirstPassages first;
  find_first_passages({sides.data(), count}, eye_, packet, first);
  RayPacket::Mask leaving = 0;
  for (std::size_t i = 0; i < packet.count; ++i) {
    const double t = first.t[i];
    if (!(t < packet.t1[i])) continue;
    leaving |= RayPacket::Mask{1} << i;
    packet.t1[i] = t;
    exits[i] = {t, region};
    const auto number = static_cast<std::size_t>(first.side[i]);
    const Ray ray = packet.ray(i);
    const Ray relative{ray.origin - eye_, ray.direction};
    if (number < columns.size()) {
      exits[i].next.column = columns_.next_of(*sides[number], relative, t);
    } else if (number < columns.size() + rows.size()) {
      exits[i].next.row = rows_.next_of(*sides[number], relative, t);
    } else {
      exits[i].next.slab = sides[number]->next;
    }
  }
  return leaving;
}

std::vector<RegionIndex> MacroGrid::neighbours_of(RegionIndex region) const {
  std::vector<RegionIndex> found;
  const auto add = [&](RegionIndex next) {
    if (std::find(found.begin(), found.end(), next) == found.end()) found.push_back(next);
  };
  for (const RegionSide& side : columns_.cells[region.column].list()) {
    add({side.next, region.row, region.slab});
    if (side.forks) add({2, region.row, region.slab});
  }
  for (const RegionSide& side : rows_.cells[region.row].list()) {
    add({region.column, side.next, region.slab});
    if (side.forks) add({region.column, 2, region.slab});
  }
  for (const RegionSide& side : slabs_.cells[region.slab].list()) {
    add({region.column, region.row, side.next});
  }
  return found;
}

bool MacroGrid::cell_may_touch(const Cell& cell, const Aabb& box, double grow) const {
  if (box.is_empty()) return false;
  for (const RegionSide& side : cell.list()) {
    // f < 0 is the half-space −f > 0: both are tested as the largest of ±f against −grow.
    const double sign = side.far ? 1 : -1;
    const auto [largest, magnitude] = support(box, eye_, sign * side.plane.normal);
    const double offset = sign * side.plane.offset;
    if (largest - offset < -grow - kRounding * (magnitude + std::fabs(offset))) return false;
  }
  return true;
}

bool MacroGrid::cell_may_touch(const Cell& cell, const Vec3& center, double radius,
                               double grow) const {
  const double magnitude = max_abs(center) + max_abs(eye_) + radius;
  for (const RegionSide& side : cell.list()) {
    const double f = side.plane.at(center - eye_);
    const double slack = grow + kRounding * (magnitude + std::fabs(side.plane.offset));
    if ((side.far ? f : -f) + radius < -slack) return false;
  }
  return true;
}

}  // namespace graycube
