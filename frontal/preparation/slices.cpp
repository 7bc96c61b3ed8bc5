#include "frontal/preparation/slices.hpp"

#include <algorithm>
#include <utility>

#include "proto/bounds_bytes.hpp"
#include "proto/horizon_bytes.hpp"
#include "proto/model_slice.hpp"
#include "proto/share_of.hpp"
#include "regions/own_pixels.hpp"
#include "regions/restrict.hpp"
#include "stop_point.hpp"
#include "visibility/foreign_bounds.hpp"

namespace graycube {
namespace {

/// Most of the scene on one node, with occluders: space is shared out however small the scene is.
constexpr double kMostPart = 0.45;

/// Calls f(texel) for a texel and those around it on its face: the pre-render traces few pixels,
/// and the next surface may ask for the texel beside the one that was asked for.
template <typename F>
void for_each_around(std::uint32_t texel, F&& f) {
  constexpr std::uint32_t kSide = LightHorizons::kSide;
  const std::uint32_t u = texel % kSide, v = texel / kSide % kSide;
  for (std::uint32_t y = v > 0 ? v - 1 : v; y <= std::min(v + 1, kSide - 1); ++y) {
    for (std::uint32_t x = u > 0 ? u - 1 : u; x <= std::min(u + 1, kSide - 1); ++x)
      f(texel - v * kSide - u + y * kSide + x);
  }
}

/// One query for each texel that is asked for, with the largest distance and the sum of rays.
std::vector<OccluderQuery> together(std::vector<OccluderQuery> queries) {
  std::sort(queries.begin(), queries.end(), [](const OccluderQuery& a, const OccluderQuery& b) {
    return a.light != b.light ? a.light < b.light : a.texel < b.texel;
  });
  std::size_t count = 0;
  for (const OccluderQuery& q : queries) {
    OccluderQuery* const last = count > 0 ? &queries[count - 1] : nullptr;
    if (last != nullptr && last->light == q.light && last->texel == q.texel) {
      last->distance = std::max(last->distance, q.distance);
      last->rays += q.rays;
    } else {
      queries[count++] = q;
    }
  }
  queries.resize(count);
  return queries;
}

/// The queries of shadow rays that leave their node, by rank, with those for the texels around.
std::vector<std::vector<OccluderQuery>> queries_of(const Model& model, const NodeMesh& mesh,
                                                   const Partition& cut) {
  std::vector<std::vector<OccluderQuery>> queries(mesh.cube().nodes());
  for (const LeavingLight& light : cut.left_by_light) {
    const RayTask& task = light.ray;
    const RegionIndex owner = owner_of_pixel(task.pixel % model.settings.image.width, light.from,
                                             cut.grid, cut.own_edges);
    const Rank rank = mesh.owner_of(owner.column, owner.row, owner.slab);
    const RegionShare share = share_of(mesh, rank);
    auto exit = share.owns(light.from) ? cut.grid.exit(light.from, task.ray, task.t)
                                       : RegionExit{task.t, light.from};
    while (exit && share.owns(exit->next)) exit = cut.grid.exit(exit->next, task.ray, exit->t);
    if (!exit || exit->t >= task.t_max) continue;
    const double distance =
        length(model.settings.lights[task.light_or_medium].position - task.ray.origin);
    const auto texel = static_cast<std::uint32_t>(
        cube_texel(cube_place(-task.ray.direction), LightHorizons::kSide));
    queries[rank.value].push_back({task.light_or_medium, texel, distance, 1});
  }
  for (std::vector<OccluderQuery>& q : queries) {
    q = together(std::move(q));
    std::vector<OccluderQuery> around;
    around.reserve(9 * q.size());
    for (const OccluderQuery& at : q) {
      for_each_around(at.texel, [&](std::uint32_t t) {
        around.push_back({at.light, t, at.distance, at.rays});
      });
    }
    q = together(std::move(around));
  }
  return queries;
}

/// Chooses the objects that nodes hold beside those that their macro-regions need.
class Contents {
 public:
  Contents(const Model& model, std::uint64_t model_bytes, const NodeMesh& mesh,
           const Partition& cut, const SurfaceTree* tree, const Occluders& occluders)
      : model_(model),
        mesh_(mesh),
        cut_(cut),
        tree_(tree),
        occluders_(occluders),
        queries_(mesh.cube().nodes()) {
    if (!occluders.is_empty()) queries_ = queries_of(model, mesh, cut);
    for (const Object& object : model.objects)
      bytes_.push_back(encoded_object_bytes(model, object));
    room_ = std::min(slice_room(model_bytes, mesh.cube().nodes()),
                     static_cast<std::uint64_t>(kMostPart * static_cast<double>(model_bytes)));
  }

