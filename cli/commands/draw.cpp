// graycube draw: the figures of the report of 1987, from the scene's own data and runs.
#include <algorithm>
#include <span>

#include "cli/commands/commands.hpp"
#include "cli/interrupts.hpp"
#include "cli/option_sense.hpp"
#include "cli/render_here.hpp"
#include "figures/bsp_figure.hpp"
#include "figures/entry_figure.hpp"
#include "figures/hypercube_figure.hpp"
#include "figures/macro_regions_figure.hpp"
#include "figures/pointers_figure.hpp"
#include "figures/token_figure.hpp"
#include "figures/traffic_figure.hpp"
#include "frontal/preparation/preparation.hpp"
#include "process/clocks.hpp"
#include "proto/job_settings.hpp"

namespace graycube {
namespace {

using figures::FigureName;

/// Pictures in figures are rendered so large that no side is longer, unless a size is given.
constexpr std::uint32_t kDrawnSide = 256;

[[noreturn]] void nothing_to_draw(const DrawCommand& command, const std::string& why) {
  throw Failure(ExitStatus::kBadInput,
                Problem{"draw", std::string(to_string(command.figure)), why});
}

void check_draw_options(const DrawCommand& command, const control::JobOptions& options) {
  const std::string figure(to_string(command.figure));
  if (command.options.algorithm != Algorithm::kAuto &&
      command.options.algorithm != Algorithm::kMacro) {
    throw usage_failure("--algorithm", "draws macro-regions; expected auto or macro");
  }
  check_sense(options);
  if (command.nodes > figures::kMostNodesDrawn) {
    throw usage_failure("-n", "figures show at most " + std::to_string(figures::kMostNodesDrawn) +
                                  " nodes, found " + std::to_string(command.nodes));
  }
  if (shows_messages(command.figure) && command.nodes < 2) {
    throw usage_failure("-n", "--figure " + figure + " needs at least 2 nodes");
  }
  const bool is_grid = options.mesh == MeshMode::k2d || options.mesh == MeshMode::kTree;
  if (!is_grid && command.figure != FigureName::kToken) {
    throw usage_failure("--mesh",
                        "--figure " + figure + " shows columns and rows of nodes, as 2d " +
                            "and tree have them, not " + std::string(to_string(options.mesh)));
  }
  const Subdivision way = options.subdivision.way;
  if (shows_leaves(command.figure) && !has_links(way)) {
    throw usage_failure("--subdivision", "--figure " + figure +
                                             " draws linked and arnaldi (default), not " +
                                             std::string(to_string(way)));
  }
  if (command.figure == FigureName::kEntry && options.subdivision.entry == Entry::kDescent) {
    throw usage_failure("--entry", "--figure entry draws extremal entry, not descent");
  }
}

/// The job whose picture or run is drawn. Where leaf regions are asked for and no subdivision, it
/// is the report's.
control::JobOptions job_of(const DrawCommand& command) {
  control::JobOptions options = command.options;
  options.algorithm = Algorithm::kMacro;
  Subdivision& way = options.subdivision.way;
  if (shows_leaves(command.figure) && way == Subdivision::kSurfaces) way = Subdivision::kArnaldi;
  return options;
}

void choose_size(control::JobOptions& options, const ImageSize& image) {
  const std::uint32_t longest = std::max(image.width, image.height);
  if (options.width || longest <= kDrawnSide) return;
  const auto shorter = [&](std::uint32_t side) {
    return std::max(1u, static_cast<std::uint32_t>(std::uint64_t{side} * kDrawnSide / longest));
  };
  options.width = shorter(image.width);
  options.height = shorter(image.height);
}

/// A scene, ready for all that figures are made of.
class Subject {
 public:
  explicit Subject(const DrawCommand& command)
      : command_(command),
        options_(job_of(command)),
        scene_(read_scene_input(command.scene, command.options, command.choice)) {
    if (!command.is_quiet) {
      for (const Problem& warning : scene_.warnings) print(warning);
    }
    choose_size(options_, scene_.scene.settings.image);
    prepare_for_farm(scene_, options_);
    settings_ = scene_.scene.settings;
    apply_overrides(options_, settings_);
  }

  const std::string& name() const { return scene_.name; }
  const RenderSettings& settings() const { return settings_; }
  Hypercube cube() const { return *Hypercube::of_size(command_.nodes); }
  /// That of figures of leaf regions.
  Subdivision way() const { return options_.subdivision.way; }

