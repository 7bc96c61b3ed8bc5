#include "cli/command_line.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <functional>
#include <optional>
#include <vector>

#include "cli/failure.hpp"
#include "cli/option_values.hpp"
#include "cli/options/completion.hpp"
#include "cli/options/join_options.hpp"
#include "cli/options/listing.hpp"
#include "cli/options/machine_options.hpp"
#include "cli/options/man_page.hpp"
#include "cli/options/shared_options.hpp"
#include "cli/options/usage.hpp"
#include "keep_rule.hpp"
#include "version.hpp"

namespace graycube {
namespace {

/// All commands; after parsing, the chosen command's values are in its declaration.
class Parser {
 public:
  Parser() {
    app_.set_version_flag("-v,--version", std::string("graycube ") + kVersion, "Print the version");
    app_.set_help_flag("-h,--help", "Print this help");
    app_.require_subcommand(1);
    declare_rendering();
    declare_up();
    declare_join();
    declare_submit();
    declare_clients();
    declare_check();
    declare_compare();
    declare_convert();
    declare_simulate();
    declare_draw();
    declare_texts();
  }

  CLI::App& app() { return app_; }

  std::vector<std::string> command_names() {
    std::vector<std::string> names;
    for (const CLI::App* sub : app_.get_subcommands([](CLI::App*) { return true; })) {
      names.push_back(sub->get_name());
    }
    return names;
  }

  Command parse(std::vector<std::string> words) {
    try {
      std::reverse(words.begin(), words.end());  // as CLI11 takes them
      app_.parse(std::move(words));
    } catch (const CLI::CallForVersion& e) {
      return PrintCommand{std::string(e.what()) + "\n"};
    } catch (const CLI::Success&) {
      return PrintCommand{app_.help()};
    } catch (const CLI::ParseError& e) {
      throw usage_failure_of(app_, e);
    }
    return chosen_();
  }

 private:
  /// A command's values, and where its options are declared.
  template <typename C>
  struct Declared {
    C& command;
    Declaring options;
  };

  template <typename C>
  Declared<C> declare(const char* name, const char* help) {
    auto command = std::make_shared<C>();
    CLI::App* sub = app_.add_subcommand(name, help);
    sub->callback([this, command] { chosen_ = [command]() -> Command { return *command; }; });
    return {*command, Declaring(*sub, described_.emplace_back(CommandDescription{name, help, {}}))};
  }

  void declare_rendering() {
    auto declared = declare<RenderCommand>("render", "Render a scene on nodes of this machine");
    RenderCommand& render = declared.command;
    Declaring& options = declared.options;
    add_scene(options, render.scene);
    add_model_choice(options, render.choice);
    add_outputs(options, render.outputs, "The picture (default: SCENE's name with .exr, here)");
    add_nodes(options, render.nodes);
    add_farm(options, render.farm);
    add_threads(options, render.threads, "Evaluator threads per node (default 1)");
    add_job_options(options, render.options);
    add_losses(options, render.losses);
    options.option({.names = "--checkpoint",
                    .value = "FILE",
                    .help = "Keep there what is done; the same command goes on from it",
                    .kind = ValueKind::kFile},
                   [&render](const std::string& text) { render.checkpoint = text; });
    options.flag("--json", render.as_json, "Progress, and what was written, as lines of JSON");
    options.flag("--quiet,-q", render.is_quiet, "Print nothing but errors");
  }

  void declare_join() {
    auto declared = declare<JoinCommand>("join", "Give this machine to a farm");
    add_join_options(declared.options, declared.command);
  }

  void declare_up() {
    auto declared = declare<UpCommand>("up", "Start a farm and keep it running");
    UpCommand& up = declared.command;
    Declaring& options = declared.options;
    add_nodes(options, up.nodes);
    add_threads(options, up.threads, "Evaluator threads per node (default 1)");
    add_farm(options, up.farm);
    options.option(
        {.names = "--listen", .value = "ENDPOINT", .help = "ipc:///PATH or tcp://HOST:PORT"},
        [&up](const std::string& text) { up.listen = text; });
    options.option({.names = "--key",
                    .value = "FILE",
                    .help = "Where the farm's key is kept, if it listens at a TCP port",
                    .kind = ValueKind::kFile},
                   [&up](const std::string& text) { up.key = text; });
    options.option({.names = "--state",
                    .value = "DIR",
                    .help = "Keep jobs and pictures there, over restarts",
                    .kind = ValueKind::kFolder},
                   [&up](const std::string& text) { up.state = text; });
    options.option(
        {.names = "--keep",
         .value = "N|DAYS",
         .help = "Ended jobs to keep: the newest N, or those of e.g. 30d (default: all)"},
        [&up](const std::string& text) {
          if (!parse_keep_rule(text)) throw usage_failure("--keep " + text, kKeepRuleText);
          up.keep = text;
        });
    options.option({.names = "--http",
                    .value = "HOST:PORT",
                    .help = "A web page of the farm at this loopback address"},
                   [&up](const std::string& text) { up.http = text; });
    add_log(options, up.log, up.is_quiet);
    add_losses(options, up.losses);
    add_outbox_rays(options, up.outbox_rays);
  }

