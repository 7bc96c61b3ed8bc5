// graycube simulate: renders a scene by the real brains on a machine that is only simulated.
#include <algorithm>
#include <cstdio>

#include "cli/commands/commands.hpp"
#include "cli/display/bars_svg.hpp"
#include "cli/display/table.hpp"
#include "cli/interrupts.hpp"
#include "cli/option_sense.hpp"
#include "cli/render_here.hpp"
#include "proto/comparison.hpp"
#include "proto/job_settings.hpp"
#include "proto/statistics.hpp"
#include "simulation/calibration.hpp"
#include "simulation/farm.hpp"
#include "simulation/message_doings.hpp"
#include "simulation/modelled_machine.hpp"
#include "simulation/traffic.hpp"
#include "transport/zmq_sockets.hpp"
#include "version.hpp"

namespace graycube {
namespace {

using simulation::CostFit;
using simulation::MachineFigures;
using simulation::PerUnit;
using simulation::Unit;

/// Costs are measured on at most so many nodes, with a picture whose sides are at most so long:
/// shorter when each ray is a message.
constexpr std::uint32_t kCalibrationNodes = 256, kCalibrationSide = 256, kBlockingSide = 128;
/// Simulated seconds after which a job counts as stalled.
constexpr double kStalled_s = 1e9;

constexpr std::pair<Unit, const char*> kUnitNames[] = {
    {Unit::kPiece, "piece_of_work"},       {Unit::kRay, "ray_traced"},
    {Unit::kVisit, "node_visited"},        {Unit::kTest, "primitive_tested"},
    {Unit::kBuildByte, "byte_built"},      {Unit::kNodeCall, "node_event"},
    {Unit::kRayIn, "ray_received"},        {Unit::kRayOut, "ray_sent"},
    {Unit::kReturn, "light_returned"},     {Unit::kLightByte, "byte_of_light_sent"},
    {Unit::kFrontalCall, "frontal_event"}, {Unit::kFrontalByte, "byte_of_light_added"},
    {Unit::kMessage, "message"},           {Unit::kMessageByte, "byte_of_message"},
    {Unit::kCipherByte, "byte_ciphered"},  {Unit::kWakeup, "wake_up"}};

std::vector<std::pair<std::string, double>> named(const PerUnit& costs) {
  std::vector<std::pair<std::string, double>> list;
  for (const auto& [unit, name] : kUnitNames) list.emplace_back(name, costs[unit]);
  return list;
}

/// The job that is measured: the same with a small picture.
control::JobOptions small_job(const SimulateCommand& command, const RenderSettings& settings) {
  control::JobOptions options = command.options;
  const std::uint32_t longest = std::max(settings.image.width, settings.image.height);
  const std::uint32_t side =
      command.options.flow == FlowMode::kBlocking ? kBlockingSide : kCalibrationSide;
  const std::uint32_t shrink = (longest + side - 1) / side;
  options.width = std::max(1u, settings.image.width / shrink);
  options.height = std::max(1u, settings.image.height / shrink);
  return options;
}

PerUnit costs_here(const SimulateCommand& command, const SceneInput& scene,
                   const RenderSettings& settings, const PerUnit& transport, std::uint32_t nodes) {
  PerUnit costs = simulation::measured_costs(scene.text, small_job(command, settings),
                                             std::min(kCalibrationNodes, nodes));
  costs[Unit::kMessageByte] = transport[Unit::kMessageByte];
  costs[Unit::kMessage] = transport[Unit::kMessage];
  costs[Unit::kWakeup] = transport[Unit::kWakeup];
  costs[Unit::kCipherByte] = simulation::kCipherByte_s;
  if (command.message_us) {
    costs[Unit::kMessage] = 1e-6 * *command.message_us;
    costs[Unit::kMessageByte] = 0;
    costs[Unit::kWakeup] = 0;
  }
  return costs;
}

PerUnit transport_here() {
  PerUnit costs;
  {
    const InterruptsHeld held;  // there is a folder with a socket to remove
    costs = simulation::transport_costs();
  }
  throw_if_interrupted();
  return costs;
}

MachineFigures machine_of(const SimulateCommand& command, const PerUnit& costs,
                          std::uint32_t nodes) {
  MachineFigures figures;
  figures.link_gbps = command.link_gbps;
  figures.host_gbps = command.host_gbps.value_or(command.link_gbps);
  figures.link_us = command.link_us;
  if (command.hosts > 0) figures.placement = HostPlacement::even(nodes, command.hosts);
  figures.local_gbps = command.local_gbps.value_or(figures.local_gbps);
  figures.local_us = command.local_us.value_or(figures.local_us);
  figures.cores = command.cores;
  figures.cpu_scale = command.cpu_scale;
  figures.costs = costs;
  return figures;
}

/// The statistics of what the nodes of a job that failed had done until then.
std::string statistics_until_failure(const simulation::Outcome& outcome, const SceneInput& scene,
                                     const SimulateCommand& command, const RenderSettings& settings,
                                     std::uint32_t nodes) {
  Statistics s;
  s.version = kVersion;
  s.scene = scene.name;
  s.algorithm = command.options.algorithm;
  s.nodes = nodes;
  s.scatter = std::max(1u, command.options.scatter);
  s.shadows = command.options.shadows;
  s.partition = command.options.partition;
  s.flow = command.options.flow;
  s.fifo = command.options.fifo;
  s.sums = sums_of(command.options);
  s.mesh = command.options.mesh;
  s.subdivision = command.options.subdivision;
  s.returns = command.options.returns;
  s.boundaries = command.options.boundaries;
  s.image = settings.image;
  s.render_s = outcome.render_s;
  s.token_rounds = outcome.rounds;
  s.per_node = outcome.reports;
  for (const control::NodeStats& n : s.per_node) s.cpu_s += n.cpu_s;
  return statistics_json(s);
}

RowOutcome outcome_of(const simulation::Outcome& outcome, simulation::Farm& farm,
                      const Picture& reference) {
  if (!outcome.violations.empty() || !outcome.ended) return RowOutcome::kFailed;
  if (outcome.failed) {
    return outcome.failed->code == FailureCode::kDeadlock ? RowOutcome::kDeadlocked
                                                          : RowOutcome::kFailed;
  }
  const Picture* picture = farm.store().picture(1);
  return picture != nullptr && *picture == reference ? RowOutcome::kSame : RowOutcome::kDifferent;
}

std::string why_of(const simulation::Outcome& outcome) {
  std::string why;
  for (const std::string& v : outcome.violations) why += v + "; ";
  if (outcome.failed && !outcome.failed->errors.empty()) why += outcome.failed->errors.front().why;
  return why;
}

void add_traffic(const simulation::Traffic& traffic, const std::optional<HostPlacement>& placement,
                 SimulatedRow& row) {
  if (!placement) return;
  row.hosts = placement->hosts();
  row.bytes_between_hosts = traffic.between_hosts(*placement);
  row.bytes_with_frontal = traffic.with_frontal();
}

/// What a job's statistics tell, or those of what was done until it failed.
void add_statistics(const simulation::Outcome& outcome, const SceneInput& scene,
                    const SimulateCommand& command, const RenderSettings& settings,
                    double frontal_gbps, SimulatedRow& row) {
  if (outcome.done) {
    row.row.statistics = outcome.done->stats.text;
  } else if (!outcome.reports.empty()) {
    row.row.statistics = statistics_until_failure(outcome, scene, command, settings, row.nodes);
  }
  if (row.row.statistics.empty()) return;
  const Figures f = figures_of(row.row.statistics);
  row.time_s = f.render_s;
  const double light_s = 8e-9 * static_cast<double>(f.light_bytes) / frontal_gbps;
  row.host_load = row.time_s > 0 ? light_s / row.time_s : 0;
}

SimulatedRow simulated(const SimulateCommand& command, const SceneInput& scene,
                       const RenderSettings& settings, const PerUnit& transport,
                       const Picture& reference, std::uint32_t nodes) {
  const PerUnit costs = costs_here(command, scene, settings, transport, nodes);
  const MachineFigures figures = machine_of(command, costs, nodes);
  simulation::ModelledMachine machine(figures);
  simulation::Farm farm({.nodes = nodes,
                         .threads = 1,
                         // Slow machines are pinged less often.
                         .heartbeat_s = std::max(1.0, command.cpu_scale / 1000),
                         .stalled_s = kStalled_s,
                         .hosts = std::max(1u, command.hosts)},
                        machine);
  CostFit measured(simulation::measuring_overhead_s());
  farm.observe = [&](const PerUnit& doings, double seconds) { measured.add(doings, seconds); };
  simulation::Traffic traffic(nodes);
  farm.on_sent = [&](simulation::Place from, simulation::Place to, double, const Message& m) {
    traffic.add(from, to, simulation::bytes_of(m));
  };
  control::JobOptions options = command.options;
  options.timeout_s = 0;
  const simulation::Outcome outcome = farm.render(scene.text, options);
  SimulatedRow row;
  row.nodes = nodes;
  row.costs = named(costs);
  row.distribution_s = outcome.distribution_s;
  add_traffic(traffic, figures.placement, row);
  row.row.name = std::to_string(nodes) + (nodes == 1 ? " node" : " nodes");
  row.row.why = why_of(outcome);
  row.row.outcome = outcome_of(outcome, farm, reference);
  if (measured.seconds() > 0) {
    row.predicted_over_measured =
        simulation::cost_of(measured.counts(), costs) / measured.seconds();
  }
  add_statistics(outcome, scene, command, settings, figures.host_gbps, row);
  return row;
}

std::string megabytes(std::uint64_t bytes) {
  return number_text("%.1f", 1e-6 * static_cast<double>(bytes));
}

std::string table_of(const std::vector<SimulatedRow>& rows, double serial_s) {
  const bool has_hosts = !rows.empty() && rows.front().hosts > 0;
  std::vector<std::vector<std::string>> cells{{"NODES", "TIME s", "SPEED-UP", "EFFICIENCY",
                                               "BLOCKED %", "HOST LINK %", "CPU s", "MESSAGES",
                                               "MB", "ROUNDS", "QUEUE PEAK", "PICTURE", "COSTS"}};
  if (has_hosts) {
    auto& names = cells.front();
    names.insert(names.end() - 2, {"BETWEEN HOSTS MB", "FRONTAL MB"});
  }
  for (const SimulatedRow& r : rows) {
    auto& line = cells.emplace_back(std::vector<std::string>{std::to_string(r.nodes)});
    if (r.row.statistics.empty()) {
      line.resize(cells.front().size() - 2, "-");
    } else {
      const Figures f = figures_of(r.row.statistics);
      const bool ended =
          r.row.outcome == RowOutcome::kSame || r.row.outcome == RowOutcome::kDifferent;
      line.insert(line.end(),
                  {number_text("%.4g", r.time_s),
                   ended ? number_text("%.2f", r.time_s > 0 ? serial_s / r.time_s : 0) : "-",
                   number_text("%.2f", f.efficiency), number_text("%.1f", 100 * f.blocked_fraction),
                   number_text("%.1f", 100 * r.host_load), number_text("%.4g", f.cpu_s),
                   std::to_string(f.messages), megabytes(f.message_bytes), std::to_string(f.rounds),
                   std::to_string(f.queue_peak)});
      if (has_hosts) {
        line.insert(line.end(),
                    {megabytes(r.bytes_between_hosts), megabytes(r.bytes_with_frontal)});
      }
    }
    line.push_back(to_string(r.row.outcome));
    line.push_back(number_text("%.2f", r.predicted_over_measured));
  }
  std::string text = table_text(cells);
  for (const SimulatedRow& r : rows) {
    if (!r.row.why.empty()) text += r.row.name + ": " + r.row.why + "\n";
  }
  return text;
}

/// Throws a usage failure unless every host has a node.
void check_hosts(const SimulateCommand& command) {
  if (command.hosts == 0) {
    for (const auto& [name, value] : {std::pair{"--local-gbps", command.local_gbps},
                                      std::pair{"--local-us", command.local_us}}) {
      if (value) throw usage_failure(name, "is for --hosts");
    }
  }
  const std::uint32_t least = std::ranges::min(command.nodes);
  if (command.hosts > least) {
    throw usage_failure("--hosts", "expected at most as many as nodes, found " +
                                       std::to_string(command.hosts) + " for " +
                                       std::to_string(least));
  }
}

void say(const SimulateCommand& command, const std::string& what) {
  if (!command.is_quiet) std::fprintf(stderr, "%s\n", what.c_str());
}

void write_plot(const SimulateCommand& command, const SceneInput& scene,
                const std::vector<SimulatedRow>& rows) {
  std::vector<ComparedRow> bars;
  for (const SimulatedRow& r : rows) bars.push_back(r.row);
  write_text_file(command.plot,
                  bars_svg(scene.name + ", simulated: what evaluators did with their time", bars));
}

}  // namespace

ExitStatus run(const SimulateCommand& command) {
  catch_interrupts("simulate", command.options.timeout_s);
  if (command.options.algorithm == Algorithm::kSerial) {
    throw usage_failure("--algorithm", "serial runs on no farm; expected auto, roth or macro");
  }
  check_sense(command.options);
  check_hosts(command);
  if (!command.plot.empty()) check_output("--plot", command.plot, command.scene);
  check_ending("--plot", command.plot, ".svg", "SVG");
  SceneInput scene = read_scene_input(command.scene, command.options, command.choice);
  if (!command.is_quiet) {
    for (const Problem& warning : scene.warnings) print(warning);
  }
  prepare_for_farm(scene, command.options);
  RenderSettings settings = scene.scene.settings;
  apply_overrides(command.options, settings);
  ProgressDisplay display(stderr, command.is_quiet);
  const Rendered serial = render_here(scene, command.options, 1, display);
  const double serial_s = figures_of(serial.stats).nodes.front().busy_s * command.cpu_scale;
  scene.scene = {};
  const PerUnit transport = transport_here();
  std::vector<SimulatedRow> rows;
  for (const std::uint32_t nodes : command.nodes) {
    say(command, "simulating " + std::to_string(nodes) + (nodes == 1 ? " node" : " nodes"));
    rows.push_back(simulated(command, scene, settings, transport, serial.picture, nodes));
  }
  const std::string text =
      command.as_json ? simulation_json(scene.name, rows) + "\n" : table_of(rows, serial_s);
  std::fwrite(text.data(), 1, text.size(), stdout);
  if (!command.plot.empty()) write_plot(command, scene, rows);
  for (const SimulatedRow& r : rows) {
    if (r.row.outcome == RowOutcome::kDifferent || r.row.outcome == RowOutcome::kFailed) {
      throw Failure(ExitStatus::kFailed,
                    Problem{"simulate", r.row.name,
                            r.row.why.empty() ? "its picture is not serial's" : r.row.why});
    }
  }
  return ExitStatus::kDone;
}

}  // namespace graycube
