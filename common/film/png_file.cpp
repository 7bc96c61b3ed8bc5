// The only file that knows libpng. Its errors are longjmps, so every function that calls it with a
// setjmp behind it keeps objects with destructors out of its frame.
#include <png.h>

#include <array>
#include <cerrno>
#include <csetjmp>
#include <cstddef>
#include <cstdio>
#include <memory>
#include <new>
#include <string>
#include <system_error>
#include <vector>

#include "check.hpp"
#include "film/picture_files.hpp"
#include "film/transfer.hpp"
#include "film/whole_file.hpp"

namespace graycube {
namespace {

/// The text of a libpng error.
struct Complaint {
  std::array<char, 160> text{};
};

[[noreturn]] void on_error(png_structp png, png_const_charp message) {
  auto* complaint = static_cast<Complaint*>(png_get_error_ptr(png));
  std::snprintf(complaint->text.data(), complaint->text.size(), "%s", message);
  png_longjmp(png, 1);
}

void on_warning(png_structp, png_const_charp) {}

struct Layout {
  std::uint32_t width = 0, height = 0;
  int bits = 8;
  std::size_t row_bytes() const {
    return std::size_t{3} * width * static_cast<std::size_t>(bits / 8);
  }
};

// ---- Writing

struct Writer {
  Complaint complaint;
  png_structp png =
      png_create_write_struct(PNG_LIBPNG_VER_STRING, &complaint, on_error, on_warning);
  png_infop info = png != nullptr ? png_create_info_struct(png) : nullptr;

