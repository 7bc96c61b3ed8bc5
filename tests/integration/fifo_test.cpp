// Farms whose nodes' FIFOs are processes apart: their pictures, and what is left when any of these
// processes ends.
#include <signal.h>

#include <algorithm>
#include <string>
#include <thread>
#include <vector>

#include "catch.hpp"
#include "integration/sandbox.hpp"

namespace graycube {
namespace {

constexpr const char* kSmallSize = "64x48";
/// Keeps a farm busy for long enough to look at it.
constexpr const char* kLongSize = "3000x3000";
/// Takes a farm of four nodes seconds with FIFOs apart, and not more.
constexpr const char* kMediumSize = "500x500";
constexpr const char* kEndless = "65536";

std::string first() { return scene_file("first.json").string(); }

/// The arguments of a command that renders with FIFOs apart.
Arguments apart(Arguments arguments, const char* queue = kEndless) {
  for (const char* a :
       {"--algorithm", "macro", "--flow", "blocking", "--fifo", "process", "--queue", queue})
    arguments.emplace_back(a);
  return arguments;
}

/// The ids of the processes that run one of our programs.
std::vector<pid_t> running(const Sandbox& sandbox, const std::string& program) {
  std::vector<pid_t> pids;
  for (const std::string& process : sandbox.processes()) {
    if (process.find("/" + program + " ") != std::string::npos) pids.push_back(std::stoi(process));
  }
  return pids;
}

/// Waits until exactly `count` processes hold FIFOs. False when the time is up before.
bool are_left(const Sandbox& sandbox, std::size_t count) {
  const auto until = std::chrono::steady_clock::now() + 20s;
  while (running(sandbox, "graycube-fifo").size() != count) {
    if (std::chrono::steady_clock::now() > until) return false;
    std::this_thread::sleep_for(5ms);
  }
  return true;
}

/// A render that goes on for a while.
Running long_render(Sandbox& sandbox) {
  Running render =
      sandbox.start(apart({"render", first(), "-n", "4", "--size", kLongSize, "--retries", "0"}));
  render.wait_for("rendering");
  REQUIRE(are_left(sandbox, 4));
  return render;
}

void check_nothing_left(const Sandbox& sandbox) {
  CHECK(are_left(sandbox, 0));
  const auto until = std::chrono::steady_clock::now() + 20s;
  while (!sandbox.processes().empty() && std::chrono::steady_clock::now() < until)
    std::this_thread::sleep_for(5ms);
  CHECK(sandbox.processes().empty());
  CHECK(sandbox.files().empty());
}

TEST_CASE("with FIFOs apart a picture has serial's bytes, and statistics tell of the processes") {
  Sandbox sandbox;
  for (const char* scene : {"first.json", "mirrors.json", "glass.json"}) {
    const std::string path = scene_file(scene).string();
    REQUIRE(sandbox
                .run({"render", path, "--algorithm", "serial", "--size", kSmallSize, "-o", "s.exr",
                      "-q"})
                .status == 0);
    for (const Arguments& also :
         {Arguments{"-n", "1"}, Arguments{"-n", "4"}, Arguments{"-n", "16", "--shadows", "forward"},
          Arguments{"-n", "4", "--returns", "sender", "--sums", "tree"},
          Arguments{"-n", "8", "--shadows", "local"}}) {
      Arguments arguments =
          apart({"render", path, "--size", kSmallSize, "-o", "a.exr", "--stats", "a.json", "-q"});
      arguments.insert(arguments.end(), also.begin(), also.end());
      const Outcome o = sandbox.run(arguments);
      INFO(scene << " " << also[1] << ": " << o.err);
      REQUIRE(o.status == 0);
      CHECK((file_bytes(sandbox / "a.exr") == file_bytes(sandbox / "s.exr")));
      const auto stats = sandbox.json("a.json");
      CHECK(stats["choices"]["fifo"] == "process");
      std::uint64_t rays_in = 0;
      for (const auto& node : stats["per_node"]) {
        rays_in += node["rays_in"].get<std::uint64_t>();
        CHECK((node["fifo_cpu_s"] > 0) == (also[1] != "1"));
        CHECK(node["fifo_cpu_s"] < node["cpu_s"]);
      }
      CHECK(stats["messages"]["fifo_messages"] == 3 * rays_in);
    }
  }
  CHECK(sandbox.processes().empty());
}

TEST_CASE("short queues of FIFOs apart end in a deadlock that is found, and nothing is left") {
  Sandbox sandbox;
  const Outcome o = sandbox.run(apart(
      {"render", scene_file("mirrors.json").string(), "-n", "16", "--shadows", "forward", "-q"},
      "4"));
  CHECK(o.status == 1);
  CHECK(o.err.starts_with("graycube: render: --flow blocking: deadlock: node "));
  check_nothing_left(sandbox);
}

TEST_CASE("a killed FIFO costs its job an epoch, and the nodes live through it") {
  Sandbox sandbox;
  Running up = sandbox.start({"up", "-n", "4"});
  up.wait_for("graycube down");
  CHECK(running(sandbox, "graycube-fifo").empty());
  Running submitted = sandbox.start(apart(
      {"submit", first(), "--wait", "--size", kMediumSize, "-o", "a.exr", "--stats", "s.json"}));
  submitted.wait_for("1\n");
  REQUIRE(are_left(sandbox, 4));
  const std::vector<pid_t> nodes = running(sandbox, "graycube-node");
  REQUIRE(nodes.size() == 4);
  const pid_t killed = running(sandbox, "graycube-fifo").front();
  ::kill(killed, SIGKILL);
  const Outcome o = submitted.wait(120s);
  INFO(o.err);
  CHECK(o.status == 0);
  const std::string stats = file_bytes(sandbox / "s.json");
  CHECK(stats.find(R"("epochs":2)") != std::string::npos);
  CHECK(stats.find("FIFO (process " + std::to_string(killed) + "): killed by signal 9") !=
        std::string::npos);
  CHECK(are_left(sandbox, 0));
  // The nodes have lived through it.
  CHECK(running(sandbox, "graycube-node") == nodes);
  CHECK(sandbox.run({"down"}).status == 0);
  CHECK(up.wait(10s).status == 0);
}

TEST_CASE("a FIFO never outlives its node, its frontal or its command, however these end") {
  for (const char* program : {"graycube-node", "graycube-frontal", "graycube"}) {
    for (const bool is_stopped : {false, true}) {
      Sandbox sandbox;
      Running render = long_render(sandbox);
      INFO(program << (is_stopped ? ", stopped" : ""));
      // Stopped, it can't see for itself that its node has gone.
      if (is_stopped) ::kill(running(sandbox, "graycube-fifo").front(), SIGSTOP);
      const std::vector<pid_t> killed = running(sandbox, program);
      REQUIRE_FALSE(killed.empty());
      for (const pid_t pid : killed) ::kill(pid, SIGKILL);
      render.wait(30s);
      check_nothing_left(sandbox);
    }
  }
}

TEST_CASE("FIFOs end with their job when it is cancelled, interrupted or out of time") {
  Sandbox sandbox;
  Running interrupted = long_render(sandbox);
  interrupted.signal(SIGINT);
  CHECK(interrupted.wait(30s).status == 130);
  check_nothing_left(sandbox);

  Running up = sandbox.start({"up", "-n", "4"});
  up.wait_for("graycube down");
  Running submitted = sandbox.start(apart({"submit", first(), "--wait", "--size", kLongSize}));
  submitted.wait_for("1\n");
  REQUIRE(are_left(sandbox, 4));
  // One that stands still holds up its job, but not the farm.
  ::kill(running(sandbox, "graycube-fifo").front(), SIGSTOP);
  CHECK(sandbox.run({"cancel", "1"}).status == 0);
  CHECK(submitted.wait(30s).status == 1);
  CHECK(are_left(sandbox, 0));
  const Outcome late =
      sandbox.run(apart({"submit", first(), "--wait", "--size", kLongSize, "--timeout", "0.3"}));
  CHECK(late.status == 1);
  CHECK(late.err.find("did not end in time") != std::string::npos);
  CHECK(are_left(sandbox, 0));
  CHECK(running(sandbox, "graycube-node").size() == 4);
  CHECK(sandbox.run({"down"}).status == 0);
  CHECK(up.wait(10s).status == 0);
  CHECK(sandbox.processes().empty());
}

TEST_CASE("a FIFO apart is refused where there would be none") {
  Sandbox sandbox;
  for (const Arguments& also :
       {Arguments{}, Arguments{"--algorithm", "macro"}, Arguments{"--flow", "blocking"},
        Arguments{"--algorithm", "roth", "--flow", "blocking"}}) {
    Arguments arguments{"render", first(), "--fifo", "process"};
    arguments.insert(arguments.end(), also.begin(), also.end());
    const Outcome o = sandbox.run(arguments);
    CHECK(o.status == 2);
    CHECK(o.err.starts_with("graycube: usage: --fifo: process is for "));
  }
  CHECK(sandbox.run({"render", first(), "--fifo", "proces"}).err ==
        "graycube: usage: --fifo: expected thread or process, found \"proces\"; did you mean "
        "\"process\"?\n");
}

}  // namespace
}  // namespace graycube
