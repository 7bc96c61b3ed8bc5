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

std::size_t Domain::cell_count() const {
  return territory_->tree ? territory_->tree->item_count() : territory_->bsp->leaves().size();
}

std::size_t Domain::memory_bytes() const {
  return territory_->tree ? territory_->tree->memory_bytes() : territory_->bsp->memory_bytes();
}

}  // namespace graycube
