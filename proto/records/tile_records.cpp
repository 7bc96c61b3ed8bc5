#include "proto/records/tile_records.hpp"

#include <algorithm>
#include <cstring>

#include "content_digest.hpp"
#include "proto/bytes.hpp"
#include "regions/pixels_of.hpp"

namespace graycube {
namespace {

/// "GCT1" before all, "GCTR" before each record, read as little-endian integers.
constexpr std::uint32_t kHeadMagic = 0x31544347, kRecordMagic = 0x52544347;
/// Magic, four edges, and the number of bytes that follow before the digest.
constexpr std::size_t kRecordHeadBytes = 24, kDigestBytes = 8;
/// A sum takes seven bits of a byte each; AOVs take their words.
constexpr std::size_t kMostSumBytes = 10, kAovPlaneBytes = 12;

std::uint64_t digest_of(std::span<const std::byte> bytes) {
  return ContentDigest().add(bytes).value();
}

template <typename T>
void append(std::vector<std::byte>& out, T value) {
  out.resize(out.size() + sizeof value);
  store_little(out.data() + out.size() - sizeof value, value);
}

/// Small differences, of either sign, take few bytes: at most kMostSumBytes. Returns where they
/// end.
std::byte* put_difference(std::byte* to, std::int64_t now, std::int64_t before) {
  const std::uint64_t d = static_cast<std::uint64_t>(now) - static_cast<std::uint64_t>(before);
  std::uint64_t bits = d << 1 ^ (d >> 63 != 0 ? ~std::uint64_t{0} : 0);
  for (; bits >= 0x80; bits >>= 7) *to++ = static_cast<std::byte>(bits | 0x80);
  *to++ = static_cast<std::byte>(bits);
  return to;
}

/// Reads what put_difference() wrote; false when the bytes end before, or are too many.
bool take_sum(std::span<const std::byte>& bytes, std::int64_t& sum) {
  std::uint64_t bits = 0;
  for (std::size_t i = 0; i < std::min(bytes.size(), kMostSumBytes); ++i) {
    const auto byte = std::to_integer<std::uint64_t>(bytes[i]);
    bits |= (byte & 0x7F) << 7 * i;
    if (byte >= 0x80) continue;
    const std::uint64_t d = bits >> 1 ^ ((bits & 1) != 0 ? ~std::uint64_t{0} : 0);
    sum = static_cast<std::int64_t>(static_cast<std::uint64_t>(sum) + d);
    bytes = bytes.subspan(i + 1);
    return true;
  }
  return false;
}

std::size_t planes_of(const Film& film) {
  std::size_t planes = 0;
  for (std::size_t p = 0; p < kAovPlanes; ++p) planes += film.has_plane_of_aovs(p);
  return planes;
}

struct Record {
  PixelRect tile;
  std::span<const std::byte> pixels;
  std::size_t bytes = 0;
};

/// The record at the beginning of the bytes, if there is a whole one that lies in the picture.
std::optional<Record> record_at(std::span<const std::byte> bytes, const Film& film) {
  if (bytes.size() < kRecordHeadBytes + kDigestBytes) return std::nullopt;
  const auto word = [&](std::size_t i) { return load_little<std::uint32_t>(bytes.data() + 4 * i); };
  if (word(0) != kRecordMagic) return std::nullopt;
  Record record{{word(1), word(2), word(3), word(4)}, {}, kRecordHeadBytes + word(5)};
  const PixelRect& t = record.tile;
  if (t.is_empty() || t.x1 > film.width() || t.y1 > film.pixel_count() / film.width())
    return std::nullopt;
  if (bytes.size() < record.bytes + kDigestBytes) return std::nullopt;
  const auto digest = load_little<std::uint64_t>(bytes.data() + record.bytes);
  if (digest != digest_of(bytes.first(record.bytes))) return std::nullopt;
  record.pixels = bytes.subspan(kRecordHeadBytes, word(5));
  record.bytes += kDigestBytes;
  return record;
}

/// The record's pixels, decoded before any is added.
struct Pixels {
  std::vector<FixedRgb> sums;
  std::vector<AovWords> aovs;
};

bool decode_pixels(const Record& record, std::size_t planes, Pixels& pixels) {
  const PixelRect& t = record.tile;
  const std::uint64_t count = pixel_count_of(t);
  // Each takes three bytes at least, so that memory is bounded by the record's size.
  if (record.pixels.size() < count * (3 + kAovPlaneBytes * planes)) return false;
  auto bytes = record.pixels;
  pixels.sums.resize(count);
  FixedRgb sum;
  for (FixedRgb& s : pixels.sums) {
    if (!take_sum(bytes, sum.r) || !take_sum(bytes, sum.g) || !take_sum(bytes, sum.b)) return false;
    s = sum;
  }
  if (bytes.size() != count * kAovPlaneBytes * planes) return false;
  pixels.aovs.resize(count * planes);
  const std::byte* at = bytes.data();
  for (AovWords& words : pixels.aovs) {
    for (std::uint32_t& word : words) {
      word = load_little<std::uint32_t>(at);
      at += sizeof word;
    }
  }
  return true;
}

void add_pixels(const PixelRect& tile, const Pixels& pixels, Film& film, std::vector<bool>& known) {
  bool is_known = false;
  each_pixel_of(tile, film.width(),
                [&](std::uint32_t pixel, std::size_t) { is_known = is_known || known[pixel]; });
  if (is_known) return;
  each_pixel_of(tile, film.width(), [&](std::uint32_t pixel, std::size_t i) {
    known[pixel] = true;
    film.add(pixel, pixels.sums[i]);
  });
  std::size_t first = 0;
  for (std::size_t p = 0; p < kAovPlanes; ++p) {
    if (!film.has_plane_of_aovs(p)) continue;
    each_pixel_of(tile, film.width(), [&](std::uint32_t pixel, std::size_t i) {
      film.set_aov_words(p, pixel, pixels.aovs[first + i]);
    });
    first += pixels.sums.size();
  }
}

}  // namespace

std::vector<std::byte> encode_records_head(const RecordedPicture& picture) {
  std::vector<std::byte> head;
  append(head, kHeadMagic);
  append(head, picture.content);
  append(head, picture.width);
  append(head, picture.height);
  append(head, std::uint64_t{picture.aovs.bits()});
  append(head, digest_of(head));
  return head;
}

std::optional<RecordedPicture> decode_records_head(std::span<const std::byte> bytes) {
  if (bytes.size() < kRecordsHeadBytes) return std::nullopt;
  const std::span<const std::byte> head = bytes.first(kRecordsHeadBytes - kDigestBytes);
  if (load_little<std::uint32_t>(head.data()) != kHeadMagic ||
      load_little<std::uint64_t>(bytes.data() + head.size()) != digest_of(head))
    return std::nullopt;
  RecordedPicture picture;
  picture.content = load_little<std::uint64_t>(head.data() + 4);
  picture.width = load_little<std::uint32_t>(head.data() + 12);
  picture.height = load_little<std::uint32_t>(head.data() + 16);
  picture.aovs =
      AovSet::from_bits(static_cast<std::uint8_t>(load_little<std::uint64_t>(head.data() + 20)));
  return picture;
}

void append_tile_record(std::vector<std::byte>& records, const Film& film, const PixelRect& tile) {
  const std::size_t begin = records.size();
  append(records, kRecordMagic);
  for (const std::uint32_t edge : {tile.x0, tile.y0, tile.x1, tile.y1}) append(records, edge);
  append(records, std::uint32_t{0});
  // Room for the longest sums at once: to look for it with each byte took a third of the time.
  const std::size_t sums = records.size();
  records.resize(sums + 3 * kMostSumBytes * pixel_count_of(tile));
  std::byte* to = records.data() + sums;
  bool fits = true;
  FixedRgb before;
  each_pixel_of(tile, film.width(), [&](std::uint32_t pixel, std::size_t) {
    const std::optional<FixedRgb> sum = film.short_sum(pixel);
    fits = fits && sum.has_value();
    if (!fits) return;
    to = put_difference(to, sum->r, before.r);
    to = put_difference(to, sum->g, before.g);
    to = put_difference(to, sum->b, before.b);
    before = *sum;
  });
  if (!fits) return records.resize(begin);
  records.resize(static_cast<std::size_t>(to - records.data()));
  for (std::size_t p = 0; p < kAovPlanes; ++p) {
    if (!film.has_plane_of_aovs(p)) continue;
    each_pixel_of(tile, film.width(), [&](std::uint32_t pixel, std::size_t) {
      for (const std::uint32_t word : film.aov_words(p, pixel)) append(records, word);
    });
  }
  const std::size_t payload = records.size() - begin - kRecordHeadBytes;
  store_little(records.data() + begin + kRecordHeadBytes - 4, static_cast<std::uint32_t>(payload));
  append(records, digest_of(std::span(records).subspan(begin)));
}

std::vector<bool> restore_tiles(std::span<const std::byte> records, Film& film) {
  std::vector<bool> known(film.pixel_count(), false);
  const std::size_t planes = planes_of(film);
  Pixels pixels;
  auto left = records.subspan(std::min(records.size(), kRecordsHeadBytes));
  while (!left.empty()) {
    if (const auto record = record_at(left, film)) {
      if (decode_pixels(*record, planes, pixels)) add_pixels(record->tile, pixels, film, known);
      left = left.subspan(record->bytes);
      continue;
    }
    // A record that was cut off when a process ended: the next one begins with its magic.
    const auto first = static_cast<std::byte>(kRecordMagic & 0xFF);
    const auto next = std::find(left.begin() + 1, left.end(), first);
    left = left.subspan(static_cast<std::size_t>(next - left.begin()));
  }
  return known;
}

}  // namespace graycube
