#include "trace/step.hpp"

#include <algorithm>
#include <new>

#include "geometry/infinity.hpp"
#include "set_bits.hpp"
#include "stop_point.hpp"
#include "trace/entry_hit.hpp"
#include "trace/ray_selection.hpp"

namespace graycube {
namespace {

/// Side of the square of pixels whose primary rays make a packet.
constexpr std::uint32_t kPacketSide = 4;
static_assert(kPacketSide * kPacketSide == RayPacket::kSize);

/// Whether two rays may be traced in one wave.
bool are_alike(const RayTask& a, const RayTask& b) {
  return a.kind == b.kind && a.depth == b.depth;
}

}  // namespace

Evaluator::Evaluator(const Domain& domain)
    : domain_(domain),
      beams_(domain.settings().lights.begin(), domain.settings().lights.end()),
      shadow_(domain.settings().lights.size()) {}

void Step::clear() {
  leaving.clear();
  lacking.clear();
  set_aside.clear();
  returns.clear();
  rays = {};
  rounding = {};
}

void Evaluator::trace_pixels(const PixelRect& rect, Step& step) {
  for (std::uint32_t y = rect.y0; y < rect.y1; y += kBlockSide) {
    for (std::uint32_t x = rect.x0; x < rect.x1; x += kBlockSide) {
      trace_block({x, y, std::min(x + kBlockSide, rect.x1), std::min(y + kBlockSide, rect.y1)},
                  step);
      if (domain_.grid() == nullptr) finish_pixels(step);
    }
  }
  finish_pixels(step);
}

void Evaluator::finish_pixels(Step& step) {
  trace_all(step);
  close_pixels(step);
}

/// Traces a block's primary rays. The rays that they send out may be left on the stacks.
void Evaluator::trace_block(const PixelRect& block, Step& step) {
  const ImageSize& image = domain_.settings().image;
  const auto first_slot = static_cast<std::uint32_t>(open_.size());
  for (std::uint32_t s = 0; s < image.samples * image.samples; ++s) {
    std::uint32_t slot = first_slot;
    for (std::uint32_t y = block.y0; y < block.y1; y += kPacketSide) {
      for (std::uint32_t x = block.x0; x < block.x1; x += kPacketSide) {
        start_primary_rays(
            {x, y, std::min(x + kPacketSide, block.x1), std::min(y + kPacketSide, block.y1)}, s,
            slot, step);
      }
    }
    // When rays leave for other nodes, too few of a block's rays stay to fill packets: rays of
    // several blocks are gathered.
    if (domain_.grid() != nullptr && s == 0) {
      take_wave(viewing_);
      trace_wave(step);
    } else {
      trace_all(step);
    }
  }
}

/// Starts the ray of sample number s of each pixel. Sample 0 opens the pixels; all samples visit
/// them in the same order.
void Evaluator::start_primary_rays(const PixelRect& pixels, std::uint32_t s, std::uint32_t& slot,
                                   Step& step) {
  const ImageSize& image = domain_.settings().image;
  const std::uint32_t sx = s % image.samples, sy = s / image.samples;
  const RegionIndex first = domain_.region_of_pixel(pixels.x0, pixels.y0);
  const bool is_one_region = first == domain_.region_of_pixel(pixels.x1 - 1, pixels.y1 - 1);
  for (std::uint32_t y = pixels.y0; y < pixels.y1; ++y) {
    for (std::uint32_t x = pixels.x0; x < pixels.x1; ++x) {
      OpenRay& ray = viewing_.emplace_back();
      // Written in place, for the reason given at spawn().
      new (&ray.task.ray) Ray(domain_.frame().primary_ray(x, y, sx, sy));
      ray.task.pixel = y * image.width + x;
      ray.task.generation = domain_.generation() & 1;
      ray.task.t_max = kInf;
      ray.task.weight = {1, 1, 1};
      ray.task.region = is_one_region ? first : domain_.region_of_pixel(x, y);
      if (s == 0) open_pixel(ray.task.pixel);
      ray.slot = slot++;
      ++step.rays.created[static_cast<std::size_t>(RayKind::kPrimary)];
    }
  }
}

void Evaluator::trace_rays(std::span<const RayTask> rays, Step& step) {
  step.leaving.reserve(step.leaving.size() + rays.size());
  step.returns.reserve(step.returns.size() + rays.size());
  while (!rays.empty()) {
    stop_if_asked();
    if (has_enough(step)) {
      step.set_aside.insert(step.set_aside.end(), rays.begin(), rays.end());
      return;
    }
    wave_.clear();
    const bool are_held = domain_.holds(rays.front().region);
    for (const RayTask& task : rays.first(std::min(rays.size(), kWaveRays))) {
      if (!are_alike(task, rays.front()) || domain_.holds(task.region) != are_held) break;
      OpenRay& ray = wave_.emplace_back();
      ray.task = task;
      ray.slot = static_cast<std::uint32_t>(open_.size());
      open_pixel(task.pixel);
    }
    rays = rays.subspan(wave_.size());
    if (are_held || !domain_.borrows()) {
      trace_wave(step);
      trace_all(step);
    } else {
      for (const OpenRay& ray : wave_) finish_light_ray(ray, step);
    }
    close_pixels(step);
  }
}

/// Traces shadow rays first, then the youngest rays: so the stacks stay short.
void Evaluator::trace_all(Step& step) {
  while (!lights_.empty() || !viewing_.empty()) {
    stop_if_asked();
    if (has_enough(step)) return set_all_aside(step);
    take_wave(lights_.empty() ? viewing_ : lights_);
    trace_wave(step);
  }
}

bool Evaluator::has_enough(const Step& step) const {
  return step.leaving.size() + step.lacking.size() >= most_leaving_;
}

/// Sets viewing rays aside first, then shadow rays, each in the order of their stack: whoever takes
/// the last ones first goes on where this evaluator stopped.
void Evaluator::set_all_aside(Step& step) {
  for (std::vector<OpenRay>* stack : {&viewing_, &lights_}) {
    for (const OpenRay& ray : *stack) step.set_aside.push_back(ray.task);
    stack->clear();
  }
}

void Evaluator::trace_wave(Step& step) {
  if (wave_.front().task.kind == RayKind::kShadow) {
    in_packets(wave_, [&](std::span<const OpenRay> rays) { trace_light_rays(rays, step); });
  } else {
    in_packets(wave_, [&](std::span<OpenRay> rays) { trace_viewing_rays(rays, step); });
    trace_sent_rays(step);
  }
}

template <typename Trace>
void Evaluator::in_packets(std::span<OpenRay> rays, Trace&& trace) {
  while (!rays.empty()) {
    const std::size_t count = std::min(rays.size(), RayPacket::kSize);
    trace(rays.first(count));
    rays = rays.subspan(count);
  }
}

/// Takes rays of one kind and generation from the top of a stack, kWaveRays at most.
void Evaluator::take_wave(std::vector<OpenRay>& stack) {
  const RayTask& top = stack.back().task;
  std::size_t first = stack.size() - 1;
  while (first > 0 && stack.size() - first < kWaveRays) {
    if (!are_alike(stack[first - 1].task, top)) break;
    --first;
  }
  wave_.assign(stack.begin() + static_cast<std::ptrdiff_t>(first), stack.end());
  stack.resize(first);
}

/// Sends out the rays of a wave's surfaces: shadow rays are traced at once, light by light;
/// secondary rays go on the stack.
void Evaluator::trace_sent_rays(Step& step) {
  for (std::uint32_t light = 0; light < shadow_.size(); ++light) send_light_rays(light, step);
  share_credit();
  for (std::vector<OpenRay>& sent : secondary_) {
    viewing_.insert(viewing_.end(), sent.begin(), sent.end());
    sent.clear();
  }
  for (std::vector<OpenRay>& sent : shadow_) {
    in_packets(sent, [&](std::span<const OpenRay> rays) { trace_light_rays(rays, step); });
    sent.clear();
  }
}

/// Passes a ray that has reached its region's boundary on to the next region.
void Evaluator::go_on(const OpenRay& ray, const RegionExit& exit, Step& step) {
  const bool stays = domain_.holds(exit.next);
  RayTask& next = stays ? viewing_.emplace_back(ray).task : step.leaving.emplace_back(ray.task);
  next.t = exit.t;
  next.region = exit.next;
}

/// Passes a shadow ray that has reached its region's boundary on, with the `light` left of it.
void Evaluator::go_on_to_light(const OpenRay& ray, const Rgb& light, const RegionExit& exit,
                               Step& step) {
  const auto move_on = [&](RayTask& task) {
    task.weight = light;
    task.t = exit.t;
    task.region = exit.next;
  };
  if (domain_.holds(exit.next)) {
    move_on(lights_.emplace_back(ray).task);
  } else if (domain_.borrows()) {
    OpenRay next = ray;
    move_on(next.task);
    finish_light_ray(next, step);
  } else {
    move_on(step.leaving.emplace_back(ray.task));
  }
}

/// Traces a shadow ray on through borrowed regions. If one of these is lacking, the ray waits for
/// it as it left the domain's own regions.
void Evaluator::finish_light_ray(const OpenRay& at_border, Step& step) {
  OpenRay ray = at_border;
  RayTask& task = ray.task;
  for (;;) {
    const auto exit = domain_.exit(task);
    const bool arrives = !exit || exit->t >= task.t_max;
    const auto passes = domain_.pass_light_borrowed(
        task.region, task.ray, task.t, arrives ? task.t_max : exit->t, scratch_, task.weight);
    if (!passes) {
      step.lacking.push_back({at_border.task, task.region});
      return;
    }
    if (!*passes) return open_[ray.slot].credit.add_power(task.credit_exponent);
    if (arrives) return light_arrives(ray, task.weight, step);
    task.t = exit->t;
    task.region = exit->next;
  }
}

void Evaluator::light_arrives(const OpenRay& ray, const Rgb& light, Step& step) {
  if (ray.task.ends_at_horizon) ++step.rays.skipped_by_horizon;
  contribute(ray, light, step);
  open_[ray.slot].credit.add_power(ray.task.credit_exponent);
}

/// Like Domain::shorten_to_exits(), but rays may be in several regions. A ray in a region that the
/// domain does not hold leaves it where the ray is.
RayPacket::Mask Evaluator::shorten_to_exits(std::span<const OpenRay> rays, RayPacket& packet,
                                            std::span<RegionExit, RayPacket::kSize> exits) const {
  if (domain_.grid() == nullptr || domain_.is_replica()) return 0;
  const RegionIndex first = rays.front().task.region;
  const auto is_there = [first](const OpenRay& ray) { return ray.task.region == first; };
  if (domain_.holds(first) && std::all_of(rays.begin(), rays.end(), is_there)) {
    return domain_.shorten_to_exits(first, packet, exits);
  }
  RayPacket::Mask leaving = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const RayTask& task = rays[i].task;
    const auto exit =
        domain_.holds(task.region) ? domain_.exit(task) : RegionExit{task.t, task.region};
    if (!exit || !(exit->t < packet.t1[i])) continue;
    leaving |= RayPacket::Mask{1} << i;
    packet.t1[i] = exit->t;
    exits[i] = *exit;
  }
  return leaving;
}

