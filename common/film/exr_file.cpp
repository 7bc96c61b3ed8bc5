// The only file that knows OpenEXR.
#include <OpenEXR/Iex.h>
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStringAttribute.h>

#include <array>
#include <cstddef>
#include <exception>

#include "film/picture_files.hpp"
#include "film/whole_file.hpp"
#include "geometry/check.hpp"

namespace graycube {
namespace {

constexpr std::array<const char*, 3> kChannels{"R", "G", "B"};
constexpr std::size_t kPixelBytes = 3 * sizeof(float);

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
Imf::FrameBuffer frame_of(float* rgb, const Imath::Box2i& window) {
  const auto width = static_cast<std::size_t>(window.max.x - window.min.x) + 1;
  Imf::FrameBuffer frame;
  for (std::size_t c = 0; c < kChannels.size(); ++c) {
    frame.insert(kChannels[c],
                 Imf::Slice::Make(Imf::FLOAT, rgb + c, window, kPixelBytes, width * kPixelBytes));
  }
  return frame;
}

[[noreturn]] void fail_to_read(const std::filesystem::path& path, const std::string& why) {
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

/// Shading is noise to a compressor: ZIP takes 200 to 300 ms for a megapixel of it, a good part of
/// what tracing takes, to halve the file. Where three quarters repeat the pixel before, as on a plain
/// background, it is fast and shrinks the file to a fraction. ARCHITECTURE.md has the figures.
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
    header.insert("scene", Imf::StringAttribute(origin.scene));
    header.insert("graycube", Imf::StringAttribute(origin.version));

    const std::string name = path.string();
    Stream stream(file, name.c_str());
    Imf::OutputFile output(stream, header);
    output.setFrameBuffer(frame_of(const_cast<float*>(picture.rgb.data()), header.dataWindow()));
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
    const Imath::Box2i window = input.header().dataWindow();
    Picture picture;
    picture.width = static_cast<std::uint32_t>(window.max.x - window.min.x) + 1;
    picture.height = static_cast<std::uint32_t>(window.max.y - window.min.y) + 1;
    const std::uint64_t pixels = std::uint64_t{picture.width} * picture.height;
    if (pixels > kMaxPicturePixels) fail_to_read(path, "too many pixels");
    picture.rgb.resize(3 * pixels);
    input.setFrameBuffer(frame_of(picture.rgb.data(), window));
    input.readPixels(window.min.y, window.max.y);
    return picture;
  } catch (const PictureError&) {
    throw;
  } catch (const std::exception& error) {
    fail_to_read(path, error.what());
  }
}

}  // namespace graycube
