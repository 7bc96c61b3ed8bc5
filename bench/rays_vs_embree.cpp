// rays_vs_embree [--depth D] [--size N] [--seed S] [--rounds R]: the spheres of a flake, and the
// same rays through Graycube's engine and through Embree's own spheres, one ray at a time: primary
// rays alone, then shadow rays alone. Prints rays per second of CPU time, the best of the rounds,
// as one JSON object.
#include <embree3/rtcore.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <exception>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "bench/clocks.hpp"
#include "bench/scene_families.hpp"
#include "geometry/infinity.hpp"
#include "scene/compile_scene.hpp"
#include "trace/domain.hpp"

namespace graycube::bench {
namespace {

struct Options {
  std::uint32_t depth = 5, size = 512, seed = 11, rounds = 7;
};

struct UsageError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

Options parse(std::span<char*> arguments) {
  Options options;
  if (arguments.size() % 2 != 0) throw UsageError("an option without a value");
  for (std::size_t i = 0; i < arguments.size(); i += 2) {
    const std::string_view name = arguments[i];
    const std::string_view text = arguments[i + 1];
    struct {
      std::uint32_t* value;
      std::uint32_t most;
    } const option = name == "--depth"    ? decltype(option){&options.depth, 6}
                     : name == "--size"   ? decltype(option){&options.size, 4096}
                     : name == "--seed"   ? decltype(option){&options.seed, ~0u}
                     : name == "--rounds" ? decltype(option){&options.rounds, 1000}
                                          : decltype(option){nullptr, 0};
    if (option.value == nullptr) throw UsageError("what is " + std::string(name) + "?");
    const auto [end, error] =
        std::from_chars(text.data(), text.data() + text.size(), *option.value);
    if (error != std::errc{} || end != text.data() + text.size() || *option.value < 1 ||
        *option.value > option.most) {
      throw UsageError(std::string(name) + ": not a number from 1 to " +
                       std::to_string(option.most));
    }
  }
  return options;
}

/// A ray from t0 to t1.
struct Segment {
  Ray ray;
  double t0, t1;
};

Scene spheres_alone(const Options& options) {
  Scene scene = make_scene(Family::kFlake, options.depth, options.seed, options.size);
  std::erase_if(scene.objects, [](const SceneObject& o) {
    return !std::holds_alternative<SphereShape>(o.csg.value);
  });
  return scene;
}

std::vector<Segment> primary_rays(const Domain& domain) {
  const ImageSize& image = domain.settings().image;
  std::vector<Segment> rays;
  for (std::uint32_t y = 0; y < image.height; ++y) {
    for (std::uint32_t x = 0; x < image.width; ++x) {
      rays.push_back({domain.frame().primary_ray(x, y, 0, 0), 0, kInf});
    }
  }
  return rays;
}

/// Rays from every hit of a primary ray to every light that its surface faces.
std::vector<Segment> shadow_rays(const Domain& domain, std::span<const Segment> primary) {
  const Model& model = domain.model();
  CrossingScratch scratch;
  std::vector<Segment> rays;
  for (const Segment& s : primary) {
    const auto hit = domain.first_crossing(s.ray, s.t0, s.t1, scratch);
    if (!hit) continue;
    const Vec3 p = s.ray.at(hit->t);
    const Vec3 n = outward_normal(model.primitives[hit->primitive], model.data(), s.ray, hit->t);
    for (const PointLight& light : domain.settings().lights) {
      const Vec3 to_light = light.position - p;
      if (!(dot(n, to_light) > 0)) continue;
      // The start is far enough from the surface for single precision, too.
      const double epsilon = 1e-4 * std::fmax(1, max_abs(p));
      rays.push_back({{p, normalized(to_light)}, epsilon, length(to_light) - epsilon});
    }
  }
  return rays;
}

class EmbreeSpheres {
 public:
  explicit EmbreeSpheres(const Scene& scene) {
    device_ = rtcNewDevice("threads=1");
    scene_ = rtcNewScene(device_);
    RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_SPHERE_POINT);
    auto* v = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0,
                                                          RTC_FORMAT_FLOAT4, 4 * sizeof(float),
                                                          scene.objects.size()));
    if (v == nullptr) throw std::runtime_error("Embree gave no buffer");
    for (const SceneObject& o : scene.objects) {
      const auto& s = std::get<SphereShape>(o.csg.value);
      for (const double x : {s.center.x, s.center.y, s.center.z, s.radius})
        *v++ = static_cast<float>(x);
    }
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene_);
    if (rtcGetDeviceError(device_) != RTC_ERROR_NONE) throw std::runtime_error("Embree failed");
    rtcInitIntersectContext(&context_);
  }
  ~EmbreeSpheres() {
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
  }
  EmbreeSpheres(const EmbreeSpheres&) = delete;
  EmbreeSpheres& operator=(const EmbreeSpheres&) = delete;

  bool hits(const RTCRay& ray) {
    RTCRayHit r{ray, {}};
    r.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(scene_, &context_, &r);
    return r.hit.geomID != RTC_INVALID_GEOMETRY_ID;
  }
  bool is_occluded(RTCRay ray) {
    rtcOccluded1(scene_, &context_, &ray);
    return ray.tfar < 0;
  }

 private:
  RTCDevice device_ = nullptr;
  RTCScene scene_ = nullptr;
  RTCIntersectContext context_{};
};

