// A farm in one terminal, and its users in others.
#include <signal.h>

#include <thread>

#include "catch.hpp"
#include "film/picture_files.hpp"
#include "integration/farm.hpp"

namespace graycube {
namespace {

/// Keeps a farm busy for long enough to look at it.
constexpr const char* kLongSize = "3000x3000";

std::string first() { return scene_file("first.json").string(); }

TEST_CASE("a session: up, submit, jobs, status, watch, fetch, cancel, nodes, down") {
  Sandbox sandbox;
  Farm farm(sandbox);

  const std::string nodes = ok(sandbox, {"nodes"});
  REQUIRE(lines_of(nodes).size() == 5);
  CHECK(lines_of(ok(sandbox, {"jobs"})).size() == 1);

  const std::string small = submit(sandbox, {first(), "--size", "64x48", "--algorithm", "macro"});
  const std::string watched = ok(sandbox, {"watch", small});
  CHECK(lines_of(watched).back().starts_with("done: first.json, macro on 4 nodes, "));
  CHECK(ok(sandbox, {"status", small}).find("state: done\n") != std::string::npos);
  ok(sandbox, {"fetch", small, "-o", "a.exr", "--png", "a.png", "--stats", "a.json"});
  CHECK(sandbox.json("a.json")["algorithm"] == "macro");
  CHECK(sandbox.json("a.json")["token"]["rounds"] ==
        nlohmann::json::parse(ok(sandbox, {"status", small, "--json"}))["rounds"]);
  REQUIRE(
      sandbox.run({"render", first(), "--algorithm", "serial", "--size", "64x48", "-q"}).status ==
      0);
  CHECK((file_bytes(sandbox / "a.exr") == file_bytes(sandbox / "first.exr")));

  const std::string running =
      submit(sandbox, {first(), "--size", kLongSize, "--algorithm", "macro"});
  const std::string waiting = submit(sandbox, {first(), "--size", kLongSize});
  wait_for_state(sandbox, running, "rendering");
  CHECK(sandbox.run({"fetch", running, "-o", "b.exr"}).status == 1);
  Running watcher = sandbox.start({"watch", running});
  watcher.wait_for("rendering");
  ok(sandbox, {"cancel", waiting});
  ok(sandbox, {"cancel", running});
  const Outcome seen = watcher.wait();
  CHECK(seen.status == 1);
  CHECK(seen.err == "graycube: render: job " + running + ": cancelled\n");
  CHECK(sandbox.run({"cancel", running}).status == 1);

  const std::string table = ok(sandbox, {"jobs"});
  REQUIRE(lines_of(table).size() == 4);
  CHECK(lines_of(table)[1].starts_with(small + "    done"));
  CHECK(lines_of(table)[2].starts_with(running + "    cancelled"));
  CHECK(lines_of(table)[3].starts_with(waiting + "    cancelled"));

  ok(sandbox, {"down"});
  CHECK(farm.up().wait(10s).status == 0);
  CHECK(sandbox.processes().empty());
  CHECK(sandbox.temporary_files().empty());
  CHECK(sandbox.run({"jobs"}).status == 1);
}

TEST_CASE("jobs and nodes are lists of JSON; what runs comes first, then what waits") {
  Sandbox sandbox;
  Farm farm(sandbox);
  const std::string done = submit(sandbox, {first(), "--size", "16x16"});
  wait_for_state(sandbox, done, "done");
  const std::string running = submit(sandbox, {first(), "--size", kLongSize});
  const std::string waiting = submit(sandbox, {first(), "--size", kLongSize});
  const std::string last = submit(sandbox, {first(), "--size", kLongSize});
  wait_for_state(sandbox, running, "rendering");
  const auto jobs = nlohmann::json::parse(ok(sandbox, {"jobs", "--json"}));
  REQUIRE(jobs.size() == 4);
  std::vector<std::string> order;
  for (const auto& job : jobs) order.push_back(std::to_string(job.at("job").get<int>()));
  CHECK(order == std::vector<std::string>{running, waiting, last, done});
  CHECK(jobs[0].at("state") == "rendering");
  CHECK(jobs[1].at("state") == "queued");
  CHECK(jobs[3].at("fraction") == 1);
  const std::string page = ok(sandbox, {"jobs", "--skip", "1", "--limit", "2"});
  REQUIRE(lines_of(page).size() == 4);
  CHECK(lines_of(page)[1].starts_with(waiting));
  CHECK(lines_of(page)[3] == "jobs 2 to 3 of 4; --skip 3 shows more");
  const auto nodes = nlohmann::json::parse(ok(sandbox, {"nodes", "--json"}));
  REQUIRE(nodes.size() == 4);
  CHECK(nodes[3].at("rank") == 3);
  CHECK(nodes[3].at("pid").get<int>() > 0);
  CHECK(nodes[3].at("state").is_string());
  ok(sandbox, {"down"});
}

TEST_CASE("Ctrl-C while a job is waited for says that it goes on; a second one cancels it") {
  Sandbox sandbox;
  Farm farm(sandbox);
  for (const bool is_twice : {false, true}) {
    Running waiting =
        sandbox.start({"submit", first(), "--size", kLongSize, "--samples", "4", "--wait"});
    waiting.wait_for("\n");
    const std::string job = lines_of(waiting.out()).at(0);
    wait_for_state(sandbox, job, "rendering");
    waiting.signal(SIGINT);
    const auto until = std::chrono::steady_clock::now() + 10s;
    while (waiting.err().find("stops it") == std::string::npos &&
           std::chrono::steady_clock::now() < until)
      std::this_thread::sleep_for(5ms);
    CHECK(waiting.err().find("job " + job + " goes on; 'graycube cancel " + job + "' stops it") !=
          std::string::npos);
    if (is_twice) waiting.signal(SIGINT);
    const Outcome o = waiting.wait(20s);
    CHECK(o.status == 128 + SIGINT);
    CHECK((o.err.find("job " + job + " is cancelled") != std::string::npos) == is_twice);
    const auto info = nlohmann::json::parse(ok(sandbox, {"status", job, "--json"}));
    CHECK(info.at("state") == (is_twice ? "cancelled" : "rendering"));
    if (!is_twice) ok(sandbox, {"cancel", job});
  }
  ok(sandbox, {"down"});
}

TEST_CASE("what is waited for tells which file was written; progress comes as JSON, too") {
  Sandbox sandbox;
  Farm farm(sandbox);
  const Outcome o = sandbox.run({"submit", first(), "--size", "16x12", "--wait", "-o", "a.exr"});
  CHECK(o.status == 0);
  CHECK(o.err.find("a.exr: 16 x 12, ") != std::string::npos);
  const Outcome json = sandbox.run({"submit", first(), "--size", "16x12", "--wait", "--json"});
  const auto lines = lines_of(json.out);
  REQUIRE(lines.size() >= 2);
  CHECK(nlohmann::json::parse(lines.front()).contains("job"));
  for (const std::string& line : lines) CHECK(nlohmann::json::accept(line));
  const Outcome watched = sandbox.run({"watch", "1", "--json"});
  REQUIRE_FALSE(lines_of(watched.out).empty());
  CHECK(nlohmann::json::parse(lines_of(watched.out).back()).at("state") == "done");
  ok(sandbox, {"down"});
}

TEST_CASE("nodes that may hold few rays render the same picture") {
  Sandbox sandbox;
  Farm farm(sandbox, {"--outbox-rays", "40", "--threads", "2"});
  const std::string glass = scene_file("glass.json").string();
  const Arguments size{"--size", "64x48", "--max-depth", "4", "--quiet"};
  Arguments here{"render", glass, "--algorithm", "serial", "-o", "here.exr"};
  Arguments there{"submit",  glass, "--wait",    "--algorithm", "macro", "--shadows",
                  "forward", "-o",  "there.exr", "--stats",     "s.json"};
  for (Arguments* arguments : {&here, &there}) {
    arguments->insert(arguments->end(), size.begin(), size.end());
    ok(sandbox, *arguments);
  }
  CHECK((file_bytes(sandbox / "here.exr") == file_bytes(sandbox / "there.exr")));
  // So few rays that outboxes are full much of the time; beyond the forty, a node may hold the
  // packets and classes of its evaluators.
  constexpr int kChildren = 4, kThreads = 2, kPacket = 64, kClasses = 2 * 5 * 4;
  constexpr int kBound = 40 + kThreads * (2 + (kPacket + kClasses) * kChildren);
  const nlohmann::json stats = sandbox.json("s.json");
  REQUIRE(stats["per_node"].size() == 4);
  for (const auto& node : stats["per_node"]) {
    CHECK(node["outbox_peak"] > 20);
    CHECK(node["outbox_peak"] <= kBound);
  }
  ok(sandbox, {"down"});
  CHECK(farm.up().wait(10s).status == 0);
}

TEST_CASE("submit --wait is a render on the farm") {
  Sandbox sandbox;
  Farm farm(sandbox);
  const Outcome o = sandbox.run({"submit", first(), "--wait", "--algorithm", "macro", "--size",
                                 "64x48", "-o", "a.exr", "--png", "a.png", "--stats", "a.json"});
  INFO(o.err);
  CHECK(o.status == 0);
  CHECK(o.out == "1\n");
  CHECK(o.err.find("whether all is done") != std::string::npos);
  CHECK(sandbox.files() == std::vector<std::string>{"a.exr", "a.json", "a.png"});
  CHECK(read_exr(sandbox / "a.exr").width == 64);
  ok(sandbox,
     {"submit", first(), "--wait", "--algorithm", "macro", "--size", "64x48", "--stats", "b.json"});
  const auto start_cpu_s = [&](const char* stats) {
    return sandbox.json(stats)["start_cpu_s"].get<double>();
  };
  CHECK(start_cpu_s("a.json") > 0);
  CHECK(start_cpu_s("b.json") == 0);
  CHECK(sandbox.run({"submit", first(), "-n", "8"}).status == 2);
  CHECK(sandbox.run({"submit", first(), "--wait", "--size", kLongSize, "--timeout", "0.3", "-q"})
            .status == 1);
  CHECK(sandbox.run({"watch", "77"}).status == 2);
  ok(sandbox, {"down"});
}

TEST_CASE("a frontal that is killed is missed, and cleared away") {
  Sandbox sandbox;
  Running running =
      sandbox.start({"render", first(), "--size", kLongSize, "--algorithm", "macro", "-n", "4"});
  running.wait_for("rendering");
  for (const std::string& process : sandbox.processes()) {
    if (process.find("graycube-frontal") != std::string::npos) ::kill(std::stoi(process), SIGKILL);
  }
  const Outcome o = running.wait(20s);
  CHECK(o.status == 1);
  CHECK(o.err == "graycube: farm: graycube-frontal: killed by signal 9\n");
  const auto until = std::chrono::steady_clock::now() + 5s;
  while (!sandbox.processes().empty() && std::chrono::steady_clock::now() < until) {
    std::this_thread::sleep_for(5ms);
  }
  CHECK(sandbox.processes().empty());
  CHECK(sandbox.temporary_files().empty());
}

TEST_CASE("Ctrl-C stops a farm in order, while it works, too") {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    Sandbox sandbox;
    Farm farm(sandbox, {"--quiet"});
    const std::string job = submit(sandbox, {first(), "--size", kLongSize});
    wait_for_state(sandbox, job, "rendering");
    farm.up().signal(signal);
    const Outcome o = farm.up().wait(10s);
    CHECK(o.status == 0);
    CHECK(o.err.empty());
    CHECK(sandbox.processes().empty());
    CHECK(sandbox.temporary_files().empty());
  }
}

TEST_CASE("a second farm at the same place is refused, and a dead one's socket is no hindrance") {
  Sandbox sandbox;
  {
    Farm farm(sandbox);
    const Outcome second = sandbox.run({"up", "-n", "2"});
    CHECK(second.status == 1);
    CHECK(second.err.find("a farm is running there already") != std::string::npos);
    CHECK(lines_of(ok(sandbox, {"nodes"})).size() == 5);
    // The command first, which would start another frontal.
    farm.up().signal(SIGKILL);
    CHECK(farm.up().wait(10s).status == 128 + SIGKILL);
    for (const std::string& process : sandbox.processes()) {
      if (process.find("graycube-frontal") != std::string::npos)
        ::kill(std::stoi(process), SIGKILL);
    }
  }
  Farm again(sandbox);
  CHECK(lines_of(ok(sandbox, {"nodes"})).size() == 5);
  ok(sandbox, {"down"});
}

TEST_CASE("a farm listens where it is told, on a free port of the loopback, too") {
  Sandbox sandbox;
  const std::string local = "ipc://" + (sandbox / "my-farm").string();
  for (const std::string& listen : {local, std::string("tcp://127.0.0.1:*")}) {
    Farm farm(sandbox, {"--listen", listen});
    const std::string said = farm.up().out();
    const auto begin = said.find(" at ") + 4;
    const std::string endpoint = said.substr(begin, said.find(';') - begin);
    CHECK(endpoint.starts_with(listen.substr(0, listen.find('*'))));
    const std::string job = submit(sandbox, {first(), "--size", "32x32", "--connect", endpoint});
    ok(sandbox, {"watch", job, "--connect", endpoint});
    ok(sandbox, {"fetch", job, "-o", "a.exr", "--connect", endpoint});
    ok(sandbox, {"down", "--connect", endpoint});
    CHECK(farm.up().wait(10s).status == 0);
    CHECK(sandbox.processes().empty());
    CHECK(sandbox.files() == std::vector<std::string>{"a.exr"});
  }
}

/// A job whose preparation alone would take far longer than a test may.
const Arguments kSlowToPrepare{"--size", "8192x8192", "--samples", "64", "--algorithm", "macro"};

TEST_CASE("a job that is cancelled while it is prepared doesn't hold up the next") {
  Sandbox sandbox;
  Farm farm(sandbox);
  Arguments slow{first()};
  slow.insert(slow.end(), kSlowToPrepare.begin(), kSlowToPrepare.end());
  const std::string job = submit(sandbox, slow);
  wait_for_state(sandbox, job, "loading");
  const auto info = nlohmann::json::parse(ok(sandbox, {"status", job, "--json"}));
  CHECK(info["waits_for"].get<std::string>().starts_with("its scene to be read and cut, for "));
  const std::string next = submit(sandbox, {first(), "--size", "32x32"});
  CHECK(nlohmann::json::parse(ok(sandbox, {"status", next, "--json"}))["waits_for"] ==
        "job " + job + " to end");
  ok(sandbox, {"cancel", job});
  ok(sandbox, {"watch", next});
  CHECK(ok(sandbox, {"status", job}).find("state: cancelled\n") != std::string::npos);
  CHECK_FALSE(nlohmann::json::parse(ok(sandbox, {"status", next, "--json"})).contains("waits_for"));
}

TEST_CASE("a preparation ends with its time, and with its farm") {
  Sandbox sandbox;
  Farm farm(sandbox);
  Arguments slow{first(), "--timeout", "1"};
  slow.insert(slow.end(), kSlowToPrepare.begin(), kSlowToPrepare.end());
  const std::string late = submit(sandbox, slow);
  wait_for_state(sandbox, late, "failed");
  slow[2] = "1000";
  wait_for_state(sandbox, submit(sandbox, slow), "loading");
  ok(sandbox, {"down"});
  CHECK(farm.up().wait(30s).status == 0);
  CHECK(sandbox.processes().empty());
}

TEST_CASE("with --state a farm knows its jobs and pictures again") {
  Sandbox sandbox;
  std::string job;
  {
    Farm farm(sandbox, {"--state", "state"});
    job = submit(sandbox, {first(), "--size", "48x32"});
    ok(sandbox, {"watch", job});
    ok(sandbox, {"fetch", job, "-o", "a.exr", "--stats", "a.json"});
    ok(sandbox, {"down"});
    farm.up().wait(10s);
  }
  Farm farm(sandbox, {"--state", "state"});
  ok(sandbox, {"fetch", job, "-o", "b.exr", "--stats", "b.json"});
  CHECK((file_bytes(sandbox / "a.exr") == file_bytes(sandbox / "b.exr")));
  CHECK((file_bytes(sandbox / "a.json") == file_bytes(sandbox / "b.json")));
  CHECK(submit(sandbox, {first(), "--size", "48x32"}) != job);
  ok(sandbox, {"down"});
}

}  // namespace
}  // namespace graycube
