#include "trace/domain.hpp"

namespace graycube {
namespace {

std::unique_ptr<Territory> make_territory(Model model, Subdivision subdivision) {
  auto territory = std::make_unique<Territory>();
  territory->model = std::move(model);
  if (subdivision == Subdivision::kSurfaceTree) {
    territory->tree = SurfaceTree::build(territory->model);
  } else {
    territory->bsp = Bsp::build(territory->model);
  }
  return territory;
}

}  // namespace

Domain::Domain(Model model, Subdivision subdivision)
    : frame_(CameraFrame::from(model.settings.camera, model.settings.image)),
      territory_(make_territory(std::move(model), subdivision)) {}

Domain::Domain(MacroGrid grid, RegionIndex region, Model model, Subdivision subdivision)
    : frame_(CameraFrame::from(model.settings.camera, model.settings.image)),
      grid_(std::move(grid)),
      region_(region),
      territory_(make_territory(std::move(model), subdivision)) {}

RayPacket::Mask Domain::first_crossings(const RayPacket& packet, CrossingScratch& scratch,
                                        std::span<Crossing, RayPacket::kSize> found) const {
  if (territory_->tree) return territory_->tree->first_crossings(packet, scratch.tree, found);
  RayPacket::Mask any = 0;
  for (std::size_t i = 0; i < packet.count; ++i) {
    const auto hit = first_crossing(packet.ray(i), packet.t0[i], packet.t1[i], scratch);
    if (!hit) continue;
    found[i] = *hit;
    any |= RayPacket::Mask{1} << i;
  }
  return any;
}

RayPacket::Mask Domain::pass_lights(const RayPacket& packet, CrossingScratch& scratch,
                                    std::span<Rgb, RayPacket::kSize> light) const {
  if (territory_->tree) return territory_->tree->pass_lights(packet, scratch.tree, light);
  RayPacket::Mask arriving = 0;
  for (std::size_t i = 0; i < packet.count; ++i) {
    if (pass_light(packet.ray(i), packet.t0[i], packet.t1[i], scratch, light[i])) {
      arriving |= RayPacket::Mask{1} << i;
    }
  }
  return arriving;
}

std::size_t Domain::cell_count() const {
  return territory_->tree ? territory_->tree->item_count() : territory_->bsp->leaves().size();
}

std::size_t Domain::memory_bytes() const {
  return territory_->tree ? territory_->tree->memory_bytes() : territory_->bsp->memory_bytes();
}

}  // namespace graycube