/// Like shorten_to_exits(), but rays that can be finished here keep their whole way to the light.
RayPacket::Mask Evaluator::shorten_light_rays(std::span<const OpenRay> rays, RayPacket& packet,
                                              std::span<RegionExit, RayPacket::kSize> exits) {
  if (std::all_of(rays.begin(), rays.end(), [](const OpenRay& ray) { return ray.stays; })) return 0;
  const RayPacket::Mask leaving = shorten_to_exits(rays, packet, exits);
  const bool has_horizons = domain_.has_foreign_horizons(),
             has_bounds = domain_.has_foreign_bounds();
  RaySelection beyond;
  RayPacket::Mask finished = 0;
  for (const std::size_t i : SetBits(leaving)) {
    const RayTask& task = rays[i].task;
    if (rays[i].stays || (has_horizons && domain_.holds_way_to_light(task, exits[i].t))) {
      finished |= RayPacket::Mask{1} << i;
    } else if (has_bounds) {
      beyond.add(i, task.ray, exits[i].t, task.t_max);
    }
  }
  if (beyond.packet.count > 0) {
    finished |=
        beyond.among_all(beyond.packet.all() & ~domain_.may_meet_foreign(beyond.packet, scratch_));
  }
  for (const std::size_t i : SetBits(finished)) {
    packet.t1[i] = rays[i].task.t_max;
  }
  return leaving & ~finished;
}

