// The only file that knows OpenEXR.
#include <OpenEXR/Iex.h>
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStringAttribute.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <exception>

#include "check.hpp"
#include "film/picture_files.hpp"
#include "film/whole_file.hpp"

namespace graycube {
namespace {

constexpr std::array<const char*, 3> kChannels{"R", "G", "B"};
constexpr std::size_t kPixelBytes = 3 * sizeof(float);

/// A word of a plane of AOVs as a channel; every word has 32 bits.
struct AovChannel {
  const char* name;
  Aov aov;
  std::size_t plane, word;
  Imf::PixelType type;
};
constexpr std::array<AovChannel, 8> kAovChannels{{
    {"depth.Z", Aov::kDepth, kDepthPlane, 0, Imf::FLOAT},
    {"normal.X", Aov::kNormal, kNormalPlane, 0, Imf::FLOAT},
    {"normal.Y", Aov::kNormal, kNormalPlane, 1, Imf::FLOAT},
    {"normal.Z", Aov::kNormal, kNormalPlane, 2, Imf::FLOAT},
    {"albedo.R", Aov::kAlbedo, kAlbedoPlane, 0, Imf::FLOAT},
    {"albedo.G", Aov::kAlbedo, kAlbedoPlane, 1, Imf::FLOAT},
    {"albedo.B", Aov::kAlbedo, kAlbedoPlane, 2, Imf::FLOAT},
    {"object.I", Aov::kObject, kDepthPlane, 1, Imf::UINT},
}};

/// OpenEXR's view of a WholeFile. OpenEXR swallows what is thrown while its file closes; WholeFile
/// remembers it.
class Stream : public Imf::OStream {
 public:
  Stream(WholeFile& file, const char* name) : Imf::OStream(name), file_(file) {}

  void write(const char bytes[], int count) override {
    if (!file_.write(bytes, static_cast<std::size_t>(count))) throw Iex::IoExc("write failed");
  }
  uint64_t tellp() override { return file_.position(); }
  void seekp(uint64_t position) override {
    if (!file_.seek(position)) throw Iex::IoExc("seek failed");
  }

