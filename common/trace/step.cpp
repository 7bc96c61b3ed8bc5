#include "trace/step.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "shading/phong.hpp"
#include "trace/entry_hit.hpp"
#include "trace/first_hit.hpp"

namespace graycube {
namespace {

/// Pixels whose primary rays make a packet.
constexpr std::uint32_t kPacketSide = 4;
static_assert(kPacketSide * kPacketSide == RayPacket::kSize);
/// Pixels that are traced together, so that what they send out fills packets.
constexpr std::uint32_t kBlockSide = 8;
constexpr std::size_t kOpenPixels = kBlockSide * kBlockSide;

constexpr double kInf = std::numeric_limits<double>::infinity();

/// Crossings nearer than this to a ray's origin are ignored: the surface that it leaves.
double origin_epsilon(const Vec3& origin) { return 1e-9 * larger(1.0, max_abs(origin)); }

/// How a ray's credit 2^-e is split at a surface: a quarter to each secondary ray, the other half in equal
/// powers of two among the shadow rays and the ray's own contribution, which also takes all remainders.
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

Evaluator::Evaluator(const Domain& domain)
    : domain_(domain), shadow_(domain.settings().lights.size()) {}

void Step::clear() {
  leaving.clear();
  returns.clear();
  rays = {};
  rounding = {};
}

void Evaluator::trace_pixels(const PixelRect& rect, Step& step) {
  for (std::uint32_t y = rect.y0; y < rect.y1; y += kBlockSide) {
    for (std::uint32_t x = rect.x0; x < rect.x1; x += kBlockSide) {
      trace_block({x, y, std::min(x + kBlockSide, rect.x1), std::min(y + kBlockSide, rect.y1)}, step);
    }
  }
}

void Evaluator::trace_block(const PixelRect& block, Step& step) {
  const ImageSize& image = domain_.settings().image;
  for (std::uint32_t s = 0; s < image.samples * image.samples; ++s) {
    for (std::uint32_t y = block.y0; y < block.y1; y += kPacketSide) {
      for (std::uint32_t x = block.x0; x < block.x1; x += kPacketSide) {
        start_primary_rays({x, y, std::min(x + kPacketSide, block.x1),
                            std::min(y + kPacketSide, block.y1)}, s, step);
      }
    }
    trace_all(step);
  }
  close_pixels(step);
}

/// Sample number s of each pixel. The pixels of a block are opened by the first, in the order of all others.
void Evaluator::start_primary_rays(const PixelRect& pixels, std::uint32_t s, Step& step) {
  const ImageSize& image = domain_.settings().image;
  for (std::uint32_t y = pixels.y0; y < pixels.y1; ++y) {
    for (std::uint32_t x = pixels.x0; x < pixels.x1; ++x) {
      const auto slot = static_cast<std::uint32_t>(viewing_.size());
      OpenRay& ray = viewing_.emplace_back();
      ray.task.ray = domain_.frame().primary_ray(x, y, s % image.samples, s / image.samples);
      ray.task.pixel = y * image.width + x;
      ray.task.t_max = kInf;
      ray.task.weight = {1, 1, 1};
      ray.task.region = domain_.region_of_pixel(x, y);
      ray.slot = slot;
      if (s == 0) open_pixel(ray.task.pixel);
      ++step.rays.created[static_cast<std::size_t>(RayKind::kPrimary)];
    }
  }
}

void Evaluator::trace_rays(std::span<const RayTask> rays, Step& step) {
  while (!rays.empty()) {
    for (const RayTask& task : rays.first(std::min(rays.size(), kOpenPixels))) {
      auto& stack = task.kind == RayKind::kShadow ? lights_ : viewing_;
      stack.push_back({task, static_cast<std::uint32_t>(open_.size())});
      open_pixel(task.pixel);
    }
    rays = rays.subspan(open_.size());
    trace_all(step);
    close_pixels(step);
  }
}

/// Shadow rays first, then the youngest: the stacks stay short.
void Evaluator::trace_all(Step& step) {
  while (!lights_.empty() || !viewing_.empty()) {
    if (!lights_.empty()) {
      take_wave(lights_);
      in_packets(wave_, [&](std::span<const OpenRay> rays) { trace_light_rays(rays, step); });
    } else {
      take_wave(viewing_);
      in_packets(wave_, [&](std::span<const OpenRay> rays) { trace_viewing_rays(rays, step); });
      trace_sent_rays(step);
    }
  }
}

template <typename Trace>
void Evaluator::in_packets(std::span<const OpenRay> rays, Trace&& trace) {
  while (!rays.empty()) {
    const std::size_t count = std::min(rays.size(), RayPacket::kSize);
    trace(rays.first(count));
    rays = rays.subspan(count);
  }
}

/// Takes rays of one kind, generation and region from the top of a stack, kOpenPixels at most.
void Evaluator::take_wave(std::vector<OpenRay>& stack) {
  const RayTask& top = stack.back().task;
  std::size_t first = stack.size() - 1;
  while (first > 0 && stack.size() - first < kOpenPixels) {
    const RayTask& next = stack[first - 1].task;
    if (next.kind != top.kind || next.depth != top.depth || next.region != top.region) break;
    --first;
  }
  wave_.assign(stack.begin() + static_cast<std::ptrdiff_t>(first), stack.end());
  stack.resize(first);
}

/// What the surfaces of a wave sent out: shadow rays at once, light by light; secondary rays on the stack.
void Evaluator::trace_sent_rays(Step& step) {
  for (std::vector<OpenRay>& sent : secondary_) {
    viewing_.insert(viewing_.end(), sent.begin(), sent.end());
    sent.clear();
  }
  for (std::vector<OpenRay>& sent : shadow_) {
    in_packets(sent, [&](std::span<const OpenRay> rays) { trace_light_rays(rays, step); });
    sent.clear();
  }
}

/// A ray that reached its region's boundary.
void Evaluator::go_on(const OpenRay& ray, const RegionExit& exit, std::vector<OpenRay>& stack,
                      Step& step) {
  OpenRay next = ray;
  next.task.t = exit.t;
  next.task.region = exit.next;
  if (domain_.holds(exit.next)) {
    stack.push_back(next);
  } else {
    step.leaving.push_back(next.task);
  }
}

/// `rays` are in one region, a packet at most.
void Evaluator::trace_light_rays(std::span<const OpenRay> rays, Step& step) {
  RayPacket packet;
  std::array<std::optional<RegionExit>, RayPacket::kSize> exits;
  std::array<Rgb, RayPacket::kSize> light;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const RayTask& task = rays[i].task;
    exits[i] = domain_.exit(task.region, task.ray, task.t);
    if (exits[i] && exits[i]->t >= task.t_max) exits[i].reset();
    light[i] = task.weight;
    packet.add(task.ray, task.t, exits[i] ? exits[i]->t : task.t_max);
  }
  const RayPacket::Mask passing = domain_.pass_lights(packet, scratch_, light);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    if ((passing >> i & 1) != 0 && exits[i]) {
      OpenRay dimmed = rays[i];
      dimmed.task.weight = light[i];
      go_on(dimmed, *exits[i], lights_, step);
      continue;
    }
    if ((passing >> i & 1) != 0) contribute(rays[i], light[i], step);
    open_[rays[i].slot].credit.add_power(rays[i].task.credit_exponent);
  }
}

