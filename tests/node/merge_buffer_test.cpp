// The light that a node sends home: summed per pixel, its credit per tile, and nothing is lost in
// any order of arrival.
#include "node/parts/merge_buffer.hpp"

#include <map>
#include <random>

#include "catch.hpp"

using namespace graycube;

namespace {

const TilePlan kPlan(ImageSize{256, 256, 1}, TileShape{});

struct Totals {
  std::map<std::uint32_t, FixedRgb> light;
  std::map<std::uint32_t, Credit> credit;

  void add(const PixelReturn& r) {
    if (r.pixel < kPlan.pixel_count()) credit[kPlan.tile_of_pixel(r.pixel)].add(r.credit);
    if (r.merged > 0) light[r.pixel].add(r.light);
  }
  void add(const MergeBuffer::Merged& m) {
    for (const TileCredit& c : m.credits) credit[c.tile].add(c.credit);
    for (const Contribution& c : m.contributions) light[c.pixel].add(c.light);
  }
  friend bool operator==(const Totals&, const Totals&) = default;
};

PixelReturn some_return(std::mt19937_64& random, std::uint32_t pixels) {
  PixelReturn r;
  r.pixel = static_cast<std::uint32_t>(random() % pixels);
  r.merged = static_cast<std::uint32_t>(random() % 4);
  const auto light = [&] { return static_cast<std::int64_t>(random() >> 30); };
  if (r.merged > 0) r.light = {light(), light(), light()};
  r.credit.add_power(static_cast<int>(random() % 200));
  return r;
}

MergeBuffer::Merged taken(MergeBuffer& buffer) {
  MergeBuffer::Merged all = buffer.gathered();
  buffer.clear();
  return all;
}

void feed(MergeBuffer& buffer, std::span<const PixelReturn> returns, Totals& sent) {
  while (!returns.empty()) {
    returns = returns.subspan(buffer.add(returns, kPlan));
    if (buffer.is_full()) sent.add(taken(buffer));
  }
}

}  // namespace

TEST_CASE("what is merged sums up to what came in, through many fillings") {
  std::mt19937_64 random(1);
  for (const std::uint32_t pixels : {1u, 7u, 300u, 65536u, 5u * 65536u}) {
    INFO(pixels << " pixels, those beyond 65536 for AOVs");
    MergeBuffer buffer;
    Totals came, sent;
    for (int step = 0; step < 40; ++step) {
      std::vector<PixelReturn> returns;
      for (std::size_t i = random() % 3000; i > 0; --i)
        returns.push_back(some_return(random, pixels));
      for (const PixelReturn& r : returns) came.add(r);
      feed(buffer, returns, sent);
    }
    sent.add(taken(buffer));
    CHECK(buffer.is_empty());
    CHECK(sent == came);
  }
}

TEST_CASE("a buffer takes its room when the first light comes, whichever way, and keeps it") {
  PixelReturn r;
  r.merged = 1;
  r.light = {1, 2, 3};
  r.credit.add_power(0);
  const auto room = [](const MergeBuffer& buffer) {
    return buffer.gathered().contributions.capacity();
  };
  MergeBuffer by_pixels, by_tile, gathered;
  gathered.expect_others(true);
  for (const MergeBuffer* buffer : {&by_pixels, &by_tile, &gathered}) CHECK(room(*buffer) == 0);
  CHECK(by_pixels.add({&r, 1}, kPlan) == 1);
  CHECK(by_tile.add_tile({&r, 1}, 0, kPlan) == 1);
  CHECK(gathered.add_gathered(by_tile.gathered().credits, by_tile.gathered().contributions));
  for (MergeBuffer* buffer : {&by_pixels, &by_tile, &gathered}) {
    CHECK(room(*buffer) >= MergeBuffer::kFullPixels);
    buffer->clear();
    CHECK(room(*buffer) >= MergeBuffer::kFullPixels);
  }
}

