#include "film/picture_files.hpp"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <OpenEXR/ImfThreading.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstddef>
#include <fstream>
#include <functional>
#include <iterator>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "catch.hpp"
#include "check.hpp"
#include "process/temporary_folder.hpp"

using namespace graycube;
namespace fs = std::filesystem;

namespace {

std::vector<std::string> names_in(const fs::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder)) names.push_back(entry.path().filename());
  return names;
}

using Bytes = std::vector<char>;

Bytes bytes_of(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

void put(const fs::path& path, const Bytes& bytes) {
  fs::remove(path);  // some file systems wait for the disk when a file is emptied and written again
  std::ofstream(path, std::ios::binary)
      .write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

Bytes from_hex(const std::string& hex) {
  Bytes bytes;
  for (std::size_t i = 0; i + 1 < hex.size(); i += 2) {
    bytes.push_back(static_cast<char>(std::stoi(hex.substr(i, 2), nullptr, 16)));
  }
  return bytes;
}

/// A picture of noise, from dark to far above white.
Picture noise(std::uint32_t width, std::uint32_t height, std::uint64_t seed = 1) {
  std::mt19937_64 engine(seed);
  Picture picture{width, height, {}};
  for (std::uint64_t i = 0; i < 3ull * width * height; ++i) {
    picture.rgb.push_back(
        std::ldexp(static_cast<float>(engine() >> 40), static_cast<int>(i % 40) - 50));
  }
  return picture;
}

std::string complaint_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const PictureError& error) {
    return error.what();
  }
  return "no complaint";
}

/// Files end at `bytes` while this lives, as on a full disk.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    ::getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{bytes, before_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileSizeLimit() {
    ::setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }
  FileSizeLimit(const FileSizeLimit&) = delete;
  FileSizeLimit& operator=(const FileSizeLimit&) = delete;

 private:
  void (*handler_)(int);
  rlimit before_{};
};

/// While this lives, the test runs as another user: the superuser may write anywhere.
class NotSuperuser {
 public:
  NotSuperuser() {
    if (was_superuser_) REQUIRE(::seteuid(kNobody) == 0);
  }
  ~NotSuperuser() {
    if (was_superuser_) GRAYCUBE_CHECK(::seteuid(0) == 0, "can't be superuser again");
  }
  NotSuperuser(const NotSuperuser&) = delete;
  NotSuperuser& operator=(const NotSuperuser&) = delete;

 private:
  static constexpr uid_t kNobody = 65534;
  const bool was_superuser_ = ::geteuid() == 0;
};

bool has_chunk(const Bytes& png, const std::string& name) {
  return std::search(png.begin(), png.end(), name.begin(), name.end()) != png.end();
}

const PictureOrigin kOrigin{"first.json", "0.1.0"};

}  // namespace

TEST_CASE("an EXR read back is the picture written, bit for bit") {
  const TemporaryFolder folder;
  for (const auto& [width, height] : {std::pair{1u, 1u}, {1u, 40u}, {67u, 1u}, {67u, 35u}}) {
    const Picture picture = noise(width, height);
    write_exr(folder / "a.exr", picture, kOrigin);
    CHECK(read_exr(folder / "a.exr") == picture);
  }
  CHECK(names_in(folder.path()) == std::vector<std::string>{"a.exr"});
}

TEST_CASE("equal pictures are equal EXR files whatever the thread count") {
  const TemporaryFolder folder;
  const Picture picture = noise(130, 90);
  write_exr(folder / "0.exr", picture, kOrigin);
  const int before = Imf::globalThreadCount();
  for (const int threads : {1, 2, 5}) {
    Imf::setGlobalThreadCount(threads);
    write_exr(folder / "n.exr", picture, kOrigin);
    CHECK(bytes_of(folder / "n.exr") == bytes_of(folder / "0.exr"));
  }
  Imf::setGlobalThreadCount(before);
}

