#include "proto/bytes.hpp"

#include "catch.hpp"
#include "proto/messages.hpp"
#include "proto/picture_rows.hpp"

using namespace graycube;

TEST_CASE("fields are written little-endian, whatever the machine") {
  ByteWriter w(1 + 2 + 4 + 8 + 8);
  w.put(std::uint8_t{0x01});
  w.put(std::uint16_t{0x0302});
  w.put(std::uint32_t{0x07060504});
  w.put(std::int64_t{-2});
  w.put(1.0);
  const std::vector<std::byte> bytes = std::move(w).take();
  const unsigned char expected[] = {1,    2,    3,    4, 5, 6, 7, 0xFE, 0xFF, 0xFF, 0xFF, 0xFF,
                                    0xFF, 0xFF, 0xFF, 0, 0, 0, 0, 0,    0,    0xF0, 0x3F};
  REQUIRE(bytes.size() == std::size(expected));
  for (std::size_t i = 0; i < bytes.size(); ++i)
    CHECK(std::to_integer<int>(bytes[i]) == expected[i]);
}

TEST_CASE("a reader gives back what a writer wrote") {
  ByteWriter w(8 + 4 + 1);
  w.put(-0.0);
  w.put(1.5f);
  w.put(std::uint8_t{200});
  const auto bytes = std::move(w).take();
  ByteReader r(bytes);
  CHECK(std::signbit(r.get<double>()));
  CHECK(r.get<float>() == 1.5f);
  CHECK(r.get<std::uint8_t>() == 200);
  CHECK(r.ok());
  CHECK(r.remaining() == 0);
}

TEST_CASE("a reader's failure is sticky, even when a shorter field would fit") {
  const std::vector<std::byte> bytes(3, std::byte{7});
  ByteReader r(bytes);
  CHECK(r.get<std::uint32_t>() == 0);
  CHECK_FALSE(r.ok());
  CHECK(r.get<std::uint8_t>() == 0);
  CHECK(r.take(0) == nullptr);
  CHECK(r.remaining() == 0);
}

TEST_CASE("a length near the largest integer doesn't wrap round") {
  const std::vector<std::byte> bytes(16);
  ByteReader r(bytes);
  r.get<std::uint64_t>();
  CHECK(r.take(static_cast<std::size_t>(-4)) == nullptr);
  CHECK_FALSE(r.ok());
}

TEST_CASE("picture rows come back bit for bit, infinities included") {
  const std::vector<float> values{0.0f, -0.0f, 1.5f, 1e30f, std::numeric_limits<float>::infinity(),
                                  2.0f};
  const auto frame = encode_picture_rows(values);
  CHECK(frame.size() == 24);
  std::vector<float> again(6);
  REQUIRE(decode_picture_rows(frame, again));
  CHECK(std::memcmp(again.data(), values.data(), 24) == 0);
}

TEST_CASE("rows of AOVs come back bit for bit, signalling NaNs included") {
  const std::vector<std::uint32_t> words{0, 0x7F800001, 0xFFFFFFFF, 1, 2, 0x80000000};
  std::vector<std::uint32_t> again(6);
  REQUIRE(decode_picture_rows(encode_picture_rows(words), again));
  CHECK(again == words);
}

TEST_CASE("picture rows of another size than announced are refused") {
  const auto frame = encode_picture_rows(std::vector<float>(6));
  std::vector<float> values(12, 1.0f);
  CHECK_FALSE(decode_picture_rows(frame, values));
  CHECK_FALSE(decode_picture_rows(frame, std::span(values).first(3)));
  CHECK_FALSE(decode_picture_rows(std::span(frame).first(23), std::span(values).first(6)));
  CHECK_FALSE(decode_picture_rows({}, values));
  CHECK(values == std::vector<float>(12, 1.0f));
}