  void declare_submit() {
    auto [submit, options] =
        declare<SubmitCommand>("submit", "Give a farm a scene; prints the job's id");
    add_scene(options, submit.scene);
    add_model_choice(options, submit.choice);
    add_outputs(options, submit.outputs, "The picture, with --wait");
    add_nodes(options, submit.nodes, "What the farm is expected to have");
    add_threads(options, submit.options.threads,
                "Evaluator threads per node (default: the farm's)");
    add_job_options(options, submit.options);
    options.flag("--quiet,-q", submit.is_quiet, "With --wait: no progress");
    options.flag("--json", submit.as_json, "The id, and with --wait progress, as lines of JSON");
    options.flag("--wait", submit.waits, "Wait for the end, with progress");
    add_connect(options, submit.connect);
  }

  /// Declares a command that asks a farm for something, about a job or not; `add_more` declares its
  /// options beyond those that all such commands have.
  template <typename C>
  void declare_client(
      const char* name, const char* help,
      const std::function<void(Declaring&, C&)>& add_more = [](Declaring&, C&) {}) {
    auto declared = declare<C>(name, help);
    if constexpr (requires { declared.command.job; }) {
      add_job(declared.options, declared.command.job);
    }
    add_more(declared.options, declared.command);
    add_connect(declared.options, declared.command.connect);
  }

  void declare_clients() {
    declare_client<JobsCommand>("jobs", "List a farm's jobs", add_job_listing);
    declare_client<StatusCommand>(
        "status", "How a job is getting on, or the farm",
        [](Declaring& options, StatusCommand& status) {
          options.option({.names = "JOB", .help = "The job's id, as 'submit' and 'jobs' print it"},
                         [&status](const std::string& text) {
                           status.number = parse_count("JOB", text, 1, 0xFFFFFFFFu);
                         });
          options.flag("--farm", status.is_of_farm, "The farm itself, instead of a job");
          options.flag("--json", status.as_json, "As one line of JSON");
        });
    declare_client<WatchCommand>(
        "watch", "Follow a job to its end", [](Declaring& options, WatchCommand& watch) {
          options.flag("--json", watch.as_json, "Progress, and the job's end, as lines of JSON");
        });
    declare_client<CancelCommand>("cancel", "Stop a job");
    declare_client<FetchCommand>("fetch", "Get a job's picture",
                                 [](Declaring& options, FetchCommand& fetch) {
                                   add_outputs(options, fetch.outputs, "The picture", true);
                                 });
    declare_client<NodesCommand>("nodes", "List a farm's nodes",
                                 [](Declaring& options, NodesCommand& nodes) {
                                   options.flag("--json", nodes.as_json, "As one line of JSON");
                                 });
    declare_client<LogCommand>("log", "What a farm's log says", add_log_listing);
    declare_client<DownCommand>("down", "Stop a farm");
    auto key = declare<KeyCommand>("key", "Print a new key for a farm at a TCP port");
    add_farm_of_client(key.options, key.command.of_farm);
  }

  void declare_check() {
    auto declared = declare<CheckCommand>("check", "Find every error of a scene file");
    CheckCommand& check = declared.command;
    Declaring& options = declared.options;
    add_scene(options, check.scene);
    add_model_choice(options, check.choice);
    options.flag("--json", check.as_json, "What is found as one line of JSON");
  }

  void declare_compare() {
    auto declared = declare<CompareCommand>("compare", "Render a scene in every way, and compare");
    CompareCommand& compare = declared.command;
    Declaring& options = declared.options;
    compare.nodes = default_nodes();
    add_scene(options, compare.scene);
    add_model_choice(options, compare.choice);
    add_nodes(options, compare.nodes);
    add_common_options(options, compare.options);
    options.flag("--report", compare.is_report,
                 "Every subdivision of space with each distribution, as the report would have it");
    add_table_options(options, compare.as_json, compare.is_quiet, compare.plot);
  }