TEST_CASE("an EXR's header says scene and version and 32-bit float, and nothing of its making") {
  const TemporaryFolder folder;
  write_exr(folder / "a.exr", noise(4, 3), kOrigin);
  const Imf::InputFile file((folder / "a.exr").c_str());
  const Imf::Header& header = file.header();
  CHECK(header.typedAttribute<Imf::StringAttribute>("scene").value() == "first.json");
  CHECK(header.typedAttribute<Imf::StringAttribute>("graycube").value() == "0.1.0");
  int channels = 0;
  for (auto c = header.channels().begin(); c != header.channels().end(); ++c, ++channels) {
    CHECK(c.channel().type == Imf::FLOAT);
  }
  CHECK(channels == 3);
  for (const char* name : {"owner", "capDate", "comments", "utcOffset"}) {
    CHECK(header.find(name) == header.end());
  }
}

TEST_CASE("an EXR is compressed where three quarters of the pixels repeat the one before") {
  const TemporaryFolder folder;
  Picture picture = noise(64, 64);
  const auto compression_at = [&](std::size_t plain_pixels) {
    for (std::size_t i = 0; i < 3 * plain_pixels; ++i) picture.rgb[i] = static_cast<float>(i % 3);
    write_exr(folder / "a.exr", picture, kOrigin);
    CHECK(read_exr(folder / "a.exr") == picture);
    return Imf::InputFile((folder / "a.exr").c_str()).header().compression();
  };
  const std::size_t raw_bytes = picture.rgb.size() * sizeof(float);
  CHECK(compression_at(0) == Imf::NO_COMPRESSION);
  CHECK(compression_at(64 * 64 / 2) == Imf::NO_COMPRESSION);
  CHECK(bytes_of(folder / "a.exr").size() > raw_bytes);
  CHECK(compression_at(64 * 64 * 4 / 5) == Imf::ZIP_COMPRESSION);
  CHECK(bytes_of(folder / "a.exr").size() < raw_bytes / 3);
  CHECK(compression_at(64 * 64) == Imf::ZIP_COMPRESSION);
}

TEST_CASE("a linear PNG holds 16-bit samples by the rule and says that they are linear") {
  const TemporaryFolder folder;
  const Picture picture{
      2, 2, {0, 1, 0.5f, -1, 2, 0.25f, 1e-5f, 0.9999f, 1e-6f, std::nanf(""), 0, 0.1f}};
  write_png(folder / "a.linear.png", picture);
  const PngImage image = read_png(folder / "a.linear.png");
  CHECK(image.width == 2);
  CHECK(image.height == 2);
  CHECK(image.bits == 16);
  CHECK(image.rgb ==
        std::vector<std::uint16_t>{0, 65535, 32768, 0, 65535, 16384, 1, 65528, 0, 0, 0, 6554});
  const Bytes bytes = bytes_of(folder / "a.linear.png");
  // A file gamma of 1.0 is the number 100000 = 0x000186A0.
  CHECK(has_chunk(bytes, std::string("gAMA\x00\x01\x86\xA0", 8)));
  CHECK_FALSE(has_chunk(bytes, "sRGB"));
  CHECK_FALSE(has_chunk(bytes, "tIME"));
}

TEST_CASE("any other PNG holds 8-bit sRGB and says so") {
  const TemporaryFolder folder;
  write_png(folder / "a.png", {2, 1, {0, 0.5f, 1, 0.18f, 5, -1}});
  const PngImage image = read_png(folder / "a.png");
  CHECK(image.bits == 8);
  CHECK(image.rgb == std::vector<std::uint16_t>{0, 188, 255, 118, 255, 0});
  CHECK(has_chunk(bytes_of(folder / "a.png"), "sRGB"));
  CHECK(has_chunk(bytes_of(folder / "a.png"), "gAMA"));
}

TEST_CASE("equal pictures are equal PNG files") {
  const TemporaryFolder folder;
  for (const char* name : {"a.png", "a.linear.png"}) {
    write_png(folder / name, noise(50, 20));
    const Bytes first = bytes_of(folder / name);
    write_png(folder / name, noise(50, 20));
    CHECK(bytes_of(folder / name) == first);
    write_png(folder / name, noise(50, 20, 2));
    CHECK(bytes_of(folder / name) != first);
  }
}

