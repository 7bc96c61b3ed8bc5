// solid_volume [--grid N] SCENE [OTHER]: the volume of all objects of a scene taken together, from
// the lengths of N × N parallel rays along each axis inside of them. With another scene the same
// rays go through both: then the ratio of the volumes is far more exact than each of them, and so
// is the part of the rays that meet one of the two alone. Prints one JSON object. Both must be
// bounded.
#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <deque>
#include <stdexcept>
#include <string_view>

#include "bench/scene_arguments.hpp"
#include "crossings/surface_tree.hpp"
#include "geometry/infinity.hpp"
#include "scene/compile_scene.hpp"

namespace graycube::bench {
namespace {

constexpr std::uint32_t kDefaultGrid = 200, kMaxGrid = 10'000;
/// Rays go through the cells of the grid off their centres, since models like to have faces there.
constexpr double kPlaceInCell[2] = {0.3819660112501051, 0.5857864376269049};

/// The union of all objects of a file, ready for rays.
class Solid {
 public:
  explicit Solid(const std::filesystem::path& file)
      : model_(compile_scene(united(file))), tree_(SurfaceTree::build(model_)) {}
  // The tree points at the model.
  Solid(const Solid&) = delete;
  Solid& operator=(const Solid&) = delete;

  /// Grows the box to hold the objects.
  void add_bounds(Aabb& box) const {
    for (const Object& object : model_.objects) {
      for (int a = 0; a < 3; ++a) {
        box.lo[a] = std::min(box.lo[a], object.bounds.lo[a]);
        box.hi[a] = std::max(box.hi[a], object.bounds.hi[a]);
      }
    }
  }

  /// The length inside of a ray that begins outside, of unit direction.
  double length_along(const Ray& ray) {
    double length = 0, t0 = 0;
    while (const auto crossing = tree_.first_crossing(ray, t0, kInf, scratch_)) {
      length += crossing->entering ? -crossing->t : crossing->t;
      t0 = std::nextafter(crossing->t, kInf);
    }
    return length;
  }

 private:
  static Scene united(const std::filesystem::path& file) {
    SceneArguments arguments;
    arguments.scene = file;
    Scene scene = load(arguments);
    if (scene.objects.size() < 2) return scene;
    OperationNode all{Operation::kUnion, {}};
    for (SceneObject& object : scene.objects) {
      object.csg.material = object.material;
      all.children.push_back(std::move(object.csg));
    }
    const MaterialIndex material = scene.objects.front().material;
    scene.objects.resize(1);
    scene.objects.front() = {"all", material, CsgNode{std::move(all), {}, material}};
    return scene;
  }

  Model model_;
  SurfaceTree tree_;
  TreeScratch scratch_;
};

struct Result {
  double volume[2] = {0, 0};
  std::uint64_t rays = 0, hit_by_one = 0, hit = 0;
};

/// Adds what the rays along an axis find, as a third of the whole.
void measure(std::deque<Solid>& solids, const Aabb& box, int axis, std::uint32_t grid,
             Result& result) {
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  const double du = (box.hi[u] - box.lo[u]) / grid, dv = (box.hi[v] - box.lo[v]) / grid;
  Ray ray;
  ray.direction[axis] = 1;
  ray.origin[axis] = box.lo[axis] - 0.01 * (box.hi[axis] - box.lo[axis]);
  for (std::uint32_t i = 0; i < grid; ++i) {
    ray.origin[u] = box.lo[u] + (i + kPlaceInCell[0]) * du;
    for (std::uint32_t j = 0; j < grid; ++j) {
      ray.origin[v] = box.lo[v] + (j + kPlaceInCell[1]) * dv;
      bool hits[2] = {false, false};
      for (std::size_t s = 0; s < solids.size(); ++s) {
        const double length = solids[s].length_along(ray);
        hits[s] = length > 0;
        result.volume[s] += length * du * dv / 3;
      }
      ++result.rays;
      result.hit += hits[0] || hits[1] ? 1 : 0;
      result.hit_by_one += hits[0] != hits[1] ? 1 : 0;
    }
  }
}

void run(std::deque<Solid>& solids, std::uint32_t grid) {
  Aabb box{{kInf, kInf, kInf}, {-kInf, -kInf, -kInf}};
  for (const Solid& solid : solids) solid.add_bounds(box);
  for (int a = 0; a < 3; ++a) {
    if (!std::isfinite(box.lo[a]) || !std::isfinite(box.hi[a])) {
      throw std::runtime_error("a solid is empty or has no bounds");
    }
  }
  Result result;
  for (int axis = 0; axis < 3; ++axis) measure(solids, box, axis, grid, result);
  std::printf("{\"volume\": %.9g", result.volume[0]);
  if (solids.size() > 1) {
    std::printf(", \"other_volume\": %.9g, \"hit_by_one_percent\": %.4f", result.volume[1],
                100.0 * static_cast<double>(result.hit_by_one) /
                    static_cast<double>(std::max<std::uint64_t>(1, result.hit)));
  }
  std::printf(", \"rays\": %llu}\n", static_cast<unsigned long long>(result.rays));
}

int guarded_main(int argc, char** argv) {
  std::deque<Solid> solids;
  std::uint32_t grid = kDefaultGrid;
  bool is_bad = false;
  for (int i = 1; i < argc; ++i) {
    const std::string_view argument = argv[i];
    if (argument == "--grid" && i + 1 < argc) {
      const std::string_view text = argv[++i];
      const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), grid);
      is_bad |=
          error != std::errc{} || end != text.data() + text.size() || grid < 1 || grid > kMaxGrid;
    } else if (argument.starts_with("-") || solids.size() == 2) {
      is_bad = true;
    } else {
      solids.emplace_back(argument);
    }
  }
  if (is_bad || solids.empty()) {
    std::fprintf(stderr, "usage: solid_volume [--grid N] SCENE [OTHER]; N from 1 to %u\n",
                 kMaxGrid);
    return 2;
  }
  run(solids, grid);
  return 0;
}

}  // namespace
}  // namespace graycube::bench

int main(int argc, char** argv) {
  try {
    return graycube::bench::guarded_main(argc, argv);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "solid_volume: %s\n", e.what());
    return 1;
  }
}
