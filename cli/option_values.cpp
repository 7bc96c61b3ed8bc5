#include "cli/option_values.hpp"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <span>
#include <thread>

#include "cli/failure.hpp"
#include "film/aov.hpp"
#include "shading/settings.hpp"
#include "spelling.hpp"
#include "topology/hypercube.hpp"

namespace graycube {
namespace {

constexpr double kMaxSeconds = 366.0 * 24 * 3600;

[[noreturn]] void expected(std::string_view option, const std::string& what,
                           std::string_view found) {
  throw usage_failure(std::string(option), "expected " + what + ", found " + quoted(found));
}

/// The whole text as a number; nothing when it isn't a number, or is too large for the type.
template <typename Number>
std::optional<Number> number(std::string_view text) {
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

std::string range(std::uint64_t least, std::uint64_t most) {
  return std::to_string(least) + " to " + std::to_string(most);
}

template <typename Value>
Value parse_choice(std::string_view option, std::string_view text, std::span<const Value> choices) {
  std::vector<std::string_view> names;
  for (const Value v : choices) {
    if (text == to_string(v)) return v;
    names.push_back(to_string(v));
  }
  std::string list;
  for (std::size_t i = 0; i < names.size(); ++i) {
    list += (i == 0 ? "" : i + 1 == names.size() ? " or " : ", ") + std::string(names[i]);
  }
  throw usage_failure(std::string(option),
                      "expected " + list + ", found " + quoted(text) + did_you_mean(text, names));
}

}  // namespace

std::uint32_t parse_count(std::string_view option, std::string_view text, std::uint32_t least,
                          std::uint32_t most) {
  const auto value = number<std::uint32_t>(text);
  if (!value || *value < least || *value > most) {
    expected(option, "a whole number from " + range(least, most), text);
  }
  return *value;
}

std::uint32_t parse_nodes(std::string_view option, std::string_view text) {
  const auto value = number<std::uint32_t>(text);
  if (!value || !Hypercube::of_size(*value)) {
    expected(option, "a power of two from " + range(1, kMaxNodes), text);
  }
  return *value;
}

std::vector<std::uint32_t> parse_node_list(std::string_view option, std::string_view text) {
  std::vector<std::uint32_t> counts;
  for (std::size_t from = 0; from <= text.size();) {
    const std::size_t to = std::min(text.find(',', from), text.size());
    counts.push_back(parse_nodes(option, text.substr(from, to - from)));
    if (counts.size() > kMaxNodeCounts) {
      expected(option, "at most " + std::to_string(kMaxNodeCounts) + " numbers of nodes", text);
    }
    from = to + 1;
  }
  return counts;
}

double parse_number(std::string_view option, std::string_view text, double least, double most) {
  const auto value = number<double>(text);
  if (!value || !(*value >= least && *value <= most)) {
    char range_text[64];
    std::snprintf(range_text, sizeof range_text, "a number from %g to %g", least, most);
    expected(option, range_text, text);
  }
  return *value;
}

PictureSize parse_size(std::string_view option, std::string_view text) {
  const auto cross = text.find('x');
  if (cross != std::string_view::npos) {
    const auto width = number<std::uint32_t>(text.substr(0, cross));
    const auto height = number<std::uint32_t>(text.substr(cross + 1));
    const auto fits = [](std::uint32_t side) { return side >= 1 && side <= kMaxImageSide; };
    if (width && height && fits(*width) && fits(*height)) {
      if (std::uint64_t{*width} * *height <= kMaxPixels) return {*width, *height};
      expected(option, "at most " + std::to_string(kMaxPixels) + " pixels", text);
    }
  }
  expected(option, "WIDTHxHEIGHT in pixels, each " + range(1, kMaxImageSide), text);
}

double parse_seconds(std::string_view option, std::string_view text) {
  const auto value = number<double>(text);
  if (!value || !std::isfinite(*value) || *value <= 0 || *value > kMaxSeconds) {
    expected(option, "a number of seconds above 0, at most a year", text);
  }
  return *value;
}

Algorithm parse_algorithm(std::string_view option, std::string_view text) {
  return parse_choice<Algorithm>(option, text, kAlgorithmChoices);
}

Grain parse_grain(std::string_view option, std::string_view text) {
  return parse_choice<Grain>(option, text, kGrainChoices);
}

ShadowMode parse_shadows(std::string_view option, std::string_view text) {
  return parse_choice<ShadowMode>(option, text, kShadowChoices);
}

PartitionMode parse_partition(std::string_view option, std::string_view text) {
  return parse_choice<PartitionMode>(option, text, kPartitionChoices);
}

std::uint32_t parse_scatter(std::string_view option, std::string_view text) {
  return parse_count(option, text, 1, kMaxScatter);
}

FlowMode parse_flow(std::string_view option, std::string_view text) {
  return parse_choice<FlowMode>(option, text, kFlowChoices);
}

FifoMode parse_fifo(std::string_view option, std::string_view text) {
  return parse_choice<FifoMode>(option, text, kFifoChoices);
}

SumsMode parse_sums(std::string_view option, std::string_view text) {
  return parse_choice<SumsMode>(option, text, kSumsChoices);
}

MeshMode parse_mesh(std::string_view option, std::string_view text) {
  return parse_choice<MeshMode>(option, text, kMeshChoices);
}

ReturnsMode parse_returns(std::string_view option, std::string_view text) {
  return parse_choice<ReturnsMode>(option, text, kReturnsChoices);
}

BoundariesMode parse_boundaries(std::string_view option, std::string_view text) {
  return parse_choice<BoundariesMode>(option, text, kBoundariesChoices);
}

Subdivision parse_subdivision(std::string_view option, std::string_view text) {
  return parse_choice<Subdivision>(option, text, kSubdivisionChoices);
}

Entry parse_entry(std::string_view option, std::string_view text) {
  return parse_choice<Entry>(option, text, kEntryChoices);
}

figures::FigureName parse_figure(std::string_view option, std::string_view text) {
  return parse_choice<figures::FigureName>(option, text, kFigureChoices);
}

FarmKind parse_farm(std::string_view option, std::string_view text) {
  return parse_choice<FarmKind>(option, text, kFarmChoices);
}

Shell parse_shell(std::string_view option, std::string_view text) {
  return parse_choice<Shell>(option, text, kShellChoices);
}

double parse_angle(std::string_view option, std::string_view text) {
  constexpr double kMostTurns = 1e6;
  const auto value = number<double>(text);
  if (!value || !std::isfinite(*value) || std::fabs(*value) > kMostTurns) {
    expected(option, "an angle in degrees", text);
  }
  return *value;
}

std::string parse_aov_list(std::string_view option, std::string_view text) {
  const auto aovs = parse_aovs(text);
  if (aovs && aovs->any()) return to_string(*aovs);
  expected(option, to_string(AovSet::all()) + ", or some of them, each once", text);
}

std::uint32_t default_nodes() {
  return std::bit_floor(std::clamp(std::thread::hardware_concurrency(), 1u, kMaxNodes));
}

}  // namespace graycube