/// `rays` are in one region, a packet at most.
void Evaluator::trace_viewing_rays(std::span<const OpenRay> rays, Step& step) {
  RayPacket packet;
  std::array<std::optional<RegionExit>, RayPacket::kSize> exits;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const RayTask& task = rays[i].task;
    exits[i] = domain_.exit(task.region, task.ray, task.t);
    packet.add(task.ray, task.t, exits[i] ? exits[i]->t : kInf);
  }
  std::array<Crossing, RayPacket::kSize> found;
  const RayPacket::Mask hits = domain_.first_crossings(packet, scratch_, found);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    if (const auto entry = entry_behind(domain_, rays[i].task, scratch_)) {
      shade(rays[i], *entry, step);
    } else if ((hits >> i & 1) != 0) {
      shade(rays[i], found[i], step);
    } else if (exits[i]) {
      go_on(rays[i], *exits[i], viewing_, step);
    } else {
      contribute(rays[i], rays[i].task.weight * domain_.settings().background, step);
      open_[rays[i].slot].credit.add_power(rays[i].task.credit_exponent);
    }
  }
}

void Evaluator::shade(const OpenRay& ray, const Crossing& hit, Step& step) {
  const Model& model = domain_.model();
  const Primitive& solid = model.primitives[hit.primitive];
  const Material& m = model.materials[solid.material];
  const RayTask& task = ray.task;
  if (task.kind == RayKind::kPrimary && model.settings.aovs.any()) {
    note_first_hit(domain_, task, hit, step);
  }
  const Vec3& d = task.ray.direction;
  Vec3 n = outward_normal(solid, model.planes, task.ray, hit.t);
  if (dot(n, d) > 0) n = -n;
  const SurfacePoint at{m, task.ray.at(hit.t), n, reflected(d, n), hit.entering};
  if (task.depth < model.settings.max_depth) send_secondary_rays(ray, at, step);
  send_light_rays(ray, at, step);
  share_credit(ray);
  const Rgb ambient = (m.ambient * (1 - m.transmit)) * (m.color * model.settings.ambient);
  contribute(ray, task.weight * ambient, step);
}

