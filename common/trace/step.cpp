#include "trace/step.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "shading/phong.hpp"
#include "trace/entry_hit.hpp"
#include "trace/first_hit.hpp"

namespace graycube {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();

/// Crossings nearer than this to a ray's origin are ignored: the surface that it leaves.
double origin_epsilon(const Vec3& origin) { return 1e-9 * std::fmax(1.0, max_abs(origin)); }

int clamped_exponent(int exponent) { return std::min(exponent, Credit::kMaxExponent); }

Credit whole_credit(const RayTask& task) {
  Credit c;
  c.add_power(task.credit_exponent);
  return c;
}

/// How a ray's credit 2^-e is split at a surface: a quarter to each secondary ray, the other half in equal
/// powers of two among the shadow rays and the ray's own contribution, which also takes all remainders.
class CreditSplit {
 public:
  CreditSplit(int exponent, std::size_t shadow_rays, std::size_t secondary_rays)
      : exponent_(exponent) {
    if (shadow_rays + secondary_rays == 0) {
      own_.add_power(exponent);
      return;
    }
    while ((std::size_t{1} << bits_) < shadow_rays + 1) ++bits_;
    for (std::size_t i = shadow_rays; i < (std::size_t{1} << bits_); ++i) {
      own_.add_power(shadow_exponent());
    }
    for (std::size_t i = secondary_rays; i < 2; ++i) own_.add_power(secondary_exponent());
  }

  int shadow_exponent() const { return clamped_exponent(exponent_ + 1 + bits_); }
  int secondary_exponent() const { return clamped_exponent(exponent_ + 2); }
  const Credit& own() const { return own_; }

 private:
  int exponent_;
  int bits_ = 0;
  Credit own_;
};

/// A ray from `origin` that inherits pixel and generation.
RayTask spawn(const RayTask& parent, RayKind kind, const Vec3& origin, const Vec3& direction,
              const Rgb& weight) {
  RayTask r;
  r.ray = {origin, direction};
  r.t = origin_epsilon(origin);
  r.t_max = kInf;
  r.weight = weight;
  r.pixel = parent.pixel;
  r.kind = kind;
  r.depth = static_cast<std::uint16_t>(parent.depth + (kind == RayKind::kShadow ? 0 : 1));
  r.region = parent.region;
  return r;
}

}  // namespace

void Step::clear() {
  leaving.clear();
  returns.clear();
  rays = {};
  rounding = {};
}

void Evaluator::trace_pixels(const PixelRect& rect, Step& step) {
  const ImageSize& image = domain_.settings().image;
  for (std::uint32_t y = rect.y0; y < rect.y1; ++y) {
    for (std::uint32_t x = rect.x0; x < rect.x1; ++x) {
      RayTask task;
      task.pixel = y * image.width + x;
      task.t_max = kInf;
      task.weight = {1, 1, 1};
      task.region = domain_.region_of_pixel(x, y);
      for (std::uint32_t s = 0; s < image.samples * image.samples; ++s) {
        task.ray = domain_.frame().primary_ray(x, y, s % image.samples, s / image.samples);
        ++step.rays.created[static_cast<std::size_t>(RayKind::kPrimary)];
        trace_tree(task, step);
      }
    }
  }
}

void Evaluator::trace_rays(std::span<const RayTask> rays, Step& step) {
  for (const RayTask& task : rays) trace_tree(task, step);
}

void Evaluator::trace_tree(const RayTask& root, Step& step) {
  stack_.push_back(root);
  while (!stack_.empty()) {
    RayTask task = stack_.back();
    stack_.pop_back();
    if (task.kind == RayKind::kShadow) {
      trace_light_ray(task, step);
    } else {
      trace_viewing_ray(task, step);
    }
  }
}

void Evaluator::trace_light_ray(RayTask& task, Step& step) {
  while (domain_.holds(task.region)) {
    const auto exit = domain_.exit(task.region, task.ray, task.t);
    const bool arrives = !exit || exit->t >= task.t_max;
    const double end = arrives ? task.t_max : exit->t;
    if (!domain_.pass_light(task.ray, task.t, end, scratch_, task.weight)) {
      give_back(task.pixel, whole_credit(task), step);
      return;
    }
    if (arrives) {
      contribute(task, task.weight, whole_credit(task), step);
      return;
    }
    task.t = end;
    task.region = exit->next;
  }
  step.leaving.push_back(task);
}

