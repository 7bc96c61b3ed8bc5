#include "frontal/slices.hpp"

#include <algorithm>
#include <span>
#include <utility>

#include "proto/horizon_bytes.hpp"
#include "proto/model_slice.hpp"
#include "proto/share_of.hpp"
#include "space/restrict.hpp"

namespace graycube {
namespace {

/// Of the scene on one node, with occluders: space is shared out however small the scene is.
constexpr double kMostPart = 0.45;

/// By rank.
std::vector<std::vector<OccluderQuery>> queries_of(const Model& model, const Hypercube& cube, const Partition& cut) {
  std::vector<std::vector<OccluderQuery>> queries(cube.nodes());
  for (const LeavingLight& light : cut.left_by_light) {
    const RayTask& task = light.ray;
    const Rank rank = cube.owner_of(light.from.column, light.from.row);
    const RegionShare share = share_of(cube, rank);
    auto exit = cut.grid.exit(light.from, task.ray, task.t);
    while (exit && share.owns(exit->next)) exit = cut.grid.exit(exit->next, task.ray, exit->t);
    if (!exit || exit->t >= task.t_max) continue;
    const Vec3 to_light = model.settings.lights[task.light].position - task.ray.origin;
    const auto texel = static_cast<std::uint32_t>(cube_texel(cube_place(-task.ray.direction), LightHorizons::kSide));
    for (std::uint32_t k = 0; k < 4; ++k) {
      const std::uint32_t t = (texel & ~std::uint32_t{LightHorizons::kSide + 1}) | (k & 1) | (k >> 1) * LightHorizons::kSide;
      queries[rank.value].push_back({task.light, t, length(to_light)});
    }
  }
  return queries;
}

}  // namespace

std::vector<SharedBytes> slices_of(const Model& model, const Hypercube& cube, const Partition& cut,
                                   const Occluders& occluders, std::span<const std::byte> horizons) {
  std::vector<SharedBytes> slices;
  const auto add = [&](const Bytes& slice, std::span<const std::byte> foreign) {
    Bytes all;
    all.reserve(slice.size() + foreign.size() + horizons.size());
    for (const auto part : {std::span(slice), foreign, horizons}) all.insert(all.end(), part.begin(), part.end());
    slices.push_back(std::move(all));
  };
  if (occluders.is_empty()) {
    for (std::uint32_t rank = 0; rank < cube.nodes(); ++rank) {
      add(encode_model(restrict_to_share(model, cut.grid, share_of(cube, Rank{rank}))), {});
    }
    return slices;
  }
  const auto queries = queries_of(model, cube, cut);
  const std::uint64_t all = encoded_model_bytes(model);
  const std::uint64_t room = std::min(slice_room(all, cube.nodes()), static_cast<std::uint64_t>(kMostPart * static_cast<double>(all)));
  std::vector<std::size_t> bytes;
  for (const Object& object : model.objects) bytes.push_back(encoded_object_bytes(model, object));
  for (std::uint32_t rank = 0; rank < cube.nodes(); ++rank) {
    ModelContents contents = contents_of_share(model, cut.grid, share_of(cube, Rank{rank}));
    std::uint64_t held = 0;
    for (std::size_t i = 0; i < bytes.size(); ++i) held += contents.is_whole[i] ? bytes[i] : 0;
    for (const ModelContents::Part& part : contents.parts) held += bytes[part.object];
    std::vector<bool> whole = contents.is_whole;
    choose_occluders(occluders, queries[rank], bytes, room - std::min(room, held), whole);
    contents.hold_whole(whole);
    const Model slice = extract(model, contents);
    add(encode_model(slice), encode_horizons(occluders.foreign_horizons(contents, slice)));
  }
  return slices;
}

}  // namespace graycube
