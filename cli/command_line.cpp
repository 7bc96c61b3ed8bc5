#include "cli/command_line.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdlib>
#include <functional>
#include <optional>
#include <vector>

#include "cli/failure.hpp"
#include "cli/option_values.hpp"
#include "spelling.hpp"
#include "transport/endpoint.hpp"
#include "version.hpp"

namespace graycube {
namespace {

constexpr std::uint32_t kMaxCores = 1u << 16;

/// Declares an option whose text `take` turns into a value.
void add(CLI::App& app, const std::string& names, const char* type, const std::string& help,
         std::function<void(const std::string&)> take, bool is_required = false) {
  app.add_option_function<std::string>(names, std::move(take), help)
      ->type_name(type)
      ->required(is_required)
      ->multi_option_policy(CLI::MultiOptionPolicy::Throw);
}

void add_scene(CLI::App& app, std::string& scene) {
  add(
      app, "SCENE", "",
      "A scene file (.json), OpenSCAD's evaluated tree (.csg), BRL-CAD's database (.g, .asc), a "
      "mesh (.stl, .off)",
      [&scene](const std::string& text) { scene = text; }, true);
}

void add_facets(CLI::App& app, ModelChoice& choice) {
  app.add_flag("--facets", choice.facets, "OpenSCAD: what is round as OpenSCAD's own facets");
}

/// What to show of a model that says nothing of that itself.
void add_choice(CLI::App& app, ModelChoice& choice) {
  add_facets(app, choice);
  app.add_option_function<std::vector<std::string>>(
         "--object",
         [&choice](const std::vector<std::string>& names) {
           choice.objects = names;
           choice.is_given = true;
         },
         "BRL-CAD: what to show (again for more; default: all that nothing refers to)")
      ->type_name("NAME")
      ->expected(1)
      ->take_all();
  add(app, "--view", "FILE", "BRL-CAD: a view script, as rt reads it",
      [&choice](const std::string& text) {
        choice.view = text;
        choice.is_given = true;
      });
  const auto angle = [&](const char* name, const char* help, double& value) {
    add(app, name, "DEGREES", help, [&choice, &value, name](const std::string& text) {
      value = parse_angle(name, text);
      choice.is_given = true;
    });
  };
  angle("--azimuth", "BRL-CAD: from where to look (default 35)", choice.azimuth_degrees);
  angle("--elevation", "BRL-CAD: from how high to look (default 25)", choice.elevation_degrees);
}

void add_job(CLI::App& app, std::uint32_t& job) {
  add(
      app, "JOB", "", "The job's id, as 'submit' and 'jobs' print it",
      [&job](const std::string& text) { job = parse_count("JOB", text, 1, 0xFFFFFFFFu); }, true);
}

void add_connect(CLI::App& app, std::string& connect) {
  add(app, "--connect", "ENDPOINT",
      "The farm (default: $GRAYCUBE_FRONTAL, else where 'graycube up' listens)",
      [&connect](const std::string& text) { connect = text; });
}

void add_outputs(CLI::App& app, Outputs& outputs, bool is_exr_required, const char* exr_help) {
  add(
      app, "-o,--output", "OUT.exr", exr_help,
      [&outputs](const std::string& text) { outputs.exr = text; }, is_exr_required);
  add(app, "--png", "OUT.png", "Also a PNG: 8-bit sRGB, or 16-bit linear if named *.linear.png",
      [&outputs](const std::string& text) { outputs.png = text; });
  add(app, "--stats", "STATS.json", "What the render did: rays, messages, times",
      [&outputs](const std::string& text) { outputs.stats = text; });
}

void add_threads(CLI::App& app, const char* help, std::uint32_t& threads) {
  add(app, "--threads", "T", help, [&threads](const std::string& text) {
    threads = parse_count("--threads", text, 1, kMaxThreads);
  });
}

/// 100 GB of them.
constexpr std::uint32_t kMaxOutboxRays = 1'000'000'000;

void add_nodes(CLI::App& app, const char* help, std::uint32_t& nodes) {
  add(app, "-n,--nodes", "NODES", help,
      [&nodes](const std::string& text) { nodes = parse_nodes("-n", text); });
}

/// What every way to compute the picture takes.
void add_common_options(CLI::App& app, control::JobOptions& o) {
  add(app, "--queue", "N", "Rays that a node's queues hold where flow is blocking (default 64)",
      [&o](const auto& text) { o.queue = parse_count("--queue", text, 1, kMaxQueue); });
  add(app, "--size", "WxH", "The picture's size, instead of the scene's", [&o](const auto& text) {
    const PictureSize size = parse_size("--size", text);
    o.width = size.width;
    o.height = size.height;
  });
  add(app, "--samples", "S", "S x S rays per pixel, instead of the scene's",
      [&o](const auto& text) { o.samples = parse_count("--samples", text, 1, kMaxSamples); });
  add(app, "--max-depth", "D", "Generations of rays, instead of the scene's",
      [&o](const auto& text) { o.max_depth = parse_count("--max-depth", text, 0, kMaxDepth); });
}

/// What decides how the picture is computed.
void add_job_options(CLI::App& app, control::JobOptions& o) {
  add(app, "--algorithm", "NAME", "auto (default), serial, roth or macro",
      [&o](const auto& text) { o.algorithm = parse_algorithm("--algorithm", text); });
  add(app, "--grain", "NAME", "What 'roth' hands out: pixel, line or tile (default)",
      [&o](const auto& text) { o.grain = parse_grain("--grain", text); });
  add(app, "--shadows", "NAME",
      "horizon (default), forward or local: how macro finishes shadow rays",
      [&o](const auto& text) { o.shadows = parse_shadows("--shadows", text); });
  add(app, "--partition", "NAME",
      "auto (default), regular, or balanced: boundaries by a coarse pre-render",
      [&o](const auto& text) { o.partition = parse_partition("--partition", text); });
  add(app, "--scatter", "K", "K x K macro-regions per node, 1 to 8 (default: what suits the scene)",
      [&o](const auto& text) { o.scatter = parse_scatter("--scatter", text); });
  add(app, "--flow", "NAME",
      "credit (default), or blocking: bounded queues that stall evaluators, as in 1987",
      [&o](const auto& text) { o.flow = parse_flow("--flow", text); });
  add(app, "--sums", "NAME",
      "direct (default), or tree: nodes add up each other's light on its way",
      [&o](const auto& text) { o.sums = parse_sums("--sums", text); });
  add_common_options(app, o);
  add(app, "--aov", "NAMES", "Also of each first hit, in OUT.exr: depth,normal,albedo,object",
      [&o](const auto& text) { o.aov = parse_aov_list("--aov", text); });
  add(app, "--timeout", "S", "Give up after so many seconds",
      [&o](const auto& text) { o.timeout_s = parse_seconds("--timeout", text); });
}

/// All commands; the chosen one's values are in its declaration after parsing.
class Parser {
 public:
  Parser() {
    app_.set_version_flag("--version", std::string("graycube ") + kVersion, "Print the version");
    app_.set_help_flag("-h,--help", "Print this help");
    app_.require_subcommand(1);
    declare_rendering();
    declare_client();
    declare_files();
    declare_simulate();
  }