  Writer() = default;
  Writer(const Writer&) = delete;
  Writer& operator=(const Writer&) = delete;
  ~Writer() { png_destroy_write_struct(&png, &info); }
};

void write_bytes(png_structp png, png_bytep bytes, png_size_t count) {
  auto* file = static_cast<WholeFile*>(png_get_io_ptr(png));
  if (!file->write(bytes, count)) png_error(png, "write failed");
}

/// Never throws across libpng: a failure is one of libpng's.
void append_bytes(png_structp png, png_bytep bytes, png_size_t count) {
  auto* text = static_cast<std::string*>(png_get_io_ptr(png));
  bool is_full = false;
  try {
    text->append(reinterpret_cast<const char*>(bytes), count);
  } catch (const std::bad_alloc&) {
    is_full = true;
  }
  if (is_full) png_error(png, "there is not enough memory");
}

void flush_nothing(png_structp) {}

/// Big-endian 16-bit or 8-bit samples of one row.
void encode_row(const float* linear, const Layout& layout, png_bytep out) {
  const std::size_t samples = std::size_t{3} * layout.width;
  for (std::size_t i = 0; i < samples; ++i) {
    if (layout.bits == 8) {
      out[i] = srgb_8_bit(linear[i]);
    } else {
      const std::uint16_t sample = linear_16_bit(linear[i]);
      out[2 * i] = static_cast<png_byte>(sample >> 8);
      out[2 * i + 1] = static_cast<png_byte>(sample & 0xFF);
    }
  }
}

/// Where the bytes of a PNG go: what libpng calls, and with what.
struct Sink {
  png_rw_ptr write;
  void* to;
};

/// False when libpng complained. `row` holds layout.row_bytes().
bool encode(Writer& writer, const Sink& sink, const Layout& layout, const float* rgb,
            png_bytep row) {
  png_structp png = writer.png;
  if (setjmp(png_jmpbuf(png)) != 0) return false;
  png_set_write_fn(png, sink.to, sink.write, flush_nothing);
  png_set_IHDR(png, writer.info, layout.width, layout.height, layout.bits, PNG_COLOR_TYPE_RGB,
               PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  if (layout.bits == 8) {
    png_set_sRGB_gAMA_and_cHRM(png, writer.info, PNG_sRGB_INTENT_PERCEPTUAL);
  } else {
    png_set_gAMA(png, writer.info, 1.0);
  }
  // All rows as differences, compressed fast, take a third of the time of libpng's defaults, which
  // try every filter, for files a sixth larger at most (docs/lab/2026-11-22-files.md).
  png_set_filter(png, PNG_FILTER_TYPE_BASE, PNG_FILTER_SUB);
  png_set_compression_level(png, 1);
  png_write_info(png, writer.info);
  for (std::uint32_t y = 0; y < layout.height; ++y) {
    encode_row(rgb + std::size_t{3} * layout.width * y, layout, row);
    png_write_row(png, row);
  }
  png_write_end(png, nullptr);
  return true;
}

// ---- Reading

struct Reader {
  Complaint complaint;
  png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &complaint, on_error, on_warning);
  png_infop info = png != nullptr ? png_create_info_struct(png) : nullptr;

  Reader() = default;
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;
  ~Reader() { png_destroy_read_struct(&png, &info, nullptr); }
};

/// libpng's largest allocation for one ancillary chunk; pictures need none of them.
constexpr png_alloc_size_t kMaxChunkBytes = png_alloc_size_t{1} << 20;

/// Reads up to the pixels and asks for RGB of 8 or 16 bits. False when libpng complained.
bool decode_header(Reader& reader, std::FILE* file, Layout& layout) {
  png_structp png = reader.png;
  if (setjmp(png_jmpbuf(png)) != 0) return false;
  png_init_io(png, file);
  png_set_user_limits(png, kMaxPictureSide, kMaxPictureSide);
  png_set_chunk_malloc_max(png, kMaxChunkBytes);
  png_read_info(png, reader.info);
  png_set_expand(png);  // palettes to RGB, 1, 2 and 4 bits to 8
  png_set_gray_to_rgb(png);
  png_set_strip_alpha(png);
  png_set_interlace_handling(png);
  png_read_update_info(png, reader.info);
  layout = {png_get_image_width(png, reader.info), png_get_image_height(png, reader.info),
            png_get_bit_depth(png, reader.info)};
  if (png_get_rowbytes(png, reader.info) != layout.row_bytes()) png_error(png, "unexpected layout");
  return true;
}

bool decode_pixels(Reader& reader, png_bytepp rows) {
  png_structp png = reader.png;
  if (setjmp(png_jmpbuf(png)) != 0) return false;
  png_read_image(png, rows);
  png_read_end(png, nullptr);
  return true;
}

[[noreturn]] void fail_to_read(const std::filesystem::path& path, const std::string& why) {
  throw PictureError("cannot read picture: " + path.string() + ": " + why);
}

}  // namespace

void write_png(const std::filesystem::path& path, const Picture& picture) {
  const std::uint64_t pixels = std::uint64_t{picture.width} * picture.height;
  GRAYCUBE_CHECK(pixels > 0 && picture.rgb.size() == 3 * pixels, "%u x %u pixels, %zu floats",
                 picture.width, picture.height, picture.rgb.size());
  const Layout layout{picture.width, picture.height,
                      path.filename().string().ends_with(".linear.png") ? 16 : 8};
  std::vector<png_byte> row(layout.row_bytes());
  WholeFile file(path);
  Writer writer;
  if (writer.info == nullptr) throw std::bad_alloc();
  const Sink sink{write_bytes, &file};
  if (!encode(writer, sink, layout, picture.rgb.data(), row.data()) && !file.failed()) {
    throw PictureError("cannot write picture: " + path.string() + ": " +
                       writer.complaint.text.data());
  }
  file.commit();  // reports a failed write
}

std::string png_text(const Picture& picture) {
  const std::uint64_t pixels = std::uint64_t{picture.width} * picture.height;
  GRAYCUBE_CHECK(pixels > 0 && picture.rgb.size() == 3 * pixels, "%u x %u pixels, %zu floats",
                 picture.width, picture.height, picture.rgb.size());
  const Layout layout{picture.width, picture.height, 8};
  std::vector<png_byte> row(layout.row_bytes());
  std::string text;
  Writer writer;
  if (writer.info == nullptr) throw std::bad_alloc();
  if (!encode(writer, {append_bytes, &text}, layout, picture.rgb.data(), row.data())) {
    throw PictureError(std::string("cannot write picture: ") + writer.complaint.text.data());
  }
  return text;
}

PngImage read_png(const std::filesystem::path& path) {
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rbe"),
                                                             std::fclose);
  if (!file) fail_to_read(path, std::generic_category().message(errno));
  Reader reader;
  if (reader.info == nullptr) throw std::bad_alloc();
  Layout layout;
  if (!decode_header(reader, file.get(), layout)) fail_to_read(path, reader.complaint.text.data());
  const std::uint64_t pixels = std::uint64_t{layout.width} * layout.height;
  if (pixels > kMaxPicturePixels) fail_to_read(path, "too many pixels");

  std::vector<png_byte> bytes(layout.row_bytes() * layout.height);
  std::vector<png_bytep> rows(layout.height);
  for (std::size_t y = 0; y < rows.size(); ++y) rows[y] = bytes.data() + y * layout.row_bytes();
  if (!decode_pixels(reader, rows.data())) fail_to_read(path, reader.complaint.text.data());

  PngImage image{layout.width, layout.height, layout.bits, {}};
  image.rgb.resize(3 * pixels);
  for (std::size_t i = 0; i < image.rgb.size(); ++i) {
    image.rgb[i] = layout.bits == 8
                       ? bytes[i]
                       : static_cast<std::uint16_t>(bytes[2 * i] << 8 | bytes[2 * i + 1]);
  }
  return image;
}

}  // namespace graycube
