// The rendered picture inside a figure.
#pragma once

#include <string>

#include "figures/page/svg.hpp"
#include "film/film.hpp"

namespace graycube::figures {

/// Pictures in figures are made smaller until no side is longer than this, in pixels.
inline constexpr std::uint32_t kMostShownSide = 176;

/// A picture on a page, in a box of its own shape.
class ShownPicture {
 public:
  /// As large as fits into `room`, at its middle.
  ShownPicture(const Picture& picture, const Box& room);

  const Box& box() const { return box_; }
  /// The place on the page of a point in pixels of the whole picture.
  Point at(double x, double y) const {
    return {box_.x + x / width_ * box_.width, box_.y + y / height_ * box_.height};
  }
  /// Draws the picture, and white over it with that opacity.
  void draw(Svg& svg, double fade) const;

 private:
  double width_, height_;
  Box box_;
  std::string uri_;
};

/// The mean of each square of k × k pixels, with the least k for which no side is longer than
/// `most`.
Picture shrunk(const Picture& picture, std::uint32_t most);

/// Bytes as base64 writes them (RFC 4648, section 4).
std::string base64_of(std::string_view bytes);

}  // namespace graycube::figures