  CLI::App& app() { return app_; }

  std::vector<std::string> command_names() {
    std::vector<std::string> names;
    for (const CLI::App* sub : app_.get_subcommands([](CLI::App*) { return true; })) {
      names.push_back(sub->get_name());
    }
    return names;
  }

  Command parse(int argc, const char* const* argv) {
    try {
      app_.parse(argc, argv);
    } catch (const CLI::CallForVersion& e) {
      return PrintCommand{std::string(e.what()) + "\n"};
    } catch (const CLI::Success&) {
      return PrintCommand{app_.help()};
    } catch (const CLI::ExtrasError& e) {
      throw unexpected(e);
    } catch (const CLI::ParseError& e) {
      throw usage_failure("", e.what());
    }
    return chosen_();
  }

 private:
  template <typename C>
  C& declare(const char* name, const char* help, CLI::App*& sub) {
    auto command = std::make_shared<C>();
    sub = app_.add_subcommand(name, help);
    sub->callback([this, command] { chosen_ = [command]() -> Command { return *command; }; });
    return *command;
  }

  void declare_rendering() {
    CLI::App* sub = nullptr;
    auto& render = declare<RenderCommand>("render", "Render a scene on nodes of this machine", sub);
    render.nodes = default_nodes();
    add_scene(*sub, render.scene);
    add_choice(*sub, render.choice);
    add_outputs(*sub, render.outputs, false, "The picture (default: SCENE's name with .exr, here)");
    add_nodes(*sub, "Node processes: a power of two, 1 to 1024 (default: as processors allow)",
              render.nodes);
    add_threads(*sub, "Evaluator threads per node (default 1)", render.threads);
    add_job_options(*sub, render.options);
    sub->add_flag("--quiet,-q", render.is_quiet, "Print nothing but errors");

    auto& up = declare<UpCommand>("up", "Start a farm and keep it running", sub);
    up.nodes = default_nodes();
    add_nodes(*sub, "Node processes: a power of two, 1 to 1024 (default: as processors allow)",
              up.nodes);
    add_threads(*sub, "Evaluator threads per node (default 1)", up.threads);
    add(*sub, "--listen", "ENDPOINT", "ipc:///PATH or tcp://127.0.0.1:PORT",
        [&up](const std::string& text) { up.listen = text; });
    add(*sub, "--state", "DIR", "Keep jobs and pictures there, over restarts",
        [&up](const std::string& text) { up.state = text; });
    add(*sub, "--http", "HOST:PORT", "A web page of the farm at this loopback address",
        [&up](const std::string& text) { up.http = text; });
    add(*sub, "--outbox-rays", "N",
        "Rays to be sent that a node may hold (default " + std::to_string(kDefaultOutboxRays) + ")",
        [&up](const std::string& text) {
          up.outbox_rays = parse_count("--outbox-rays", text, 1, kMaxOutboxRays);
        });
  }