std::vector<RTCRay> embree_rays(std::span<const Segment> segments) {
  std::vector<RTCRay> rays;
  for (const auto& [ray, t0, t1] : segments) {
    RTCRay r{};
    r.org_x = static_cast<float>(ray.origin.x);
    r.org_y = static_cast<float>(ray.origin.y);
    r.org_z = static_cast<float>(ray.origin.z);
    r.tnear = static_cast<float>(t0);
    r.dir_x = static_cast<float>(ray.direction.x);
    r.dir_y = static_cast<float>(ray.direction.y);
    r.dir_z = static_cast<float>(ray.direction.z);
    r.tfar = static_cast<float>(t1);
    r.mask = ~0u;
    rays.push_back(r);
  }
  return rays;
}

struct Rate {
  double per_second = 0;
  std::size_t found = 0;
};

/// Asks both the same, in turns, so that changes of the machine's speed meet both alike.
template <typename A, typename B>
std::pair<Rate, Rate> race(std::uint32_t rounds, std::size_t rays, A&& ours, B&& embree) {
  std::pair<Rate, Rate> best;
  const auto run = [&](auto&& ask, Rate& rate) {
    CpuClock clock;
    std::size_t found = 0;
    for (std::size_t i = 0; i < rays; ++i) found += ask(i) ? 1 : 0;
    rate = {std::max(rate.per_second, static_cast<double>(rays) / clock.lap()), found};
  };
  for (std::uint32_t round = 0; round < rounds; ++round) {
    run(ours, best.first);
    run(embree, best.second);
  }
  return best;
}

void print(const char* what, std::size_t rays, const std::pair<Rate, Rate>& rates) {
  const auto& [ours, embree] = rates;
  std::printf(
      "  \"%s\": {\"rays\": %zu, \"graycube_per_s\": %.0f, \"embree_per_s\": %.0f, \"ratio\": "
      "%.3f,\n"
      "    \"graycube_hits\": %zu, \"embree_hits\": %zu}",
      what, rays, ours.per_second, embree.per_second, ours.per_second / embree.per_second,
      ours.found, embree.found);
}

void run(const Options& options) {
  const Scene scene = spheres_alone(options);
  EmbreeSpheres embree(scene);
  const Domain domain(compile_scene(scene));
  CrossingScratch scratch;

  const std::vector<Segment> primary = primary_rays(domain);
  const std::vector<RTCRay> embree_primary = embree_rays(primary);
  const auto primary_rates = race(
      options.rounds, primary.size(),
      [&](std::size_t i) {
        const Segment& s = primary[i];
        return domain.first_crossing(s.ray, s.t0, s.t1, scratch).has_value();
      },
      [&](std::size_t i) { return embree.hits(embree_primary[i]); });

  const std::vector<Segment> shadow = shadow_rays(domain, primary);
  const std::vector<RTCRay> embree_shadow = embree_rays(shadow);
  const auto shadow_rates = race(
      options.rounds, shadow.size(),
      [&](std::size_t i) {
        const Segment& s = shadow[i];
        Rgb light{1, 1, 1};
        return !domain.pass_light(s.ray, s.t0, s.t1, scratch, light);
      },
      [&](std::size_t i) { return embree.is_occluded(embree_shadow[i]); });

  std::printf("{\"spheres\": %zu,\n", scene.objects.size());
  print("primary", primary.size(), primary_rates);
  std::printf(",\n");
  print("shadow", shadow.size(), shadow_rates);
  std::printf("}\n");
}

}  // namespace
}  // namespace graycube::bench

int main(int argc, char** argv) {
  using namespace graycube::bench;
  try {
    run(parse(std::span(argv + 1, static_cast<std::size_t>(argc - 1))));
    return 0;
  } catch (const UsageError& e) {
    std::fprintf(stderr,
                 "rays_vs_embree: %s\n"
                 "usage: rays_vs_embree [--depth D] [--size N] [--seed S] [--rounds R]\n",
                 e.what());
    return 2;
  } catch (const std::exception& e) {
    std::fprintf(stderr, "rays_vs_embree: %s\n", e.what());
    return 1;
  }
}
