// plain_tracer SCENE [--size N] [--exr OUT.exr]: a plain tracer of CSG scenes to measure Graycube
// by, and to check it: Embree over the objects' bounds, Roth's interval lists within them, the
// photometric model of docs/scene.md. One thread. Prints one JSON object; trace_cpu_s leaves out
// loading and building.
#include <embree3/rtcore.h>

#include <cmath>
#include <cstdio>
#include <exception>
#include <stdexcept>
#include <string>

#include "bench/clocks.hpp"
#include "bench/plain/plain_solids.hpp"
#include "bench/scene_arguments.hpp"
#include "film/picture_files.hpp"

namespace graycube::plain {
namespace {

struct Ray {
  Vec3 origin, direction;
  double from = 0, to = kInf;
};

/// The data of Embree's callbacks: Embree's own ray is of single precision and only finds
/// candidates.
struct Query {
  RTCIntersectContext base;
  const Line* line;
  Window window;
  Spans* spans;
  Hit hit;
  double light = 1;
};

class Tracer {
 public:
  explicit Tracer(const Scene& scene) : solids_(scene), settings_(scene.settings) { build(); }
  ~Tracer() {
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
  }
  Tracer(const Tracer&) = delete;
  Tracer& operator=(const Tracer&) = delete;

  Picture render() {
    const auto& [width, height, samples] = settings_.image;
    Picture picture{width, height, {}};
    for (std::uint32_t i = 0; i < width * height; ++i) {
      Rgb sum;
      for (std::uint32_t s = 0; s < samples * samples; ++s) {
        ++rays_;
        sum = sum + light_along(primary_ray(i % width + (s % samples + 0.5) / samples,
                                            i / width + (s / samples + 0.5) / samples),
                                0, {1, 1, 1});
      }
      const double n = 1.0 / (samples * samples);
      for (const double v : {sum.r, sum.g, sum.b}) picture.rgb.push_back(static_cast<float>(n * v));
    }
    return picture;
  }
  std::uint64_t rays() const { return rays_; }

