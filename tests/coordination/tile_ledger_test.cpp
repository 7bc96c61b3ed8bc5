#include "coordination/tile_ledger.hpp"

#include <algorithm>
#include <random>
#include <utility>
#include <vector>

#include "catch.hpp"

namespace graycube {
namespace {

Credit units(std::uint64_t n) { return Credit::from_words({n, 0, 0, 0, 0}); }
Credit power(int exponent) {
  Credit credit;
  credit.add_power(exponent);
  return credit;
}

TEST_CASE("a tile is whole when one unit for each of its primary rays has come back") {
  TileLedger ledger({2, 1});
  CHECK(ledger.add(0, units(1)) == CreditResult::kOpen);
  CHECK(ledger.add(0, power(1)) == CreditResult::kOpen);
  CHECK_FALSE(ledger.is_whole(0));
  CHECK(ledger.add(0, power(1)) == CreditResult::kWhole);
  CHECK(ledger.is_whole(0));
  CHECK(ledger.whole_count() == 1);
  CHECK(ledger.open_tiles() == std::vector<std::uint32_t>{1});
  CHECK_FALSE(ledger.all_whole());
  CHECK(ledger.add(1, units(1)) == CreditResult::kWhole);
  CHECK(ledger.all_whole());
}

TEST_CASE("a tile without primary rays is whole at once and stays so when cleared") {
  TileLedger ledger({0, 3});
  CHECK(ledger.is_whole(0));
  ledger.clear(0);
  CHECK(ledger.is_whole(0));
  CHECK(ledger.whole_count() == 1);
  CHECK(TileLedger({}).all_whole());
}

TEST_CASE("more credit than primary rays is refused and changes nothing") {
  TileLedger ledger({2});
  CHECK(ledger.add(0, units(3)) == CreditResult::kOverflow);
  CHECK(ledger.add(0, units(1)) == CreditResult::kOpen);
  Credit above = units(1);
  above.add_power(255);
  CHECK(ledger.add(0, above) == CreditResult::kOverflow);
  CHECK(ledger.add(0, units(~std::uint64_t{0})) == CreditResult::kOverflow);
  CHECK(ledger.add(0, units(1)) == CreditResult::kWhole);
}

TEST_CASE("a whole tile takes nothing more, not even nothing") {
  TileLedger ledger({1});
  CHECK(ledger.add(0, units(1)) == CreditResult::kWhole);
  CHECK(ledger.add(0, power(255)) == CreditResult::kOverflow);
  CHECK(ledger.add(0, Credit{}) == CreditResult::kOverflow);
  CHECK(ledger.is_whole(0));
}

TEST_CASE("credit for a tile that does not exist is refused") {
  TileLedger ledger({1, 1});
  CHECK(ledger.add(2, units(1)) == CreditResult::kUnknownTile);
  CHECK(ledger.add(0xffffffffu, units(1)) == CreditResult::kUnknownTile);
}

TEST_CASE("a cleared tile needs all of its credit again") {
  TileLedger ledger({1, 1});
  CHECK(ledger.add(0, power(1)) == CreditResult::kOpen);
  ledger.clear(0);
  CHECK(ledger.add(0, power(1)) == CreditResult::kOpen);
  CHECK(ledger.add(0, power(1)) == CreditResult::kWhole);
  ledger.clear(0);
  CHECK(ledger.whole_count() == 0);
  CHECK(ledger.open_tiles() == std::vector<std::uint32_t>{0, 1});
  CHECK(ledger.add(0, units(1)) == CreditResult::kWhole);
}

TEST_CASE("tiles become whole with the last piece of credit, in whatever order it comes") {
  for (std::uint32_t seed = 0; seed < 50; ++seed) {
    std::mt19937 engine(seed);
    std::vector<std::uint32_t> rays(20);
    std::vector<std::pair<std::uint32_t, Credit>> pieces;
    for (std::uint32_t tile = 0; tile < rays.size(); ++tile) {
      rays[tile] = 1 + static_cast<std::uint32_t>(engine() % 4);
      for (std::uint32_t ray = 0; ray < rays[tile]; ++ray) {
        const int last = 1 + static_cast<int>(engine() % 255);
        for (int e = 1; e <= last; ++e) pieces.emplace_back(tile, power(e));
        pieces.emplace_back(tile, power(last));
      }
    }
    std::shuffle(pieces.begin(), pieces.end(), engine);
    std::vector<std::size_t> left(rays.size());
    for (const auto& piece : pieces) ++left[piece.first];
    TileLedger ledger(rays);
    bool as_expected = true;
    for (const auto& [tile, credit] : pieces) {
      const auto expected = --left[tile] == 0 ? CreditResult::kWhole : CreditResult::kOpen;
      as_expected = as_expected && ledger.add(tile, credit) == expected;
    }
    CAPTURE(seed);
    CHECK(as_expected);
    CHECK(ledger.all_whole());
  }
}

}  // namespace
}  // namespace graycube
