// The values of the command line. Only command_line.cpp, options/declaring.cpp and
// options/usage.cpp know CLI11.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "cli/farm/address.hpp"
#include "cli/farm/farm_kind.hpp"
#include "cli/farm/loss_options.hpp"
#include "cli/outputs.hpp"
#include "cli/scene_input.hpp"
#include "figures/figure_name.hpp"
#include "proto/messages.hpp"

namespace graycube {

struct RenderCommand {
  std::string scene;
  ModelChoice choice;
  Outputs outputs;
  /// Where tiles are recorded, so that the same command goes on; empty for nowhere.
  std::filesystem::path checkpoint;
  control::JobOptions options;
  LossOptions losses;
  FarmKind farm = FarmKind::kAuto;
  /// 0 nodes for what is usual.
  std::uint32_t nodes = 0, threads = 1;
  bool as_json = false, is_quiet = false;
};

struct SubmitCommand {
  FarmAddress connect;
  std::string scene;
  ModelChoice choice;
  Outputs outputs;
  control::JobOptions options;
  /// 0 for whatever number the farm has.
  std::uint32_t nodes = 0;
  bool is_quiet = false, waits = false, as_json = false;
};

struct UpCommand {
  FarmKind farm = FarmKind::kAuto;
  std::string listen, state, http, key, log;
  bool is_quiet = false;
  /// A text of parse_keep_rule(); empty to keep everything.
  std::string keep;
  /// 0 nodes for what is usual.
  std::uint32_t nodes = 0, threads = 1;
  LossOptions losses;
  /// 0 for the frontal's default.
  std::uint32_t outbox_rays = 0;
};

struct JoinCommand {
  std::string endpoint;
  /// The file of the farm's key, "-" for standard input; empty for the usual place.
  std::string key;
  std::string name, address;
  /// 0 for as many as there are cores.
  std::uint32_t slots = 0;
};

struct JobsCommand {
  FarmAddress connect;
  bool as_json = false;
  std::uint32_t limit = 50, skip = 0;
};
struct StatusCommand {
  FarmAddress connect;
  /// 0 where the farm itself is asked about.
  std::uint32_t number = 0;
  bool is_of_farm = false, as_json = false;
};
struct WatchCommand {
  FarmAddress connect;
  std::uint32_t job = 0;
  bool as_json = false;
};
struct CancelCommand {
  FarmAddress connect;
  std::uint32_t job = 0;
};
struct FetchCommand {
  FarmAddress connect;
  std::uint32_t job = 0;
  Outputs outputs;
};
struct NodesCommand {
  FarmAddress connect;
  bool as_json = false;
};
struct LogCommand {
  FarmAddress connect;
  /// The newest so many are printed first.
  std::uint32_t lines = 100;
  bool follows = false, as_json = false;
};
struct DownCommand {
  FarmAddress connect;
};
struct KeyCommand {
  /// The file of the farm's key of which a client's is made; empty for a new farm's key.
  std::filesystem::path of_farm;
};
struct CheckCommand {
  std::string scene;
  ModelChoice choice;
  bool as_json = false;
};
struct CompareCommand {
  std::string scene;
  ModelChoice choice;
  /// Options that all ways have in common: size, samples, depth, the historical queue.
  control::JobOptions options;
  std::uint32_t nodes = 1;
  std::filesystem::path plot;
  /// Subdivisions with each distribution, instead of 1987's and today's means.
  bool is_report = false;
  bool as_json = false, is_quiet = false;
};
struct SimulateCommand {
  std::string scene;
  ModelChoice choice;
  control::JobOptions options;
  std::vector<std::uint32_t> nodes;
  /// See simulation::MachineFigures.
  double link_gbps = 10, link_us = 50, cpu_scale = 1;
  /// Hosts that the nodes lie on; 0 gives each node a machine of its own, with a link to each
  /// neighbour.
  std::uint32_t hosts = 0;
  /// The same as of links, within hosts; those of MachineFigures if not given.
  std::optional<double> local_gbps, local_us;
  /// Bandwidth of the frontal's link; like the other links if not given.
  std::optional<double> host_gbps;
  /// Microseconds that handing a message over takes each side; measured if not given.
  std::optional<double> message_us;
  std::uint32_t cores = 0;
  std::filesystem::path plot;
  bool as_json = false, is_quiet = false;
};
struct DrawCommand {
  std::string scene;
  ModelChoice choice;
  figures::FigureName figure = figures::FigureName::kHypercube;
  /// The algorithm is macro, whatever they say.
  control::JobOptions options;
  std::uint32_t nodes = 16;
  /// Empty for a name made of the scene's and the figure's.
  std::filesystem::path output;
  bool is_quiet = false;
};
struct ConvertCommand {
  std::string in, out;
  ModelChoice choice;
};
/// A text to print: help, the version, a shell's completion file or the man page.
struct PrintCommand {
  std::string text;
};

using Command = std::variant<RenderCommand, SubmitCommand, UpCommand, JoinCommand, JobsCommand,
                             StatusCommand, WatchCommand, CancelCommand, FetchCommand, NodesCommand,
                             LogCommand, DownCommand, KeyCommand, CheckCommand, CompareCommand,
                             SimulateCommand, DrawCommand, ConvertCommand, PrintCommand>;

/// Throws a usage failure. The arguments are main's, the command's own name first.
Command parse_command_line(int argc, const char* const* argv);

}  // namespace graycube
