#include "frontal/rendering/light_intake.hpp"

#include "catch.hpp"
#include "proto/records/tile_records.hpp"
#include "transport/message.hpp"

using namespace graycube;

namespace {

constexpr std::uint32_t kNodes = 2, kJob = 3, kTileRays = 16 * 16;

/// Four tiles of 16 × 16 pixels.
struct Intake {
  RenderSettings settings;
  TilePlan plan;
  LightIntake intake;

  Intake()
      : settings(small()),
        plan(settings.image, TileShape{16, 16}),
        intake(kJob, settings, plan, kNodes) {}
  static RenderSettings small() {
    RenderSettings s;
    s.image = {32, 32, 1};
    return s;
  }
  LightIntake::Taken take(std::uint32_t sender, std::uint64_t sequence, std::uint32_t tile,
                          std::uint64_t units, std::vector<Contribution> light = {},
                          std::uint32_t epoch = 0) {
    const TileCredit credit{tile, Credit::from_words({units, 0, 0, 0, 0})};
    return intake.take(encode_contributions({kJob, epoch, sender, 7, sequence}, {{credit}}, light),
                       0);
  }
};

}  // namespace

TEST_CASE("a tile is whole when all its credit is back, whoever brings it") {
  Intake in;
  CHECK(in.take(0, 0, 2, kTileRays - 1).whole.empty());
  CHECK(in.take(1, 0, 2, 1).whole == std::vector<std::uint32_t>{2});
  CHECK(in.intake.tiles().whole_count() == 1);
  CHECK(in.intake.batches() == 2);
}

TEST_CASE("more credit than a tile gave out is an error") {
  Intake in;
  CHECK(in.take(0, 0, 2, kTileRays + 1).wrong ==
        "internal error: more was done of part 2 of the picture than there is of it");
}

TEST_CASE(
    "a batch that is missing, or comes twice, is found out for each node "
    "by itself") {
  Intake in;
  CHECK(in.take(0, 0, 0, 1).wrong.empty());
  CHECK(in.take(1, 0, 0, 1).wrong.empty());
  CHECK(in.take(0, 2, 0, 1).wrong == "a batch of contributions from node 0 was lost");
  CHECK(in.take(1, 0, 0, 1).wrong == "a batch of contributions from node 1 was lost");
  CHECK(in.take(0, 1, 0, 1).wrong.empty());
}

TEST_CASE("a batch of another epoch is passed over, and doesn't count") {
  Intake in;
  const LightIntake::Taken taken = in.take(0, 5, 0, kTileRays, {}, 1);
  CHECK(taken.wrong.empty());
  CHECK(taken.whole.empty());
  CHECK(in.intake.batches() == 0);
}

TEST_CASE("light is added to the film, and AOVs only where somebody asked for them") {
  Intake in;
  const std::int64_t one = std::int64_t{1} << 32;
  CHECK(in.take(0, 0, 0, 1, {{5, {one, 0, 0}}}).wrong.empty());
  CHECK(in.take(1, 0, 0, 1, {{5, {one, one, 0}}}).wrong.empty());
  const Picture picture = in.intake.film().develop();
  CHECK(picture.rgb[15] == 2);
  CHECK(picture.rgb[16] == 1);
  CHECK(in.take(0, 1, 0, 1, {{32 * 32, {1, 0, 0}}}).wrong ==
        "a contribution to AOVs that nobody asked for");
}

TEST_CASE("what is no batch of contributions is told to be broken") {
  Intake in;
  CHECK(in.intake.take({}, 0).wrong.starts_with("a broken batch of contributions: "));
}

TEST_CASE("tiles that were recorded are whole from the beginning, with their light") {
  Intake before;
  before.take(0, 0, 0, kTileRays, {{0, {1, 2, 3}}});
  before.take(0, 1, 2, kTileRays, {{17 * 32, {4, 5, 6}}});
  const RecordedPicture picture{1, 32, 32, {}};
  Bytes records = encode_records_head(picture);
  for (const std::uint32_t tile : {0u, 2u})
    append_tile_record(records, before.intake.film(), before.plan.rect(tile));
  Intake in;
  CHECK(in.intake.restore(records, in.plan) == 2);
  CHECK(in.intake.tiles().is_whole(0));
  CHECK(in.intake.tiles().open_tiles() == std::vector<std::uint32_t>{1, 3});
  CHECK(in.intake.film().short_sum(0) == FixedRgb{1, 2, 3});
  CHECK(in.intake.film().short_sum(17 * 32) == FixedRgb{4, 5, 6});
  CHECK(in.intake.batches() == 0);
}

TEST_CASE("a tile of which only a part was recorded is traced whole, without that light") {
  Film film(32, 32, 1);
  for (std::uint32_t p = 0; p < 32 * 32; ++p) film.add(p, {1, 1, 1});
  Bytes records = encode_records_head({1, 32, 32, {}});
  // Tiles of another plan: all of tile 0, and half of tile 1.
  append_tile_record(records, film, {0, 0, 24, 16});
  Intake in;
  CHECK(in.intake.restore(records, in.plan) == 1);
  CHECK(in.intake.tiles().open_tiles() == std::vector<std::uint32_t>{1, 2, 3});
  CHECK(in.intake.film().short_sum(16) == FixedRgb{});
}

TEST_CASE("of a picture that was recorded whole one tile is left to trace") {
  Film film(32, 32, 1);
  for (std::uint32_t p = 0; p < 32 * 32; ++p) film.add(p, {1, 1, 1});
  Bytes records = encode_records_head({1, 32, 32, {}});
  append_tile_record(records, film, {0, 0, 32, 32});
  Intake in;
  CHECK(in.intake.restore(records, in.plan) == 3);
  CHECK(in.intake.tiles().open_tiles() == std::vector<std::uint32_t>{3});
  CHECK(in.intake.film().short_sum(31 * 32) == FixedRgb{1, 1, 1});
  CHECK(in.intake.film().short_sum(31 * 32 + 31) == FixedRgb{});
}
