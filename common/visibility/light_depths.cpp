#include "visibility/light_depths.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

#include "csg/morphology.hpp"
#include "csg/tree.hpp"
#include "regions/camera.hpp"
#include "stop_point.hpp"

namespace graycube {
namespace {

/// Number of pixels that are sampled along each side of the picture.
constexpr std::uint32_t kSamples = 64;
/// Blocks are made until this share of the samples that ask for a block have theirs: the last ones
/// would serve few rays each.
constexpr double kServedShare = 0.8;
/// Solids are grown or shrunk by this many δ more than a texel's half width asks for; texels are
/// taken to be wider by this factor.
constexpr double kGrowDeltas = 16;
constexpr double kWiden = 1 + 1e-5;
/// Distances are given this much shorter or longer, relatively.
constexpr double kRelativeError = 1e-9;
/// Texels along a side of the squares that are traced together, as one packet.
constexpr std::uint32_t kSquare = 4;
static_assert(kSquare * kSquare == RayPacket::kSize && kSquare % LightDepths::kGroup == 0);

/// The blocks of one light that the picture's surfaces ask for.
struct Demand {
  /// The number of samples that ask for each texel of the horizon map.
  std::vector<std::uint32_t> samples = std::vector<std::uint32_t>(LightHorizons::kTexels);
  /// The distance of the farthest of these samples from the light (scene units).
  double far = 0;
};

/// The demand of each light, from samples of the picture.
std::vector<Demand> demands(const LightHorizons& horizons, const SurfaceTree& whole) {
  const Model& model = whole.model();
  const auto& lights = model.settings.lights;
  const CameraFrame frame = CameraFrame::from(model.settings.camera, model.settings.image);
  std::vector<Demand> result(lights.size());
  TreeScratch scratch;
  const auto look = [&](const Ray& ray, const Crossing& hit) {
    const Vec3 p = ray.at(hit.t);
    Vec3 n = outward_normal(model.primitives[hit.primitive], model.data(), ray, hit.t);
    if (dot(n, ray.direction) > 0) n = -n;
    for (std::size_t l = 0; l < lights.size(); ++l) {
      const Vec3 from_light = p - lights[l].position;
      const double distance = length(from_light);
      if (horizons.maps()[l].empty() || !(dot(n, from_light) < 0)) continue;
      const std::size_t texel = cube_texel(cube_place(from_light), LightHorizons::kSide);
      if (!(horizons.maps()[l].at(texel) < distance)) continue;
      ++result[l].samples[texel];
      result[l].far = std::max(result[l].far, distance);
    }
  };
  const std::uint32_t across = std::min(kSamples, frame.image.width),
                      down = std::min(kSamples, frame.image.height);
  const auto pixel = [](std::uint32_t i, std::uint32_t count, std::uint32_t pixels) {
    return static_cast<std::uint32_t>((2 * std::uint64_t{i} + 1) * pixels / (2 * count));
  };
  for (std::uint32_t j = 0; j < down; ++j) {
    for (std::uint32_t i = 0; i < across; ++i) {
      const Ray ray = frame.primary_ray(pixel(i, across, frame.image.width),
                                        pixel(j, down, frame.image.height), 0, 0);
      if (const auto hit = whole.first_crossing(ray, 0, kInf, scratch)) look(ray, *hit);
    }
  }
  return result;
}

/// Chooses the blocks asked for most, as many as it takes to serve kServedShare of the samples.
void choose_blocks(const std::vector<Demand>& demand, std::vector<LightDepths>& depths) {
  struct Block {
    std::uint32_t samples, light, texel;
  };
  std::vector<Block> all;
  std::uint64_t samples = 0;
  for (std::uint32_t l = 0; l < demand.size(); ++l) {
    for (std::uint32_t texel = 0; texel < LightHorizons::kTexels; ++texel) {
      if (demand[l].samples[texel] == 0) continue;
      all.push_back({demand[l].samples[texel], l, texel});
      samples += all.back().samples;
    }
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const Block& a, const Block& b) { return a.samples > b.samples; });
  std::uint64_t served = 0;
  for (const Block& b : all) {
    if (static_cast<double>(served) >= kServedShare * static_cast<double>(samples)) break;
    served += b.samples;
    depths[b.light].blocks.push_back(b.texel);
  }
  for (LightDepths& d : depths) std::sort(d.blocks.begin(), d.blocks.end());
}

/// The most by which a unit direction in a texel may differ from the texel's middle direction.
double half_width(std::uint32_t split) {
  return kWiden * std::sqrt(2.0) / (LightHorizons::kSide * split);
}

/// Splits blocks so that a texel is about equally wide where each light's farthest samples are, as
/// fine as `most_texels` allow; false when they allow nothing.
bool split_blocks(const std::vector<Demand>& demand, std::uint64_t most_texels,
                  std::vector<LightDepths>& depths) {
  double farthest = 0;
  for (const Demand& d : demand) farthest = std::max(farthest, d.far);
  if (!(farthest > 0) || !std::isfinite(farthest)) return false;
  for (std::uint32_t finest = LightDepths::kMostSplit; finest >= 1; --finest) {
    std::uint64_t texels = 0;
    for (std::size_t l = 0; l < depths.size(); ++l) {
      depths[l].split =
          std::max(1u, static_cast<std::uint32_t>(std::ceil(demand[l].far / farthest * finest)));
      texels +=
          std::uint64_t{depths[l].dark_split()} * depths[l].dark_split() * depths[l].blocks.size();
    }
    if (texels > 0 && texels <= most_texels) return true;
  }
  return false;
}

/// The most (scene units) by which lines in a texel part from its middle line on their way to the
/// far side of an object, or to where depths end: the largest over all lights. `split_of` gives the
/// number of texels along a side of a light's blocks.
template <typename SplitOf>
double half_width_at(const Object& object, const Model& model, const std::vector<Demand>& demand,
                     const std::vector<LightDepths>& depths, SplitOf&& split_of) {
  double most = 0;
  for (std::size_t l = 0; l < depths.size(); ++l) {
    if (depths[l].blocks.empty()) continue;
    const Vec3 lo = object.bounds.lo - model.settings.lights[l].position;
    const double reach = length(lo) + length(object.bounds.hi - object.bounds.lo);
    // Written so that an infinite reach or NaN counts as the distance to which depths go.
    const double far = reach < demand[l].far ? reach : demand[l].far;
    most = std::max(most, far * half_width(split_of(depths[l])));
  }
  return most + kGrowDeltas * model.delta;
}

/// Finds the first crossings of a scene with rays from a light.
class View {
 public:
  View(const SurfaceTree& tree, const Vec3& light) : tree_(tree), light_(light) {}

