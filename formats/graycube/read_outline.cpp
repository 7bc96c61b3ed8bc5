// Reads the outlines of lathes and sweeps.
#include <algorithm>
#include <string>
#include <utility>

#include "formats/graycube/read_leaf.hpp"
#include "geometry/infinity.hpp"
#include "outline/outline.hpp"

namespace graycube {
namespace {

enum OutlinedKey : std::size_t { kOutline = kCommonKeys, kHeight, kBase };

/// The distance of a lathe's control points from its axis, and other coordinates.
bool read_point(JsonAccess& json, JsonIndex at, bool is_lathe, OutlinePoint& out) {
  if (json.tree.kind(at) != JsonKind::kArray || json.tree.size(at) != 2)
    return json.wrong(at, is_lathe ? "a point [r, z]" : "a point [x, y]");
  const JsonIndex x = json.tree.first_child(at);
  const bool x_good = json.read(x, out.x, is_lathe ? kNotNegative : kAnyNumber);
  return json.read(json.tree.next(x), out.y) && x_good;
}

/// Adds the straight segment along the axis from the loop's last point to its first.
void close_along_axis(OutlineLoop& loop) {
  const double from = loop.back().y, to = loop.front().y;
  loop.push_back({0, (2.0 / 3) * from + (1.0 / 3) * to});
  loop.push_back({0, (1.0 / 3) * from + (2.0 / 3) * to});
}

/// Closes a loop of 3 n points, which is closed already, or of 3 n + 1: with its first point as the
/// last once more, or with both on a lathe's axis.
bool close(JsonAccess& json, JsonIndex at, bool is_lathe, OutlineLoop& loop) {
  if (loop.size() % 3 == 0) return true;
  if (loop.front() == loop.back()) {
    loop.pop_back();
    return true;
  }
  if (is_lathe && loop.front().x == 0 && loop.back().x == 0) {
    close_along_axis(loop);
    return true;
  }
  return json.wrong(at, is_lathe ? "a last point equal to the first, or both on the axis"
                                 : "a last point equal to the first");
}

bool read_loop(JsonAccess& json, JsonIndex at, bool is_lathe, std::uint32_t& segments,
               OutlineLoop& out) {
  if (!json.is_array(at)) return false;
  const std::uint32_t count = json.tree.size(at);
  if (count < 3 || count % 3 == 2)
    return json.wrong(at, "3 points a segment, one more at the end or none");
  segments += count / 3;
  // One along a lathe's axis may be added.
  if (segments >= kMaxOutlineSegments)
    return json.wrong(at, "fewer than " + std::to_string(kMaxOutlineSegments) + " segments");
  out.resize(count);
  bool good = true;
  JsonIndex child = json.tree.first_child(at);
  for (OutlinePoint& point : out) {
    good = read_point(json, child, is_lathe, point) && good;
    child = json.tree.next(child);
  }
  return good && close(json, at, is_lathe, out);
}

/// Whether the outline is wide and high: a curve that isn't encloses nothing.
bool has_extent(const OutlineLoops& loops) {
  OutlineBox all{{kInf, kInf}, {-kInf, -kInf}};
  for (const OutlinePiece& piece : pieces_of(loops)) {
    const OutlineBox box = piece.box();
    all = {{std::min(all.lo.x, box.lo.x), std::min(all.lo.y, box.lo.y)},
           {std::max(all.hi.x, box.hi.x), std::max(all.hi.y, box.hi.y)}};
  }
  return all.lo.x < all.hi.x && all.lo.y < all.hi.y;
}

/// The number of segments; 0 after reporting that something is wrong.
std::uint32_t read_loops(JsonAccess& json, JsonIndex at, bool is_lathe, OutlineLoops& out) {
  if (!json.is_array(at)) return 0;
  const std::uint32_t count = json.tree.size(at);
  if (count == 0 || count > kMaxOutlineSegments) {
    json.wrong(at, "1 to " + std::to_string(kMaxOutlineSegments) + " loops");
    return 0;
  }
  out.resize(count);
  std::uint32_t segments = 0;
  bool good = true;
  JsonIndex child = json.tree.first_child(at);
  for (OutlineLoop& loop : out) {
    good = read_loop(json, child, is_lathe, segments, loop) && good;
    if (segments >= kMaxOutlineSegments) return 0;
    child = json.tree.next(child);
  }
  if (!good) return 0;
  if (has_extent(out)) return segments;
  json.errors.add(at, "expected curves that go round an area, found none");
  return 0;
}

}  // namespace

std::uint32_t read_outlined(JsonAccess& json, NodeType type,
                            const std::array<JsonIndex, kMaxNodeKeys>& members, CsgNode& out) {
  const bool is_lathe = type == NodeType::kLathe;
  OutlineLoops loops;
  const std::uint32_t segments =
      members[kOutline] != 0 ? read_loops(json, members[kOutline], is_lathe, loops) : 0;
  if (is_lathe) {
    out.value = LatheShape{std::move(loops)};
    return segments;
  }
  SweepShape sweep;
  if (members[kHeight] != 0) json.read(members[kHeight], sweep.height, kPositive);
  json.read_optional(members[kBase], sweep.base);
  sweep.outline = std::move(loops);
  out.value = std::move(sweep);
  return segments;
}

}  // namespace graycube
