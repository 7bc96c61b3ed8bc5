#include "trace/domain.hpp"

#include "check.hpp"

namespace graycube {
namespace {

template <typename T>
std::size_t bytes_of(const std::vector<T>& v) {
  return v.size() * sizeof(T);
}

std::size_t shape_bytes(const Model& model) {
  std::size_t bytes = 0;
  for (const Mesh& mesh : model.meshes) bytes += mesh.memory_bytes();
  for (const Outline& outline : model.outlines) bytes += outline.memory_bytes();
  return bytes;
}

}  // namespace

std::shared_ptr<const Territory> Territory::of(std::shared_ptr<const Model> model,
                                               const SubdivisionChoice& subdivision) {
  auto territory = std::make_shared<Territory>();
  territory->model = std::move(model);
  territory->subdivision = subdivision;
  territory->media = Media(territory->model->materials);
  if (subdivision.way == Subdivision::kSurfaces) {
    territory->tree = SurfaceTree::build(*territory->model);
  } else {
    territory->search = make_search(*territory->model, subdivision);
  }
  return territory;
}

std::size_t Territory::memory_bytes() const {
  return bytes_of(model->primitives) + bytes_of(model->planes) + bytes_of(model->nodes) +
         bytes_of(model->objects) + shape_bytes(*model) + bytes_of(model->materials) +
         (tree ? tree->memory_bytes() : search->memory_bytes());
}

Domain::Domain(std::shared_ptr<const Territory> territory)
    : frame_(
          CameraFrame::from(territory->model->settings.camera, territory->model->settings.image)),
      territory_(std::move(territory)) {}

Domain::Domain(MacroGrid grid, RegionShare share, Model model, const SubdivisionChoice& subdivision)
    : frame_(CameraFrame::from(model.settings.camera, model.settings.image)),
      grid_(std::move(grid)),
      share_(share),
      territory_(Territory::of(std::move(model), subdivision)) {}

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
  return territory_->tree ? territory_->tree->item_count() : territory_->search->cell_count();
}

std::size_t Domain::memory_bytes() const {
  std::size_t bytes = territory_->memory_bytes();
  for (const auto& b : borrowed_) bytes += b ? b->memory_bytes() : 0;
  if (foreign_bounds_) bytes += foreign_bounds_->memory_bytes();
  return bytes;
}

std::shared_ptr<const Domain> Domain::with_borrowed(
    const RegionShare& theirs, std::shared_ptr<const Territory> territory) const {
  auto wider = std::make_shared<Domain>(*this);
  wider->borrowed_.resize(std::size_t{share_.columns} * share_.rows * share_.slabs);
  wider->borrowed_[place_of_owner(theirs.column, theirs.row, theirs.slab)] = std::move(territory);
  return wider;
}

RegionIndex Domain::region_at(const RayTask& task, double t) const {
  RegionIndex region = task.region;
  if (!grid_) return region;
  for (auto exit = grid_->exit(region, task.ray, task.t); exit && exit->t <= t;
       exit = grid_->exit(region, task.ray, exit->t)) {
    region = exit->next;
  }
  return region;
}

std::shared_ptr<Domain> Domain::of_neighbour(const RegionShare& share, Model model) const {
  GRAYCUBE_CHECK(grid_.has_value(), "without boundaries there are no neighbours");
  auto theirs = std::make_shared<Domain>(*this);
  theirs->share_ = share;
  theirs->territory_ = Territory::of(std::move(model), territory_->subdivision);
  theirs->foreign_horizons_ = nullptr;
  theirs->foreign_bounds_ = nullptr;
  return theirs;
}

std::optional<bool> Domain::pass_light_borrowed(RegionIndex region, const Ray& ray, double t0,
                                                double t1, CrossingScratch& scratch,
                                                Rgb& light) const {
  if (holds(region)) return pass_light(ray, t0, t1, scratch, light);
  if (borrowed_.empty()) return std::nullopt;
  const std::size_t place = place_of_owner(region.column, region.row, region.slab);
  if (!borrowed_[place]) return std::nullopt;
  const Territory& lent = *borrowed_[place];
  if (lent.search) return lent.search->pass_light(ray, t0, t1, scratch.mailbox, light);
  scratch.borrowed.resize(borrowed_.size());
  return lent.tree->pass_light(ray, t0, t1, scratch.borrowed[place], light);
}

}  // namespace graycube
