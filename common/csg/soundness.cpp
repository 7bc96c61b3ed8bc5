#include "csg/soundness.hpp"

#include <algorithm>
#include <cmath>

#include "csg/half_space.hpp"
#include "csg/sphere.hpp"

namespace graycube {
namespace {

constexpr const char* kSingular =
    "is singular to working precision under its maps, or leaves the range of doubles";
constexpr const char* kTooFar = "reaches beyond 1e18";
constexpr const char* kTooSmall = "is smaller than 1e-18";
static_assert(kMaxCoordinate == 1e18 && kLeastSize == 1e-18);

bool has_nan(const Aabb& box) {
  for (int a = 0; a < 3; ++a) {
    if (std::isnan(box.lo[a]) || std::isnan(box.hi[a])) return true;
  }
  return false;
}

bool is_tiny(const Aabb& box) { return max_abs(box.hi - box.lo) < kLeastSize; }

/// Why an axis of the solid's frame is too long or too short; null if none is.
const char* why_frame_unsound(const Affine& to_local) {
  for (int i = 0; i < 3; ++i) {
    const double per_unit = max_abs(to_local.row(i));
    if (per_unit > 1 / kLeastSize) return kTooSmall;
    if (per_unit < 1 / kMaxCoordinate) return kTooFar;
  }
  return nullptr;
}

}  // namespace

bool is_within_range(const Vec3& point) { return max_abs(point) <= kMaxCoordinate; }

bool is_within_range(const Aabb& box) {
  for (int a = 0; a < 3; ++a) {
    for (const double x : {box.lo[a], box.hi[a]}) {
      if (std::isnan(x) || (std::isfinite(x) && std::fabs(x) > kMaxCoordinate)) return false;
    }
  }
  return true;
}

const char* why_unsound(const Primitive& p, std::span<const Plane> planes) {
  const bool finite =
      std::all_of(p.v.begin(), p.v.end(), [](double v) { return std::isfinite(v); }) &&
      p.to_local.is_finite() && !has_nan(p.bounds);
  if (!finite) return kSingular;
  for (const Plane& f : csg::faces_of(p, planes)) {
    if (!is_finite(f.normal) || !std::isfinite(f.offset)) return kSingular;
    if (std::fabs(f.offset) > kMaxCoordinate) return kTooFar;
  }
  if (!is_within_range(p.bounds)) return kTooFar;
  switch (p.kind) {
    case PrimitiveKind::kSphere: return csg::sphere_radius(p.v) < kLeastSize ? kTooSmall : nullptr;
    case PrimitiveKind::kHalfSpace:
      return std::fabs(csg::half_space_plane(p).offset) > kMaxCoordinate ? kTooFar : nullptr;
    case PrimitiveKind::kBox:
    case PrimitiveKind::kParallelepiped:
    case PrimitiveKind::kMesh:
    case PrimitiveKind::kPolyhedron: return is_tiny(p.bounds) ? kTooSmall : nullptr;
    default: return why_frame_unsound(p.to_local);
  }
}

}  // namespace graycube