  ModelContents of(Rank rank) const {
    stop_if_asked();
    ModelContents contents =
        contents_with_own_pixels(model_, cut_.grid, share_of(mesh_, rank), cut_.own_edges);
    std::uint64_t held = 0;
    for (std::size_t i = 0; i < bytes_.size(); ++i) held += contents.is_whole[i] ? bytes_[i] : 0;
    for (const ModelContents::Part& part : contents.parts) held += bytes_[part.object];
    std::size_t room = room_ - std::min(room_, held);
    std::vector<bool> whole = contents.is_whole;
    if (tree_ != nullptr) add_unbounded(room, whole);
    choose_occluders(occluders_, queries_[rank.value], bytes_, room, whole);
    contents.hold_whole(whole);
    return contents;
  }

 private:
  /// Such objects are few, mostly floors, and if one is foreign nothing can be said of any ray.
  void add_unbounded(std::size_t& room, std::vector<bool>& whole) const {
    for (const std::uint32_t item : tree_->unbounded_items()) {
      const std::uint32_t object = tree_->items()[item].object;
      if (whole[object] || bytes_[object] > room) continue;
      whole[object] = true;
      room -= bytes_[object];
    }
  }

  const Model& model_;
  const NodeMesh& mesh_;
  const Partition& cut_;
  const SurfaceTree* tree_;
  const Occluders& occluders_;
  std::vector<std::vector<OccluderQuery>> queries_;
  /// Encoded bytes of each object, by its index.
  std::vector<std::size_t> bytes_;
  std::uint64_t room_ = 0;
};

/// Encoded foreign bounds, by rank. If they are too large for one node, no node gets any: nodes
/// with bounds send on rays that are on their way to others.
std::vector<Bytes> bounds_of(std::span<const ModelContents> contents, const SurfaceTree* tree,
                             std::size_t most_bytes) {
  std::vector<Bytes> all(contents.size());
  if (tree == nullptr) return all;
  const ForeignBoundsMaker maker(*tree);
  for (std::size_t rank = 0; rank < contents.size(); ++rank) {
    const auto bounds = maker.bounds(contents[rank], most_bytes);
    if (!bounds) return std::vector<Bytes>(contents.size());
    all[rank] = encode_bounds(*bounds);
  }
  return all;
}

}  // namespace

Slices slices_of(const Model& model, const NodeMesh& mesh, const Partition& cut,
                 const SurfaceTree* tree, const Occluders& occluders,
                 std::span<const std::byte> horizons) {
  Slices slices;
  const SliceEncoder encoder(model);
  const auto add = [&](const ModelContents& contents, std::span<const std::byte> bounds,
                       std::span<const std::byte> foreign) {
    stop_if_asked();
    const std::span<const std::byte> tails[] = {bounds, foreign, horizons};
    slices.bytes.push_back(encoder.encode(contents, tails));
  };
  const std::uint64_t model_bytes = encoded_model_bytes(model);
  const Contents contents_of(model, model_bytes, mesh, cut, tree, occluders);
  std::vector<ModelContents> contents;
  for (std::uint32_t rank = 0; rank < mesh.cube().nodes(); ++rank)
    contents.push_back(contents_of.of(Rank{rank}));
  const std::vector<Bytes> bounds =
      bounds_of(contents, tree, bounds_room(model_bytes, mesh.cube().nodes()));
  slices.have_bounds = std::ranges::none_of(bounds, &Bytes::empty);
  for (std::uint32_t rank = 0; rank < mesh.cube().nodes(); ++rank) {
    add(contents[rank], bounds[rank],
        occluders.is_empty() ? Bytes{}
                             : encode_horizons(occluders.foreign_horizons(contents[rank], model)));
  }
  return slices;
}

}  // namespace graycube
