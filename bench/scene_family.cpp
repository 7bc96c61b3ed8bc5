// scene_family FAMILY SIZE SEED OUT…: writes a scene of a family, as scene files (.json) and for
// POV-Ray (.pov).
#include <charconv>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

#include "bench/scene_families.hpp"
#include "formats/graycube/write_scene.hpp"
#include "formats/pov/write_pov.hpp"

namespace {

using namespace graycube;
using namespace graycube::bench;

struct UsageError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

std::string usage() {
  std::string text = "usage: scene_family FAMILY SIZE SEED OUT.json|OUT.pov…\n";
  for (const FamilyInfo& f : families()) {
    text += "  " + std::string(f.name) + ": sizes " + std::to_string(f.smallest) + " to " +
            std::to_string(f.largest) + "\n";
  }
  return text;
}

std::uint64_t parse_number(std::string_view text, std::uint64_t least, std::uint64_t most) {
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || value < least || value > most) {
    throw UsageError("not a number from " + std::to_string(least) + " to " + std::to_string(most) +
                     ": " + std::string(text));
  }
  return value;
}

void write_file(const std::filesystem::path& path, const std::string& text) {
  std::ofstream out(path, std::ios::binary);
  out << text;
  out.close();
  if (!out) throw std::runtime_error("cannot write " + path.string());
}

void run(std::span<char*> arguments) {
  if (arguments.size() < 4) throw UsageError("too few arguments");
  const auto family = family_of(arguments[0]);
  if (!family) throw UsageError("unknown family: " + std::string(arguments[0]));
  const FamilyInfo& info = families()[static_cast<std::size_t>(*family)];
  const auto size =
      static_cast<std::uint32_t>(parse_number(arguments[1], info.smallest, info.largest));
  const Scene scene = make_scene(*family, size, parse_number(arguments[2], 0, ~std::uint64_t{0}));
  for (const char* out : arguments.subspan(3)) {
    const std::filesystem::path path = out;
    if (path.extension() == ".json") {
      write_file(path, write_scene_text(scene));
    } else if (path.extension() == ".pov") {
      write_file(path, write_pov(scene).text);
    } else {
      throw UsageError("neither .json nor .pov: " + path.string());
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  try {
    run(std::span(argv + 1, static_cast<std::size_t>(argc - 1)));
    return 0;
  } catch (const UsageError& e) {
    std::fprintf(stderr, "scene_family: %s\n%s", e.what(), usage().c_str());
    return 2;
  } catch (const std::exception& e) {
    std::fprintf(stderr, "scene_family: %s\n", e.what());
    return 1;
  }
}
