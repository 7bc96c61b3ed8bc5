#include "trace/first_hit.hpp"

#include <bit>

#include "film/aov.hpp"

namespace graycube {
namespace {

std::uint32_t bits_of(double v) {
  return std::bit_cast<std::uint32_t>(static_cast<float>(v + 0.0));
}

bool is_pixels_own_ray(const Domain& domain, const RayTask& task) {
  const ImageSize& image = domain.settings().image;
  if (image.samples == 1) return true;
  const std::uint32_t middle = image.samples / 2;
  return task.ray == domain.frame().primary_ray(task.pixel % image.width, task.pixel / image.width,
                                                middle, middle);
}

/// The normal out of the object: against a ray that enters it, along a ray that leaves it.
Vec3 object_normal(const Domain& domain, const RayTask& task, const Crossing& hit) {
  const Model& model = domain.model();
  const Vec3 n = outward_normal(model.primitives[hit.primitive], model.data(), task.ray, hit.t);
  return (dot(n, task.ray.direction) > 0) == hit.entering ? -n : n;
}

void put(const RenderSettings& settings, std::size_t plane, std::uint32_t pixel,
         const AovWords& words, Step& step) {
  const std::uint64_t pixels = std::uint64_t{settings.image.width} * settings.image.height;
  step.returns.push_back(
      {aov_slot(plane, pixels, pixel), 1, {words[0], words[1], words[2]}, Credit{}});
}

}  // namespace

void note_first_hit(const Domain& domain, const RayTask& task, const Crossing& hit, Step& step) {
  const RenderSettings& settings = domain.settings();
  if (!is_pixels_own_ray(domain, task)) return;
  const Model& model = domain.model();
  if (has_plane(settings.aovs, kNormalPlane)) {
    const Vec3 n = object_normal(domain, task, hit);
    put(settings, kNormalPlane, task.pixel, {bits_of(n.x), bits_of(n.y), bits_of(n.z)}, step);
  }
  if (has_plane(settings.aovs, kAlbedoPlane)) {
    const Material& m = model.materials[model.primitives[hit.primitive].material];
    const Rgb c = color_at(m.pattern, m.color, task.ray.at(hit.t));
    put(settings, kAlbedoPlane, task.pixel, {bits_of(c.r), bits_of(c.g), bits_of(c.b)}, step);
  }
  if (has_plane(settings.aovs, kDepthPlane)) {
    put(settings, kDepthPlane, task.pixel, {bits_of(hit.t), model.objects[hit.object].id + 1, 0},
        step);
  }
}

}  // namespace graycube