void Evaluator::send_secondary_rays(const OpenRay& ray, const SurfacePoint& at, Step& step) {
  const Material& m = at.material;
  const auto send = [&](RayKind kind, const Vec3& direction, double coefficient) {
    const Rgb weight = coefficient * ray.task.weight;
    if (!(max_component(weight) > 0)) return;
    if (max_component(weight) < domain_.settings().min_weight) return;
    ++step.rays.created[static_cast<std::size_t>(kind)];
    const std::uint32_t which = kind == RayKind::kRefraction ? 0 : 1;
    sends_.push_back(which);
    secondary_[which].push_back(
        {spawn(ray.task, kind, at.p, normalized(direction), weight), ray.slot});
  };
  if (m.transmit > 0) {
    const auto through =
        refracted(ray.task.ray.direction, at.n, at.entering ? 1 / m.ior : m.ior);
    if (!through) return send(RayKind::kReflection, at.mirror, 1);
    send(RayKind::kRefraction, *through, m.transmit);
  }
  if (m.reflect > 0) send(RayKind::kReflection, at.mirror, m.reflect);
}

void Evaluator::send_light_rays(const OpenRay& ray, const SurfacePoint& at, Step& step) {
  const auto& lights = domain_.settings().lights;
  for (std::uint32_t i = 0; i < lights.size(); ++i) {
    const PointLight& light = lights[i];
    const Vec3 to_light = light.position - at.p;
    const double distance = length(to_light);
    const Vec3 l = (1 / distance) * to_light;
    const double n_dot_l = dot(at.n, l);
    if (!(n_dot_l > 0)) continue;
    ++step.rays.created[static_cast<std::size_t>(RayKind::kShadow)];
    Rgb intensity = light.color;
    if (light.falloff == Falloff::kInverseSquare) intensity = (1 / (distance * distance)) * intensity;
    const Rgb weight = ray.task.weight * (intensity * phong(at.material, n_dot_l, at.mirror, l));
    if (!(max_component(weight) > 0)) continue;
    OpenRay& sent = shadow_[i].emplace_back();
    sent.task = spawn(ray.task, RayKind::kShadow, at.p, l, weight);
    sent.task.t_max = distance - sent.task.t;
    sent.slot = ray.slot;
    lit_by_.push_back(i);
  }
}

/// Among the rays that were just sent, and the surface's own contribution.
void Evaluator::share_credit(const OpenRay& ray) {
  const CreditSplit split(ray.task.credit_exponent, lit_by_.size(), sends_.size());
  for (const std::uint32_t i : lit_by_) {
    shadow_[i].back().task.credit_exponent = split.shadow_exponent();
  }
  for (const std::uint32_t i : sends_) {
    secondary_[i].back().task.credit_exponent = split.secondary_exponent();
  }
  split.add_own_to(open_[ray.slot].credit);
  lit_by_.clear();
  sends_.clear();
}

void Evaluator::open_pixel(std::uint32_t pixel) { open_.push_back({pixel, 0, {}, {}}); }

void Evaluator::contribute(const OpenRay& ray, const Rgb& light, Step& step) {
  PixelReturn& sum = open_[ray.slot];
  sum.light.add(to_fixed(light, step.rounding));
  if (++sum.merged == kMaxMergedContributions) {
    step.returns.push_back(sum);
    sum = {sum.pixel, 0, {}, {}};
  }
}

void Evaluator::close_pixels(Step& step) {
  step.returns.insert(step.returns.end(), open_.begin(), open_.end());
  open_.clear();
}

}  // namespace graycube
