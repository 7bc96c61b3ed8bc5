#include "proto/picture_rows.hpp"

#include "check.hpp"
#include "proto/bytes.hpp"
#include "proto/messages.hpp"

namespace graycube {
namespace {

constexpr std::size_t kValueBytes = 4;

template <typename Value>
std::vector<std::byte> encode_rows(std::span<const Value> values) {
  GRAYCUBE_CHECK(values.size() % 3 == 0 && values.size() <= kMaxPictureBytes / kValueBytes,
                 "%zu values", values.size());
  ByteWriter w(values.size() * kValueBytes);
  std::byte* at = w.room(values.size() * kValueBytes);
  for (std::size_t i = 0; i < values.size(); ++i) store_little(at + kValueBytes * i, values[i]);
  return std::move(w).take();
}

template <typename Value>
bool decode_rows(std::span<const std::byte> frame, std::span<Value> values) {
  if (frame.size() % kValueBytes != 0 || frame.size() / kValueBytes != values.size()) return false;
  for (std::size_t i = 0; i < values.size(); ++i)
    values[i] = load_little<Value>(frame.data() + kValueBytes * i);
  return true;
}

}  // namespace

std::vector<std::byte> encode_picture_rows(std::span<const float> values) {
  return encode_rows(values);
}
std::vector<std::byte> encode_picture_rows(std::span<const std::uint32_t> words) {
  return encode_rows(words);
}

bool decode_picture_rows(std::span<const std::byte> frame, std::span<float> values) {
  return decode_rows(frame, values);
}
bool decode_picture_rows(std::span<const std::byte> frame, std::span<std::uint32_t> words) {
  return decode_rows(frame, words);
}

}  // namespace graycube
