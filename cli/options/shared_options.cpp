#include "cli/options/shared_options.hpp"

#include <vector>

#include "cli/option_values.hpp"
#include "formats/mesh/mesh_file.hpp"
#include "shading/settings.hpp"

namespace graycube {
namespace {

/// Rays that take about 100 GB of memory.
constexpr std::uint32_t kMaxOutboxRays = 1'000'000'000;

}  // namespace

void add_scene(Declaring& options, std::string& scene) {
  options.option({.names = "SCENE",
                  .help = "A scene file (.json, .cbor), OpenSCAD's program (.scad) or evaluated "
                          "tree (.csg), BRL-CAD's database (.g, .asc), meshes (" +
                          mesh_endings_text() + ")",
                  .kind = ValueKind::kFile,
                  .is_required = true},
                 [&scene](const std::string& text) { scene = text; });
}

void add_import_options(Declaring& options, ModelChoice& choice) {
  options.flag("--facets", choice.facets, "OpenSCAD: what is round as OpenSCAD's own facets");
  options.flag("--strict", choice.is_strict,
               "Refuse a model of which a part would be left out, instead of warning");
  options.flag("--repair", choice.repairs,
               "Mesh files: join corners and fill flat holes of open meshes, and say so");
}

void add_model_choice(Declaring& options, ModelChoice& choice) {
  add_import_options(options, choice);
  options.repeatable(
      {.names = "--object",
       .value = "NAME",
       .help = "BRL-CAD: what to show (again for more; default: all that nothing refers to)"},
      [&choice](const std::vector<std::string>& names) {
        choice.objects = names;
        choice.is_given = true;
      });
  options.option({.names = "--view",
                  .value = "FILE",
                  .help = "BRL-CAD: a view script, as rt reads it",
                  .kind = ValueKind::kFile},
                 [&choice](const std::string& text) {
                   choice.view = text;
                   choice.is_given = true;
                 });
  const auto angle = [&](const char* name, const char* help, double& value) {
    options.option({.names = name, .value = "DEGREES", .help = help},
                   [&choice, &value, name](const std::string& text) {
                     value = parse_angle(name, text);
                     choice.is_given = true;
                   });
  };
  angle("--azimuth", "BRL-CAD: from where to look (default 35)", choice.azimuth_degrees);
  angle("--elevation", "BRL-CAD: from how high to look (default 25)", choice.elevation_degrees);
}

void add_job(Declaring& options, std::uint32_t& job) {
  options.option(
      {.names = "JOB",
       .help = "The job's id, as 'submit' and 'jobs' print it",
       .is_required = true},
      [&job](const std::string& text) { job = parse_count("JOB", text, 1, 0xFFFFFFFFu); });
}

void add_connect(Declaring& options, FarmAddress& connect) {
  options.option(
      {.names = "--connect",
       .value = "ENDPOINT",
       .help = "The farm (default: $GRAYCUBE_FRONTAL, else where 'graycube up' listens)"},
      [&connect](const std::string& text) { connect.endpoint = text; });
  options.option({.names = "--key",
                  .value = "FILE",
                  .help = "The key of a farm at a TCP port (default: where 'graycube up' puts it)",
                  .kind = ValueKind::kFile},
                 [&connect](const std::string& text) { connect.key_file = text; });
}

void add_farm_of_client(Declaring& options, std::filesystem::path& farm_key) {
  options.option({.names = "--client",
                  .value = "FILE",
                  .help = "Instead, of the farm's key there, one with which to be its client only",
                  .kind = ValueKind::kFile},
                 [&farm_key](const std::string& text) { farm_key = text; });
}

void add_farm(Declaring& options, FarmKind& farm) {
  options.option({.names = "--farm",
                  .value = "KIND",
                  .help = "Who runs the nodes: local (this machine), joined (hosts that 'graycube "
                          "join' adds), slurm (those of its job), auto (default)",
                  .kind = ValueKind::kChoice,
                  .choices = names_of(kFarmChoices)},
                 [&farm](const std::string& text) { farm = parse_farm("--farm", text); });
}

void add_outputs(Declaring& options, Outputs& outputs, const char* exr_help, bool is_exr_required) {
  options.option({.names = "-o,--output",
                  .value = "OUT.exr",
                  .help = exr_help,
                  .kind = ValueKind::kFile,
                  .is_required = is_exr_required},
                 [&outputs](const std::string& text) { outputs.exr = text; });
  options.option({.names = "--png",
                  .value = "OUT.png",
                  .help = "Also a PNG: 8-bit sRGB, or 16-bit linear if named *.linear.png",
                  .kind = ValueKind::kFile},
                 [&outputs](const std::string& text) { outputs.png = text; });
  options.option({.names = "--stats",
                  .value = "STATS.json",
                  .help = "What the render did: rays, messages, times",
                  .kind = ValueKind::kFile},
                 [&outputs](const std::string& text) { outputs.stats = text; });
}

void add_threads(Declaring& options, std::uint32_t& threads, const char* help) {
  options.option({.names = "--threads", .value = "T", .help = help},
                 [&threads](const std::string& text) {
                   threads = parse_count("--threads", text, 1, kMaxThreads);
                 });
}

void add_nodes(Declaring& options, std::uint32_t& nodes, const std::string& help) {
  options.option({.names = "-n,--nodes", .value = "NODES", .help = help},
                 [&nodes](const std::string& text) { nodes = parse_nodes("-n", text); });
}

void add_nodes(Declaring& options, std::uint32_t& nodes) {
  add_nodes(options, nodes,
            "Node processes: a power of two, 1 to 1024 (default: as processors allow)");
}

void add_common_options(Declaring& options, control::JobOptions& o) {
  options.option({.names = "--queue",
                  .value = "N",
                  .help = "Rays that a node's queues hold where flow is blocking (default 64)"},
                 [&o](const auto& text) { o.queue = parse_count("--queue", text, 1, kMaxQueue); });
  options.option(
      {.names = "--size", .value = "WxH", .help = "The picture's size, instead of the scene's"},
      [&o](const auto& text) {
        const PictureSize size = parse_size("--size", text);
        o.width = size.width;
        o.height = size.height;
      });
  options.option(
      {.names = "--samples", .value = "S", .help = "S x S rays per pixel, instead of the scene's"},
      [&o](const auto& text) { o.samples = parse_count("--samples", text, 1, kMaxSamples); });
  options.option(
      {.names = "--max-depth", .value = "D", .help = "Generations of rays, instead of the scene's"},
      [&o](const auto& text) { o.max_depth = parse_count("--max-depth", text, 0, kMaxDepth); });
}

namespace {

/// Declares an option whose values are the names of an enum's values.
void add_named(Declaring& options, const char* name, const char* help,
               std::vector<std::string> names, std::function<void(const std::string&)> take) {
  options.option({.names = name,
                  .value = "NAME",
                  .help = help,
                  .kind = ValueKind::kChoice,
                  .choices = std::move(names)},
                 std::move(take));
}

}  // namespace

void add_how(Declaring& options, control::JobOptions& o) {
  add_named(options, "--algorithm", "auto (default), serial, roth or macro",
            names_of(kAlgorithmChoices),
            [&o](const auto& text) { o.algorithm = parse_algorithm("--algorithm", text); });
  add_named(options, "--grain", "What 'roth' hands out: pixel, line or tile (default)",
            names_of(kGrainChoices),
            [&o](const auto& text) { o.grain = parse_grain("--grain", text); });
  add_named(options, "--shadows",
            "horizon (default), forward or local: how macro finishes shadow rays",
            names_of(kShadowChoices),
            [&o](const auto& text) { o.shadows = parse_shadows("--shadows", text); });
  add_named(options, "--partition",
            "auto (default), regular, or balanced: boundaries by a coarse pre-render",
            names_of(kPartitionChoices),
            [&o](const auto& text) { o.partition = parse_partition("--partition", text); });
  options.option({.names = "--scatter",
                  .value = "K",
                  .help = "K x K macro-regions per node, 1 to 8 (default: what suits the scene)"},
                 [&o](const auto& text) { o.scatter = parse_scatter("--scatter", text); });
  add_named(options, "--flow",
            "credit (default), or blocking: bounded queues that stall evaluators, as in 1987",
            names_of(kFlowChoices),
            [&o](const auto& text) { o.flow = parse_flow("--flow", text); });
  add_named(options, "--fifo",
            "thread (default), or process: blocking queues are held by processes apart, as in 1987",
            names_of(kFifoChoices),
            [&o](const auto& text) { o.fifo = parse_fifo("--fifo", text); });
  add_named(
      options, "--mesh", "2d (default), 3d, ring or tree: how nodes with macro-regions are linked",
      names_of(kMeshChoices), [&o](const auto& text) { o.mesh = parse_mesh("--mesh", text); });
  add_named(options, "--sums",
            "direct (default), tree or ring: nodes add up each other's light on its way",
            names_of(kSumsChoices),
            [&o](const auto& text) { o.sums = parse_sums("--sums", text); });
  add_named(options, "--returns",
            "frontal (default), or sender: light goes back along the rays' ways, as in 1983",
            names_of(kReturnsChoices),
            [&o](const auto& text) { o.returns = parse_returns("--returns", text); });
  add_named(
      options, "--boundaries",
      "fixed (default), or sliding: macro-regions' boundaries move while rendering, as in 1986",
      names_of(kBoundariesChoices),
      [&o](const auto& text) { o.boundaries = parse_boundaries("--boundaries", text); });
  add_named(options, "--subdivision",
            "surfaces (default), or a way of 1987: roth, linked, arnaldi, octree, kaplan",
            names_of(kSubdivisionChoices), [&o](const auto& text) {
              o.subdivision.way = parse_subdivision("--subdivision", text);
            });
  add_named(options, "--entry",
            "descent or extremal: where rays begin in linked cells (default: what is usual)",
            names_of(kEntryChoices),
            [&o](const auto& text) { o.subdivision.entry = parse_entry("--entry", text); });
}

void add_job_options(Declaring& options, control::JobOptions& o) {
  add_how(options, o);
  add_common_options(options, o);
  options.option({.names = "--aov",
                  .value = "NAMES",
                  .help = "Also of each first hit, in OUT.exr: depth,normal,albedo,object"},
                 [&o](const auto& text) { o.aov = parse_aov_list("--aov", text); });
  options.option({.names = "--timeout", .value = "S", .help = "Give up after so many seconds"},
                 [&o](const auto& text) { o.timeout_s = parse_seconds("--timeout", text); });
}

void add_losses(Declaring& options, LossOptions& losses) {
  options.option({.names = "--silence",
                  .value = "S",
                  .help = "Seconds until a silent node is taken for dead (default 2, and more "
                          "where more than 8 nodes share a core)"},
                 [&losses](const auto& text) {
                   losses.silence_s = parse_number("--silence", text, 0.1, 3600);
                 });
  options.option({.names = "--retries",
                  .value = "N",
                  .help = "How often nodes may be lost at the same part of the picture (default " +
                          std::to_string(kDefaultRetries) + ")"},
                 [&losses](const auto& text) {
                   losses.retries = parse_count("--retries", text, 0, kMaxRetries);
                 });
}

void add_log(Declaring& options, std::string& log, bool& is_quiet) {
  options.option({.names = "--log",
                  .value = "FILE",
                  .help = "Append there what happens: jobs, losses, refusals",
                  .kind = ValueKind::kFile},
                 [&log](const std::string& text) {
                   if (text.empty()) throw usage_failure("--log", "expected a file's name");
                   log = text;
                 });
  options.flag("--quiet,-q", is_quiet, "Show only what goes wrong");
}

void add_outbox_rays(Declaring& options, std::uint32_t& rays) {
  options.option({.names = "--outbox-rays",
                  .value = "N",
                  .help = "Rays to be sent that a node may hold (default " +
                          std::to_string(kDefaultOutboxRays) + ")"},
                 [&rays](const std::string& text) {
                   rays = parse_count("--outbox-rays", text, 1, kMaxOutboxRays);
                 });
}

void add_table_options(Declaring& options, bool& as_json, bool& is_quiet,
                       std::filesystem::path& plot) {
  options.flag("--json", as_json, "All statistics as one line of JSON, instead of a table");
  options.flag("--quiet,-q", is_quiet, "Print nothing but the table and errors");
  options.option({.names = "--plot",
                  .value = "OUT.svg",
                  .help = "Also a picture of what each node did with its time",
                  .kind = ValueKind::kFile},
                 [&plot](const std::string& text) { plot = text; });
}

}  // namespace graycube
