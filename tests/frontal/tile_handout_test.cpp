#include "frontal/rendering/tile_handout.hpp"

#include <numeric>
#include <set>

#include "catch.hpp"
#include "frontal/prepared.hpp"
#include "trace/corner_scene.hpp"

using namespace graycube;
using namespace graycube::testing;

namespace {

constexpr std::uint32_t kNodes = 4;
const Hypercube kCube = *Hypercube::of_size(kNodes);

/// A scene cut for four nodes, and how its tiles are handed out.
struct Handout {
  PreparedScene scene;
  TileLedger ledger;
  TileHandout tiles;

  explicit Handout(TileHandout::Way way)
      : scene(cut(way)),
        ledger(rays_of(*scene.plan)),
        tiles(kCube, *scene.plan, ledger, way, TileWindow(scene, kNodes, 1, {})) {}
  static std::vector<std::uint32_t> rays_of(const TilePlan& plan) {
    std::vector<std::uint32_t> rays;
    for (std::uint32_t tile = 0; tile < plan.tile_count(); ++tile)
      rays.push_back(static_cast<std::uint32_t>(plan.primary_rays(tile)));
    return rays;
  }
  /// All of the tile's light has come.
  void make_whole(std::uint32_t tile) {
    const std::uint64_t rays = scene.plan->primary_rays(tile);
    REQUIRE(ledger.add(tile, Credit::from_words({rays, 0, 0, 0, 0})) == CreditResult::kWhole);
    tiles.is_whole(tile);
  }
  static PreparedScene cut(TileHandout::Way way) {
    if (way == TileHandout::Way::kAny) return prepared(large(), {}, kNodes, Algorithm::kRoth);
    control::JobOptions options;
    options.partition = PartitionMode::kRegular;
    if (way == TileHandout::Way::kHelp) options.shadows = ShadowMode::kLocal;
    return prepared(large(), options, kNodes);
  }
  static Scene large() {
    Scene scene = corner_scene();
    scene.settings.image = {256, 256, 1};
    return scene;
  }
  Rank owner_of(std::uint32_t tile) const {
    const RegionIndex region = scene.plan->owner_of_tile(tile);
    return NodeMesh(kCube).owner_of(region.column, region.row);
  }
};

}  // namespace

TEST_CASE("every tile is handed out once, whatever the way") {
  for (const auto way : {TileHandout::Way::kAny, TileHandout::Way::kOwn, TileHandout::Way::kHelp}) {
    Handout h(way);
    std::set<std::uint32_t> seen;
    bool any = true;
    while (any) {
      any = false;
      for (std::uint32_t rank = 0; rank < kNodes; ++rank) {
        for (const std::uint32_t tile : h.tiles.next(Rank{rank})) {
          CHECK(seen.insert(tile).second);
          CHECK(h.tiles.is_whole(tile) == Rank{rank});
          any = true;
        }
      }
    }
    CHECK(seen.size() == h.scene.plan->tile_count());
  }
}

TEST_CASE("a node gets its own tiles only, unless it may help") {
  Handout own(TileHandout::Way::kOwn);
  for (const std::uint32_t tile : own.tiles.next(Rank{1})) CHECK(own.owner_of(tile) == Rank{1});
  CHECK(own.tiles.next(Rank{1}).empty());
  const auto relief = own.tiles.take_relief();
  CHECK(std::accumulate(relief.begin(), relief.end(), 0u) == 0);
}

TEST_CASE(
    "a node that has none left takes over tiles of a neighbour, which is "
    "relieved of them") {
  Handout h(TileHandout::Way::kHelp);
  std::vector<std::uint32_t> taken;
  while (taken.empty()) {
    const auto tiles = h.tiles.next(Rank{0});
    REQUIRE_FALSE(tiles.empty());
    for (const std::uint32_t tile : tiles) {
      if (h.owner_of(tile) != Rank{0}) taken.push_back(tile);
      CHECK(h.tiles.is_whole(tile) == Rank{0});
    }
  }
  const Rank owner = h.owner_of(taken.front());
  CHECK(kCube.link_between(Rank{0}, owner));
  const auto relief = h.tiles.take_relief();
  CHECK(relief[owner.value] > 0);
  CHECK(std::accumulate(relief.begin(), relief.end(), std::size_t{0}) == taken.size());
  CHECK(h.tiles.take_relief()[owner.value] == 0);
}

TEST_CASE("the batches that bring a node its tiles are numbered for each node") {
  Handout h(TileHandout::Way::kOwn);
  CHECK(h.tiles.next_sequence(Rank{0}) == 0);
  CHECK(h.tiles.next_sequence(Rank{0}) == 1);
  CHECK(h.tiles.next_sequence(Rank{1}) == 0);
}

TEST_CASE("a new epoch hands out again what isn't whole, and nothing else") {
  for (const auto way : {TileHandout::Way::kAny, TileHandout::Way::kOwn, TileHandout::Way::kHelp}) {
    Handout h(way);
    std::set<std::uint32_t> whole;
    for (std::uint32_t rank = 0; rank < kNodes; ++rank) {
      const auto tiles = h.tiles.next(Rank{rank});
      for (std::size_t i = 0; i < tiles.size(); i += 2) {
        h.make_whole(tiles[i]);
        whole.insert(tiles[i]);
      }
    }
    REQUIRE_FALSE(whole.empty());
    REQUIRE_FALSE(h.tiles.under_way().empty());
    const Retries retries(kDefaultRetries, kNodes);
    h.tiles.reopen(retries);
    CHECK(h.tiles.under_way().empty());
    for (bool any = true; any;) {
      any = false;
      for (std::uint32_t rank = 0; rank < kNodes; ++rank) {
        for (const std::uint32_t tile : h.tiles.next(Rank{rank})) {
          CHECK(whole.insert(tile).second);
          h.make_whole(tile);
          any = true;
        }
      }
    }
    CHECK(whole.size() == h.scene.plan->tile_count());
  }
}

TEST_CASE("tiles that were under way at losses come first, and ever fewer at a time") {
  for (const auto way : {TileHandout::Way::kAny, TileHandout::Way::kOwn}) {
    Handout h(way);
    Retries retries(kDefaultRetries, kNodes);
    std::vector<std::uint32_t> tiles = h.tiles.next(Rank{1});
    for (std::uint32_t loss = 1; loss <= kDefaultRetries; ++loss) {
      REQUIRE_FALSE(retries.note_loss(tiles, h.scene.plan->tile_count()));
      h.tiles.reopen(retries);
      const auto again = h.tiles.next(Rank{1});
      CHECK(again.size() <= std::max<std::size_t>(1, tiles.size()));
      CHECK(retries.losses_of(again.front()) == loss);
      tiles = again;
    }
    CHECK(tiles.size() == 1);
    CHECK(retries.note_loss(tiles, h.scene.plan->tile_count()) == tiles.front());
  }
}
