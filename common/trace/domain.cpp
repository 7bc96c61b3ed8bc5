#include "trace/domain.hpp"

namespace graycube {
namespace {

std::unique_ptr<Territory> make_territory(Model model) {
  auto territory = std::make_unique<Territory>();
  territory->model = std::move(model);
  territory->bsp = Bsp::build(territory->model);
  return territory;
}

}  // namespace

Domain::Domain(Model model)
    : frame_(CameraFrame::from(model.settings.camera, model.settings.image)),
      territory_(make_territory(std::move(model))) {}

Domain::Domain(MacroGrid grid, RegionIndex region, Model model)
    : frame_(CameraFrame::from(model.settings.camera, model.settings.image)),
      grid_(std::move(grid)),
      region_(region),
      territory_(make_territory(std::move(model))) {}

}  // namespace graycube
