#include "proto/picture_rows.hpp"

#include "geometry/check.hpp"
#include "proto/bytes.hpp"
#include "proto/messages.hpp"

namespace graycube {
namespace {

template <typename Value>
std::vector<std::byte> encode_rows(std::span<const Value> values) {
  GRAYCUBE_CHECK(values.size() % 3 == 0 && values.size() <= kMaxPictureBytes / 4, "%zu values",
                 values.size());
  ByteWriter w(values.size() * 4);
  for (const Value v : values) w.put(v);
  return std::move(w).take();
}

template <typename Value>
bool decode_rows(std::span<const std::byte> frame, std::uint32_t width, std::uint32_t rows,
                 std::vector<Value>& values) {
  values.clear();
  const std::uint64_t pixels = std::uint64_t{width} * rows;
  if (frame.size() > kMaxPictureBytes || frame.size() % 12 != 0 || frame.size() / 12 != pixels)
    return false;
  values.resize(frame.size() / 4);
  const std::byte* at = frame.data();
  for (Value& v : values) {
    v = load_little<Value>(at);
    at += 4;
  }
  return true;
}

}  // namespace

std::vector<std::byte> encode_picture_rows(std::span<const float> values) {
  return encode_rows(values);
}
std::vector<std::byte> encode_picture_rows(std::span<const std::uint32_t> words) {
  return encode_rows(words);
}

bool decode_picture_rows(std::span<const std::byte> frame, std::uint32_t width, std::uint32_t rows,
                         std::vector<float>& values) {
  return decode_rows(frame, width, rows, values);
}
bool decode_picture_rows(std::span<const std::byte> frame, std::uint32_t width, std::uint32_t rows,
                         std::vector<std::uint32_t>& words) {
  return decode_rows(frame, width, rows, words);
}

}  // namespace graycube
