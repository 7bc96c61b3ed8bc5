// The part of Evaluator that treats the surfaces that a wave meets: their own light, the secondary
// and shadow rays that they send out, and the credit of each.
#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "geometry/infinity.hpp"
#include "shading/fresnel.hpp"
#include "shading/hall_greenberg.hpp"
#include "shading/phong.hpp"
#include "shading/rt_model.hpp"
#include "shading/torrance_sparrow.hpp"
#include "trace/first_hit.hpp"
#include "trace/step.hpp"
#include "visibility/cube_texels.hpp"

namespace graycube {
namespace {

/// Crossings nearer than this to a ray's origin are ignored: the surface that it leaves.
double origin_epsilon(const Vec3& origin) { return 1e-9 * larger(1.0, max_abs(origin)); }

/// How a ray's credit 2^-e is split at a surface: a quarter to each secondary ray, the other half
/// in equal powers of two among the shadow rays and the ray's own contribution, which also takes
/// all remainders.
class CreditSplit {
 public:
  CreditSplit(int exponent, std::size_t shadow_rays, std::size_t secondary_rays)
      : exponent_(exponent), shadow_rays_(shadow_rays), secondary_rays_(secondary_rays) {
    while ((std::size_t{1} << bits_) < shadow_rays + 1) ++bits_;
  }

  std::uint8_t shadow_exponent() const { return clamped_exponent(exponent_ + 1 + bits_); }
  std::uint8_t secondary_exponent() const { return clamped_exponent(exponent_ + 2); }
  void add_own_to(Credit& sum) const {
    if (shadow_rays_ + secondary_rays_ == 0) return sum.add_power(exponent_);
    for (std::size_t i = shadow_rays_; i < (std::size_t{1} << bits_); ++i) {
      sum.add_power(shadow_exponent());
    }
    for (std::size_t i = secondary_rays_; i < 2; ++i) sum.add_power(secondary_exponent());
  }

 private:
  static std::uint8_t clamped_exponent(int exponent) {
    return static_cast<std::uint8_t>(std::min(exponent, Credit::kMaxExponent));
  }