  /// The picture, found by today's subdivision: all give the same.
  Picture picture() const {
    control::JobOptions options = options_;
    options.algorithm = Algorithm::kSerial;
    options.subdivision = {};
    ProgressDisplay display(stderr, command_.is_quiet);
    return render_here(scene_, options, 1, display).picture;
  }
  Model model() const {
    SceneInput scene = scene_;
    scene.scene.settings = settings_;
    return compile_input(scene);
  }
  /// What a frontal makes of the scene.
  PreparedScene prepared() const {
    const auto text = std::as_bytes(std::span(scene_.text.data(), scene_.text.size()));
    PreparationWork work;
    work.scene_name = scene_.name;
    work.scene = Bytes(text.begin(), text.end());
    work.options = options_;
    work.cube = cube();
    PreparationResult result = prepare(work, thread_cpu_seconds);
    if (result.scene) return std::move(*result.scene);
    std::vector<Problem> problems;
    for (const control::ErrorItem& e : result.errors) problems.push_back({"scene", e.where, e.why});
    throw Failure(result.is_internal ? ExitStatus::kFailed : ExitStatus::kBadInput,
                  std::move(problems));
  }
  /// A run of the job on a simulated farm; one that ended in a deadlock counts.
  figures::RunRecord run() const {
    figures::RunRecord run = figures::record_run(scene_.text, options_, command_.nodes);
    const auto& failed = run.outcome.failed;
    if (failed && failed->code != FailureCode::kDeadlock) {
      throw Failure(ExitStatus::kFailed,
                    Problem{"draw", "the run",
                            failed->errors.empty() ? "it failed" : failed->errors.front().why});
    }
    if (run.is_cut_short) {
      throw usage_failure("--size", "more messages than a figure is made of, " +
                                        std::to_string(figures::RunRecord::kMostShipments) +
                                        "; draw a smaller picture");
    }
    return run;
  }

 private:
  const DrawCommand& command_;
  control::JobOptions options_;
  SceneInput scene_;
  RenderSettings settings_;
};

std::string macro_regions_of(const Subject& subject) {
  const PreparedScene prepared = subject.prepared();
  return figures::macro_regions_svg(subject.name(), subject.picture(), subject.cube(),
                                    prepared.grid, prepared.partition);
}

std::string leaves_of(const Subject& subject, FigureName figure) {
  const Model model = subject.model();
  const figures::LeafSpace space(model, subject.way());
  return figure == FigureName::kBsp ? figures::bsp_svg(subject.name(), subject.picture(), space)
                                    : figures::pointers_svg(subject.name(), space);
}

std::string entry_of(const Subject& subject, const DrawCommand& command) {
  const auto entry = figures::choose_entry(subject.run(), subject.prepared().slices, subject.way());
  if (!entry) {
    nothing_to_draw(command,
                    "no ray goes on to a neighbour where that can be drawn; --shadows forward "
                    "or a scene with mirrors has more");
  }
  return figures::entry_svg(subject.name(), *entry);
}

std::string traffic_of(const Subject& subject, const DrawCommand& command) {
  const figures::RunRecord run = subject.run();
  if (run.shipments.empty()) {
    nothing_to_draw(command, "no ray goes from one node to another; --shadows forward has more");
  }
  return figures::traffic_svg(subject.name(), subject.picture(), subject.settings(), subject.cube(),
                              run);
}

std::string token_of(const Subject& subject, const DrawCommand& command) {
  const figures::RunRecord run = subject.run();
  if (run.token.empty()) nothing_to_draw(command, "the run ended before the token set out");
  return figures::token_svg(subject.name(), subject.cube(), run);
}

std::string figure_of(const Subject& subject, const DrawCommand& command) {
  switch (command.figure) {
    case FigureName::kHypercube: return figures::hypercube_svg(subject.cube());
    case FigureName::kMacroRegions: return macro_regions_of(subject);
    case FigureName::kBsp:
    case FigureName::kPointers: return leaves_of(subject, command.figure);
    case FigureName::kEntry: return entry_of(subject, command);
    case FigureName::kTraffic: return traffic_of(subject, command);
    case FigureName::kToken: return token_of(subject, command);
  }
  return {};
}

/// SCENE's name without its ending, with "-FIGURE.svg", in the current folder.
std::filesystem::path default_svg(const DrawCommand& command) {
  return std::filesystem::path(command.scene).stem().string() + "-" +
         std::string(to_string(command.figure)) + ".svg";
}

}  // namespace

ExitStatus run(const DrawCommand& command) {
  catch_interrupts("draw", 0);
  check_draw_options(command, job_of(command));
  const std::filesystem::path out = command.output.empty() ? default_svg(command) : command.output;
  const char* option = command.output.empty() ? "" : "-o";
  check_output(option, out, command.scene);
  check_ending(option, out, ".svg", "SVG");
  const Subject subject(command);
  write_text_file(out, figure_of(subject, command));
  if (!command.is_quiet) std::printf("%s\n", out.c_str());
  return ExitStatus::kDone;
}

}  // namespace graycube
