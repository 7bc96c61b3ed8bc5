// Tiles that are recorded and read again, and what damage does to their records.
#include "proto/records/tile_records.hpp"

#include <algorithm>
#include <random>

#include "catch.hpp"

using namespace graycube;

namespace {

constexpr std::uint32_t kWidth = 40, kHeight = 24;
const PixelRect kFirst{0, 0, 16, 16}, kSecond{16, 8, 40, 24};

Film film_of(AovSet aovs = {}) { return Film(kWidth, kHeight, 4, aovs); }

/// A film full of light of all sizes and signs, and of AOVs.
Film lit_film(AovSet aovs = {}) {
  Film film = film_of(aovs);
  std::mt19937_64 random(5);
  for (std::uint32_t p = 0; p < film.pixel_count(); ++p) {
    const auto light = [&] { return static_cast<std::int64_t>(random()) >> (2 + random() % 61); };
    film.add(p, {light(), light(), light()});
    for (std::size_t plane = 0; plane < kAovPlanes; ++plane) {
      if (!film.has_plane_of_aovs(plane)) continue;
      const auto word = [&] { return static_cast<std::uint32_t>(random()); };
      film.set_aov_words(plane, p, {word(), word(), word()});
    }
  }
  return film;
}

std::vector<std::byte> records_of(const Film& film, std::vector<PixelRect> tiles) {
  auto bytes = encode_records_head({77, kWidth, kHeight, {}});
  for (const PixelRect& tile : tiles) append_tile_record(bytes, film, tile);
  return bytes;
}

bool is_in(const PixelRect& r, std::uint32_t p) {
  const std::uint32_t x = p % kWidth, y = p / kWidth;
  return x >= r.x0 && x < r.x1 && y >= r.y0 && y < r.y1;
}

/// Checks that the film holds the pixels of these tiles as the lit one does, and no other light.
void check_holds(const Film& film, const std::vector<bool>& known, const Film& lit,
                 const std::vector<PixelRect>& tiles) {
  std::size_t wrong = 0;
  for (std::uint32_t p = 0; p < film.pixel_count(); ++p) {
    const bool is_wanted =
        std::any_of(tiles.begin(), tiles.end(), [p](const auto& t) { return is_in(t, p); });
    wrong += known[p] != is_wanted;
    wrong += film.short_sum(p) != (is_wanted ? lit.short_sum(p) : FixedRgb{});
    for (std::size_t plane = 0; plane < kAovPlanes; ++plane) {
      if (is_wanted && film.has_plane_of_aovs(plane))
        wrong += film.aov_words(plane, p) != lit.aov_words(plane, p);
    }
  }
  CHECK(wrong == 0);
}

}  // namespace

TEST_CASE("tiles that were recorded are there again to the bit, AOVs too, and no others") {
  const AovSet aovs = GENERATE(AovSet{}, AovSet::all(), AovSet::from_bits(2));
  const Film lit = lit_film(aovs);
  Film film = film_of(aovs);
  const auto known = restore_tiles(records_of(lit, {kFirst, kSecond}), film);
  check_holds(film, known, lit, {kFirst, kSecond});
}

TEST_CASE("records tell which picture they are of") {
  const RecordedPicture picture{0xFEDC'BA98'7654'3210, 16384, 3, AovSet::from_bits(9)};
  const auto head = encode_records_head(picture);
  REQUIRE(head.size() == kRecordsHeadBytes);
  CHECK(decode_records_head(head) == picture);
  for (std::size_t i = 0; i < head.size(); ++i) {
    auto damaged = head;
    damaged[i] ^= std::byte{1};
    CHECK_FALSE(decode_records_head(damaged));
  }
  CHECK_FALSE(decode_records_head(std::span(head).first(head.size() - 1)));
}

TEST_CASE("a record that was cut off is passed over, and those before and behind it are read") {
  const Film lit = lit_film();
  const auto whole = records_of(lit, {kFirst});
  const auto both = records_of(lit, {kFirst, kSecond});
  for (std::size_t cut = kRecordsHeadBytes; cut < whole.size(); cut += 37) {
    // A process ended while it wrote the first record; the next one has appended the second.
    std::vector<std::byte> bytes(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(cut));
    bytes.insert(bytes.end(), both.begin() + static_cast<std::ptrdiff_t>(whole.size()), both.end());
    Film film = film_of();
    check_holds(film, restore_tiles(bytes, film), lit, {kSecond});
  }
  for (std::size_t cut = whole.size(); cut < both.size(); cut += 37) {
    Film film = film_of();
    check_holds(film, restore_tiles(std::span(both).first(cut), film), lit, {kFirst});
  }
}

TEST_CASE("no byte of a record can change unnoticed") {
  const Film lit = lit_film();
  const PixelRect tiny{1, 1, 3, 2};
  const auto sound = records_of(lit, {tiny});
  for (std::size_t i = kRecordsHeadBytes; i < sound.size(); ++i) {
    auto damaged = sound;
    damaged[i] ^= std::byte{0x10};
    Film film = film_of();
    check_holds(film, restore_tiles(damaged, film), lit, {});
  }
}

TEST_CASE("a pixel that is recorded twice counts once") {
  const Film lit = lit_film();
  Film film = film_of();
  const auto known = restore_tiles(records_of(lit, {kFirst, kFirst, {8, 8, 20, 20}}), film);
  check_holds(film, known, lit, {kFirst});
}

TEST_CASE("a tile whose sums leave 64 bits is not recorded") {
  Film lit = lit_film();
  for (int i = 0; i < 3; ++i) lit.add(5, {std::int64_t{1} << 62, 0, 0});
  CHECK_FALSE(lit.short_sum(5));
  Film film = film_of();
  const auto known = restore_tiles(records_of(lit, {kFirst, kSecond}), film);
  check_holds(film, known, lit, {kSecond});
}

TEST_CASE("records of tiles outside the picture are passed over") {
  const Film large(100, 100, 1);
  auto bytes = encode_records_head({77, kWidth, kHeight, {}});
  for (const PixelRect tile : {PixelRect{30, 0, 41, 4}, PixelRect{0, 20, 4, 25}})
    append_tile_record(bytes, large, tile);
  Film film = film_of();
  check_holds(film, restore_tiles(bytes, film), film, {});
}
