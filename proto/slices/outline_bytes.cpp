#include "proto/slices/outline_bytes.hpp"

#include <cmath>
#include <utility>

#include "proto/model_layout.hpp"
#include "proto/model_slice.hpp"

namespace graycube {
namespace {

using namespace model_layout;

constexpr std::size_t kPointsOfSegment = 3;

/// Coordinates are parts of the outline's size, which the primitive's map has.
bool is_in_frame(const OutlinePoint& p) { return std::fabs(p.x) <= 1 && std::fabs(p.y) <= 1; }

}  // namespace

std::size_t segment_count(const Outline& outline) {
  std::size_t segments = 0;
  for (const OutlineLoop& loop : outline.loops()) segments += loop.size() / kPointsOfSegment;
  return segments;
}

std::size_t outline_bytes(const Outline& outline) {
  return kOutlineBytes + outline.loops().size() * kLoopBytes +
         segment_count(outline) * kSegmentBytes;
}

void put_outline(ByteWriter& w, const Outline& outline) {
  w.put(static_cast<std::uint32_t>(outline.loops().size()));
  for (const OutlineLoop& loop : outline.loops()) {
    w.put(static_cast<std::uint32_t>(loop.size() / kPointsOfSegment));
    for (const OutlinePoint& p : loop) {
      w.put(p.x);
      w.put(p.y);
    }
  }
}

const char* get_outline(ByteReader& r, std::uint64_t& segments, Outline& out) {
  const auto loops = r.get<std::uint32_t>();
  if (loops == 0) return "empty";
  if (loops > kMaxOutlineSegments) return "a count beyond its limit";
  OutlineLoops read(loops);
  std::uint64_t own = 0;
  for (OutlineLoop& loop : read) {
    const std::uint64_t count = r.get<std::uint32_t>();
    if (count == 0) return "a loop without segments";
    own += count;
    if (own > kMaxOutlineSegments || segments + own > kMaxModelSegments)
      return "a count beyond its limit";
    if (count * kSegmentBytes > r.remaining()) return "too short";
    loop.resize(kPointsOfSegment * count);
    for (OutlinePoint& p : loop) {
      p.x = r.get<double>();
      p.y = r.get<double>();
      if (!is_in_frame(p)) return "a point out of range";
    }
  }
  segments += own;
  out = Outline(std::move(read));
  return nullptr;
}

}  // namespace graycube
