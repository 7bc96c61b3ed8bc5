#include "figures/page/shown_picture.hpp"

#include <algorithm>

#include "film/picture_files.hpp"

namespace graycube::figures {

Picture shrunk(const Picture& picture, std::uint32_t most) {
  const std::uint32_t longest = std::max(picture.width, picture.height);
  const std::uint32_t k = (longest + most - 1) / most;
  if (k <= 1) return {picture.width, picture.height, picture.rgb, {}, {}};
  Picture small;
  small.width = (picture.width + k - 1) / k;
  small.height = (picture.height + k - 1) / k;
  small.rgb.reserve(std::size_t{3} * small.width * small.height);
  for (std::uint32_t y = 0; y < small.height; ++y) {
    for (std::uint32_t x = 0; x < small.width; ++x) {
      const std::uint32_t x1 = std::min(picture.width, (x + 1) * k);
      const std::uint32_t y1 = std::min(picture.height, (y + 1) * k);
      double sum[3] = {0, 0, 0};
      for (std::uint32_t j = y * k; j < y1; ++j) {
        for (std::uint32_t i = x * k; i < x1; ++i) {
          for (std::size_t c = 0; c < 3; ++c) {
            sum[c] += picture.rgb[3 * (std::size_t{j} * picture.width + i) + c];
          }
        }
      }
      const double pixels = static_cast<double>(x1 - x * k) * (y1 - y * k);
      for (const double s : sum) small.rgb.push_back(static_cast<float>(s / pixels));
    }
  }
  return small;
}

std::string base64_of(std::string_view bytes) {
  constexpr std::string_view kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t group = 0;
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
    for (std::size_t j = 0; j < 3; ++j) {
      group = group << 8 | (j < count ? static_cast<unsigned char>(bytes[i + j]) : 0u);
    }
    for (std::size_t j = 0; j < 4; ++j) {
      text += j <= count ? kDigits[group >> (18 - 6 * j) & 63] : '=';
    }
  }
  return text;
}

ShownPicture::ShownPicture(const Picture& picture, const Box& room)
    : width_(picture.width),
      height_(picture.height),
      uri_("data:image/png;base64," + base64_of(png_text(shrunk(picture, kMostShownSide)))) {
  const double scale = std::min(room.width / width_, room.height / height_);
  box_ = {room.center().x - scale * width_ / 2, room.center().y - scale * height_ / 2,
          scale * width_, scale * height_};
}

void ShownPicture::draw(Svg& svg, double fade) const {
  svg.image(box_, uri_);
  svg.rectangle(box_, {.fill = "#ffffff", .opacity = fade});
  svg.rectangle(box_, {.stroke = "#1f2933", .width = 1});
}

}  // namespace graycube::figures
