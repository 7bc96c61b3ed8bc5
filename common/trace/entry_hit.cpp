#include "trace/entry_hit.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "set_bits.hpp"
#include "trace/ray_selection.hpp"

namespace graycube {
namespace {

/// The most objects behind the eye, one behind the other, that are looked at before the search for
/// an object around the eye is given up.
constexpr std::size_t kMostBehind = 256;

/// The parameter at which `ray` crosses the primitive nearest to t. t was found with the reversed
/// ray, whose roots may differ in the last bit.
double own_root(const Model& model, std::uint32_t primitive, const Ray& ray, double t) {
  const Spans spans = spans_along(model.primitives[primitive], model.data(), ray);
  double best = t, least = kInf;
  for (int i = 0; i < spans.count; ++i) {
    const auto& s = spans.interval[static_cast<std::size_t>(i)];
    for (const double end : {s.enter, s.leave}) {
      if (!(std::fabs(end - t) < least)) continue;
      least = std::fabs(end - t);
      best = end;
    }
  }
  return best;
}

/// The crossing at which the ray entered the object that it starts in. `back` is the reversed ray,
/// and `first` the first crossing of `back`.
std::optional<Crossing> entry_behind(const Domain& domain, const Ray& ray, const Ray& back,
                                     const Crossing& first, CrossingScratch& scratch) {
  std::array<std::uint32_t, kMostBehind> seen;
  std::size_t count = 0;
  for (std::optional<Crossing> hit = first; hit && count < kMostBehind;) {
    const auto end = seen.begin() + static_cast<std::ptrdiff_t>(count);
    if (std::find(seen.begin(), end, hit->object) == end) {
      // The reversed ray leaves an object that it never entered: the start lies in it.
      if (!hit->entering) {
        return Crossing{own_root(domain.model(), hit->primitive, ray, -hit->t), hit->primitive,
                        hit->object, true};
      }
      seen[count++] = hit->object;
    }
    hit = domain.first_crossing(back, std::nextafter(hit->t, kInf), kInf, scratch);
  }
  return std::nullopt;
}

}  // namespace

RayPacket::Mask entries_behind(const Domain& domain, RayKind kind, const RayPacket& packet,
                               CrossingScratch& scratch,
                               std::span<Crossing, RayPacket::kSize> found) {
  if (domain.settings().camera.inside != InsideView::kEntry || kind != RayKind::kPrimary) return 0;
  RaySelection back;
  for (std::size_t i = 0; i < packet.count; ++i) {
    if (packet.t0[i] != 0) continue;
    const Ray ray = packet.ray(i);
    back.add(i, {ray.origin, -ray.direction}, 0, kInf);
  }
  if (back.packet.count == 0) return 0;
  std::array<Crossing, RayPacket::kSize> first;
  RayPacket::Mask any = 0;
  for (const std::size_t place : SetBits(domain.first_crossings(back.packet, scratch, first))) {
    const std::size_t i = back.numbers[place];
    const auto entry =
        entry_behind(domain, packet.ray(i), back.packet.ray(place), first[place], scratch);
    if (!entry) continue;
    found[i] = *entry;
    any |= RayPacket::Mask{1} << i;
  }
  return any;
}

}  // namespace graycube