  /// The parameter of each ray's first crossing; `end` if there is none before.
  std::span<const double> look(std::span<const Vec3> directions, double end) {
    RayPacket packet;
    for (const Vec3& d : directions) packet.add({light_, d}, 0, end);
    std::array<Crossing, RayPacket::kSize> found;
    const RayPacket::Mask hits = tree_.first_crossings(packet, scratch_, found);
    for (std::size_t i = 0; i < directions.size(); ++i)
      first_[i] = (hits >> i & 1) != 0 ? found[i].t : end;
    return {first_.data(), directions.size()};
  }

 private:
  const SurfaceTree& tree_;
  Vec3 light_;
  TreeScratch scratch_;
  std::array<double, RayPacket::kSize> first_;
};

bool is_inside(const Model& model, const Vec3& point) {
  return std::any_of(model.objects.begin(), model.objects.end(), [&](const Object& object) {
    if (!object.bounds.contains(point)) return false;
    return evaluate(model.tree(object), [&](std::uint32_t p) {
      return contains(model.primitives[p], model.data(), point);
    });
  });
}

/// Fills a light's depths from what it sees of the dilated and of the eroded scene.
class DepthMaker {
 public:
  /// `map` is the light's horizon.
  DepthMaker(const SurfaceTree& larger, const SurfaceTree& smaller, const Vec3& light,
             const HorizonMap& map, double far, LightDepths& depths)
      : larger_(larger, light), smaller_(smaller, light), map_(map), far_(far), depths_(depths) {}

  void run() {
    const std::uint32_t split = depths_.split, dark_split = depths_.dark_split();
    // Made a little shorter, so that no distance of up to kNever units lies beyond `far_`.
    depths_.unit = far_ * (1 - kRelativeError) / LightDepths::kNever;
    depths_.lit.resize(depths_.blocks.size() * split * split);
    depths_.dark.assign(depths_.blocks.size() * dark_split * dark_split, LightDepths::kNever);
    for (std::size_t block = 0; block < depths_.blocks.size(); ++block) {
      stop_if_asked();
      for_each_square(split, [&](std::uint32_t x, std::uint32_t y) { look_about(block, x, y); });
      for_each_square(dark_split,
                      [&](std::uint32_t x, std::uint32_t y) { look_behind(block, x, y); });
    }
  }

 private:
  template <typename F>
  static void for_each_square(std::uint32_t split, F&& f) {
    for (std::uint32_t y = 0; y < split; y += kSquare) {
      for (std::uint32_t x = 0; x < split; x += kSquare) f(x, y);
    }
  }

