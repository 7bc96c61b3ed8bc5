// graycube compare: renders one scene in every way, and prints one table.
#include <chrono>

#include "cli/commands/commands.hpp"
#include "cli/display/bars_svg.hpp"
#include "cli/display/table.hpp"
#include "cli/farm/frontal_process.hpp"
#include "cli/farm/job_client.hpp"
#include "cli/interrupts.hpp"
#include "cli/render_here.hpp"
#include "process/clocks.hpp"
#include "proto/comparison.hpp"
#include "proto/statistics.hpp"

namespace graycube {
namespace {

/// A way to render: its name, its arguments for `graycube render`, and its options.
struct Way {
  std::string name, arguments;
  control::JobOptions options;
};

std::vector<Way> ways_of(const control::JobOptions& common) {
  std::vector<Way> ways;
  const auto add = [&](std::string name, std::string arguments, auto&& set) {
    Way way{std::move(name), std::move(arguments), common};
    set(way.options);
    ways.push_back(std::move(way));
  };
  for (const Grain grain : {Grain::kPixel, Grain::kLine, Grain::kTile}) {
    const std::string name(to_string(grain));
    add("roth " + name, "--algorithm roth --grain " + name, [&](auto& o) {
      o.algorithm = Algorithm::kRoth;
      o.grain = grain;
    });
  }
  struct Macro {
    ShadowMode shadows = ShadowMode::kForward;
    std::uint32_t scatter = 1;
    PartitionMode partition = PartitionMode::kRegular;
    /// Places of a blocking queue; 0 for flow by credit.
    std::uint32_t queue = 0;
  };
  const auto macro = [&](std::string name, const Macro& m) {
    std::string arguments = "--algorithm macro --shadows " + std::string(to_string(m.shadows)) +
                            " --scatter " + std::to_string(m.scatter) + " --partition " +
                            std::string(to_string(m.partition));
    if (m.queue != 0) arguments += " --flow blocking --queue " + std::to_string(m.queue);
    add(std::move(name), std::move(arguments), [&](auto& o) {
      o.algorithm = Algorithm::kMacro;
      o.shadows = m.shadows;
      o.scatter = m.scatter;
      o.partition = m.partition;
      o.flow = m.queue != 0 ? FlowMode::kBlocking : FlowMode::kCredit;
      if (m.queue != 0) o.queue = m.queue;
    });
  };
  macro("macro as in 1987", {.queue = common.queue});
  macro("  with endless queues", {.queue = kMaxQueue});
  macro("macro, credits", {});
  macro("macro, horizons", {.shadows = ShadowMode::kHorizon});
  macro("macro, local shadows", {.shadows = ShadowMode::kLocal});
  macro("macro, scatter 2", {.scatter = 2});
  macro("macro, balance", {.partition = PartitionMode::kBalanced});
  macro("macro, all", {.shadows = ShadowMode::kHorizon, .partition = PartitionMode::kAuto});
  add("auto", "--algorithm auto", [](auto& o) { o.algorithm = Algorithm::kAuto; });
  return ways;
}

ComparedRow compared(FarmClient& farm, const SceneInput& scene, const Way& way,
                     const Picture& reference, ProgressDisplay& display) {
  ComparedRow row{way.name, way.arguments, RowOutcome::kSame, {}, {}};
  const std::uint32_t job = submit_scene(farm, scene, way.options);
  try {
    row.statistics = follow_job(farm, job, display);
  } catch (const Failure& failure) {
    throw_if_interrupted();
    if (failure.problems().empty() || failure.status() == ExitStatus::kBadInput) throw;
    row.why = failure.problems().front().why;
    row.outcome = failure.is_deadlock() ? RowOutcome::kDeadlocked : RowOutcome::kFailed;
    row.statistics = failure.statistics();
    return row;
  }
  if (fetch_picture(farm, job) != reference) row.outcome = RowOutcome::kDifferent;
  return row;
}

std::string table_of(const std::vector<ComparedRow>& rows) {
  const Figures serial = figures_of(rows.front().statistics);
  std::vector<std::vector<std::string>> cells{{"WAY", "WALL s", "CPU s", "CPU/SERIAL", "EFFICIENCY",
                                               "BLOCKED %", "RAYS FORWARDED", "MESSAGES", "MB",
                                               "MEMORY %", "ROUNDS", "QUEUE PEAK", "PICTURE"}};
  for (const ComparedRow& row : rows) {
    auto& line = cells.emplace_back(std::vector<std::string>{row.name});
    if (row.statistics.empty()) {
      line.resize(cells.front().size() - 1, "-");
    } else {
      const Figures f = figures_of(row.statistics);
      const auto memory = static_cast<double>(f.largest_memory_bytes);
      const auto whole = static_cast<double>(serial.largest_memory_bytes);
      line.insert(line.end(),
                  {number_text("%.2f", f.wall_s), number_text("%.2f", f.cpu_s),
                   number_text("%.2f", serial.cpu_s > 0 ? f.cpu_s / serial.cpu_s : 0),
                   number_text("%.2f", f.efficiency), number_text("%.1f", 100 * f.blocked_fraction),
                   std::to_string(f.forwarded), std::to_string(f.messages),
                   number_text("%.1f", 1e-6 * static_cast<double>(f.message_bytes)),
                   number_text("%.1f", whole > 0 ? 100 * memory / whole : 0),
                   std::to_string(f.rounds), std::to_string(f.queue_peak)});
    }
    line.push_back(to_string(row.outcome));
  }
  std::string text = table_text(cells);
  for (const ComparedRow& row : rows) {
    if (!row.why.empty()) text += row.name + ": " + row.why + "\n";
  }
  return text;
}

struct TimedRender {
  Rendered rendered;
  double wall_s = 0, cpu_s = 0;
};

TimedRender render_serially(const CompareCommand& command, const SceneInput& scene,
                            ProgressDisplay& display) {
  const auto started = std::chrono::steady_clock::now();
  const double cpu_before_s = process_cpu_seconds();
  TimedRender timed{render_here(scene, command.options, 1, display)};
  timed.wall_s = seconds_since(started);
  timed.cpu_s = process_cpu_seconds() - cpu_before_s;
  return timed;
}

/// Serial's row comes first, but it is rendered again at the end, and gets the mean of both times:
/// machines get slower and quicker, and all rows are compared with this one.
std::vector<ComparedRow> compare_all(const CompareCommand& command, const SceneInput& scene,
                                     ProgressDisplay& display) {
  std::vector<ComparedRow> rows;
  const TimedRender first = render_serially(command, scene, display);
  rows.push_back({"serial", "--algorithm serial", RowOutcome::kReference, {}, {}});
  {
    const InterruptsHeld held;
    FrontalProcess frontal(
        {"--private", "--nodes", std::to_string(command.nodes), "--threads", "1"});
    FarmClient farm(frontal.wait_until_listening(), [&] {
      throw_if_interrupted();
      frontal.check_running();
    });
    for (const Way& way : ways_of(command.options)) {
      rows.push_back(compared(farm, scene, way, first.rendered.picture, display));
    }
    frontal.stop();
  }
  const TimedRender last = render_serially(command, scene, display);
  rows.front().statistics = with_command_times(
      first.rendered.stats, (first.wall_s + last.wall_s) / 2, (first.cpu_s + last.cpu_s) / 2);
  return rows;
}

}  // namespace

ExitStatus run(const CompareCommand& command) {
  catch_interrupts("compare", 0);
  if (!command.plot.empty()) check_output("--plot", command.plot, command.scene);
  check_ending("--plot", command.plot, ".svg", "SVG");
  SceneInput scene = read_scene_input(command.scene, command.options, command.choice);
  check_is_built(command.scene, scene.scene);
  for (const Problem& warning : scene.warnings) print(warning);
  prepare_for_farm(scene, command.options);
  ProgressDisplay display(stderr, command.is_quiet);
  const std::vector<ComparedRow> rows = compare_all(command, scene, display);
  display.clear();
  const std::string text =
      command.as_json ? comparison_json(scene.name, command.nodes, rows) + "\n" : table_of(rows);
  std::fwrite(text.data(), 1, text.size(), stdout);
  if (!command.plot.empty()) {
    write_text_file(command.plot, bars_svg(scene.name + " on " + std::to_string(command.nodes) +
                                               " nodes: what evaluators did with their time",
                                           rows));
  }
  for (const ComparedRow& row : rows) {
    if (row.outcome == RowOutcome::kDifferent || row.outcome == RowOutcome::kFailed) {
      throw Failure(ExitStatus::kFailed,
                    Problem{"compare", row.arguments,
                            row.why.empty() ? "its picture is not serial's" : row.why});
    }
  }
  return ExitStatus::kDone;
}

}  // namespace graycube
