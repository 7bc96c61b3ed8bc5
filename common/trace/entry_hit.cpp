#include "trace/entry_hit.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace graycube {
namespace {

/// Objects that may lie behind the eye, one behind the other, before an object around it is given up on.
constexpr std::size_t kMostBehind = 256;

/// The parameter at which the primitive itself is crossed nearest to t: what found t was the ray turned round, whose
/// roots may differ in the last bit.
double own_root(const Model& model, std::uint32_t primitive, const Ray& ray, double t) {
  const Spans spans = spans_along(model.primitives[primitive], model.data(), ray);
  double best = t, least = Aabb::kInf;
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

}  // namespace

std::optional<Crossing> entry_behind(const Domain& domain, const RayTask& task, CrossingScratch& scratch) {
  if (domain.settings().camera.inside != InsideView::kEntry || task.t != 0 ||
      task.kind != RayKind::kPrimary) {
    return std::nullopt;
  }
  const Ray back{task.ray.origin, -task.ray.direction};
  std::array<std::uint32_t, kMostBehind> seen;
  std::size_t count = 0;
  for (double t = 0; count < kMostBehind;) {
    const auto hit = domain.first_crossing(back, t, Aabb::kInf, scratch);
    if (!hit) return std::nullopt;
    const auto end = seen.begin() + static_cast<std::ptrdiff_t>(count);
    if (std::find(seen.begin(), end, hit->object) == end) {
      // Backwards out of an object that was never entered: the start lies in it.
      if (!hit->entering) {
        return Crossing{own_root(domain.model(), hit->primitive, task.ray, -hit->t), hit->primitive,
                        hit->object, true};
      }
      seen[count++] = hit->object;
    }
    t = std::nextafter(hit->t, Aabb::kInf);
  }
  return std::nullopt;
}

}  // namespace graycube
