#include "cli/command_line.hpp"

#include <cstdlib>
#include <vector>

#include "cli/expect_failure.hpp"

namespace graycube {
namespace {

Command parsed(std::vector<const char*> arguments) {
  arguments.insert(arguments.begin(), "graycube");
  return parse_command_line(static_cast<int>(arguments.size()), arguments.data());
}

std::string refused(const std::vector<const char*>& arguments) {
  return refusal([&] { parsed(arguments); });
}

TEST_CASE("every option of render arrives") {
  const auto c = std::get<RenderCommand>(
      parsed({"render",        "a.json",  "-o",          "b.exr",    "--png",        "c.png",
              "--stats",       "d.json",  "-n",          "16",       "--threads",    "3",
              "--algorithm",   "macro",   "--grain",     "line",     "--shadows",    "forward",
              "--partition",   "regular", "--scatter",   "1",        "--flow",       "credit",
              "--sums",        "tree",    "--returns",   "sender",   "--boundaries", "sliding",
              "--subdivision", "linked",  "--entry",     "extremal", "--size",       "64x32",
              "--samples",     "2",       "--max-depth", "7",        "--timeout",    "2.5",
              "--quiet"}));
  CHECK(c.scene == "a.json");
  CHECK(c.outputs.exr == "b.exr");
  CHECK(c.outputs.png == "c.png");
  CHECK(c.outputs.stats == "d.json");
  CHECK(c.nodes == 16);
  CHECK(c.threads == 3);
  CHECK(c.is_quiet);
  CHECK(c.options.algorithm == Algorithm::kMacro);
  CHECK(c.options.grain == Grain::kLine);
  CHECK(c.options.shadows == ShadowMode::kForward);
  CHECK(c.options.sums == SumsMode::kTree);
  CHECK(c.options.returns == ReturnsMode::kSender);
  CHECK(c.options.boundaries == BoundariesMode::kSliding);
  CHECK(c.options.subdivision == SubdivisionChoice{Subdivision::kLinked, Entry::kExtremal});
  CHECK(c.options.width == 64u);
  CHECK(c.options.height == 32u);
  CHECK(c.options.samples == 2u);
  CHECK(c.options.max_depth == 7u);
  CHECK(c.options.timeout_s == 2.5);
}

TEST_CASE("what render is not told stays the scene's, or the default") {
  const auto c = std::get<RenderCommand>(parsed({"render", "a.json"}));
  CHECK(c.outputs.none());
  CHECK(c.threads == 1);
  CHECK_FALSE(c.is_quiet);
  control::JobOptions expected;
  CHECK(c.options == expected);
}

TEST_CASE("submit asks for the farm's own threads unless told otherwise") {
  const auto c = std::get<SubmitCommand>(parsed({"submit", "a.json"}));
  CHECK(c.options.threads == 0);
  CHECK(c.nodes == 0);
  CHECK_FALSE(c.waits);
  const auto d = std::get<SubmitCommand>(parsed({"submit", "a.json", "--threads", "2", "--wait"}));
  CHECK(d.options.threads == 2);
  CHECK(d.waits);
}

TEST_CASE("every option of simulate arrives") {
  const auto c = std::get<SimulateCommand>(
      parsed({"simulate",     "a.json",   "--nodes",     "64,256", "--link-gbps", "0.002",
              "--link-us",    "1000",     "--cores",     "3",      "--host-gbps", "1",
              "--message-us", "7",        "--cpu-scale", "1e4",    "--algorithm", "macro",
              "--flow",       "blocking", "--queue",     "9",      "--fifo",      "process",
              "--json",       "--plot",   "b.svg",       "--size", "64x32",       "-q"}));
  CHECK(c.scene == "a.json");
  CHECK(c.nodes == std::vector<std::uint32_t>{64, 256});
  CHECK(c.link_gbps == 0.002);
  CHECK(c.host_gbps == 1.0);
  CHECK(c.link_us == 1000);
  CHECK(c.message_us == 7.0);
  CHECK(c.cpu_scale == 1e4);
  CHECK(c.cores == 3);
  CHECK(c.options.algorithm == Algorithm::kMacro);
  CHECK(c.options.flow == FlowMode::kBlocking);
  CHECK(c.options.queue == 9);
  CHECK(c.options.fifo == FifoMode::kProcess);
  CHECK(c.options.width == 64u);
  CHECK(c.plot == "b.svg");
  CHECK(c.as_json);
  CHECK(c.is_quiet);
  CHECK(c.hosts == 0);
  CHECK_FALSE(c.local_gbps);
  const auto hosts = std::get<SimulateCommand>(parsed(
      {"simulate", "a.json", "-n", "64", "--hosts", "8", "--local-gbps", "20", "--local-us", "3"}));
  CHECK(hosts.hosts == 8);
  CHECK(hosts.local_gbps == 20.0);
  CHECK(hosts.local_us == 3.0);
  CHECK(refused({"simulate", "a.json"}).find("--nodes is required") != std::string::npos);
}

TEST_CASE("every option of draw arrives") {
  const auto c = std::get<DrawCommand>(parsed(
      {"draw", "a.json", "--figure", "macro-regions", "-n", "8", "-o", "f.svg", "--size", "64x32",
       "--subdivision", "linked", "--shadows", "forward", "--partition", "regular", "-q"}));
  CHECK(c.scene == "a.json");
  CHECK(c.figure == figures::FigureName::kMacroRegions);
  CHECK(c.nodes == 8);
  CHECK(c.output == "f.svg");
  CHECK(c.options.width == 64u);
  CHECK(c.options.subdivision.way == Subdivision::kLinked);
  CHECK(c.options.shadows == ShadowMode::kForward);
  CHECK(c.options.partition == PartitionMode::kRegular);
  CHECK(c.is_quiet);
  CHECK(std::get<DrawCommand>(parsed({"draw", "a.json", "--figure", "token"})).nodes == 16);
  CHECK(refused({"draw", "a.json"}).find("--figure is required") != std::string::npos);
  CHECK(refused({"draw", "a.json", "--figure", "tokens"}).find("token") != std::string::npos);
}

TEST_CASE("clients look for the farm where they are told, then in the environment") {
  ::setenv("GRAYCUBE_FRONTAL", "tcp://127.0.0.1:7000", 1);
  CHECK(std::get<JobsCommand>(parsed({"jobs"})).connect.endpoint == "tcp://127.0.0.1:7000");
  CHECK(std::get<JobsCommand>(parsed({"jobs", "--connect", "ipc:///run/x"})).connect.endpoint ==
        "ipc:///run/x");
  ::unsetenv("GRAYCUBE_FRONTAL");
  ::setenv("XDG_RUNTIME_DIR", "/run/user/7", 1);
  CHECK(std::get<NodesCommand>(parsed({"nodes"})).connect.endpoint ==
        "ipc:///run/user/7/graycube/frontal");
  CHECK(refused({"down", "--connect", "tcp://192.0.2.1:7000"})
            .starts_with("graycube: usage: --connect tcp://192.0.2.1:7000: other than loopback"));
}

TEST_CASE("jobs are named by their numbers") {
  CHECK(std::get<StatusCommand>(parsed({"status", "3", "--json"})).as_json);
  CHECK(std::get<StatusCommand>(parsed({"status", "3"})).number == 3);
  CHECK(std::get<StatusCommand>(parsed({"status", "--farm"})).is_of_farm);
  CHECK(std::get<UpCommand>(parsed({"up", "--keep", "30d"})).keep == "30d");
  CHECK(std::get<WatchCommand>(parsed({"watch", "4"})).job == 4);
  CHECK(std::get<CancelCommand>(parsed({"cancel", "5"})).job == 5);
  CHECK(std::get<FetchCommand>(parsed({"fetch", "6", "-o", "x.exr"})).job == 6);
  CHECK(refused({"watch", "first"}).starts_with("graycube: usage: JOB: expected a whole number"));
  CHECK(refused({"watch", "0"}).starts_with("graycube: usage: JOB: expected a whole number"));
  CHECK(refused({"fetch", "6"}).starts_with("graycube: usage: "));
}

TEST_CASE("a mistyped command or option is guessed") {
  CHECK(refused({"rendr", "a.json"}) ==
        "graycube: usage: command line: unknown command \"rendr\"; did you mean \"render\"?");
  CHECK(refused({"render", "a.json", "--algoritm", "serial"}) ==
        "graycube: usage: render: unknown option \"--algoritm\"; did you mean \"--algorithm\"?");
  CHECK(refused({"jobs", "--conect=ipc:///x"}) ==
        "graycube: usage: jobs: unknown option \"--conect\"; did you mean \"--connect\"?");
}

TEST_CASE("a command line that means nothing is refused in one line") {
  for (const auto& arguments :
       std::vector<std::vector<const char*>>{{},
                                             {"render"},
                                             {"render", "a.json", "b.json"},
                                             {"render", "a.json", "-n"},
                                             {"render", "a.json", "-n", "4", "-n", "8"},
                                             {"render", "a.json", "-n", "3"},
                                             {"render", "a.json", "--threads", "0"},
                                             {"render", "a.json", "--threads", "1025"},
                                             {"render", "a.json", "--wait"},
                                             {"up", "a.json"},
                                             {"convert", "a.json"},
                                             {"--frobnicate"}}) {
    const std::string line = refused(arguments);
    CHECK(line.starts_with("graycube: usage: "));
    CHECK(line.find('\n') == std::string::npos);
  }
}

TEST_CASE("what a command line lacks is told with where to read on") {
  for (const auto& [arguments, line] :
       std::vector<std::pair<std::vector<const char*>, std::string>>{
           {{"--bogus"}, "command line: unknown option \"--bogus\"; see 'graycube --help'"},
           {{"render"}, "render: SCENE is required; see 'graycube render --help'"},
           {{"render", "a.json", "-n"},
            "render: --nodes needs a value; see 'graycube render --help'"},
           {{"render", "a.json", "--size", "1x1", "--size", "2x2"},
            "render: --size is given twice; see 'graycube render --help'"},
           {{"render", "a.json", "--quiet=3"},
            "render: --quiet takes no value; see 'graycube render --help'"},
           {{"up", "--wait"},
            "up: unknown option \"--wait\"; submit has it; see 'graycube up --help'"},
           {{"render", "a.json", "-o", ""},
            "-o: expected the name of a file, found nothing; see 'graycube render --help'"}}) {
    CHECK(refused(arguments) == "graycube: usage: " + line);
  }
  CHECK(refused({"render", "--connect", "x", "a.json"}).find("did you mean") == std::string::npos);
}

TEST_CASE("help is a command, too, and -v tells the version") {
  const auto text = [](const std::vector<const char*>& words) {
    return std::get<PrintCommand>(parsed(words)).text;
  };
  CHECK(text({"help"}) == text({"--help"}));
  CHECK(text({"help", "render"}) == text({"render", "--help"}));
  CHECK(text({"-v"}) == text({"--version"}));
}

TEST_CASE("lists of jobs and nodes are asked for as JSON, and page by page") {
  const auto jobs =
      std::get<JobsCommand>(parsed({"jobs", "--json", "--limit", "3", "--skip", "6"}));
  CHECK(jobs.as_json);
  CHECK(jobs.limit == 3);
  CHECK(jobs.skip == 6);
  CHECK(std::get<NodesCommand>(parsed({"nodes", "--json"})).as_json);
  CHECK(std::get<WatchCommand>(parsed({"watch", "1", "--json"})).as_json);
  CHECK(std::get<SubmitCommand>(parsed({"submit", "a.json", "--json"})).as_json);
}

TEST_CASE("help names every ending of a scene's name") {
  for (const char* command :
       {"render", "submit", "check", "compare", "simulate", "draw", "convert"}) {
    const auto help = std::get<PrintCommand>(parsed({command, "--help"})).text;
    for (const std::string_view ending : kSceneEndings) {
      INFO(command << " " << ending);
      CHECK(help.find(ending) != std::string::npos);
    }
  }
}

TEST_CASE("completion and the man page tell a command's options and their values") {
  const auto text = [](std::vector<const char*> arguments) {
    return std::get<PrintCommand>(parsed(std::move(arguments))).text;
  };
  CHECK_THAT(text({"completion", "bash"}),
             Catch::Contains("--shadows) _graycube_words 'horizon forward local'") &&
                 Catch::Contains("-o | --output) _graycube_paths -f"));
  CHECK_THAT(text({"completion", "zsh"}), Catch::Contains("'(--shadows)--shadows[") &&
                                              Catch::Contains(":NAME:(horizon ") &&
                                              Catch::Contains("'*--object[BRL-CAD\\: what"));
  CHECK_THAT(text({"completion", "fish"}),
             Catch::Contains("-s o -l output -r -F -d ") && Catch::Contains("OpenSCAD'\\''s"));
  CHECK_THAT(text({"man-page"}), Catch::Contains("\\fB\\-o\\fR, \\fB\\-\\-output\\fR"));
  CHECK_THAT(refused({"completion", "bahs"}), Catch::Contains("did you mean \"bash\"?"));
}

TEST_CASE("help names every command, and a command's help its options") {
  const auto all = std::get<PrintCommand>(parsed({"--help"})).text;
  for (const char* name :
       {"render", "up", "submit", "jobs", "status", "watch", "cancel", "fetch", "nodes", "down",
        "check", "compare", "simulate", "draw", "convert", "completion"}) {
    CHECK(all.find(name) != std::string::npos);
  }
  const auto render = std::get<PrintCommand>(parsed({"render", "--help"})).text;
  for (const char* option :
       {"--png",       "--nodes",      "--threads",     "--algorithm", "--grain", "--shadows",
        "--partition", "--scatter",    "--flow",        "--fifo",      "--mesh",  "--sums",
        "--returns",   "--boundaries", "--subdivision", "--entry",     "--size",  "--samples",
        "--max-depth", "--stats",      "--timeout",     "--quiet"}) {
    CHECK(render.find(option) != std::string::npos);
  }
  CHECK(all.find("man-page") == std::string::npos);
  CHECK(std::get<PrintCommand>(parsed({"--version"})).text.starts_with("graycube "));
}

TEST_CASE("every option of log arrives, and lines have a limit") {
  const auto usual = std::get<LogCommand>(parsed({"log"}));
  CHECK(usual.lines == 100);
  CHECK_FALSE(usual.follows);
  const auto c = std::get<LogCommand>(parsed({"log", "-f", "--lines", "1000", "--json"}));
  CHECK(c.lines == kMaxLinesKept);
  CHECK(c.follows);
  CHECK(c.as_json);
  CHECK_FALSE(refused({"log", "--lines", "1001"}).empty());
}

}  // namespace
}  // namespace graycube
