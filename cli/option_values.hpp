// The values of options, read from text. Each function throws a usage failure that names the
// option, what was expected and what was found.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cli/farm/farm_kind.hpp"
#include "cli/options/completion.hpp"
#include "figures/figure_name.hpp"
#include "proto/messages.hpp"

namespace graycube {

struct PictureSize {
  std::uint32_t width = 0, height = 0;
  friend bool operator==(const PictureSize&, const PictureSize&) = default;
};

/// Reads a whole number in decimal digits, least … most.
std::uint32_t parse_count(std::string_view option, std::string_view text, std::uint32_t least,
                          std::uint32_t most);
/// Reads a power of two, 1 … kMaxNodes.
std::uint32_t parse_nodes(std::string_view option, std::string_view text);
/// Reads "WxH", within the limits of a picture.
PictureSize parse_size(std::string_view option, std::string_view text);
/// Reads powers of two as parse_nodes() does, with commas between; at most kMaxNodeCounts.
std::vector<std::uint32_t> parse_node_list(std::string_view option, std::string_view text);
inline constexpr std::size_t kMaxNodeCounts = 16;
/// Reads a number, least … most.
double parse_number(std::string_view option, std::string_view text, double least, double most);
/// Reads seconds, more than 0 and at most a year.
double parse_seconds(std::string_view option, std::string_view text);

// The choices of the options below, in the order in which errors and completion list them.
inline constexpr std::array kAlgorithmChoices{Algorithm::kAuto, Algorithm::kSerial,
                                              Algorithm::kRoth, Algorithm::kMacro};
inline constexpr std::array kGrainChoices{Grain::kPixel, Grain::kLine, Grain::kTile};
inline constexpr std::array kShadowChoices{ShadowMode::kHorizon, ShadowMode::kForward,
                                           ShadowMode::kLocal};
inline constexpr std::array kPartitionChoices{PartitionMode::kAuto, PartitionMode::kRegular,
                                              PartitionMode::kBalanced};
inline constexpr std::array kFlowChoices{FlowMode::kCredit, FlowMode::kBlocking};
inline constexpr std::array kFifoChoices{FifoMode::kThread, FifoMode::kProcess};
inline constexpr std::array kSumsChoices{SumsMode::kDirect, SumsMode::kTree, SumsMode::kRing};
inline constexpr std::array kMeshChoices{MeshMode::k2d, MeshMode::k3d, MeshMode::kRing,
                                         MeshMode::kTree};
inline constexpr std::array kReturnsChoices{ReturnsMode::kFrontal, ReturnsMode::kSender};
inline constexpr std::array kBoundariesChoices{BoundariesMode::kFixed, BoundariesMode::kSliding};
inline constexpr std::array kSubdivisionChoices{Subdivision::kSurfaces, Subdivision::kRoth,
                                                Subdivision::kLinked,   Subdivision::kArnaldi,
                                                Subdivision::kOctree,   Subdivision::kKaplan};
inline constexpr std::array kEntryChoices{Entry::kUsual, Entry::kDescent, Entry::kExtremal};
inline constexpr std::array kFigureChoices{
    figures::FigureName::kHypercube, figures::FigureName::kMacroRegions,
    figures::FigureName::kBsp,       figures::FigureName::kPointers,
    figures::FigureName::kEntry,     figures::FigureName::kTraffic,
    figures::FigureName::kToken};
inline constexpr std::array kFarmChoices{FarmKind::kAuto, FarmKind::kLocal, FarmKind::kJoined,
                                         FarmKind::kSlurm};
inline constexpr std::array kShellChoices{Shell::kBash, Shell::kZsh, Shell::kFish};

/// The choices as they are spelled.
template <typename Value, std::size_t N>
std::vector<std::string> names_of(const std::array<Value, N>& choices) {
  std::vector<std::string> names;
  for (const Value v : choices) names.emplace_back(to_string(v));
  return names;
}

Algorithm parse_algorithm(std::string_view option, std::string_view text);
Grain parse_grain(std::string_view option, std::string_view text);
ShadowMode parse_shadows(std::string_view option, std::string_view text);
PartitionMode parse_partition(std::string_view option, std::string_view text);
std::uint32_t parse_scatter(std::string_view option, std::string_view text);
FlowMode parse_flow(std::string_view option, std::string_view text);
FifoMode parse_fifo(std::string_view option, std::string_view text);
SumsMode parse_sums(std::string_view option, std::string_view text);
MeshMode parse_mesh(std::string_view option, std::string_view text);
ReturnsMode parse_returns(std::string_view option, std::string_view text);
BoundariesMode parse_boundaries(std::string_view option, std::string_view text);
Subdivision parse_subdivision(std::string_view option, std::string_view text);
Entry parse_entry(std::string_view option, std::string_view text);
figures::FigureName parse_figure(std::string_view option, std::string_view text);
FarmKind parse_farm(std::string_view option, std::string_view text);
Shell parse_shell(std::string_view option, std::string_view text);

/// Reads a finite number.
double parse_angle(std::string_view option, std::string_view text);

/// Reads names of AOVs, with commas between; returns them as to_string(AovSet) writes them.
std::string parse_aov_list(std::string_view option, std::string_view text);

/// The largest power of two not above the number of processors that this process may use.
std::uint32_t default_nodes();

}  // namespace graycube
