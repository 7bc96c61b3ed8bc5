// The frontal dies: nothing that was accepted is lost, and clients wait.
#include <signal.h>

#include <algorithm>
#include <set>
#include <sstream>
#include <thread>

#include "catch.hpp"
#include "integration/sandbox.hpp"

namespace graycube {
namespace {

/// Takes a farm of four nodes some seconds.
constexpr const char* kLongSize = "1600x1600";
/// Takes one long enough to be recorded on the way.
constexpr const char* kLargeSize = "3000x3000";

class Farm {
 public:
  explicit Farm(Sandbox& sandbox, const Arguments& options = {}) : up_(start(sandbox, options)) {
    up_.wait_for("graycube down");
  }
  Running& up() { return up_; }

 private:
  static Running start(Sandbox& sandbox, const Arguments& options) {
    Arguments arguments{"up", "-n", "4"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    return sandbox.start(arguments);
  }
  Running up_;
};

std::string ok(Sandbox& sandbox, const Arguments& arguments) {
  const Outcome o = sandbox.run(arguments);
  INFO(arguments.front() << ": " << o.out << o.err);
  REQUIRE(o.status == 0);
  return o.out;
}

std::string first() { return scene_file("first.json").string(); }

std::string submit(Sandbox& sandbox, const std::string& size) {
  const std::string out = ok(sandbox, {"submit", first(), "--size", size});
  return out.substr(0, out.size() - 1);
}

std::string serial(Sandbox& sandbox, const std::string& size) {
  ok(sandbox, {"render", first(), "--size", size, "--algorithm", "serial", "-o", "serial.exr"});
  return file_bytes(sandbox / "serial.exr");
}

/// How the farm is, as `status --farm --json` tells it.
nlohmann::json farm_status(Sandbox& sandbox) {
  return nlohmann::json::parse(ok(sandbox, {"status", "--farm", "--json"}));
}

pid_t frontal(Sandbox& sandbox) { return farm_status(sandbox).at("pid").get<pid_t>(); }

std::set<pid_t> nodes(Sandbox& sandbox) {
  std::set<pid_t> pids;
  for (const auto& node : nlohmann::json::parse(ok(sandbox, {"nodes", "--json"})))
    pids.insert(node.at("pid").get<pid_t>());
  pids.erase(0);
  return pids;
}

/// Whether the processes end within so long; those that have ended and are nobody's count, too.
bool all_end(const std::set<pid_t>& pids, std::chrono::milliseconds limit) {
  const auto until = std::chrono::steady_clock::now() + limit;
  const auto lives = [](pid_t pid) {
    std::istringstream stat(file_bytes("/proc/" + std::to_string(pid) + "/stat"));
    std::string number, name, state;
    return static_cast<bool>(stat >> number >> name >> state) && state != "Z";
  };
  while (std::any_of(pids.begin(), pids.end(), lives)) {
    if (std::chrono::steady_clock::now() > until) return false;
    std::this_thread::sleep_for(20ms);
  }
  return true;
}

void wait_until_on(Sandbox& sandbox, const std::string& job) {
  const auto until = std::chrono::steady_clock::now() + 60s;
  while (nlohmann::json::parse(ok(sandbox, {"status", job, "--json"})).at("state") != "rendering") {
    REQUIRE(std::chrono::steady_clock::now() < until);
    std::this_thread::sleep_for(20ms);
  }
}

}  // namespace

TEST_CASE("a client at a TCP port shows its key to the next frontal, too") {
  Sandbox sandbox;
  const std::string expected = serial(sandbox, kLongSize);
  const std::string key = (sandbox / "key").string();
  Farm farm(sandbox, {"--listen", "tcp://127.0.0.1:*", "--key", key});
  const std::string said = farm.up().out(), before = " at tcp://";
  const std::size_t begin = said.find(before) + 4;
  const std::string endpoint = said.substr(begin, said.find(';', begin) - begin);
  Running waiting = sandbox.start({"submit", first(), "--size", kLongSize, "--wait", "-o", "a.exr",
                                   "--connect", endpoint, "--key", key});
  waiting.wait_for("1\n");
  const auto info = nlohmann::json::parse(
      ok(sandbox, {"status", "--farm", "--json", "--connect", endpoint, "--key", key}));
  REQUIRE(::kill(info.at("pid").get<pid_t>(), SIGKILL) == 0);
  const Outcome o = waiting.wait(120s);
  INFO(o.err);
  CHECK(o.status == 0);
  CHECK((file_bytes(sandbox / "a.exr") == expected));
}

TEST_CASE("a frontal that is killed is started again, and every job ends right") {
  // Without --state, too, as long as the farm is up.
  const bool has_state = GENERATE(true, false);
  INFO("with --state: " << has_state);
  Sandbox sandbox;
  const std::string expected = serial(sandbox, kLongSize);
  Arguments options{"--log", "farm.log"};
  if (has_state) options.insert(options.end(), {"--state", "state"});
  Farm farm(sandbox, options);
  Running waiting = sandbox.start(
      {"submit", first(), "--size", kLongSize, "--wait", "-o", "a.exr", "--stats", "a.json"});
  waiting.wait_for("1\n");
  const std::string second = submit(sandbox, "48x32"), third = submit(sandbox, "32x48");
  wait_until_on(sandbox, "1");
  const pid_t killed = frontal(sandbox);
  const auto orphans = nodes(sandbox);
  CHECK(orphans.size() == 4);
  REQUIRE(::kill(killed, SIGKILL) == 0);
  CHECK(all_end(orphans, 2s));
  farm.up().wait_for("killed by signal 9; it is started again");
  const Outcome o = waiting.wait(120s);
  INFO(o.err);
  CHECK(o.status == 0);
  CHECK(o.out == "1\n");
  CHECK((file_bytes(sandbox / "a.exr") == expected));
  const auto stats = nlohmann::json::parse(file_bytes(sandbox / "a.json"));
  CHECK(stats.at("epochs") == 2);
  CHECK(stats.at("losses").at(0).at("why") == "the frontal ended, and another one goes on");
  CHECK(frontal(sandbox) != killed);
  for (const std::string& job : {second, third}) {
    ok(sandbox, {"watch", job});
    ok(sandbox, {"fetch", job, "-o", job + ".exr"});
  }
  CHECK((file_bytes(sandbox / (second + ".exr")) == serial(sandbox, "48x32")));
  CHECK((file_bytes(sandbox / (third + ".exr")) == serial(sandbox, "32x48")));
  CHECK(submit(sandbox, "16x16") == "4");
  const std::string log = file_bytes(sandbox / "farm.log");
  INFO(log);
  for (const char* told : {" farm: graycube-frontal: killed by signal 9; it is started again\n",
                           " job 1: taken up again, \"first.json\"\n",
                           " job 1: begins again, after 1 frontal that had begun it ended\n"})
    CHECK(log.find(told) != std::string::npos);
  ok(sandbox, {"down"});
  CHECK(farm.up().wait(10s).status == 0);
  CHECK(sandbox.processes().empty());
  CHECK(sandbox.temporary_files().empty());
}

TEST_CASE("a frontal that is stopped is killed, and another one goes on") {
  Sandbox sandbox;
  const std::string expected = serial(sandbox, kLongSize);
  Farm farm(sandbox, {"--state", "state"});
  Running waiting =
      sandbox.start({"submit", first(), "--size", kLongSize, "--wait", "-o", "a.exr"});
  waiting.wait_for("1\n");
  wait_until_on(sandbox, "1");
  const pid_t stopped = frontal(sandbox);
  REQUIRE(::kill(stopped, SIGSTOP) == 0);
  farm.up().wait_for("killed by signal 9; it is started again");
  const Outcome o = waiting.wait(120s);
  INFO(o.err);
  CHECK(o.status == 0);
  CHECK((file_bytes(sandbox / "a.exr") == expected));
  CHECK(frontal(sandbox) != stopped);
  ok(sandbox, {"down"});
  CHECK(farm.up().wait(10s).status == 0);
  CHECK(sandbox.processes().empty());
}

TEST_CASE("jobs that had not ended when a farm with --state stopped go on when it is up again") {
  Sandbox sandbox;
  {
    Farm farm(sandbox, {"--state", "state"});
    CHECK(submit(sandbox, kLongSize) == "1");
    CHECK(submit(sandbox, "48x32") == "2");
    Running watching = sandbox.start({"watch", "2"});
    wait_until_on(sandbox, "1");
    ok(sandbox, {"down"});
    CHECK(watching.wait(10s).err.find("it has stopped") != std::string::npos);
    CHECK(farm.up().wait(10s).status == 0);
  }
  Farm farm(sandbox, {"--state", "state"});
  CHECK(submit(sandbox, "16x16") == "3");
  ok(sandbox, {"watch", "1"});
  for (const char* job : {"1", "2", "3"}) ok(sandbox, {"watch", job});
  ok(sandbox, {"fetch", "1", "-o", "a.exr"});
  CHECK((file_bytes(sandbox / "a.exr") == serial(sandbox, kLongSize)));
  ok(sandbox, {"down"});
}

TEST_CASE("a frontal that dies again and again is given up") {
  Sandbox sandbox;
  Farm farm(sandbox);
  for (int death = 1; death <= 4; ++death) {
    const pid_t killed = frontal(sandbox);
    REQUIRE(::kill(killed, SIGKILL) == 0);
    if (death == 4) break;
    const auto until = std::chrono::steady_clock::now() + 30s;
    while (frontal(sandbox) == killed) REQUIRE(std::chrono::steady_clock::now() < until);
  }
  const Outcome o = farm.up().wait(10s);
  CHECK(o.status == 1);
  CHECK(o.err.find("killed by signal 9; it has been started again 3 times within 60 s") !=
        std::string::npos);
  CHECK(sandbox.processes().empty());
  CHECK(sandbox.temporary_files().empty());
}

TEST_CASE("two farms can't have the same --state, and the second is told who has it") {
  Sandbox sandbox;
  Farm farm(sandbox, {"--state", "state"});
  const Outcome o =
      sandbox.run({"up", "-n", "2", "--listen", "tcp://127.0.0.1:*", "--state", "state"});
  CHECK(o.status == 1);
  CHECK(o.err.find("state: is in use by the farm of process " + std::to_string(frontal(sandbox))) !=
        std::string::npos);
  ok(sandbox, {"down"});
}

TEST_CASE("a farm tells about itself: the frontal's process, nodes and jobs") {
  Sandbox sandbox;
  Farm farm(sandbox);
  ok(sandbox, {"submit", first(), "--size", "16x16", "--wait", "--quiet"});
  const auto status = farm_status(sandbox);
  CHECK(::kill(status.at("pid").get<pid_t>(), 0) == 0);
  CHECK(status.at("frontal").at("pid") == status.at("pid"));
  CHECK(status.at("frontal").at("endpoint").get<std::string>().starts_with("ipc://"));
  CHECK(status.at("nodes") == 4);
  CHECK(status.at("jobs") == 1);
  CHECK(status.at("ended") == 1);
  CHECK(ok(sandbox, {"status", "--farm"}).find("nodes: 4 of 4\n") != std::string::npos);
  CHECK(sandbox.run({"status"}).status == 2);
  CHECK(sandbox.run({"status", "1", "--farm"}).status == 2);
  ok(sandbox, {"down"});
}

TEST_CASE("of the jobs that have ended a farm keeps as many as it is told") {
  Sandbox sandbox;
  {
    Farm farm(sandbox, {"--state", "state", "--keep", "2"});
    for (int i = 0; i < 4; ++i) ok(sandbox, {"submit", first(), "--size", "16x16", "--wait", "-q"});
    ok(sandbox, {"down"});
  }
  Farm farm(sandbox, {"--state", "state", "--keep", "2"});
  const auto until = std::chrono::steady_clock::now() + 30s;
  while (std::filesystem::exists(sandbox / "state/job-2.exr"))
    REQUIRE(std::chrono::steady_clock::now() < until);
  CHECK(nlohmann::json::parse(ok(sandbox, {"jobs", "--json"})).size() == 2);
  CHECK(sandbox.run({"fetch", "2", "-o", "a.exr"}).status == 2);
  ok(sandbox, {"fetch", "3", "-o", "a.exr"});
  CHECK(submit(sandbox, "16x16") == "5");
  ok(sandbox, {"down"});
  const Outcome o = sandbox.run({"up", "--keep", "some"});
  CHECK(o.status == 2);
  CHECK(o.err.starts_with("graycube: usage: --keep some: expected a number of jobs"));
}

TEST_CASE("tiles that were whole when the frontal died are not traced again") {
  Sandbox sandbox;
  const std::string expected = serial(sandbox, kLargeSize);
  Farm farm(sandbox, {"--state", "state"});
  Running waiting = sandbox.start(
      {"submit", first(), "--size", kLargeSize, "--wait", "-o", "a.exr", "--stats", "a.json"});
  const auto until = std::chrono::steady_clock::now() + 60s;
  waiting.wait_for("1\n");
  while (!std::filesystem::exists(sandbox / "state/job-1.tiles"))
    REQUIRE(std::chrono::steady_clock::now() < until);
  REQUIRE(::kill(frontal(sandbox), SIGKILL) == 0);
  const Outcome o = waiting.wait(120s);
  INFO(o.err);
  CHECK(o.status == 0);
  CHECK((file_bytes(sandbox / "a.exr") == expected));
  CHECK(sandbox.json("a.json").at("resumed_tiles") > 0);
  ok(sandbox, {"down"});
  CHECK(farm.up().wait(10s).status == 0);
  CHECK_FALSE(std::filesystem::exists(sandbox / "state/job-1.tiles"));
}

TEST_CASE("a render that was interrupted goes on from its checkpoint, and removes it at the end") {
  const std::string algorithm = GENERATE("serial", "roth", "macro");
  INFO(algorithm);
  Sandbox sandbox;
  const Arguments command{"render",  first(),  "--size", kLargeSize,     "--algorithm",
                          algorithm, "-n",     "4",      "-o",           "a.exr",
                          "--stats", "a.json", "-q",     "--checkpoint", "a.checkpoint"};
  Running render = sandbox.start(command);
  const auto until = std::chrono::steady_clock::now() + 60s;
  while (!std::filesystem::exists(sandbox / "a.checkpoint"))
    REQUIRE(std::chrono::steady_clock::now() < until);
  render.signal(SIGINT);
  const Outcome interrupted = render.wait(20s);
  CHECK(interrupted.status != 0);
  CHECK(interrupted.err.find("the same command goes on from it") != std::string::npos);
  CHECK_FALSE(std::filesystem::exists(sandbox / "a.exr"));
  REQUIRE(std::filesystem::exists(sandbox / "a.checkpoint"));

  Arguments other = command;
  other.insert(other.end(), {"--samples", "2"});
  const Outcome refused = sandbox.run(other);
  CHECK(refused.status == 2);
  CHECK(refused.err.find("a.checkpoint: it is of another scene") != std::string::npos);

  ok(sandbox, command);
  CHECK((file_bytes(sandbox / "a.exr") == serial(sandbox, kLargeSize)));
  CHECK(sandbox.json("a.json").at("resumed_tiles") > 0);
  CHECK_FALSE(std::filesystem::exists(sandbox / "a.checkpoint"));
  CHECK(sandbox.processes().empty());
}

TEST_CASE("a file that is no checkpoint is refused and stays as it is") {
  Sandbox sandbox;
  sandbox.write("notes.txt", "notes that are longer than the head of a checkpoint is");
  const Outcome o = sandbox.run(
      {"render", first(), "--size", "16x16", "-o", "a.exr", "--checkpoint", "notes.txt"});
  CHECK(o.status == 2);
  CHECK(o.err.find("notes.txt: it is no checkpoint") != std::string::npos);
  CHECK(file_bytes(sandbox / "notes.txt").starts_with("notes that"));
}

}  // namespace graycube
