#include "figures/screen_regions.hpp"

namespace graycube::figures {

std::vector<ScreenRegion> screen_regions_of(const LeafSpace& space) {
  std::vector<ScreenRegion> regions;
  std::vector<std::uint32_t> open{0};
  const CameraFrame& frame = space.frame();
  const auto column = [&](double c) { return c / frame.pixel_size + 0.5 * frame.image.width; };
  const auto row = [&](double c) { return c / frame.pixel_size + 0.5 * frame.image.height; };
  while (!open.empty()) {
    const std::uint32_t i = open.back();
    open.pop_back();
    const BspNode& n = space.bsp().nodes()[i];
    if (n.axis < 2) {
      open.insert(open.end(), {n.child + 1, n.child});
      continue;
    }
    const Aabb& cell = space.cell(i);
    regions.push_back({i, column(cell.lo.x), row(cell.lo.y), column(cell.hi.x), row(cell.hi.y),
                       space.leaves_below(i),
                       static_cast<std::uint32_t>(space.primitives_below(i).size())});
  }
  return regions;
}

}  // namespace graycube::figures