  int exponent_;
  int bits_ = 0;
  std::size_t shadow_rays_, secondary_rays_;
};

bool is_finite(const Rgb& light) {
  return std::isfinite(light.r) && std::isfinite(light.g) && std::isfinite(light.b);
}

/// Makes `r` a ray from `origin` that inherits its parent's pixel and generation. Written
/// in place, number by number: a temporary copy would wait for its parts to reach the
/// cache.
void spawn(const RayTask& parent, RayKind kind, const RegionIndex& region, const Vec3& origin,
           const Vec3& direction, const Rgb& weight, RayTask& r) {
  r.ray.origin = origin;
  r.ray.direction = direction;
  r.t = origin_epsilon(origin);
  r.t_max = kInf;
  r.weight = weight;
  r.pixel = parent.pixel;
  r.kind = kind;
  r.depth = static_cast<std::uint16_t>(parent.depth + (kind == RayKind::kShadow ? 0 : 1));
  r.region = region;
  r.generation = parent.generation;
  r.hops = parent.hops;
}

/// Whether all numbers of a ray are finite and its direction has a length. Others bring no light:
/// extreme scenes make them, and no node accepts them.
bool is_traceable(const Vec3& origin, const Vec3& direction, const Rgb& weight) {
  return is_finite(origin) && dot(direction, direction) > 0.5 && is_finite(weight);
}

/// The share of light that is sent on where nothing goes through.
double totally_reflected(const Material& m) {
  return has_fresnel(m) ? std::max(m.reflect, m.transmit) : 1;
}

/// The surface of a solid that is seen from within: rt lights only its outside.
const Material kUnlit{.color = {0, 0, 0}, .ambient = 0, .diffuse = 0};

}  // namespace

/// `is_beyond` tells that the ray had left its macro-region before the hit.
void Evaluator::shade(OpenRay& ray, const Crossing& hit, bool is_beyond, Step& step) {
  RayTask& task = ray.task;
  const Model& model = domain_.model();
  const Primitive& solid = model.primitives[hit.primitive];
  const Material& m = model.materials[solid.material];
  if (task.kind == RayKind::kPrimary && model.settings.aovs.any()) {
    note_first_hit(domain_, task, hit, step);
  }
  if (hit.t < 0 && is_rt_model(m)) {
    contribute(ray, kRtCutGrey * task.weight, step);
    open_[ray.slot].credit.add_power(task.credit_exponent);
    return;
  }
  const Vec3& d = task.ray.direction;
  const Vec3 p = task.ray.at(hit.t);
  Vec3 n = outward_normal(solid, model.data(), task.ray, hit.t);
  if (dot(n, d) > 0) n = -n;
  const std::size_t index = surfaces_.size();
  for (std::size_t a = 0; a < 3; ++a) {
    point_[a][index] = p[static_cast<int>(a)];
    normal_[a][index] = n[static_cast<int>(a)];
  }
  SurfacePoint& at = surfaces_.emplace_back(
      SurfacePoint{&ray, &m, reflected(d, n), hit.t, is_beyond, !hit.entering});
  if (!domain_.media().empty()) cross_media(task, hit, at);
  if (task.depth < model.settings.max_depth) send_secondary_rays(at, n, step);
  if (m.model == ShadingModel::kRt && m.transmit > 0 && !hit.entering) {
    at.material = &kUnlit;
  } else if (m.pattern.kind != PatternKind::kNone) {
    patterned_[index] = m;
    patterned_[index].color = color_at(m.pattern, m.color, p);
    at.material = &patterned_[index];
  }
  contribute(ray, task.weight * ambient_light(*at.material, -dot(n, d)), step);
}

/// Finds the media on both sides of a surface, and dims what the ray brings by that through which
/// it came. Only a primary ray doesn't know where it is: if it meets a solid from within, there.
void Evaluator::cross_media(RayTask& task, const Crossing& hit, SurfacePoint& at) const {
  const Media& media = domain_.media();
  const Medium of_solid = media.of(domain_.model().primitives[hit.primitive].material);
  const bool starts_within = task.kind == RayKind::kPrimary && at.is_within && hit.t > 0;
  at.before = starts_within ? of_solid : task.light_or_medium;
  at.behind = at.is_within ? Medium{0} : of_solid;
  if (at.before != 0) task.weight = task.weight * media.left_after(at.before, hit.t);
}

/// What a ray brings that meets nothing: through a medium without end no light comes.
Rgb Evaluator::background(const RayTask& task) const {
  const Rgb light = task.weight * domain_.settings().background;
  return task.light_or_medium == 0 ? light
                                   : light * domain_.media().left_after(task.light_or_medium, kInf);
}

/// What the surface sends out of the scene's ambient light; `cosine` is that of the viewing angle.
Rgb Evaluator::ambient_light(const Material& m, double cosine) const {
  const Rgb& ambient = domain_.settings().ambient;
  if (is_rt_model(m)) return rt_ambient(m, cosine) * ambient;
  return (m.ambient * (1 - m.transmit)) * (m.color * ambient);
}

/// The region of the surface: its ray need not have been traced through the regions between.
RegionIndex Evaluator::region_of(const SurfacePoint& at) const {
  return at.is_beyond ? domain_.region_at(at.ray->task, at.t) : at.ray->task.region;
}

/// Sends a ray from the newest surface, unless it would bring too little.
void Evaluator::send_secondary_ray(SurfacePoint& at, RayKind kind, const Vec3& direction,
                                   const Rgb& weight, Step& step) {
  if (!(max_component(weight) > 0)) return;
  if (max_component(weight) < domain_.settings().min_weight) return;
  const std::size_t surface = surfaces_.size() - 1;
  const Vec3 p{point_[0][surface], point_[1][surface], point_[2][surface]};
  const Vec3 unit = normalized(direction);
  if (!is_traceable(p, unit, weight)) {
    ++step.rounding.non_finite;
    return;
  }
  ++step.rays.created[static_cast<std::size_t>(kind)];
  ++at.secondary_rays;
  OpenRay& sent = secondary_[kind == RayKind::kRefraction ? 0 : 1].emplace_back();
  spawn(at.ray->task, kind, region_of(at), p, unit, weight, sent.task);
  sent.task.light_or_medium = (kind == RayKind::kReflection ? at.before : at.behind) & kLightMask;
  sent.slot = at.ray->slot;
  sent.surface = static_cast<std::uint32_t>(surface);
}

void Evaluator::send_secondary_rays(SurfacePoint& at, const Vec3& n, Step& step) {
  const Material& m = *at.material;
  const bool entering = !at.is_within;
  const RayTask& task = at.ray->task;
  if (m.model == ShadingModel::kRtLamp) return;
  const auto send = [&](RayKind kind, const Vec3& direction, double coefficient,
                        const Rgb& tint = {1, 1, 1}) {
    send_secondary_ray(at, kind, direction, coefficient * task.weight * tint, step);
  };
  const bool is_rt = m.model == ShadingModel::kRt;
  Rgb mirrored{1, 1, 1}, passing{1, 1, 1};
  if (has_fresnel(m)) {
    mirrored = fresnel(m, -dot(n, task.ray.direction), at.is_within);
    passing = {1 - mirrored.r, 1 - mirrored.g, 1 - mirrored.b};
  }
  if (m.transmit > 0) {
    const auto through = refracted(task.ray.direction, n, entering ? 1 / m.ior : m.ior);
    // rt takes glass as one thing: it colours and splits light where this enters, and mirrors
    // nothing from within but what can't leave.
    if (is_rt && through && !entering) return send(RayKind::kRefraction, *through, 1);
    if (is_rt && through) send(RayKind::kRefraction, *through, m.transmit, m.color);
    if (!through) return send(RayKind::kReflection, at.mirror, totally_reflected(m));
    if (!is_rt) send(RayKind::kRefraction, *through, m.transmit, passing);
  }
  if (m.reflect > 0) send(RayKind::kReflection, at.mirror, m.reflect, mirrored);
}

/// Sends a shadow ray to a light from every surface of the wave that faces it, or that shows lights
/// behind it, within its beam. The first loop is written to be vectorized: its expressions are
/// those of length(), scaling and dot().
void Evaluator::send_light_rays(std::uint32_t light, Step& step) {
  const Vec3 at = domain_.settings().lights[light].position;
  const std::size_t count = surfaces_.size();
  for (std::size_t i = 0; i < count; ++i) {
    const double x = at.x - point_[0][i];
    const double y = at.y - point_[1][i];
    const double z = at.z - point_[2][i];
    const double distance = std::sqrt(x * x + y * y + z * z);
    const double inverse = 1 / distance;
    to_light_[0][i] = inverse * x;
    to_light_[1][i] = inverse * y;
    to_light_[2][i] = inverse * z;
    distance_[i] = distance;
    cosine_[i] = normal_[0][i] * to_light_[0][i] + normal_[1][i] * to_light_[1][i] +
                 normal_[2][i] * to_light_[2][i];
  }
  look_up_horizons(light);
  const LightBeam& beam = beams_[light];
  for (std::size_t i = 0; i < count; ++i) {
    if (!beam.reaches({to_light_[0][i], to_light_[1][i], to_light_[2][i]})) continue;
    // A light that lies in the surface's plane to within rounding lights nothing: else highlights
    // would come and go at random.
    const double above = cosine_[i] * distance_[i];
    const bool is_behind = above < 0 && has_light_from_behind(*surfaces_[i].material);
    if (!(above > 0) && !is_behind) continue;
    if (std::fabs(above) > origin_epsilon({point_[0][i], point_[1][i], point_[2][i]}))
      send_light_ray(light, i, step);
  }
}

/// Looks up all surfaces at once, since most of the time goes into waiting for memory.
void Evaluator::look_up_horizons(std::uint32_t light) {
  const bool has_foreign = domain_.has_foreign_horizons();
  if (!domain_.has_horizons() && !has_foreign) return;
  std::array<std::uint32_t, kWaveRays> texels;
  static_assert(kWaveRays % kTexelLanes == 0);
  find_opposite_texels(to_light_[0], to_light_[1], to_light_[2], surfaces_.size(),
                       LightHorizons::kSide, texels);
  const auto used = std::span(texels).first(surfaces_.size());
  if (domain_.has_horizons()) domain_.horizons().distances_at(light, used, lit_);
  if (has_foreign) domain_.foreign_horizons().distances_at(light, used, all_held_);
}

SurfaceView Evaluator::view_of(const SurfacePoint& at, std::size_t surface) const {
  return {{normal_[0][surface], normal_[1][surface], normal_[2][surface]},
          -at.ray->task.ray.direction,
          at.is_within};
}

/// What of unit white light from unit direction l a surface of the wave sends back along its ray.
Rgb Evaluator::light_share(std::size_t surface, const Vec3& l) const {
  const SurfacePoint& at = surfaces_[surface];
  const Material& m = *at.material;
  const double n_dot_l = cosine_[surface];
  switch (m.model) {
    case ShadingModel::kPhong: return phong(m, n_dot_l, at.mirror, l);
    case ShadingModel::kTorranceSparrow:
      return torrance_sparrow(m, view_of(at, surface), n_dot_l, l);
    case ShadingModel::kHallGreenberg:
      return n_dot_l > 0 ? hall_greenberg(m, view_of(at, surface), n_dot_l, l)
                         : hall_greenberg_from_behind(m, view_of(at, surface), l);
    case ShadingModel::kRt:
    case ShadingModel::kRtLamp: return rt_reflected(m, n_dot_l, at.mirror, l);
  }
  return {0, 0, 0};
}

void Evaluator::send_light_ray(std::uint32_t light, std::size_t surface, Step& step) {
  const PointLight& source = domain_.settings().lights[light];
  SurfacePoint& at = surfaces_[surface];
  const RayTask& task = at.ray->task;
  const double distance = distance_[surface];
  const Vec3 l{to_light_[0][surface], to_light_[1][surface], to_light_[2][surface]};
  ++step.rays.created[static_cast<std::size_t>(RayKind::kShadow)];
  Rgb intensity = source.color;
  if (source.falloff == Falloff::kInverseSquare)
    intensity = (1 / (distance * distance)) * intensity;
  const Rgb weight = task.weight * (intensity * light_share(surface, l));
  if (!(max_component(weight) > 0)) return;
  if (!is_finite(weight)) [[unlikely]] {
    ++step.rounding.non_finite;
    return;
  }
  if (!source.shadows) {
    --step.rays.created[static_cast<std::size_t>(RayKind::kShadow)];
    return contribute(*at.ray, weight, step);
  }
  const Vec3 p{point_[0][surface], point_[1][surface], point_[2][surface]};
  ShadowWay way{origin_epsilon(p), distance - origin_epsilon(p)};
  if (domain_.has_horizons()) {
    LightHorizons::Reach reach{lit_[surface]};
    if (domain_.horizons().has_depths(light)) reach = domain_.horizons().toward(light, -l);
    const Horizon at_horizon = meet_horizon(reach, way);
    if (at_horizon != Horizon::kGoesOn) {
      ++step.rays.skipped_by_horizon;
      if (at_horizon == Horizon::kArrives) contribute(*at.ray, weight, step);
      return;
    }
  }
  OpenRay& sent = shadow_[light].emplace_back();
  sent.stays = domain_.has_foreign_horizons() && Domain::is_beyond(p, distance, all_held_[surface]);
  spawn(task, RayKind::kShadow, sent.stays ? task.region : region_of(at), p, l, weight, sent.task);
  sent.slot = at.ray->slot;
  sent.surface = static_cast<std::uint32_t>(surface);
  sent.task.t_max = way.t_max;
  sent.task.light_or_medium = static_cast<std::uint16_t>(light & kLightMask);
  sent.task.ends_at_horizon = way.ends_at_horizon;
  ++at.lights;
}

/// Shortens a shadow ray's way to the point where it reaches its light's horizon. A ray that begins
/// past that point arrives, and one that begins where no light comes ends in shadow.
Evaluator::Horizon Evaluator::meet_horizon(const LightHorizons::Reach& reach, ShadowWay& way) {
  // Crossings count up to a little before the light; its distance is no more than `farthest`.
  const double epsilon = way.t;
  const double farthest = way.t_max + 4 * epsilon;
  if (way.t_max - 2 * epsilon > reach.dark && 2 * epsilon < reach.clearance)
    return Horizon::kEndsInShadow;
  const double end = farthest - reach.lit;
  if (!(end < way.t_max)) return Horizon::kGoesOn;
  way.t_max = end;
  way.ends_at_horizon = true;
  return end > way.t ? Horizon::kGoesOn : Horizon::kArrives;
}

/// Splits each ray's credit among the rays that its surface sends out and the surface itself.
void Evaluator::share_credit() {
  const auto split = [](const SurfacePoint& at) {
    return CreditSplit(at.ray->task.credit_exponent, at.lights, at.secondary_rays);
  };
  for (const SurfacePoint& at : surfaces_) split(at).add_own_to(open_[at.ray->slot].credit);
  for (std::vector<OpenRay>& sent : shadow_) {
    for (OpenRay& ray : sent) {
      ray.task.credit_exponent = split(surfaces_[ray.surface]).shadow_exponent();
    }
  }
  for (std::vector<OpenRay>& sent : secondary_) {
    for (OpenRay& ray : sent) {
      ray.task.credit_exponent = split(surfaces_[ray.surface]).secondary_exponent();
    }
  }
  surfaces_.clear();
}

}  // namespace graycube
