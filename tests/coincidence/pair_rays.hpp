// Rays for a pair of scenes, most of them aimed where surfaces touch, and their crossings.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "coincidence/pair_maker.hpp"
#include "crossings/surface_tree.hpp"

namespace graycube::testing {

struct PairRay {
  const char* what = "";
  Ray ray;
  /// Crossings before it don't count.
  double t0 = 0;
  /// The size of the part at which the ray is aimed.
  double size = 1;
  bool starts_on_face = false;
};

/// Nothing is checked of rays that meet a face at less than this angle, in radians.
inline constexpr double kLeastGrazing = 0.01;

class PairRays {
 public:
  PairRays(const FlushPair& pair, std::uint64_t seed) : pair_(pair), dice_(seed ^ 0x5DEECE66Dull) {}

  static constexpr std::size_t kKinds = 5;

  PairRay make(std::size_t kind) {
    site_ = &pair_.sites[dice_.below(pair_.sites.size())];
    const double size = site_->world_size();
    PairRay r{"", {}, 0, size, false};
    switch (kind % kKinds) {
      case 0:
        r.what = "from outside";
        r.ray = towards(inside_point(), size);
        break;
      case 1:
        r.what = "from outside at a face";
        r.ray = towards(face_point(), size);
        break;
      case 2:
        r.what = "grazing a face";
        r.ray = grazing(size);
        break;
      case 3:
        r.what = "from inside";
        r.ray = {inside_point(), dice_.unit_vector()};
        break;
      default:
        r.what = "from a face";
        r.ray = {face_point(), dice_.unit_vector()};
        start_on_face(r);
    }
    return r;
  }

  /// A ray that starts at a point of a surface, as a shadow or a reflected ray does.
  PairRay secondary(const PairRay& from, const Vec3& hit) {
    PairRay r{"from a hit", {hit, dice_.unit_vector()}, 0, from.size, false};
    start_on_face(r);
    return r;
  }
  /// Whether secondary rays' least t is short beside the size (it is 1e-9 in scenes that are
  /// smaller).
  static bool is_large_enough(const PairRay& r) { return epsilon(r.ray.origin) < 5e-3 * r.size; }

  /// The ray moved a little aside; if it starts on a face, only its direction is changed.
  PairRay beside(PairRay r, double by) {
    const Vec3 aside = cross(r.ray.direction, dice_.unit_vector());
    if (!r.starts_on_face)
      r.ray.origin = r.ray.origin + (by * r.size) * cross(r.ray.direction, normalized(aside));
    r.ray.direction = normalized(r.ray.direction + by * normalized(aside));
    return r;
  }

 private:
  static double epsilon(const Vec3& origin) { return 1e-9 * larger(1, max_abs(origin)); }
  static void start_on_face(PairRay& r) {
    r.t0 = epsilon(r.ray.origin);
    r.starts_on_face = true;
  }
  Vec3 inside_point() {
    const double r = site_->radius;
    return site_->to_world.point(
        {dice_.between(-r, r), dice_.between(-r, r), dice_.between(-0.1, 1.1) * site_->height});
  }
  /// A point of a face that other faces may touch.
  Vec3 face_point() {
    const double z = site_->heights[dice_.below(site_->heights.size())];
    Vec3 disc{0, 0, site_->radius};
    if (!site_->discs.empty() && !dice_.one_in(4))
      disc = site_->discs[dice_.below(site_->discs.size())];
    return site_->to_world.point(
        {disc.x + disc.z * dice_.between(-1, 1), disc.y + disc.z * dice_.between(-1, 1), z});
  }
  Ray towards(const Vec3& at, double size) {
    const Vec3 from = site_->to_world.translation() + 3 * size * dice_.unit_vector();
    return {from, normalized(at - from)};
  }
  Ray grazing(double size) {
    const double turn = dice_.between(0, 360);
    const Vec3 along =
        normalized(site_->to_world.vector({cos_degrees(turn), sin_degrees(turn), 0}));
    const Vec3 beside = site_->to_world.vector({-sin_degrees(turn), cos_degrees(turn), 0});
    const double angle = dice_.sign() * dice_.between(kLeastGrazing, 0.1);
    const Vec3 d = normalized(along + angle * normalized(cross(along, beside)));
    return {face_point() - 2 * size * d, d};
  }

  const FlushPair& pair_;
  const Site* site_ = nullptr;
  Dice dice_;
};

/// A crossing as a viewer sees it.
struct SeenCrossing {
  double t = 0;
  std::uint32_t object = 0;
  bool entering = false;
  /// The normal, against the ray.
  Vec3 normal;
  /// The cosine of the angle between normal and ray.
  double cosine = 0;
};

inline constexpr std::size_t kMostCrossings = 200;

/// All crossings from t0 on, each found by a search of its own.
class CrossingFinder {
 public:
  explicit CrossingFinder(const Model& model) : model_(model), tree_(SurfaceTree::build(model)) {}
  CrossingFinder(const CrossingFinder&) = delete;
  CrossingFinder& operator=(const CrossingFinder&) = delete;

  std::vector<SeenCrossing> all(const PairRay& r) {
    std::vector<SeenCrossing> found;
    double t = r.t0;
    while (found.size() < kMostCrossings) {
      const auto hit =
          tree_.first_crossing(r.ray, t, std::numeric_limits<double>::infinity(), scratch_);
      if (!hit) break;
      found.push_back(seen(r.ray, *hit));
      t = std::nextafter(hit->t, std::numeric_limits<double>::infinity());
    }
    return found;
  }
  const SurfaceTree& tree() const { return tree_; }
  TreeScratch& scratch() { return scratch_; }

 private:
  SeenCrossing seen(const Ray& ray, const Crossing& c) const {
    Vec3 n = outward_normal(model_.primitives[c.primitive], model_.data(), ray, c.t);
    if (dot(n, ray.direction) > 0) n = -n;
    return {c.t, c.object, c.entering, n, -dot(n, ray.direction)};
  }

  const Model& model_;
  SurfaceTree tree_;
  TreeScratch scratch_;
};

/// The crossings without pieces, of a solid or between two, that are not thicker than `thickness`.
inline std::vector<SeenCrossing> without_skins(const std::vector<SeenCrossing>& all,
                                               double thickness) {
  std::vector<SeenCrossing> kept;
  for (const SeenCrossing& c : all) {
    const auto before = std::find_if(kept.rbegin(), kept.rend(),
                                     [&](const auto& k) { return k.object == c.object; });
    if (before != kept.rend() &&
        (c.t - before->t) * std::fmax(c.cosine, kLeastGrazing) <= thickness) {
      kept.erase(std::next(before).base());
    } else {
      kept.push_back(c);
    }
  }
  return kept;
}

/// How much crossings of one line may differ that were computed by different arithmetic.
struct CrossingTolerance {
  /// In scene units, for a ray straight at a face; more for one that grazes it.
  double t = 0;
  double normal = 1e-6;
};

inline bool same_crossings(const std::vector<SeenCrossing>& a, const std::vector<SeenCrossing>& b,
                           const CrossingTolerance& by) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [&](const SeenCrossing& x, const SeenCrossing& y) {
                      return x.object == y.object && x.entering == y.entering &&
                             std::fabs(x.t - y.t) * std::fmax(x.cosine, kLeastGrazing) <= by.t &&
                             length(x.normal - y.normal) <= by.normal;
                    });
}

}  // namespace graycube::testing