TEST_CASE("a pixel that comes again is one contribution, until a record can't hold it") {
  for (const bool others : {false, true}) {
    MergeBuffer buffer;
    buffer.expect_others(others);
    const PixelReturn half{9, kMaxMergedContributions / 2, {1, 2, kMaxMergedLight / 2}, Credit{}};
    const std::vector<PixelReturn> returns(3, half);
    REQUIRE(buffer.add(returns, kPlan) == 3);
    if (others) {
      const Contribution once{9, half.light};
      REQUIRE(buffer.add_gathered({}, std::vector(2, once)));
    } else {
      REQUIRE(buffer.add(std::span(returns).first(2), kPlan) == 2);
    }
    const MergeBuffer::Merged merged = taken(buffer);
    REQUIRE(merged.contributions.size() == 3);
    CHECK(merged.contributions[0].light == FixedRgb{2, 4, kMaxMergedLight});
    CHECK(merged.contributions[2].light == half.light);
  }
}

TEST_CASE("what children have gathered is added to what is here, exactly") {
  std::mt19937_64 random(3);
  for (const std::uint32_t pixels : {5u, 4000u, 65536u, 4u * 65536u}) {
    INFO(pixels << " pixels, those beyond 65536 for AOVs");
    std::vector<MergeBuffer> children(3);
    MergeBuffer parent;
    parent.expect_others(true);
    Totals came, sent;
    const auto pass_on = [&](const MergeBuffer::Merged& m) {
      if (!parent.add_gathered(m.credits, m.contributions)) {
        sent.add(taken(parent));
        REQUIRE(parent.add_gathered(m.credits, m.contributions));
      }
      if (parent.is_full()) sent.add(taken(parent));
    };
    for (int step = 0; step < 60; ++step) {
      std::vector<PixelReturn> returns;
      for (std::size_t i = random() % 3000; i > 0; --i)
        returns.push_back(some_return(random, pixels));
      for (const PixelReturn& r : returns) came.add(r);
      if (step % 4 == 3) {
        feed(parent, returns, sent);
        continue;
      }
      MergeBuffer& child = children[static_cast<std::size_t>(step % 4)];
      std::span<const PixelReturn> rest = returns;
      while (!rest.empty()) {
        rest = rest.subspan(child.add(rest, kPlan));
        if (child.is_full()) pass_on(taken(child));
      }
    }
    for (MergeBuffer& child : children) pass_on(taken(child));
    const MergeBuffer::Merged last = taken(parent);
    if (pixels < 5000) CHECK(last.contributions.size() <= pixels);
    sent.add(last);
    CHECK(sent == came);
  }
}

TEST_CASE("gathered light that doesn't fit is left, and what is here stays as it is") {
  MergeBuffer buffer;
  buffer.expect_others(true);
  std::vector<Contribution> many(MergeBuffer::kMostPixels);
  for (std::uint32_t i = 0; i < many.size(); ++i) many[i] = {i, {i, 1, 1}};
  REQUIRE(buffer.add_gathered({}, many));
  CHECK(buffer.is_full());
  CHECK_FALSE(buffer.add_gathered({}, std::vector{Contribution{7, {1, 1, 1}}}));
  CHECK(taken(buffer).contributions == many);
  buffer.expect_others(false);
  CHECK_FALSE(buffer.add_gathered({}, many));
  CHECK(buffer.is_empty());
}

TEST_CASE(
    "a tile's light comes with exactly its credit, also when the buffer fills within the tile") {
  std::mt19937_64 random(2);
  MergeBuffer buffer;
  Totals came, sent;
  const auto first_pixel = kPlan.rect(5).x0;
  for (int step = 0; step < 100; ++step) {
    std::vector<PixelReturn> returns;
    for (std::uint32_t i = 0; i < 250; ++i) {
      PixelReturn r = some_return(random, 1);
      r.pixel = first_pixel + i / 16 * 256 + i % 16;
      came.add(r);
      returns.push_back(r);
    }
    std::span<const PixelReturn> rest = returns;
    while (!rest.empty()) {
      rest = rest.subspan(buffer.add_tile(rest, 5, kPlan));
      if (!buffer.is_full()) continue;
      const MergeBuffer::Merged merged = taken(buffer);
      CHECK(merged.contributions.size() <= MergeBuffer::kFullPixels);
      CHECK(merged.credits.size() == 1);
      sent.add(merged);
    }
  }
  sent.add(taken(buffer));
  CHECK(sent == came);
}