 private:
  WholeFile& file_;
};

/// OpenEXR's slices are declared for reading and writing alike, hence the mutable pointer.
Imf::FrameBuffer frame_of(Picture& picture, const Imath::Box2i& window) {
  const auto width = static_cast<std::size_t>(window.max.x - window.min.x) + 1;
  Imf::FrameBuffer frame;
  for (std::size_t c = 0; c < kChannels.size(); ++c) {
    frame.insert(kChannels[c], Imf::Slice::Make(Imf::FLOAT, picture.rgb.data() + c, window,
                                                kPixelBytes, width * kPixelBytes));
  }
  for (const AovChannel& c : kAovChannels) {
    if (!picture.aovs.has(c.aov)) continue;
    frame.insert(c.name, Imf::Slice::Make(c.type, picture.aov_planes[c.plane].data() + c.word,
                                          window, kPixelBytes, width * kPixelBytes));
  }
  return frame;
}

/// A plane of background words: those that no channel of the file fills keep them.
std::vector<std::uint32_t> blank_plane(std::size_t plane, std::uint64_t pixels) {
  const AovWords words = aov_background(plane);
  std::vector<std::uint32_t> blank;
  blank.reserve(3 * pixels);
  for (std::uint64_t i = 0; i < pixels; ++i) blank.insert(blank.end(), words.begin(), words.end());
  return blank;
}

[[noreturn]] void fail_to_read(const std::filesystem::path& path, std::string why) {
  // OpenEXR names the file itself.
  const std::string named = "Cannot read image file \"" + path.string() + "\". ";
  if (why.starts_with(named)) why.erase(0, named.size());
  throw PictureError("cannot read picture: " + path.string() + ": " + why);
}

void check_channels(const std::filesystem::path& path, const Imf::ChannelList& channels) {
  for (const char* name : kChannels) {
    const Imf::Channel* channel = channels.findChannel(name);
    if (channel == nullptr) fail_to_read(path, std::string("no channel ") + name);
    if (channel->xSampling != 1 || channel->ySampling != 1)
      fail_to_read(path, "subsampled channels");
  }
}

/// The AOVs whose channels are all there, of the types that we write.
AovSet aovs_among(const Imf::ChannelList& channels) {
  std::uint8_t bits = AovSet::kAllBits;
  for (const AovChannel& c : kAovChannels) {
    const Imf::Channel* channel = channels.findChannel(c.name);
    const bool is_ours = channel != nullptr && channel->type == c.type && channel->xSampling == 1 &&
                         channel->ySampling == 1;
    if (!is_ours) bits &= static_cast<std::uint8_t>(~(1u << static_cast<unsigned>(c.aov)));
  }
  return AovSet::from_bits(bits);
}

/// Shading is noise to a compressor: ZIP takes 200 to 300 ms for a megapixel of it, a good part of
/// the time for tracing, to halve the file. If three quarters of the pixels repeat the one before,
/// as on a plain background, it is fast and shrinks the file to a fraction
/// (docs/lab/2026-11-22-files.md).
Imf::Compression compression_for(const Picture& picture) {
  constexpr std::size_t kStep = 3;
  std::size_t repeats = 0;
  for (std::size_t i = kStep; i < picture.rgb.size(); i += kStep) {
    const float* at = picture.rgb.data() + i;
    repeats += at[0] == at[-3] && at[1] == at[-2] && at[2] == at[-1] ? 1 : 0;
  }
  const std::size_t pixels = picture.rgb.size() / kStep;
  return repeats >= pixels - pixels / 4 ? Imf::ZIP_COMPRESSION : Imf::NO_COMPRESSION;
}

/// OpenEXR allocates tables by the header's size before anyone can look at it; this is its own
/// guard.
void limit_header_sizes() {
  static const bool limited = [] {
    Imf::Header::setMaxImageSize(static_cast<int>(kMaxPictureSide),
                                 static_cast<int>(kMaxPictureSide));
    return true;
  }();
  static_cast<void>(limited);
}

/// A black picture without anything in it, as large as the window.
Picture blank_picture(const std::filesystem::path& path, const Imath::Box2i& window, AovSet aovs) {
  const std::int64_t width = std::int64_t{window.max.x} - window.min.x + 1;
  const std::int64_t height = std::int64_t{window.max.y} - window.min.y + 1;
  if (width < 1 || height < 1) fail_to_read(path, "a window without pixels");
  if (width > std::int64_t{kMaxPictureSide} || height > std::int64_t{kMaxPictureSide} ||
      static_cast<std::uint64_t>(width * height) > kMaxPicturePixels) {
    fail_to_read(path, "too many pixels");
  }
  Picture picture;
  picture.width = static_cast<std::uint32_t>(width);
  picture.height = static_cast<std::uint32_t>(height);
  const std::uint64_t pixels = std::uint64_t{picture.width} * picture.height;
  picture.rgb.resize(3 * pixels);
  picture.aovs = aovs;
  for (std::size_t p = 0; p < kAovPlanes; ++p) {
    if (has_plane(aovs, p)) picture.aov_planes[p] = blank_plane(p, pixels);
  }
  return picture;
}

/// Copies the pixels that two windows of one plane have in common.
void copy_common(const Picture& from, const Imath::Box2i& from_window, Picture& to,
                 const Imath::Box2i& to_window) {
  const int left = std::max(from_window.min.x, to_window.min.x);
  const int right = std::min(from_window.max.x, to_window.max.x);
  if (left > right) return;
  const auto index = [&](const Picture& picture, const Imath::Box2i& window, int y) {
    const auto row = static_cast<std::size_t>(std::int64_t{y} - window.min.y);
    return 3 * (row * picture.width + static_cast<std::size_t>(std::int64_t{left} - window.min.x));
  };
  const std::size_t count = 3 * (static_cast<std::size_t>(right - left) + 1);
  const int bottom = std::min(from_window.max.y, to_window.max.y);
  for (int y = std::max(from_window.min.y, to_window.min.y); y <= bottom; ++y) {
    const std::size_t source = index(from, from_window, y), target = index(to, to_window, y);
    std::copy_n(from.rgb.data() + source, count, to.rgb.data() + target);
    for (std::size_t p = 0; p < kAovPlanes; ++p) {
      if (!has_plane(from.aovs, p)) continue;
      std::copy_n(from.aov_planes[p].data() + source, count, to.aov_planes[p].data() + target);
    }
  }
}

}  // namespace

void write_exr(const std::filesystem::path& path, const Picture& picture,
               const PictureOrigin& origin) {
  const std::uint64_t pixels = std::uint64_t{picture.width} * picture.height;
  GRAYCUBE_CHECK(pixels > 0 && picture.rgb.size() == 3 * pixels, "%u x %u pixels, %zu floats",
                 picture.width, picture.height, picture.rgb.size());
  WholeFile file(path);
  try {
    Imf::Header header(static_cast<int>(picture.width), static_cast<int>(picture.height));
    header.compression() = compression_for(picture);
    for (const char* name : kChannels) header.channels().insert(name, Imf::Channel(Imf::FLOAT));
    for (const AovChannel& c : kAovChannels) {
      if (picture.aovs.has(c.aov)) header.channels().insert(c.name, Imf::Channel(c.type));
    }
    header.insert("scene", Imf::StringAttribute(origin.scene));
    header.insert("graycube", Imf::StringAttribute(origin.version));

    const std::string name = path.string();
    Stream stream(file, name.c_str());
    Imf::OutputFile output(stream, header);
    output.setFrameBuffer(frame_of(const_cast<Picture&>(picture), header.dataWindow()));
    output.writePixels(static_cast<int>(picture.height));
  } catch (const std::exception& error) {
    if (!file.failed()) {
      throw PictureError("cannot write picture: " + path.string() + ": " + error.what());
    }
  }
  file.commit();  // reports a failed write
}

Picture read_exr(const std::filesystem::path& path) {
  limit_header_sizes();
  try {
    Imf::InputFile input(path.c_str());
    check_channels(path, input.header().channels());
    const Imath::Box2i data = input.header().dataWindow();
    const Imath::Box2i shown = input.header().displayWindow();
    Picture picture = blank_picture(path, data, aovs_among(input.header().channels()));
    input.setFrameBuffer(frame_of(picture, data));
    input.readPixels(data.min.y, data.max.y);
    if (data == shown) return picture;
    Picture placed = blank_picture(path, shown, picture.aovs);
    copy_common(picture, data, placed, shown);
    return placed;
  } catch (const PictureError&) {
    throw;
  } catch (const std::exception& error) {
    fail_to_read(path, error.what());
  }
}

}  // namespace graycube
