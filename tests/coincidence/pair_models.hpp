// The two scenes of a pair compared along rays.
#pragma once

#include <limits>
#include <sstream>
#include <string>
#include <vector>

#include "coincidence/pair_rays.hpp"

namespace graycube::testing {

/// The results of the rays of some pairs.
struct Tally {
  std::size_t rays = 0, met = 0, wrong = 0;
  /// Rays that differ within a hair's breadth of an edge, or nearly along a face.
  std::size_t near_edges = 0;
  /// The first wrong ray.
  std::string first;

  void add(const Tally& t) {
    rays += t.rays;
    met += t.met;
    wrong += t.wrong;
    near_edges += t.near_edges;
    if (first.empty()) first = t.first;
  }
};

/// Compares the two scenes of a pair.
class PairOfModels {
 public:
  struct Options {
    /// Skins as thin as the rounding of numbers don't count.
    bool forgives_skins = false;
    /// Numbers as written may be off by this share of the size and of coordinates.
    double rounding = 1e-10;
  };

  explicit PairOfModels(const FlushPair& pair) : PairOfModels(pair, Options{}) {}
  PairOfModels(const FlushPair& pair, const Options& options)
      : pair_(pair),
        options_(options),
        flush_model_(compile_scene(pair.flush)),
        longer_model_(compile_scene(pair.longer)),
        flush_(flush_model_),
        longer_(longer_model_),
        rays_(pair, pair.seed) {}

  Tally compare(std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
      const PairRay ray = rays_.make(i);
      if (ray.starts_on_face && !may_start_on_face(ray)) continue;
      const auto expected = compare(ray);
      if (expected.empty() || !may_start_on_face(ray)) continue;
      compare(rays_.secondary(ray, ray.ray.at(expected[i % expected.size()].t)));
    }
    return tally_;
  }

 private:
  /// If numbers are coarse, a ray that starts on a face of one scene may miss the other's face.
  bool may_start_on_face(const PairRay& ray) const {
    return options_.rounding < 1e-9 && PairRays::is_large_enough(ray);
  }
  std::vector<SeenCrossing> compare(const PairRay& ray) {
    const auto expected = longer_.all(ray);
    auto found = flush_.all(ray);
    if (options_.forgives_skins) found = without_skins(found, 0.3 * tolerance(ray, found).t);
    ++tally_.rays;
    tally_.met += expected.empty() ? 0 : 1;
    if (same_crossings(expected, found, tolerance(ray, expected))) return expected;
    if (!is_clear_of_edges(ray, expected)) {
      ++tally_.near_edges;
      return expected;
    }
    if (++tally_.wrong == 1) tally_.first = describe(ray, expected, found);
    return expected;
  }

  CrossingTolerance tolerance(const PairRay& ray, const std::vector<SeenCrossing>& expected) const {
    const double farthest = expected.empty() ? 0 : expected.back().t;
    const double reach = max_abs(ray.ray.origin) + farthest;
    const double of_coordinates =
        options_.rounding > 1e-9 ? options_.rounding : 64 * std::numeric_limits<double>::epsilon();
    return {10 * options_.rounding * (ray.size + farthest) + of_coordinates * reach,
            std::fmax(1e-6, 1000 * options_.rounding)};
  }

  /// Whether rays a millionth of the size beside it, or a little more if numbers are coarser, cross
  /// the same faces, none of them nearly along the face.
  bool is_clear_of_edges(const PairRay& ray, const std::vector<SeenCrossing>& expected) {
    const double beside = std::fmax(1e-6, 60 * options_.rounding);
    for (const SeenCrossing& c : expected) {
      if (c.cosine < kLeastGrazing) return false;
    }
    for (int i = 0; i < 8; ++i) {
      const auto around = longer_.all(rays_.beside(ray, beside));
      const double far = ray.size + 1e-3 * max_abs(ray.ray.origin);
      if (!same_crossings(expected, around, {30 * beside * far, std::fmax(1e-2, 30 * beside)}))
        return false;
    }
    return true;
  }

  std::string describe(const PairRay& ray, const std::vector<SeenCrossing>& expected,
                       const std::vector<SeenCrossing>& found) const {
    std::ostringstream out;
    out.precision(17);
    const Vec3 &o = ray.ray.origin, &d = ray.ray.direction;
    out << pair_.text() << ": ray " << ray.what << " {{" << o.x << ", " << o.y << ", " << o.z
        << "}, {" << d.x << ", " << d.y << ", " << d.z << "}}, size " << ray.size
        << ", ways differ by " << pair_.ways_differ_ulps << " ulps";
    const auto list = [&](const char* name, const std::vector<SeenCrossing>& crossings) {
      out << "\n  " << name << ':';
      for (const SeenCrossing& c : crossings) out << ' ' << (c.entering ? "in " : "out ") << c.t;
    };
    list("expected", expected);
    list("found", found);
    return out.str();
  }

  const FlushPair& pair_;
  Options options_;
  Model flush_model_, longer_model_;
  CrossingFinder flush_, longer_;
  PairRays rays_;
  Tally tally_;
};

}  // namespace graycube::testing