  void declare_client() {
    CLI::App* sub = nullptr;
    auto& submit =
        declare<SubmitCommand>("submit", "Give a farm a scene; prints the job's id", sub);
    add_scene(*sub, submit.scene);
    add_choice(*sub, submit.choice);
    add_outputs(*sub, submit.outputs, false, "The picture, with --wait");
    add_nodes(*sub, "What the farm is expected to have", submit.nodes);
    add_threads(*sub, "Evaluator threads per node (default: the farm's)", submit.options.threads);
    add_job_options(*sub, submit.options);
    sub->add_flag("--quiet,-q", submit.is_quiet, "With --wait: no progress");
    sub->add_flag("--wait", submit.waits, "Wait for the end, with progress");
    add_connect(*sub, submit.connect);

    auto& jobs = declare<JobsCommand>("jobs", "List a farm's jobs", sub);
    add_connect(*sub, jobs.connect);

    auto& status = declare<StatusCommand>("status", "How a job is getting on", sub);
    add_job(*sub, status.job);
    sub->add_flag("--json", status.as_json, "As one line of JSON");
    add_connect(*sub, status.connect);

    auto& watch = declare<WatchCommand>("watch", "Follow a job to its end", sub);
    add_job(*sub, watch.job);
    add_connect(*sub, watch.connect);

    auto& cancel = declare<CancelCommand>("cancel", "Stop a job", sub);
    add_job(*sub, cancel.job);
    add_connect(*sub, cancel.connect);

    auto& fetch = declare<FetchCommand>("fetch", "Get a job's picture", sub);
    add_job(*sub, fetch.job);
    add_outputs(*sub, fetch.outputs, true, "The picture");
    add_connect(*sub, fetch.connect);

    auto& nodes = declare<NodesCommand>("nodes", "List a farm's nodes", sub);
    add_connect(*sub, nodes.connect);

    auto& down = declare<DownCommand>("down", "Stop a farm", sub);
    add_connect(*sub, down.connect);
  }

  void declare_files() {
    CLI::App* sub = nullptr;
    auto& check = declare<CheckCommand>("check", "Find every error of a scene file", sub);
    add_scene(*sub, check.scene);
    add_choice(*sub, check.choice);

    auto& compare =
        declare<CompareCommand>("compare", "Render a scene in every way, and compare", sub);
    compare.nodes = default_nodes();
    add_scene(*sub, compare.scene);
    add_facets(*sub, compare.choice);
    add_nodes(*sub, "Node processes: a power of two, 1 to 1024 (default: as processors allow)",
              compare.nodes);
    add_common_options(*sub, compare.options);
    sub->add_flag("--json", compare.as_json,
                  "All statistics as one line of JSON, instead of a table");
    sub->add_flag("--quiet,-q", compare.is_quiet, "Print nothing but the table and errors");
    add(*sub, "--plot", "OUT.svg", "Also a picture of what each node did with its time",
        [&compare](const std::string& text) { compare.plot = text; });

    auto& convert =
        declare<ConvertCommand>("convert", "Convert a file, by the names' endings", sub);
    add(
        *sub, "IN", "", ".json, .cbor, .scad, .csg, .g, .asc, .stl, .off or .exr",
        [&convert](const std::string& text) { convert.in = text; }, true);
    add(
        *sub, "OUT", "", "From a scene: .json or .pov; from .exr: .png",
        [&convert](const std::string& text) { convert.out = text; }, true);
    add_choice(*sub, convert.choice);
  }

