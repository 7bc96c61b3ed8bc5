// Pictures as files: OpenEXR and PNG. The only place that knows either library.
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "film/film.hpp"

namespace graycube {

/// A picture file could not be written or read; what() says which and why.
struct PictureError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The attributes that an EXR's header gives beside the picture's size. No time, host or user:
/// equal pictures make equal files.
struct PictureOrigin {
  std::string scene;    // attribute "scene": the scene file's name without folders
  std::string version;  // attribute "graycube"
};

/// Writes R, G, B as 32-bit floats, and the picture's AOVs as depth.Z, normal.X/Y/Z, albedo.R/G/B
/// and object.I (unsigned); ZIP-compressed where that pays, as the pixels alone decide. Identical
/// input gives identical bytes whatever the thread count. The file appears whole or not at all
/// (written beside, then renamed).
void write_exr(const std::filesystem::path& path, const Picture& picture,
               const PictureOrigin& origin);
/// The picture is the file's display window. Pixels of its data window outside that are dropped;
/// where there are no data it is black.
Picture read_exr(const std::filesystem::path& path);

/// Writes 16-bit linear RGB, floor(65535 · clamp(v, 0, 1) + 0.5), if the name ends in
/// ".linear.png"; else 8-bit sRGB. The file appears whole or not at all, like that of write_exr().
void write_png(const std::filesystem::path& path, const Picture& picture);

/// The bytes of a PNG with 8-bit sRGB, as write_png() writes them.
std::string png_text(const Picture& picture);

/// A PNG's samples as stored: 8 or 16 bits, RGB (grey is widened, alpha dropped).
struct PngImage {
  std::uint32_t width = 0, height = 0;
  int bits = 8;
  std::vector<std::uint16_t> rgb;
};
PngImage read_png(const std::filesystem::path& path);

}  // namespace graycube
