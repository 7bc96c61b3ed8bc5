// graycube compare: renders one scene in every way, and prints one table.
#include <chrono>

#include "cli/commands/commands.hpp"
#include "cli/commands/compare_ways.hpp"
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

std::string table_of(const std::vector<ComparedRow>& rows, bool is_report) {
  const Figures serial = figures_of(rows.front().statistics);
  std::vector<std::vector<std::string>> cells{{"WAY", "WALL s", "CPU s", "CPU/SERIAL", "EFFICIENCY",
                                               "BLOCKED %", "RAYS FORWARDED", "MESSAGES", "MB",
                                               "MEMORY %", "ROUNDS", "QUEUE PEAK"}};
  if (is_report) cells.front().insert(cells.front().end(), {"CELLS", "TESTS/RAY"});
  cells.front().emplace_back("PICTURE");
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
      if (is_report) {
        line.insert(line.end(), {std::to_string(f.cells),
                                 number_text("%.1f", f.rays > 0 ? static_cast<double>(f.tests) /
                                                                      static_cast<double>(f.rays)
                                                                : 0)});
      }
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

TimedRender render_serially(const control::JobOptions& options, const SceneInput& scene,
                            ProgressDisplay& display) {
  const auto started = std::chrono::steady_clock::now();
  const double cpu_before_s = process_cpu_seconds();
  TimedRender timed{render_here(scene, options, 1, display)};
  timed.wall_s = seconds_since(started);
  timed.cpu_s = process_cpu_seconds() - cpu_before_s;
  return timed;
}

ComparedRow compared_here(const SceneInput& scene, const Way& way, const Picture& reference,
                          ProgressDisplay& display) {
  const TimedRender timed = render_serially(way.options, scene, display);
  return {way.name,
          way.arguments,
          timed.rendered.picture == reference ? RowOutcome::kSame : RowOutcome::kDifferent,
          {},
          with_command_times(timed.rendered.stats, timed.wall_s, timed.cpu_s)};
}

/// Serial's row comes first, but it is rendered again at the end, and gets the mean of both times:
/// machines get slower and quicker, and all rows are compared with this one.
std::vector<ComparedRow> compare_all(const CompareCommand& command, const SceneInput& scene,
                                     ProgressDisplay& display) {
  std::vector<ComparedRow> rows;
  const TimedRender first = render_serially(command.options, scene, display);
  rows.push_back({"serial", "--algorithm serial", RowOutcome::kReference, {}, {}});
  {
    const InterruptsHeld held;
    FrontalProcess frontal(
        {"--private", "--nodes", std::to_string(command.nodes), "--threads", "1"});
    FarmClient farm(frontal.wait_until_listening(), [&] {
      throw_if_interrupted();
      frontal.check_running();
    });
    const auto ways =
        command.is_report ? ways_of_report(command.options) : ways_of_algorithms(command.options);
    for (const Way& way : ways) {
      rows.push_back(way.options.algorithm == Algorithm::kSerial
                         ? compared_here(scene, way, first.rendered.picture, display)
                         : compared(farm, scene, way, first.rendered.picture, display));
    }
    frontal.stop();
  }
  const TimedRender last = render_serially(command.options, scene, display);
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
  for (const Problem& warning : scene.warnings) print(warning);
  prepare_for_farm(scene, command.options);
  ProgressDisplay display(stderr, command.is_quiet);
  const std::vector<ComparedRow> rows = compare_all(command, scene, display);
  display.clear();
  const std::string text = command.as_json ? comparison_json(scene.name, command.nodes, rows) + "\n"
                                           : table_of(rows, command.is_report);
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
