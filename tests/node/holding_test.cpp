#include "node/parts/holding.hpp"

#include "catch.hpp"
#include "node/node_at_work.hpp"
#include "node/sent_mail.hpp"
#include "scene/compile_scene.hpp"
#include "trace/corner_scene.hpp"

using namespace graycube;
using namespace graycube::testing;

namespace {

constexpr std::uint32_t kColumns = 8, kRows = 4;
const Hypercube kCube = *Hypercube::of_size(8);

std::vector<std::int64_t> edges(std::uint32_t cells, std::uint32_t pixels) {
  std::vector<std::int64_t> edges;
  for (std::uint32_t i = 1; i < cells; ++i) edges.push_back(std::int64_t{i} * pixels / cells);
  return edges;
}

/// Four macro-regions for each of eight nodes.
control::Load scattered() {
  return load_of({kColumns, kRows, 2, edges(kColumns, 128), edges(kRows, 96)});
}

/// The holding of rank 1 of eight in a small scene; with foreign bounds if `foreign`.
Holding holding(const control::Load& load, bool foreign = false) {
  const Seat seat{kCube, Rank{1}};
  Model model = compile_scene(corner_scene());
  std::shared_ptr<Domain> domain;
  if (load.algorithm == Algorithm::kRoth) {
    domain = std::make_shared<Domain>(std::move(model));
  } else {
    const auto frame = CameraFrame::from(model.settings.camera, model.settings.image);
    const MacroGrid grid(frame, load.grid.column_edges, load.grid.row_edges);
    domain = std::make_shared<Domain>(grid, seat.share(), std::move(model));
  }
  if (foreign)
    domain->set_foreign_bounds(std::make_shared<const ForeignBounds>(std::vector<WideNode>{}));
  return Holding::of(seat, load, domain);
}

control::Load roth() {
  control::Load load = scattered();
  load.algorithm = Algorithm::kRoth;
  return load;
}

RayTask ray_in(const RegionIndex& region) {
  RayTask ray = shadow_ray();
  ray.region = region;
  return ray;
}

template <typename F>
void each_region(F&& f) {
  for (std::uint16_t column = 0; column < kColumns; ++column) {
    for (std::uint16_t row = 0; row < kRows; ++row) f(RegionIndex{column, row});
  }
}

}  // namespace

TEST_CASE("a node holds its regions, and rays in others go on across a link") {
  const Holding here = holding(scattered());
  std::uint32_t held = 0;
  each_region([&](const RegionIndex& region) {
    CHECK(here.holds(region) == (here.seat.owner_of(region) == Rank{1}));
    CHECK(here.next_link(region).has_value() != here.holds(region));
    if (here.holds(region))
      ++held;
    else
      CHECK(*here.next_link(region) < here.seat.links());
  });
  CHECK(held == 4);
}

TEST_CASE("rays are due in a node's regions, and in neighbours' where neighbours help") {
  const Holding here = holding(scattered());
  each_region([&](const RegionIndex& region) {
    const Rank owner = here.seat.owner_of(region);
    const bool is_near = kCube.link_between(Rank{1}, owner).has_value();
    CHECK(here.is_due(region, false) == (owner == Rank{1}));
    CHECK(here.is_due(region, true) == (owner == Rank{1} || is_near));
    const std::vector both{ray_in({1, 0}), ray_in(region)};
    CHECK(here.are_due(both, false) == (here.is_due({1, 0}, false) && here.is_due(region, false)));
  });
}

TEST_CASE("rays are due in any region where they are finished beyond their own") {
  const Holding here = holding(scattered(), true);
  each_region([&](const RegionIndex& region) { CHECK(here.is_due(region, false)); });
}

TEST_CASE("own tiles are those of a node's regions; in roth all are everybody's") {
  const Holding here = holding(scattered());
  std::uint64_t own = 0;
  for (std::uint32_t tile = 0; tile < here.plan.tile_count(); ++tile) {
    CHECK(here.is_own_tile(tile) == (here.owner_of_tile(tile) == Rank{1}));
    own += here.is_own_tile(tile) ? 1 : 0;
  }
  CHECK(own == here.own_tiles());
  CHECK(own * 8 == here.plan.tile_count());
  CHECK(holding(roth()).own_tiles() == 0);
}

TEST_CASE("batches may hold what the scene, the grid and the farm have") {
  const Holding here = holding(scattered());
  CHECK(here.limits.pixel_count == 128 * 96);
  CHECK(here.limits.tile_count == here.plan.tile_count());
  CHECK(here.limits.lights == 2);
  CHECK(here.limits.columns == kColumns);
  CHECK(here.limits.rows == kRows);
  CHECK(here.limits.nodes == 8);
  CHECK(here.limits.max_hops == most_hops(here.limits.max_depth, kColumns, kRows));
  const Holding all = holding(roth());
  CHECK(all.limits.columns == 1);
  CHECK(all.limits.rows == 1);
}
