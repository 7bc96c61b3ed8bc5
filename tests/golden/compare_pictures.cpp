// compare_pictures A B: how far two picture files differ, channel by channel, as 16-bit samples.
#include <algorithm>
#include <charconv>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "film/picture_files.hpp"
#include "film/transfer.hpp"

namespace {

using namespace graycube;

constexpr const char* kUsage =
    "usage: compare_pictures A B [--tolerance UNITS] [--most-percent P] [--difference OUT.png]\n"
    "                        [--covered]\n"
    "  A, B             .exr or .png; an EXR is turned to 16-bit linear samples, as in a "
    ".linear.png;\n"
    "                   an 8-bit PNG's samples are stretched to 16 bits, whatever they mean\n"
    "  --tolerance      a pixel is off when a channel differs by more, in 1/65535 (default 4)\n"
    "  --most-percent   so many percent of the pixels may be off (default 0)\n"
    "  --difference     writes |A - B|, the largest difference white\n"
    "  --covered        pixels that are black in both pictures don't count\n"
    "status: 0 within limits, 1 beyond them, 2 bad usage or unreadable files\n";

struct UsageError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

struct Options {
  std::vector<std::filesystem::path> pictures;
  double tolerance = 4;
  double most_percent = 0;
  std::optional<std::filesystem::path> difference;
  bool covered_only = false;
};

struct Samples {
  std::uint32_t width = 0, height = 0;
  std::vector<std::uint16_t> rgb;
};

struct Comparison {
  std::uint64_t pixels = 0, pixels_off = 0;
  int largest = 0;
  double percent() const {
    return pixels == 0 ? 0 : 100 * static_cast<double>(pixels_off) / static_cast<double>(pixels);
  }
};

double parse_limit(std::string_view option, std::string_view text, double most) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || !(value >= 0 && value <= most)) {
    throw UsageError(std::string(option) + ": not a number from 0 to " + std::to_string(most) +
                     ": " + std::string(text));
  }
  return value;
}

Options parse(std::span<char*> arguments) {
  Options options;
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    const std::string_view argument = arguments[i];
    const auto value = [&]() -> std::string_view {
      if (++i == arguments.size()) throw UsageError(std::string(argument) + ": no value");
      return arguments[i];
    };
    if (argument == "--tolerance") {
      options.tolerance = parse_limit(argument, value(), 65535);
    } else if (argument == "--most-percent") {
      options.most_percent = parse_limit(argument, value(), 100);
    } else if (argument == "--difference") {
      options.difference = value();
    } else if (argument == "--covered") {
      options.covered_only = true;
    } else if (argument.starts_with("--")) {
      throw UsageError("unknown option: " + std::string(argument));
    } else {
      options.pictures.emplace_back(argument);
    }
  }
  if (options.pictures.size() != 2) throw UsageError("two pictures are compared");
  return options;
}

Samples load(const std::filesystem::path& path) {
  Samples samples;
  if (path.extension() == ".exr") {
    const Picture picture = read_exr(path);
    samples = {picture.width, picture.height, {}};
    samples.rgb.reserve(picture.rgb.size());
    for (const float v : picture.rgb) samples.rgb.push_back(linear_16_bit(v));
  } else if (path.extension() == ".png") {
    PngImage image = read_png(path);
    samples = {image.width, image.height, std::move(image.rgb)};
    if (image.bits == 8) {
      for (std::uint16_t& v : samples.rgb) v = static_cast<std::uint16_t>(257 * v);
    }
  } else {
    throw UsageError("neither .exr nor .png: " + path.string());
  }
  return samples;
}

int difference_at(const Samples& a, const Samples& b, std::size_t i) {
  return std::abs(int{a.rgb[i]} - int{b.rgb[i]});
}

/// Black to within a step of 8 bits: rt keeps the blackest black for what nothing is hit in.
bool is_black(const Samples& s, std::size_t pixel) {
  constexpr std::uint16_t kBlack = 257;
  return std::all_of(&s.rgb[3 * pixel], &s.rgb[3 * pixel] + 3,
                     [](std::uint16_t v) { return v <= kBlack; });
}

Comparison compare(const Samples& a, const Samples& b, const Options& options) {
  Comparison result;
  for (std::size_t pixel = 0; pixel < std::size_t{a.width} * a.height; ++pixel) {
    if (options.covered_only && is_black(a, pixel) && is_black(b, pixel)) continue;
    ++result.pixels;
    int worst = 0;
    for (std::size_t c = 0; c < 3; ++c) worst = std::max(worst, difference_at(a, b, 3 * pixel + c));
    result.pixels_off += worst > options.tolerance ? 1 : 0;
    result.largest = std::max(result.largest, worst);
  }
  return result;
}

void write_difference(const std::filesystem::path& path, const Samples& a, const Samples& b,
                      int largest) {
  Picture picture{a.width, a.height, std::vector<float>(a.rgb.size())};
  const auto white = static_cast<float>(std::max(largest, 1));
  for (std::size_t i = 0; i < a.rgb.size(); ++i) {
    picture.rgb[i] = static_cast<float>(difference_at(a, b, i)) / white;
  }
  write_png(path, picture);
}

int run(const Options& options) {
  const Samples a = load(options.pictures[0]), b = load(options.pictures[1]);
  if (a.width != b.width || a.height != b.height) {
    std::printf("sizes differ: %u x %u and %u x %u\n", a.width, a.height, b.width, b.height);
    return 1;
  }
  const Comparison result = compare(a, b, options);
  std::printf("%llu of %llu pixels off (%.4f %%), largest difference %d of 65535\n",
              static_cast<unsigned long long>(result.pixels_off),
              static_cast<unsigned long long>(result.pixels), result.percent(), result.largest);
  if (options.difference) write_difference(*options.difference, a, b, result.largest);
  return result.percent() <= options.most_percent ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(parse(std::span(argv, static_cast<std::size_t>(argc)).subspan(1)));
  } catch (const UsageError& error) {
    std::fprintf(stderr, "compare_pictures: %s\n%s", error.what(), kUsage);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "compare_pictures: %s\n", error.what());
  }
  return 2;
}