  /// Aims at a square of texels, from (x0, y0) on, of a block of `split` × `split` texels.
  void aim(std::size_t block, std::uint32_t split, std::uint32_t x0, std::uint32_t y0) {
    constexpr std::uint32_t kSide = LightHorizons::kSide;
    const std::uint32_t texel = depths_.blocks[block];
    const double column = texel % kSide, row = texel / kSide % kSide;
    const double step = 1.0 / (double{kSide} * split);
    directions_.clear();
    places_.clear();
    for (std::uint32_t y = y0; y < std::min(y0 + kSquare, split); ++y) {
      for (std::uint32_t x = x0; x < std::min(x0 + kSquare, split); ++x) {
        const double u = (column * split + x + 0.5) * step, v = (row * split + y + 0.5) * step;
        directions_.push_back(normalized(cube_direction({texel / (kSide * kSide), u, v})));
        places_.push_back((block * split + y) * split + x);
      }
    }
  }

  void look_about(std::size_t block, std::uint32_t x0, std::uint32_t y0) {
    aim(block, depths_.split, x0, y0);
    const auto begins = larger_.look(directions_, far_);
    const double at_least = map_.at(depths_.blocks[block]);
    for (std::size_t i = 0; i < places_.size(); ++i) {
      const double lit = std::max(begins[i] * (1 - kRelativeError), at_least);
      depths_.lit[places_[i]] = begins[i] < far_ && lit < far_
                                    ? static_cast<std::uint16_t>(lit / depths_.unit)
                                    : LightDepths::kNever;
    }
  }

  /// Whether any surface begins in the texels of the horizon that a square of darkness covers.
  bool has_before(std::size_t block, std::uint32_t x0, std::uint32_t y0) const {
    const std::uint32_t split = depths_.split;
    constexpr std::uint32_t kGroup = LightDepths::kGroup, kGroups = kSquare / kGroup;
    for (std::uint32_t y = y0 / kGroup; y < std::min(y0 / kGroup + kGroups, split); ++y) {
      for (std::uint32_t x = x0 / kGroup; x < std::min(x0 / kGroup + kGroups, split); ++x) {
        if (depths_.lit[(block * split + y) * split + x] < LightDepths::kNever) return true;
      }
    }
    return false;
  }

  void look_behind(std::size_t block, std::uint32_t x0, std::uint32_t y0) {
    if (!has_before(block, x0, y0)) return;
    aim(block, depths_.dark_split(), x0, y0);
    const auto enters = smaller_.look(directions_, far_);
    for (std::size_t i = 0; i < places_.size(); ++i) {
      const double units = std::ceil(enters[i] * (1 + kRelativeError) / depths_.unit);
      if (units < LightDepths::kNever) depths_.dark[places_[i]] = static_cast<std::uint16_t>(units);
    }
  }

  View larger_, smaller_;
  const HorizonMap& map_;
  double far_;
  LightDepths& depths_;
  std::vector<Vec3> directions_;
  /// The places in LightDepths::lit or dark of the texels that directions_ go through.
  std::vector<std::size_t> places_;
};

}  // namespace

LightHorizons with_depths(LightHorizons horizons, const SurfaceTree& whole,
                          std::uint64_t most_texels) {
  const Model& model = whole.model();
  const auto& lights = model.settings.lights;
  if (horizons.maps().size() != lights.size()) return horizons;
  const std::vector<Demand> demand = demands(horizons, whole);
  std::vector<LightDepths> depths(lights.size());
  choose_blocks(demand, depths);
  if (!split_blocks(demand, std::min(most_texels, kMostDepthTexels), depths)) return horizons;
  // A point outside all dilated objects is at least this far from the objects themselves.
  double clearance = kInf;
  const auto larger = dilated(model, [&](const Object& object) {
    const double by =
        half_width_at(object, model, demand, depths, [](const LightDepths& d) { return d.split; });
    clearance = std::min(clearance, by);
    return by;
  });
  if (!larger) return horizons;
  const Model smaller = eroded(model, [&](const Object& object) {
    return half_width_at(object, model, demand, depths,
                         [](const LightDepths& d) { return d.dark_split(); });
  });
  const SurfaceTree larger_tree = SurfaceTree::build(*larger),
                    smaller_tree = SurfaceTree::build(smaller);
  for (std::size_t l = 0; l < lights.size(); ++l) {
    if (depths[l].blocks.empty() || is_inside(*larger, lights[l].position)) {
      depths[l] = {};
      continue;
    }
    depths[l].clearance = clearance;
    DepthMaker(larger_tree, smaller_tree, lights[l].position, horizons.maps()[l], demand[l].far,
               depths[l])
        .run();
  }
  return {horizons.maps(), std::move(depths)};
}

}  // namespace graycube