 private:
  void build() {
    for (std::uint32_t i = 0; i < solids_.object_count(); ++i) {
      const Aabb& b = solids_.bounds(i);
      (b.is_finite() ? bounded_ : unbounded_).push_back(i);
      if (b.is_finite()) reach_ = std::fmax(reach_, std::fmax(max_abs(b.lo), max_abs(b.hi)));
    }
    reach_ = std::fmax(reach_, max_abs(settings_.camera.eye));
    device_ = rtcNewDevice("threads=1");
    scene_ = rtcNewScene(device_);
    rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);
    RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_USER);
    rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(bounded_.size()));
    rtcSetGeometryUserData(geometry, this);
    rtcSetGeometryBoundsFunction(geometry, set_bounds, this);
    rtcSetGeometryIntersectFunction(geometry, intersect);
    rtcSetGeometryOccludedFunction(geometry, occlude);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene_);
    if (rtcGetDeviceError(device_) != RTC_ERROR_NONE) throw std::runtime_error("Embree failed");
  }

  static void set_bounds(const RTCBoundsFunctionArguments* args) {
    const auto* self = static_cast<const Tracer*>(args->geometryUserPtr);
    // Single precision loses half a unit of the last place of origin, direction and bounds.
    const Aabb b = self->solids_.bounds(self->bounded_[args->primID]).grown(1e-6 * self->reach_);
    RTCBounds& out = *args->bounds_o;
    out.lower_x = static_cast<float>(b.lo.x);
    out.lower_y = static_cast<float>(b.lo.y);
    out.lower_z = static_cast<float>(b.lo.z);
    out.upper_x = static_cast<float>(b.hi.x);
    out.upper_y = static_cast<float>(b.hi.y);
    out.upper_z = static_cast<float>(b.hi.z);
  }

  static void intersect(const RTCIntersectFunctionNArguments* args) {
    auto& query = *reinterpret_cast<Query*>(args->context);
    const auto* self = static_cast<const Tracer*>(args->geometryUserPtr);
    if (!self->find_nearest(self->bounded_[args->primID], query)) return;
    auto& ray = *reinterpret_cast<RTCRayHit*>(args->rayhit);
    ray.ray.tfar = rounded_up(query.hit.t);
    ray.hit.geomID = 0;
    ray.hit.primID = args->primID;
  }
  static void occlude(const RTCOccludedFunctionNArguments* args) {
    auto& query = *reinterpret_cast<Query*>(args->context);
    const auto* self = static_cast<const Tracer*>(args->geometryUserPtr);
    if (self->lets_through(self->bounded_[args->primID], query)) return;
    reinterpret_cast<RTCRay*>(args->ray)->tfar = -std::numeric_limits<float>::infinity();
  }

  /// Finds out if the object's first surface is nearer than the nearest found so far.
  bool find_nearest(std::uint32_t object, Query& query) const {
    query.spans->clear();
    const Window w{query.window.from, std::fmin(query.window.to, query.hit.t)};
    solids_.spans(object, *query.line, w, *query.spans);
    for (const Span& s : *query.spans) {
      const bool entering = s.enter >= w.from;
      const double t = entering ? s.enter : s.leave;
      if (t < w.from) continue;
      if (t >= w.to) return false;
      query.hit = {t, entering ? s.enter_leaf : s.leave_leaf, entering};
      return true;
    }
    return false;
  }
  /// Dims the query's light by each of the object's surfaces; false when no light is left.
  bool lets_through(std::uint32_t object, Query& query) const {
    query.spans->clear();
    const Window w = query.window;
    solids_.spans(object, *query.line, w, *query.spans);
    const auto pass = [&](double t, std::uint32_t leaf) {
      if (t >= w.from && t < w.to) query.light *= solids_.material(leaf).transmit;
    };
    for (const Span& s : *query.spans) {
      pass(s.enter, s.enter_leaf);
      pass(s.leave, s.leave_leaf);
    }
    return query.light > 0;
  }

  static float rounded_up(double t) {
    return std::nextafter(static_cast<float>(t), std::numeric_limits<float>::infinity());
  }
  static RTCRay embree_ray(const Ray& ray) {
    RTCRay r{};
    r.org_x = static_cast<float>(ray.origin.x);
    r.org_y = static_cast<float>(ray.origin.y);
    r.org_z = static_cast<float>(ray.origin.z);
    r.dir_x = static_cast<float>(ray.direction.x);
    r.dir_y = static_cast<float>(ray.direction.y);
    r.dir_z = static_cast<float>(ray.direction.z);
    r.tfar = rounded_up(ray.to);
    r.mask = ~0u;
    return r;
  }
  Query query_along(const Line& line, const Ray& ray) {
    Query query{{}, &line, {ray.from, ray.to}, &scratch_, {}, 1};
    rtcInitIntersectContext(&query.base);
    return query;
  }

  Hit first_hit(const Ray& ray) {
    const Line line(ray.origin, ray.direction);
    Query query = query_along(line, ray);
    for (const std::uint32_t object : unbounded_) find_nearest(object, query);
    RTCRayHit r{embree_ray(ray), {}};
    r.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(scene_, &query.base, &r);
    return query.hit;
  }
  double share_of_light(const Ray& ray) {
    const Line line(ray.origin, ray.direction);
    Query query = query_along(line, ray);
    for (const std::uint32_t object : unbounded_) {
      if (!lets_through(object, query)) return 0;
    }
    RTCRay r = embree_ray(ray);
    rtcOccluded1(scene_, &query.base, &r);
    return query.light;
  }

  Ray primary_ray(double x, double y) const {
    const Camera& c = settings_.camera;
    const auto& [width, height, samples] = settings_.image;
    const Vec3 forward = normalized(c.look_at - c.eye);
    const Vec3 sideways = normalized(cross(forward, c.up));
    const Vec3 right = c.handedness == Handedness::kRight ? sideways : -sideways;
    const Vec3 down = cross(forward, sideways);
    const bool fans = c.projection == Projection::kPerspective;
    const double pixel =
        (fans ? 2 * std::tan(c.fov_degrees * 3.14159265358979323846 / 360) : c.width) / width;
    const Vec3 across = pixel * (x - 0.5 * width) * right + pixel * (y - 0.5 * height) * down;
    if (!fans) return {c.eye + across, forward};
    return {c.eye, normalized(forward + across)};
  }

  static Ray ray_from(const Vec3& p, const Vec3& direction) {
    return {p, direction, 1e-9 * std::fmax(1, max_abs(p)), kInf};
  }

  /// `weight` is the product of coefficients so far, for min_weight alone.
  Rgb light_along(const Ray& ray, std::uint32_t depth, const Rgb& weight) {
    const Hit hit = first_hit(ray);
    if (hit.t == kInf) return settings_.background;
    const Material& m = solids_.material(hit.leaf);
    const Vec3 p = ray.origin + hit.t * ray.direction;
    const Vec3& d = ray.direction;
    Vec3 n = solids_.normal(hit.leaf, p);
    if (dot(n, d) > 0) n = -n;
    const Vec3 r = normalized(d - 2 * dot(d, n) * n);
    Rgb sum =
        (m.ambient * (1 - m.transmit)) * (m.color * settings_.ambient) + direct_light(m, p, n, r);
    if (depth == settings_.max_depth) return sum;
    const auto add = [&](const Vec3& direction, double share) {
      if (!(share > 0) || share * max_component(weight) < settings_.min_weight) return;
      ++rays_;
      sum = sum + share * light_along(ray_from(p, direction), depth + 1, share * weight);
    };
    double reflect = m.reflect;
    if (m.transmit > 0) {
      const double eta = hit.entering ? 1 / m.ior : m.ior;
      const double cosine = -dot(d, n);
      const double k = 1 - eta * eta * (1 - cosine * cosine);
      if (k < 0) {
        reflect = 1;
      } else {
        add(normalized(eta * d + (eta * cosine - std::sqrt(k)) * n), m.transmit);
      }
    }
    add(r, reflect);
    return sum;
  }

  Rgb direct_light(const Material& m, const Vec3& p, const Vec3& n, const Vec3& r) {
    Rgb sum;
    for (const PointLight& light : settings_.lights) {
      const Vec3 to_light = light.position - p;
      const double distance = length(to_light);
      const Vec3 l = (1 / distance) * to_light;
      const double cosine = dot(n, l);
      if (!(cosine > 0)) continue;
      ++rays_;
      Ray ray = ray_from(p, l);
      ray.to = distance - ray.from;
      const double fade = light.falloff == Falloff::kNone ? 1 : 1 / (distance * distance);
      const double share = fade * share_of_light(ray);
      if (!(share > 0)) continue;
      const double shine = m.specular * std::pow(std::fmax(0, dot(r, l)), m.shininess);
      const Rgb diffuse = (m.diffuse * cosine * (1 - m.transmit)) * m.color;
      sum = sum + share * (light.color * (diffuse + Rgb{shine, shine, shine}));
    }
    return sum;
  }

  Solids solids_;
  RenderSettings settings_;
  std::vector<std::uint32_t> bounded_, unbounded_;
  double reach_ = 1;
  RTCDevice device_ = nullptr;
  RTCScene scene_ = nullptr;
  Spans scratch_;
  std::uint64_t rays_ = 0;
};

void run(const bench::SceneArguments& arguments) {
  bench::CpuClock clock;
  const Scene scene = bench::load(arguments);
  const double load_s = clock.lap();
  Tracer tracer(scene);
  const double build_s = clock.lap();
  const Picture picture = tracer.render();
  const double trace_cpu_s = clock.lap();
  if (arguments.exr) write_exr(*arguments.exr, picture, {});
  std::printf(
      "{\"load_s\": %.6f, \"build_s\": %.6f, \"trace_cpu_s\": %.6f, \"rays\": %llu, "
      "\"peak_rss_bytes\": %llu}\n",
      load_s, build_s, trace_cpu_s, static_cast<unsigned long long>(tracer.rays()),
      static_cast<unsigned long long>(bench::peak_resident_bytes()));
}

}  // namespace
}  // namespace graycube::plain

int main(int argc, char** argv) {
  return graycube::bench::run_with_scene("plain_tracer", argc, argv, graycube::plain::run);
}
