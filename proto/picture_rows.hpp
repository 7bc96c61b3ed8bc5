// The binary frame behind `picture`: rows of little-endian float32 R, G, B, or of the three words of
// a plane of AOVs, top row first.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace graycube {

/// `values` are R, G, B of pixel after pixel; at most kMaxPictureBytes of them.
std::vector<std::byte> encode_picture_rows(std::span<const float> values);
/// The same for a plane of AOVs.
std::vector<std::byte> encode_picture_rows(std::span<const std::uint32_t> words);

/// False, and `values` empty, when the frame doesn't hold exactly `rows` rows of `width` pixels or
/// is larger than kMaxPictureBytes. Any bits are a value: pictures may hold infinities.
[[nodiscard]] bool decode_picture_rows(std::span<const std::byte> frame, std::uint32_t width,
                                       std::uint32_t rows, std::vector<float>& values);
[[nodiscard]] bool decode_picture_rows(std::span<const std::byte> frame, std::uint32_t width,
                                       std::uint32_t rows, std::vector<std::uint32_t>& words);

}  // namespace graycube
