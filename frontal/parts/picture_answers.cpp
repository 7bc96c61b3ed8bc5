#include "frontal/parts/picture_answers.hpp"

#include <algorithm>
#include <span>

#include "proto/picture_rows.hpp"

namespace graycube {

Answer picture_rows(const Picture& picture, const control::Fetch& m) {
  if (m.first_row >= picture.height) {
    return Refusal{m.job, FailureCode::kBadRequest, "first_row", "beyond the picture"};
  }
  if (m.plane > 0 && !has_plane(picture.aovs, m.plane - 1)) {
    return Refusal{m.job, FailureCode::kBadRequest, "plane", "the picture has no such AOVs"};
  }
  const std::size_t row_values = std::size_t{picture.width} * 3;
  const std::size_t most = std::max<std::size_t>(1, kPictureChunkBytes / (row_values * 4));
  control::Picture out;
  out.job = m.job;
  out.width = picture.width;
  out.height = picture.height;
  out.first_row = m.first_row;
  out.rows = static_cast<std::uint32_t>(
      std::min<std::size_t>({most, m.rows, picture.height - m.first_row}));
  out.plane = m.plane;
  out.aov = to_string(picture.aovs);
  const auto rows = [&](const auto& values) {
    return encode_picture_rows(
        std::span(values).subspan(m.first_row * row_values, out.rows * row_values));
  };
  return Reply{out, m.plane == 0 ? rows(picture.rgb) : rows(picture.aov_planes[m.plane - 1])};
}

Answer write_picture(const Picture& picture, const control::Write& m, const PictureOrigin& origin,
                     const std::function<double()>& used_s) {
  if (std::uint64_t{picture.width} * picture.height > kMostPixelsToWrite) {
    return Refusal{m.job, FailureCode::kTooLarge, "", "the picture has to be fetched"};
  }
  const double began_s = used_s();
  const char* option = "-o";
  try {
    if (!m.exr.empty()) write_exr(m.exr, picture, origin);
    option = "--png";
    if (!m.png.empty()) write_png(m.png, picture);
  } catch (const PictureError& e) {
    return Refusal{m.job, FailureCode::kFailed, option, e.what()};
  }
  return Reply{control::Written{m.job, picture.width, picture.height, used_s() - began_s}};
}

}  // namespace graycube
