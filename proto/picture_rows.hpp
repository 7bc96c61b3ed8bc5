// The binary frame behind `picture`: rows of little-endian float32 R, G, B, or of the three words
// of a plane of AOVs, top row first.
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

/// Fills `values`, three for each pixel of the rows announced. False, and nothing written, when the
/// frame doesn't hold exactly these. Any bits are a value: pictures may hold infinities.
[[nodiscard]] bool decode_picture_rows(std::span<const std::byte> frame, std::span<float> values);
[[nodiscard]] bool decode_picture_rows(std::span<const std::byte> frame,
                                       std::span<std::uint32_t> words);

}  // namespace graycube