TEST_CASE("grey, palette and transparent PNGs are read as RGB") {
  const TemporaryFolder folder;
  struct Sample {
    const char* name;
    int bits;
    std::vector<std::uint16_t> rgb;
    const char* hex;
  };
  // Each is one pixel.
  const std::vector<Sample> samples{
      {"grey",
       8,
       {128, 128, 128},
       "89504e470d0a1a0a0000000d49484452000000010000000108000000003a7e9b550000000a4944415478"
       "9c636800000082008177cd72b60000000049454e44ae426082"},
      {"grey-alpha",
       8,
       {64, 64, 64},
       "89504e470d0a1a0a0000000d4948445200000001000000010804000000b51c0c020000000b4944415478"
       "9c637010000000930051be0632670000000049454e44ae426082"},
      {"bit",
       8,
       {255, 255, 255},
       "89504e470d0a1a0a0000000d4948445200000001000000010100000000376ef9240000000a4944415478"
       "9c636800000082008177cd72b60000000049454e44ae426082"},
      {"palette",
       8,
       {255, 0, 7},
       "89504e470d0a1a0a0000000d494844520000000100000001080300000028cb34bb00000003504c5445ff"
       "000787869c940000000174524e53105d51c8020000000a49444154789c636000000002000148afa47100"
       "00000049454e44ae426082"},
      {"rgba16",
       16,
       {258, 772, 1286},
       "89504e470d0a1a0a0000000d49484452000000010000000110060000004f8518ca000000114944415478"
       "9c6360646266616563e70000008100259875d09f0000000049454e44ae426082"},
  };
  for (const Sample& sample : samples) {
    CAPTURE(sample.name);
    put(folder / "a.png", from_hex(sample.hex));
    const PngImage image = read_png(folder / "a.png");
    CHECK(image.bits == sample.bits);
    CHECK(image.rgb == sample.rgb);
  }
}

TEST_CASE("a path that can't be written is named with its reason and leaves nothing behind") {
  const TemporaryFolder folder;
  const Picture picture = noise(4, 4);
  const auto complaint = [&](const fs::path& path) {
    const std::string exr = complaint_of([&] { write_exr(path, picture, kOrigin); });
    CHECK(complaint_of([&] { write_png(path, picture); }) == exr);
    CHECK(exr.find(path.string()) != std::string::npos);
    CHECK(exr.find('\n') == std::string::npos);
    return exr;
  };
  CHECK(complaint(folder / "no" / "a.exr").ends_with(": the folder does not exist"));
  fs::create_directory(folder / "sub");
  CHECK(complaint(folder / "sub").ends_with(": Is a directory"));
  CHECK(complaint("/dev/null").ends_with(": not a regular file"));
  put(folder / "file", {'x'});
  CHECK(complaint(folder / "file" / "a.exr").ends_with(": Not a directory"));
  CHECK(complaint(folder / std::string(300, 'n').c_str()).ends_with(": File name too long"));
  CHECK(fs::is_character_file("/dev/null"));
  CHECK(names_in(folder.path()).size() == 2);
}

TEST_CASE("a folder without permission is named as such") {
  const TemporaryFolder folder;
  fs::permissions(folder / ".", fs::perms(0755));
  fs::create_directory(folder / "closed");
  fs::permissions(folder / "closed", fs::perms(0555));
  const Picture picture = noise(4, 4);
  std::string complaint;
  {
    const NotSuperuser nobody;
    complaint = complaint_of([&] { write_png(folder / "closed" / "a.png", picture); });
  }
  CHECK(complaint.ends_with("a.png: Permission denied"));
}

TEST_CASE("when the disk is full the old file stays and the temporary one goes") {
  const TemporaryFolder folder;
  const Picture small = noise(2, 2);
  write_exr(folder / "a.exr", small, kOrigin);
  write_png(folder / "a.png", small);
  const Bytes exr = bytes_of(folder / "a.exr"), png = bytes_of(folder / "a.png");
  for (const rlim_t limit : {0, 100, 20000}) {
    CAPTURE(limit);
    std::string exr_complaint, png_complaint;
    {
      const FileSizeLimit full(limit);
      exr_complaint = complaint_of([&] { write_exr(folder / "a.exr", noise(200, 200), kOrigin); });
      png_complaint = complaint_of([&] { write_png(folder / "a.png", noise(200, 200)); });
    }
    CHECK(exr_complaint.ends_with("a.exr: File too large"));
    CHECK(png_complaint.ends_with("a.png: File too large"));
    CHECK(bytes_of(folder / "a.exr") == exr);
    CHECK(bytes_of(folder / "a.png") == png);
    CHECK(names_in(folder.path()).size() == 2);
  }
}

