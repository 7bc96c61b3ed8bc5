#include "formats/openscad/extrusions/sweep_mesh.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <utility>

#include "flat/triangulation.hpp"
#include "geometry/portable_math.hpp"

namespace graycube {
namespace {

/// Ends of extrusions with more corners, or with holes, are cut into triangles together.
constexpr std::uint32_t kMaxCapCorners = 4096;

constexpr double kLeastRadius = 0.00000095367431640625;
constexpr double kDegree = 3.14159265358979323846 / 180;
/// Diagonals whose lengths differ by less than this part of their mean are equal for OpenSCAD.
constexpr double kEqualDiagonals = 1e-5;

using Ring = std::vector<Vec3>;

/// A connected part: the outline and its holes, and the triangles of its plane.
struct Section {
  FlatLoops loops;
  /// Empty if the outline is to be cut as a face of a mesh.
  std::vector<FlatTriangle> cap;

  std::uint32_t corners() const {
    std::size_t sum = 0;
    for (const FlatLoop& loop : loops) sum += loop.size();
    return static_cast<std::uint32_t>(sum);
  }
};

std::optional<std::vector<Section>> sections_of(const FlatLoops& loops) {
  std::vector<Section> sections;
  for (FlatRegion& region : regions_of(loops)) {
    Section& section = sections.emplace_back();
    section.loops = std::move(region.holes);
    section.loops.insert(section.loops.begin(), std::move(region.outline));
    if (section.loops.size() == 1 && section.corners() <= kMaxCapCorners) continue;
    auto triangles = triangles_of(section.loops);
    if (!triangles) return std::nullopt;
    section.cap = *std::move(triangles);
  }
  return sections;
}

/// One side of a loop from one ring to the next: a and b below, c above b, d above a.
struct Quad {
  Vec3 a, b, c, d;
};
double square_in_plane(const Vec3& v) { return v.x * v.x + v.y * v.y; }

/// Whether the diagonal from a to c cuts it, as far as flat quadrilaterals are concerned.
bool takes_shorter(const Quad& q, bool /*is_hole*/) {
  return dot(q.a - q.c, q.a - q.c) <= dot(q.b - q.d, q.b - q.d);
}

/// Which diagonal OpenSCAD takes for a bent quadrilateral: the shorter one in the plane. Of equal
/// ones the sense of the twist decides. In a slice that ends in a line it is the longer one.
struct SliceRule {
  double twist = 0;
  bool ends_in_line = false;

  bool operator()(const Quad& q, bool is_hole) const {
    const double ac = std::sqrt(square_in_plane(q.a - q.c));
    const double bd = std::sqrt(square_in_plane(q.b - q.d));
    const bool is_equal = 2 * std::fabs(ac - bd) <= kEqualDiagonals * (ac + bd);
    const bool turns_back = twist <= 0;
    return (is_equal ? is_hole == turns_back : ac < bd) != ends_in_line;
  }
};

/// Rings of points of a section's loops, joined by triangles.
class RingMesh {
 public:
  explicit RingMesh(const Section& section) : section_(section), n_(section.corners()) {}

  void add_ring(const Ring& ring) {
    mesh_.points.insert(mesh_.points.end(), ring.begin(), ring.end());
  }
  /// `rule(quad, is_hole)`: whether the diagonal from a to c is taken.
  template <typename Rule>
  void join(std::uint32_t low_ring, std::uint32_t high_ring, const Rule& rule) {
    std::uint32_t first = 0;
    for (const FlatLoop& loop : section_.loops) {
      const auto size = static_cast<std::uint32_t>(loop.size());
      for (std::uint32_t i = 0; i < size; ++i) {
        const std::uint32_t low = low_ring * n_ + first, high = high_ring * n_ + first;
        const std::uint32_t j = (i + 1) % size;
        join({low + i, low + j, high + j, high + i}, rule, first > 0);
      }
      first += size;
    }
  }
  void cap(std::uint32_t ring, bool is_upper) {
    if (section_.cap.empty()) return cap_loops(ring, is_upper);
    for (FlatTriangle t : section_.cap) {
      if (!is_upper) std::swap(t[1], t[2]);
      for (std::uint32_t& corner : t) corner += ring * n_;
      mesh_.add_face(t);
    }
  }
  /// Closes each loop by itself, where the ring is flattened to a line.
  void cap_loops(std::uint32_t ring, bool is_upper) {
    std::uint32_t first = ring * n_;
    for (const FlatLoop& loop : section_.loops) {
      std::vector<std::uint32_t> face(loop.size());
      if (is_upper) {
        std::iota(face.begin(), face.end(), first);
      } else {
        std::iota(face.rbegin(), face.rend(), first);
      }
      mesh_.add_face(face);
      first += static_cast<std::uint32_t>(loop.size());
    }
  }
  PolygonMesh take() { return std::move(mesh_); }

