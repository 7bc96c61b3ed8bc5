#include "bench/scene_arguments.hpp"

#include <array>
#include <charconv>
#include <cstdio>
#include <exception>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

#include "formats/graycube/read_scene.hpp"

namespace graycube::bench {
namespace {

constexpr std::uint32_t kMaxThreads = 1024;

struct UsageError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

std::uint32_t parse_number(std::string_view option, std::string_view text, std::uint32_t most) {
  std::uint32_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || value < 1 || value > most) {
    throw UsageError(std::string(option) + ": not a number from 1 to " + std::to_string(most) +
                     ": " + std::string(text));
  }
  return value;
}

template <typename Value>
struct Named {
  std::string_view name;
  Value value;
};
constexpr std::array kWays{
    Named{"surfaces", Subdivision::kSurfaces}, Named{"roth", Subdivision::kRoth},
    Named{"linked", Subdivision::kLinked},     Named{"arnaldi", Subdivision::kArnaldi},
    Named{"octree", Subdivision::kOctree},     Named{"kaplan", Subdivision::kKaplan}};
constexpr std::array kEntries{Named{"descent", Entry::kDescent},
                              Named{"extremal", Entry::kExtremal}};

template <typename Names>
auto parse_name(std::string_view option, std::string_view text, const Names& names) {
  for (const auto& known : names) {
    if (known.name == text) return known.value;
  }
  throw UsageError(std::string(option) + ": unknown: " + std::string(text));
}

SceneArguments parse(std::span<char*> arguments) {
  SceneArguments parsed;
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    const std::string_view argument = arguments[i];
    const auto value = [&]() -> std::string_view {
      if (++i == arguments.size()) throw UsageError(std::string(argument) + ": no value");
      return arguments[i];
    };
    if (argument == "--size") {
      parsed.size = parse_number(argument, value(), kMaxImageSide);
    } else if (argument == "--threads") {
      parsed.threads = parse_number(argument, value(), kMaxThreads);
    } else if (argument == "--exr") {
      parsed.exr = value();
    } else if (argument == "--subdivision") {
      parsed.subdivision.way = parse_name(argument, value(), kWays);
    } else if (argument == "--entry") {
      parsed.subdivision.entry = parse_name(argument, value(), kEntries);
    } else if (argument == "--build-only") {
      parsed.build_only = true;
    } else if (argument.starts_with("-") || !parsed.scene.empty()) {
      throw UsageError("what is " + std::string(argument) + "?");
    } else {
      parsed.scene = argument;
    }
  }
  if (parsed.scene.empty()) throw UsageError("no scene");
  return parsed;
}

}  // namespace

Scene load(const SceneArguments& arguments) {
  ReadResult result = read_scene_file(arguments.scene);
  if (!result.scene) {
    const SceneError& e = result.errors.front();
    throw std::runtime_error(arguments.scene.string() + ": " + e.pointer + ": " + e.message);
  }
  ImageSize& image = result.scene->settings.image;
  if (arguments.size) image.width = image.height = *arguments.size;
  return std::move(*result.scene);
}

int run_with_scene(const char* program, int argc, char** argv,
                   const std::function<void(const SceneArguments&)>& run) {
  try {
    run(parse(std::span(argv + 1, static_cast<std::size_t>(argc - 1))));
    return 0;
  } catch (const UsageError& e) {
    std::fprintf(stderr,
                 "%s: %s\nusage: %s SCENE [--size N] [--threads T] [--exr OUT.exr] [--build-only] "
                 "[--subdivision WAY [--entry descent|extremal]]\n",
                 program, e.what(), program);
    return 2;
  } catch (const std::exception& e) {
    std::fprintf(stderr, "%s: %s\n", program, e.what());
    return 1;
  }
}

}  // namespace graycube::bench