TEST_CASE("writing to a symbolic link writes the file it leads to") {
  const TemporaryFolder folder;
  fs::create_directory(folder / "sub");
  write_exr(folder / "sub" / "real.exr", noise(2, 2), kOrigin);
  fs::create_symlink("sub/real.exr", folder / "link.exr");
  write_exr(folder / "link.exr", noise(5, 5), kOrigin);
  CHECK(fs::is_symlink(folder / "link.exr"));
  CHECK(read_exr(folder / "sub" / "real.exr").width == 5);
}

TEST_CASE("truncated pictures are complaints, never crashes or half pictures") {
  const TemporaryFolder folder;
  const fs::path exr = folder / "a.exr", png = folder / "a.png";
  write_exr(exr, noise(9, 40), kOrigin);
  write_png(png, noise(9, 40));
  const Bytes exr_bytes = bytes_of(exr), png_bytes = bytes_of(png);
  for (std::size_t size = 0; size < exr_bytes.size(); size += 1 + size / 100) {
    CAPTURE(size);
    put(exr, Bytes(exr_bytes.begin(), exr_bytes.begin() + static_cast<std::ptrdiff_t>(size)));
    CHECK_THROWS_AS(read_exr(exr), PictureError);
  }
  for (std::size_t size = 0; size < png_bytes.size(); size += 1 + size / 100) {
    CAPTURE(size);
    put(png, Bytes(png_bytes.begin(), png_bytes.begin() + static_cast<std::ptrdiff_t>(size)));
    CHECK_THROWS_AS(read_png(png), PictureError);
  }
}

TEST_CASE("files that are no pictures are complaints with the file's name") {
  const TemporaryFolder folder;
  put(folder / "text", {'h', 'e', 'l', 'l', 'o'});
  for (const char* name : {"text", "missing"}) {
    CHECK(complaint_of([&] { read_exr(folder / name); }).find((folder / name).string()) !=
          std::string::npos);
    CHECK(complaint_of([&] { read_png(folder / name); }).find((folder / name).string()) !=
          std::string::npos);
  }
  CHECK(
      complaint_of([&] { read_png(folder / "missing"); }).ends_with(": No such file or directory"));
}

/// Writes an EXR with these windows in which pixel (x, y) of the data is (x, y, 1).
void write_windows(const fs::path& path, const Imath::Box2i& shown, const Imath::Box2i& data) {
  Imf::Header header(shown, data);
  const auto width = static_cast<std::size_t>(data.max.x - data.min.x + 1);
  std::vector<float> rgb;
  for (int y = data.min.y; y <= data.max.y; ++y) {
    for (int x = data.min.x; x <= data.max.x; ++x)
      rgb.insert(rgb.end(), {static_cast<float>(x), static_cast<float>(y), 1});
  }
  Imf::FrameBuffer frame;
  const char* names[] = {"R", "G", "B"};
  for (std::size_t c = 0; c < 3; ++c) {
    header.channels().insert(names[c], Imf::Channel(Imf::FLOAT));
    frame.insert(names[c], Imf::Slice::Make(Imf::FLOAT, rgb.data() + c, data, 12, 12 * width));
  }
  Imf::OutputFile file(path.c_str(), header);
  file.setFrameBuffer(frame);
  file.writePixels(data.max.y - data.min.y + 1);
}

TEST_CASE("an EXR's picture is its display window, black where it has no data") {
  const TemporaryFolder folder;
  const auto check = [&](const Imath::Box2i& shown, const Imath::Box2i& data) {
    write_windows(folder / "a.exr", shown, data);
    const Picture picture = read_exr(folder / "a.exr");
    REQUIRE(picture.width == static_cast<std::uint32_t>(shown.max.x - shown.min.x + 1));
    REQUIRE(picture.height == static_cast<std::uint32_t>(shown.max.y - shown.min.y + 1));
    std::size_t at = 0;
    for (int y = shown.min.y; y <= shown.max.y; ++y) {
      for (int x = shown.min.x; x <= shown.max.x; ++x, at += 3) {
        INFO("pixel " << x << ", " << y);
        const bool has_data = data.intersects(Imath::V2i(x, y));
        REQUIRE(picture.rgb[at] == (has_data ? static_cast<float>(x) : 0));
        REQUIRE(picture.rgb[at + 1] == (has_data ? static_cast<float>(y) : 0));
        REQUIRE(picture.rgb[at + 2] == (has_data ? 1 : 0));
      }
    }
  };
  SECTION("within it") { check({{0, 0}, {15, 11}}, {{3, 2}, {7, 9}}); }
  SECTION("beyond it") { check({{0, 0}, {5, 4}}, {{-3, -2}, {9, 9}}); }
  SECTION("partly beside it") { check({{-2, -1}, {5, 4}}, {{3, -4}, {9, 2}}); }
  SECTION("wholly beside it") { check({{0, 0}, {3, 3}}, {{10, 0}, {12, 3}}); }
  SECTION("above it") { check({{0, 0}, {3, 3}}, {{0, -9}, {3, -5}}); }
}