/// The rays, among those that are `leaving`, that can't be finished here: a ray's first crossing
/// with the domain's own model (`hits`, `found`; in any region), if there is one, is beyond its
/// exit, and something foreign may come before that crossing.
RayPacket::Mask Evaluator::must_leave(RayPacket::Mask leaving, const RayPacket& packet,
                                      std::span<const RegionExit, RayPacket::kSize> exits,
                                      RayPacket::Mask hits,
                                      std::span<const Crossing, RayPacket::kSize> found) {
  RaySelection beyond;
  for (const std::size_t i : SetBits(leaving)) {
    const bool is_hit = (hits >> i & 1) != 0;
    if (is_hit && found[i].t < exits[i].t) continue;
    beyond.add(i, packet.ray(i), exits[i].t, is_hit ? found[i].t : kInf);
  }
  return beyond.among_all(domain_.may_meet_foreign(beyond.packet, scratch_));
}

/// Traces shadow rays: one packet at most.
void Evaluator::trace_light_rays(std::span<const OpenRay> rays, Step& step) {
  RayPacket packet;
  std::array<RegionExit, RayPacket::kSize> exits;
  std::array<Rgb, RayPacket::kSize> light;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const RayTask& task = rays[i].task;
    light[i] = task.weight;
    packet.add(task.ray, task.t, task.t_max);
  }
  const RayPacket::Mask leaving = shorten_light_rays(rays, packet, exits);
  const RayPacket::Mask passing = domain_.pass_lights(packet, scratch_, light);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const OpenRay& ray = rays[i];
    if ((passing & leaving) >> i & 1) {
      go_on_to_light(ray, light[i], exits[i], step);
    } else if ((passing >> i & 1) != 0) {
      light_arrives(ray, light[i], step);
    } else {
      open_[ray.slot].credit.add_power(ray.task.credit_exponent);
    }
  }
}