  void declare_simulate() {
    CLI::App* sub = nullptr;
    auto& c =
        declare<SimulateCommand>("simulate", "Predict how a scene renders on other machines", sub);
    add_scene(*sub, c.scene);
    add_choice(*sub, c.choice);
    add(
        *sub, "-n,--nodes", "N,N,...", "Numbers of nodes, each a power of two from 1 to 1024",
        [&c](const std::string& text) { c.nodes = parse_node_list("--nodes", text); }, true);
    const auto figure = [&](const char* name, const char* type, const char* help, auto& value,
                            double least, double most) {
      add(*sub, name, type, help, [&value, name, least, most](const std::string& text) {
        value = parse_number(name, text, least, most);
      });
    };
    figure("--link-gbps", "G", "Bandwidth of a link, 10^9 bits a second (default 10)", c.link_gbps,
           1e-6, 1e6);
    figure("--link-us", "L", "Latency of a link, microseconds (default 50)", c.link_us, 0, 1e9);
    figure("--host-gbps", "G", "Bandwidth of the frontal's link (default: as the others)",
           c.host_gbps, 1e-6, 1e6);
    figure("--message-us", "T", "CPU time that a message takes each side (default: measured here)",
           c.message_us, 0, 1e9);
    figure("--cpu-scale", "F", "How much longer than here evaluators take (default 1)", c.cpu_scale,
           1e-6, 1e9);
    add(*sub, "--cores", "C", "Cores that all processes share (default: one each)",
        [&c](const std::string& text) { c.cores = parse_count("--cores", text, 1, kMaxCores); });
    add_job_options(*sub, c.options);
    sub->add_flag("--json", c.as_json, "All statistics as one line of JSON, instead of a table");
    sub->add_flag("--quiet,-q", c.is_quiet, "Print nothing but the table and errors");
    add(*sub, "--plot", "OUT.svg", "Also a picture of what each node did with its time",
        [&c](const std::string& text) { c.plot = text; });
  }

  /// An argument that no option of the command takes.
  Failure unexpected(const CLI::ExtrasError& e) {
    const auto chosen = app_.get_subcommands();
    const CLI::App* sub = chosen.empty() ? &app_ : chosen.back();
    const auto extras = sub->remaining();
    if (extras.empty()) return usage_failure("", e.what());
    const std::string written = extras.front().substr(0, extras.front().find('='));
    if (!written.starts_with("-")) {
      return usage_failure(sub->get_name(), "unexpected argument " + graycube::quoted(written));
    }
    std::vector<std::string> names;
    for (const CLI::Option* o : sub->get_options()) {
      for (const std::string& name : o->get_lnames()) names.push_back("--" + name);
    }
    const std::vector<std::string_view> candidates(names.begin(), names.end());
    return usage_failure(sub->get_name(), "unknown option " + graycube::quoted(written) +
                                              did_you_mean(written, candidates));
  }

  CLI::App app_{"Graycube renders solid models by ray tracing, on a hypercube of processes.",
                "graycube"};
  std::function<Command()> chosen_;
};

/// The clearest message for what CLI11 would report as an unexpected argument or a missing command.
void check_command_name(int argc, const char* const* argv, Parser& parser) {
  if (argc < 2) throw usage_failure("", "expected a command; see 'graycube --help'");
  const std::string_view written = argv[1];
  if (written.starts_with("-")) return;
  const auto names = parser.command_names();
  if (std::find(names.begin(), names.end(), written) != names.end()) return;
  const std::vector<std::string_view> candidates(names.begin(), names.end());
  throw usage_failure(
      "", "unknown command " + graycube::quoted(written) + did_you_mean(written, candidates));
}

/// Where client commands find the farm.
void resolve_endpoint(std::string& endpoint) {
  const char* origin = "--connect";
  if (endpoint.empty()) {
    const char* variable = std::getenv("GRAYCUBE_FRONTAL");
    if (variable != nullptr && variable[0] != '\0') {
      endpoint = variable;
      origin = "GRAYCUBE_FRONTAL";
    } else {
      endpoint = default_endpoint();
      origin = "XDG_RUNTIME_DIR";
    }
  }
  if (const auto problem = endpoint_problem(endpoint)) {
    throw usage_failure(std::string(origin) + " " + endpoint, *problem);
  }
}

template <typename C>
concept HasConnect = requires(C command) {
  command.connect;
};

}  // namespace

Command parse_command_line(int argc, const char* const* argv) {
  Parser parser;
  check_command_name(argc, argv, parser);
  Command command = parser.parse(argc, argv);
  std::visit(
      [](auto& c) {
        if constexpr (HasConnect<decltype(c)>) resolve_endpoint(c.connect);
      },
      command);
  return command;
}

}  // namespace graycube