void Evaluator::trace_viewing_ray(RayTask& task, Step& step) {
  if (task.kind == RayKind::kPrimary) {
    if (const auto hit = entry_behind(domain_, task, scratch_)) {
      if (domain_.settings().aovs.any()) note_first_hit(domain_, task, *hit, step);
      return shade(task, hit->t, hit->primitive, hit->entering, step);
    }
  }
  while (domain_.holds(task.region)) {
    const auto exit = domain_.exit(task.region, task.ray, task.t);
    const auto hit = domain_.first_crossing(task.ray, task.t, exit ? exit->t : kInf, scratch_);
    if (hit) {
      if (task.kind == RayKind::kPrimary && domain_.settings().aovs.any()) {
        note_first_hit(domain_, task, *hit, step);
      }
      shade(task, hit->t, hit->primitive, hit->entering, step);
      return;
    }
    if (!exit) {
      contribute(task, task.weight * domain_.settings().background, whole_credit(task), step);
      return;
    }
    task.t = exit->t;
    task.region = exit->next;
  }
  step.leaving.push_back(task);
}

void Evaluator::shade(const RayTask& task, double t, std::uint32_t primitive, bool entering,
                      Step& step) {
  const Model& model = domain_.model();
  const RenderSettings& settings = model.settings;
  const Primitive& solid = model.primitives[primitive];
  const Material& m = model.materials[solid.material];
  const Vec3 p = task.ray.at(t);
  const Vec3& d = task.ray.direction;
  Vec3 n = outward_normal(solid, model.planes, task.ray, t);
  if (dot(n, d) > 0) n = -n;
  const Vec3 r = reflected(d, n);

  const std::size_t first = stack_.size();
  // Secondary rays first on the stack, so that shadow rays are done first: the stack stays short.
  std::size_t secondary = 0;
  const auto send_secondary = [&](RayKind kind, const Vec3& direction, double coefficient) {
    const Rgb weight = coefficient * task.weight;
    if (!(max_component(weight) > 0) || max_component(weight) < settings.min_weight) return;
    ++step.rays.created[static_cast<std::size_t>(kind)];
    ++secondary;
    stack_.push_back(spawn(task, kind, p, normalized(direction), weight));
  };
  if (task.depth < settings.max_depth) {
    const auto through =
        m.transmit > 0 ? refracted(d, n, entering ? 1 / m.ior : m.ior) : std::nullopt;
    if (m.transmit > 0 && !through) {
      send_secondary(RayKind::kReflection, r, 1);
    } else {
      if (through) send_secondary(RayKind::kRefraction, *through, m.transmit);
      if (m.reflect > 0) send_secondary(RayKind::kReflection, r, m.reflect);
    }
  }
  std::size_t shadow = 0;
  for (const PointLight& light : settings.lights) {
    const Vec3 to_light = light.position - p;
    const double distance = length(to_light);
    const Vec3 l = (1 / distance) * to_light;
    const double n_dot_l = dot(n, l);
    if (!(n_dot_l > 0)) continue;
    ++step.rays.created[static_cast<std::size_t>(RayKind::kShadow)];
    Rgb intensity = light.color;
    if (light.falloff == Falloff::kInverseSquare) intensity = (1 / (distance * distance)) * intensity;
    const Rgb weight = task.weight * (intensity * phong(m, n_dot_l, r, l));
    if (!(max_component(weight) > 0)) continue;
    RayTask ray = spawn(task, RayKind::kShadow, p, l, weight);
    ray.t_max = distance - ray.t;
    ++shadow;
    stack_.push_back(ray);
  }
  const CreditSplit split(task.credit_exponent, shadow, secondary);
  for (std::size_t i = first; i < stack_.size(); ++i) {
    const bool is_shadow = stack_[i].kind == RayKind::kShadow;
    stack_[i].credit_exponent =
        static_cast<std::uint8_t>(is_shadow ? split.shadow_exponent() : split.secondary_exponent());
  }
  const Rgb ambient = (m.ambient * (1 - m.transmit)) * (m.color * settings.ambient);
  contribute(task, task.weight * ambient, split.own(), step);
}

void Evaluator::contribute(const RayTask& task, const Rgb& light, const Credit& credit, Step& step) {
  give_back(task.pixel, credit, step);
  PixelReturn& r = step.returns.back();
  r.light.add(to_fixed(light, step.rounding));
  ++r.merged;
}

void Evaluator::give_back(std::uint32_t pixel, const Credit& credit, Step& step) {
  if (step.returns.empty() || step.returns.back().pixel != pixel ||
      step.returns.back().merged == kMaxMergedContributions) {
    step.returns.push_back({pixel, 0, {}, {}});
  }
  step.returns.back().credit.add(credit);
}

}  // namespace graycube
