// Pictures of scenes whose surfaces touch: the same solids without touching surfaces give the same
// ones, and every way of rendering gives the same bytes.

#include "simulation/pictures.hpp"
#include "catch.hpp"
#include "coincidence/pair_pictures.hpp"
#include "formats/graycube/write_scene.hpp"
#include "geometry/simd.hpp"
#include "trace/machine.hpp"

using namespace graycube;
using namespace graycube::testing;

namespace {

constexpr std::uint32_t kSide = 96;
constexpr std::uint64_t kPictures = 102;  // six of each kind

FlushPair pair_in_picture(std::uint64_t seed, std::uint32_t side, const PairOptions& options = {}) {
  FlushPair pair = PairMaker(seed, options).make();
  set_up_picture(pair, side);
  return pair;
}

/// `make(seed)` gives a pair, set up for pictures of kSide.
template <typename Make>
void check_pictures(std::uint64_t count, const Make& make) {
  PictureTally tally;
  for (std::uint64_t seed = 1; seed <= count; ++seed) {
    const FlushPair pair = make(seed);
    tally.add(pair.text(), picture_of(pair.flush), picture_of(pair.longer));
  }
  tally.check();
}

}  // namespace

TEST_CASE("pictures of touching surfaces under quarter turns are those of the same solids") {
  check_pictures(34, [](std::uint64_t seed) {
    return pair_in_picture(seed, kSide, {.turns = ChainOptions::Turns::kQuarters});
  });
}

TEST_CASE("pictures of touching surfaces are those of the same solids without any") {
  check_pictures(kPictures, [](std::uint64_t seed) { return pair_in_picture(seed, kSide); });
}

TEST_CASE("pictures of solids without touching surfaces are the same whichever way leads to them") {
  check_pictures(kPictures, [](std::uint64_t seed) {
    FlushPair pair = PairMaker(seed).make();
    pair.flush = PairMaker(seed, {.tells_longer_anew = true}).make().longer;
    set_up_picture(pair, kSide);
    return pair;
  });
}

TEST_CASE("each instruction set and each subdivision renders touching surfaces to the same bytes") {
  for (std::uint64_t seed = 1; seed <= kPictures / 2; ++seed) {
    const FlushPair pair = pair_in_picture(seed, kSide / 2);
    INFO(pair.text());
    const Picture expected = picture_of(pair.flush);
    CHECK(picture_of(pair.flush, {Subdivision::kLinked}) == expected);
    for (const std::string& name : simd_names()) {
      INFO(name);
      REQUIRE(choose_simd(name));
      CHECK(picture_of(pair.flush) == expected);
    }
    choose_simd("best");
  }
}

TEST_CASE("macro-regions give bit for bit the whole's picture of touching surfaces") {
  constexpr std::array<std::array<std::uint32_t, 2>, 3> kGrids{{{2, 1}, {2, 2}, {4, 3}}};
  for (std::uint64_t seed = 1; seed <= kPictures / 2; ++seed) {
    FlushPair pair = pair_in_picture(seed, kSide / 3);
    pair.flush.settings.aovs = {};
    INFO(pair.text());
    const Model model = compile_scene(pair.flush);
    const Harvest whole = trace_whole(model);
    Dice dice(seed);
    const auto [columns, rows] = kGrids[seed % kGrids.size()];
    const MacroGrid grid = MacroGrid::regular(
        CameraFrame::from(model.settings.camera, model.settings.image), columns, rows);
    check_equal(whole, Machine(model, grid).trace(dice), model.settings.image);
  }
}

TEST_CASE("farms of two and four nodes render touching surfaces to the serial bytes") {
  for (std::uint64_t seed = 1; seed <= kPairKinds; ++seed) {
    FlushPair pair = pair_in_picture(seed, kSide / 4);
    pair.flush.settings.aovs = {};
    const std::string text = write_scene_text(pair.flush);
    const Picture expected = simulation::serial_picture(text);
    CHECK(expected == picture_of(pair.flush));
    for (const std::uint32_t nodes : {2u, 4u}) {
      for (const Algorithm algorithm : {Algorithm::kRoth, Algorithm::kMacro}) {
        INFO(pair.text() << ", " << nodes << " nodes, " << to_string(algorithm));
        simulation::RandomFarm farm({.nodes = nodes, .seed = seed});
        check_same_picture(farm, farm.render(text, simulation::with(algorithm)), 1, expected);
      }
    }
  }
}