/// Traces primary, reflected or refracted rays: one packet at most.
void Evaluator::trace_viewing_rays(std::span<OpenRay> rays, Step& step) {
  RayPacket packet;
  std::array<RegionExit, RayPacket::kSize> exits;
  for (const OpenRay& ray : rays) packet.add(ray.task.ray, ray.task.t, kInf);
  const RayTask& front = rays.front().task;
  const bool may_leave = front.kind != RayKind::kPrimary || domain_.primary_rays_may_leave();
  const RayPacket::Mask leaving = may_leave ? shorten_to_exits(rays, packet, exits) : 0;
  const bool sees_on = leaving != 0 && domain_.has_foreign_bounds();
  if (sees_on) packet.t1.fill(kInf);
  std::array<Crossing, RayPacket::kSize> found;
  RayPacket::Mask hits = domain_.first_crossings(packet, scratch_, found);
  hits |= entries_behind(domain_, front.kind, packet, scratch_, found);
  const RayPacket::Mask gone =
      sees_on ? must_leave(leaving, packet, exits, hits, found) : leaving & ~hits;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    if ((gone >> i & 1) != 0) {
      go_on(rays[i], exits[i], step);
    } else if ((hits >> i & 1) != 0) {
      shade(rays[i], found[i], (leaving >> i & 1) != 0 && found[i].t >= exits[i].t, step);
    } else {
      contribute(rays[i], background(rays[i].task), step);
      open_[rays[i].slot].credit.add_power(rays[i].task.credit_exponent);
    }
  }
}

void Evaluator::open_pixel(std::uint32_t pixel) { open_.emplace_back().pixel = pixel; }

void Evaluator::contribute(const OpenRay& ray, const Rgb& light, Step& step) {
  PixelReturn& sum = open_[ray.slot];
  sum.light.add(to_fixed(light, step.rounding));
  if (++sum.merged == kMaxMergedContributions) {
    step.returns.push_back(sum);
    sum = {sum.pixel, 0, {}, {}};
  }
}

void Evaluator::close_pixels(Step& step) {
  if (step.returns.empty()) step.returns.reserve(open_.size());
  // A ray that went on as a whole brought nothing; its tile may be whole before this could arrive.
  for (const PixelReturn& sum : open_) {
    if (sum.merged > 0 || !sum.credit.is_zero()) step.returns.push_back(sum);
  }
  open_.clear();
}

}  // namespace graycube