TEST_CASE("pictures of absurd size are refused before memory is taken") {
  const TemporaryFolder folder;
  const auto replaced = [](Bytes bytes, const std::string& from, const std::string& to) {
    const auto at = std::search(bytes.begin(), bytes.end(), from.begin(), from.end());
    REQUIRE(at != bytes.end());
    std::copy(to.begin(), to.end(), at);
    return bytes;
  };
  write_exr(folder / "a.exr", noise(7, 5), kOrigin);
  // The data window's corner (6, 4), little-endian, after its first corner (0, 0).
  const std::string before =
      std::string("box2i\0\x10\0\0\0\0\0\0\0\0\0\0\0\x06\0\0\0\x04\0\0\0", 26);
  SECTION("sides") {
    const std::string after =
        std::string("box2i\0\x10\0\0\0\0\0\0\0\0\0\0\0\xFF\xFF\xFF\x7E\x04\0\0\0", 26);
    put(folder / "a.exr", replaced(bytes_of(folder / "a.exr"), before, after));
    CHECK_THROWS_AS(read_exr(folder / "a.exr"), PictureError);
  }
  SECTION("pixels") {
    // 65536 × 65536, each side within its limit.
    const std::string after =
        std::string("box2i\0\x10\0\0\0\0\0\0\0\0\0\0\0\xFF\xFF\0\0\xFF\xFF\0\0", 26);
    put(folder / "a.exr", replaced(bytes_of(folder / "a.exr"), before, after));
    CHECK_THROWS_AS(read_exr(folder / "a.exr"), PictureError);
  }
}

TEST_CASE("AOVs are channels of the EXR beside R, G and B, and come back") {
  const TemporaryFolder folder;
  Picture picture;
  picture.width = 2;
  picture.height = 1;
  picture.rgb = {0, 0.25, 0.5, 1, 2, 3};
  picture.aovs = AovSet::all();
  picture.aov_planes = {{{1, 2, 3, 4, 5, 6}, {7, 8, 9, 10, 11, 12}, {13, 14, 0, 16, 17, 0}}};
  const fs::path file = folder / "aov.exr";
  write_exr(file, picture, {"scene.json", "1"});
  CHECK(read_exr(file) == picture);
  const Imf::InputFile input(file.c_str());
  const Imf::ChannelList& channels = input.header().channels();
  REQUIRE(channels.findChannel("object.I") != nullptr);
  CHECK(channels.findChannel("object.I")->type == Imf::UINT);
  for (const char* name :
       {"depth.Z", "normal.X", "normal.Y", "normal.Z", "albedo.R", "albedo.G", "albedo.B"}) {
    INFO(name);
    REQUIRE(channels.findChannel(name) != nullptr);
    CHECK(channels.findChannel(name)->type == Imf::FLOAT);
  }
}

TEST_CASE("only the AOVs that were asked for are written") {
  const TemporaryFolder folder;
  Picture picture;
  picture.width = picture.height = 1;
  picture.rgb = {0, 0, 0};
  picture.aovs.add(Aov::kObject);
  picture.aov_planes[kDepthPlane] = {0x7F800000, 5, 0};
  write_exr(folder / "object.exr", picture, {});
  CHECK(read_exr(folder / "object.exr") == picture);
  const Imf::InputFile input((folder / "object.exr").c_str());
  CHECK(input.header().channels().findChannel("depth.Z") == nullptr);
}