  void declare_convert() {
    auto declared = declare<ConvertCommand>("convert", "Convert a file, by the names' endings");
    ConvertCommand& convert = declared.command;
    Declaring& options = declared.options;
    options.option({.names = "IN",
                    .help = "A scene (" + scene_endings_text() + ") or a picture (.exr)",
                    .kind = ValueKind::kFile,
                    .is_required = true},
                   [&convert](const std::string& text) { convert.in = text; });
    options.option({.names = "OUT",
                    .help = "From a scene: .json, .cbor or .pov; from .exr: .png",
                    .kind = ValueKind::kFile,
                    .is_required = true},
                   [&convert](const std::string& text) { convert.out = text; });
    add_model_choice(options, convert.choice);
  }

  void declare_simulate() {
    auto declared =
        declare<SimulateCommand>("simulate", "Predict how a scene renders on other machines");
    SimulateCommand& c = declared.command;
    Declaring& options = declared.options;
    add_scene(options, c.scene);
    add_model_choice(options, c.choice);
    options.option({.names = "-n,--nodes",
                    .value = "N,N,...",
                    .help = "Numbers of nodes, each a power of two from 1 to 1024",
                    .is_required = true},
                   [&c](const std::string& text) { c.nodes = parse_node_list("--nodes", text); });
    add_machine(options, c);
    add_job_options(options, c.options);
    add_table_options(options, c.as_json, c.is_quiet, c.plot);
  }

  void declare_draw() {
    auto declared = declare<DrawCommand>("draw", "Draw a figure of how a scene is rendered");
    DrawCommand& c = declared.command;
    Declaring& options = declared.options;
    add_scene(options, c.scene);
    add_model_choice(options, c.choice);
    options.option({.names = "--figure",
                    .value = "NAME",
                    .help = "hypercube, macro-regions, bsp, pointers, entry, traffic or token",
                    .kind = ValueKind::kChoice,
                    .choices = names_of(kFigureChoices),
                    .is_required = true},
                   [&c](const std::string& text) { c.figure = parse_figure("--figure", text); });
    add_nodes(options, c.nodes,
              "Nodes: a power of two, 1 to 64 (default " + std::to_string(c.nodes) + ")");
    options.option({.names = "-o,--output",
                    .value = "OUT.svg",
                    .help = "The drawing (default: SCENE's name with -FIGURE.svg, here)",
                    .kind = ValueKind::kFile},
                   [&c](const std::string& text) { c.output = text; });
    add_how(options, c.options);
    add_common_options(options, c.options);
    options.flag("--quiet,-q", c.is_quiet, "Print nothing but errors");
  }

  /// Declares the commands that print texts made of these very declarations.
  void declare_texts() {
    const char* help = "Print what makes a shell complete this command's options";
    CLI::App* sub = app_.add_subcommand("completion", help);
    const auto shell = std::make_shared<Shell>();
    sub->callback([this, shell] {
      chosen_ = [this, shell] { return PrintCommand{completion_text(*shell, described_)}; };
    });
    Declaring options(*sub, described_.emplace_back(CommandDescription{"completion", help, {}}));
    options.option({.names = "SHELL",
                    .help = "bash, zsh or fish",
                    .kind = ValueKind::kChoice,
                    .choices = names_of(kShellChoices),
                    .is_required = true},
                   [shell](const std::string& text) { *shell = parse_shell("SHELL", text); });
    // This is only for the build, which installs the page: users read it by `man graycube`.
    CLI::App* page = app_.add_subcommand("man-page", "Print the man page")->group("");
    page->callback([this] { chosen_ = [this] { return PrintCommand{man_page(described_)}; }; });
  }

  CLI::App app_{"Graycube renders solid models by ray tracing, on a hypercube of processes.",
                "graycube"};
  CommandLineDescription described_;
  std::function<Command()> chosen_;
};

template <typename C>
concept IsQuietImport = requires(C command) {
  command.choice;
  command.is_quiet;
};

}  // namespace

Command parse_command_line(int argc, const char* const* argv) {
  Parser parser;
  const std::vector<std::string> words = words_of(argc, argv);
  const auto names = parser.command_names();
  const bool is_known =
      !words.empty() && std::find(names.begin(), names.end(), words.front()) != names.end();
  try {
    check_command_name(words, names);
    Command command = parser.parse(words);
    std::visit(
        [](auto& c) {
          if constexpr (requires { c.connect; }) resolve(c.connect);
          if constexpr (IsQuietImport<decltype(c)>) c.choice.is_quiet = c.is_quiet;
        },
        command);
    return command;
  } catch (const Failure& failure) {
    throw with_help(failure, is_known ? words.front() : "");
  }
}

}  // namespace graycube
