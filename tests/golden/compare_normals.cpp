// compare_normals PICTURE.exr REFERENCE.png [MOST_OFF_PERCENT [MOST_COVERAGE_PERCENT]]: how well a
// render's normal AOV agrees with a picture of normals as BRL-CAD's `rt -l2` makes it: 0.5 − 0.5 n,
// black where nothing is hit. Status 0 when at most so many pixels are off by more than 2/255, and
// coverages differ by at most so much.
#include <bit>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>

#include "film/picture_files.hpp"

using namespace graycube;

namespace {

constexpr int kTolerance = 2;

int shade_of(std::uint32_t word) {
  const double n = std::bit_cast<float>(word);
  return static_cast<int>(std::floor(255 * (0.5 - 0.5 * n) + 0.5));
}

int compare(const char* picture_path, const char* reference_path, double most_off,
            double most_coverage) {
  const Picture picture = read_exr(picture_path);
  const PngImage reference = read_png(reference_path);
  if (!picture.aovs.has(Aov::kNormal)) {
    std::fprintf(stderr, "%s has no normals; render with --aov normal\n", picture_path);
    return 2;
  }
  if (picture.width != reference.width || picture.height != reference.height) {
    std::fprintf(stderr, "sizes differ: %u x %u and %u x %u\n", picture.width, picture.height,
                 reference.width, reference.height);
    return 2;
  }
  const auto& words = picture.aov_planes[kNormalPlane];
  const int unit = reference.bits == 16 ? 257 : 1;
  std::size_t off = 0, hit = 0, reference_hit = 0;
  const std::size_t pixels = words.size() / 3;
  for (std::size_t i = 0; i < pixels; ++i) {
    bool is_hit = false, is_reference_hit = false, is_off = false;
    for (std::size_t c = 3 * i; c < 3 * i + 3; ++c) {
      is_hit = is_hit || words[c] != 0;
      is_reference_hit = is_reference_hit || reference.rgb[c] != 0;
    }
    for (std::size_t c = 3 * i; c < 3 * i + 3; ++c) {
      const int shade = is_hit ? shade_of(words[c]) : 0;
      is_off = is_off || std::abs(shade - reference.rgb[c] / unit) > kTolerance;
    }
    hit += is_hit;
    reference_hit += is_reference_hit;
    off += is_off;
  }
  const double off_percent = 100.0 * static_cast<double>(off) / static_cast<double>(pixels);
  const double coverage = 100.0 *
                          std::fabs(static_cast<double>(hit) - static_cast<double>(reference_hit)) /
                          static_cast<double>(pixels);
  const bool is_good = off_percent <= most_off && coverage <= most_coverage;
  std::printf("%s: %.3f %% of pixels off, coverage differs by %.3f %%\n",
              is_good ? "same" : "DIFFERENT", off_percent, coverage);
  return is_good ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3 || argc > 5) {
    std::fprintf(stderr,
                 "compare_normals PICTURE.exr REFERENCE.png [MOST_OFF_%% [MOST_COVERAGE_%%]]\n");
    return 2;
  }
  try {
    return compare(argv[1], argv[2], argc > 3 ? std::atof(argv[3]) : 0.3,
                   argc > 4 ? std::atof(argv[4]) : 0.1);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "%s\n", e.what());
    return 2;
  }
}