 private:
  template <typename Rule>
  void join(const std::array<std::uint32_t, 4>& side, const Rule& rule, bool is_hole) {
    const auto [a, b, c, d] = side;
    const auto& p = mesh_.points;
    if (rule(Quad{p[a], p[b], p[c], p[d]}, is_hole)) {
      mesh_.add_face(std::array{a, b, c});
      mesh_.add_face(std::array{a, c, d});
    } else {
      mesh_.add_face(std::array{a, b, d});
      mesh_.add_face(std::array{b, c, d});
    }
  }

  const Section& section_;
  std::uint32_t n_;
  PolygonMesh mesh_;
};

Ring ring_at(const Section& section, const LinearSweep& sweep, double share, double z) {
  const FlatPoint scale{1 + (sweep.scale.x - 1) * share, 1 + (sweep.scale.y - 1) * share};
  const double c = cos_degrees(-sweep.twist * share), s = sin_degrees(-sweep.twist * share);
  Ring ring;
  for (const FlatLoop& loop : section.loops) {
    for (const FlatPoint& p : loop)
      ring.push_back({scale.x * (c * p.x - s * p.y), scale.y * (s * p.x + c * p.y), z});
  }
  return ring;
}

PolygonMesh swept_section(const Section& section, const LinearSweep& sweep) {
  RingMesh mesh(section);
  const double height = sweep.high - sweep.low;
  const bool is_flat_sided = sweep.twist == 0 && sweep.scale.x == sweep.scale.y;
  const bool is_flattened = sweep.scale.x == 0 || sweep.scale.y == 0;
  for (int i = 0; i <= sweep.slices; ++i) {
    const double share = static_cast<double>(i) / sweep.slices;
    const double z = i == sweep.slices ? sweep.high : sweep.low + share * height;
    mesh.add_ring(ring_at(section, sweep, share, z));
  }
  const auto last = static_cast<std::uint32_t>(sweep.slices);
  for (std::uint32_t i = 0; i < last; ++i) {
    if (is_flat_sided) {
      mesh.join(i, i + 1, takes_shorter);
    } else {
      mesh.join(i, i + 1, SliceRule{sweep.twist, is_flattened && i + 1 == last});
    }
  }
  mesh.cap(0, false);
  if (is_flattened) {
    mesh.cap_loops(last, true);
  } else {
    mesh.cap(last, true);
  }
  return mesh.take();
}

/// The section as rings at the given angles.
PolygonMesh turned_section(const Section& section, const std::vector<double>& angles,
                           bool is_closed) {
  RingMesh mesh(section);
  for (const double angle : angles) {
    const double c = cos_degrees(angle), s = sin_degrees(angle);
    Ring ring;
    for (const FlatLoop& loop : section.loops) {
      for (const FlatPoint& p : loop) ring.push_back({p.x * c, p.x * s, p.y});
    }
    mesh.add_ring(ring);
  }
  const auto count = static_cast<std::uint32_t>(angles.size());
  for (std::uint32_t r = 0; r + (is_closed ? 0 : 1) < count; ++r)
    mesh.join(r, (r + 1) % count, takes_shorter);
  if (!is_closed) {
    mesh.cap(0, false);
    mesh.cap(count - 1, true);
  }
  return mesh.take();
}

/// The length of Archimedes' spiral r = a θ from 0 to `angle`, which is a ∫ √(1 + θ²).
double spiral_length(double a, double angle) {
  const double root = std::sqrt(1 + angle * angle);
  return 0.5 * a * (angle * root + std::log(angle + root));
}

}  // namespace

// The formulas are those of OpenSCAD 2021.01's Calc.cc, stated anew.
int slices_of(const FlatLoops& loops, const LinearSweep& sweep) {
  if (sweep.slices > 0) return sweep.slices;
  const ScadFineness& f = sweep.fineness;
  const double height = sweep.high - sweep.low, twist = std::fabs(sweep.twist);
  double radius2 = 0, change2 = 0;
  for (const FlatLoop& loop : loops) {
    for (const FlatPoint& p : loop) {
      radius2 = std::max(radius2, p.x * p.x + p.y * p.y);
      const double dx = (1 - sweep.scale.x) * p.x, dy = (1 - sweep.scale.y) * p.y;
      change2 = std::max(change2, dx * dx + dy * dy);
    }
  }
  const double radius = std::sqrt(radius2);
  double slices = 1;
  const bool is_uneven = sweep.scale.x != sweep.scale.y;
  if (twist > 0) {
    double length = std::sqrt(twist * kDegree * twist * kDegree * radius2 + height * height);
    if (!is_uneven && sweep.scale.x != 1) {
      const double scale = sweep.scale.x, turn = twist * kDegree;
      const double end = scale > 1 ? turn * scale / (scale - 1) : turn / (1 - scale);
      const double flat =
          spiral_length(radius / end, end) - spiral_length(radius / end, end - turn);
      length = std::sqrt(flat * flat + height * height);
    }
    const double least = std::max(std::ceil(twist / 120), 1.0);
    slices = least;
    if (radius >= kLeastRadius) {
      slices = f.fn > 0
                   ? std::max(std::ceil(twist / 360 * f.fn), least)
                   : std::max(std::min(std::ceil(twist / f.fa), std::ceil(length / f.fs)), least);
    }
  } else if (is_uneven && std::sqrt(change2) >= kLeastRadius) {
    slices = f.fn > 0 ? std::floor(f.fn) : std::ceil(std::sqrt(change2 + height * height) / f.fs);
  }
  return static_cast<int>(std::clamp(slices, 1.0, double{kMaxOpenscadSides}));
}

std::optional<std::vector<PolygonMesh>> swept(const FlatLoops& loops, const LinearSweep& sweep) {
  const auto sections = sections_of(loops);
  if (!sections) return std::nullopt;
  LinearSweep cut = sweep;
  cut.slices = slices_of(loops, sweep);
  std::vector<PolygonMesh> meshes;
  for (const Section& section : *sections) meshes.push_back(swept_section(section, cut));
  return meshes;
}

int steps_of(const FlatLoops& loops, const TurnSweep& sweep) {
  const auto [lo, hi] = flat_bounds(loops);
  const double share = std::fabs(sweep.angle) / 360;
  const int around = fragments(std::max(hi.x, 0.0) - std::min(lo.x, 0.0), sweep.fineness);
  return std::max(static_cast<int>(around * share), sweep.angle == 360 ? 3 : 1);
}

std::optional<std::vector<PolygonMesh>> turned_mesh(const FlatLoops& loops,
                                                    const TurnSweep& sweep) {
  const auto sections = sections_of(loops);
  if (!sections) return std::nullopt;
  const bool is_closed = sweep.angle == 360;
  const int steps = steps_of(loops, sweep);
  std::vector<double> angles;
  for (int i = 0; i < steps + (is_closed ? 0 : 1); ++i)
    angles.push_back(sweep.start + sweep.angle * i / steps);
  std::vector<PolygonMesh> meshes;
  for (const Section& section : *sections)
    meshes.push_back(turned_section(section, angles, is_closed));
  return meshes;
}

}  // namespace graycube
