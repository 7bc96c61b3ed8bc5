// Nodes die, or stop, while they render: the picture is the serial one all the same.
#include <signal.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>
#include <thread>

#include "catch.hpp"
#include "integration/sandbox.hpp"

namespace graycube {
namespace {

/// Takes a farm of four nodes some seconds.
constexpr const char* kLongSize = "1600x1600";

std::string first() { return scene_file("first.json").string(); }

nlohmann::json json_of(Sandbox& sandbox, const Arguments& arguments) {
  const Outcome o = sandbox.run(arguments);
  INFO(o.err);
  REQUIRE(o.status == 0);
  return nlohmann::json::parse(o.out);
}

pid_t pid_of_node(Sandbox& sandbox, std::size_t rank) {
  return json_of(sandbox, {"nodes", "--json"}).at(rank).at("pid").get<pid_t>();
}

std::string serial_bytes(Sandbox& sandbox) {
  const Outcome o = sandbox.run(
      {"render", first(), "--size", kLongSize, "--algorithm", "serial", "-o", "serial.exr", "-q"});
  REQUIRE(o.status == 0);
  return file_bytes(sandbox / "serial.exr");
}

std::string output_of(Sandbox& sandbox, const Arguments& arguments) {
  const Outcome o = sandbox.run(arguments);
  REQUIRE(o.status == 0);
  return o.out;
}

/// Of the nodes that share a process one reports its memory.
void check_process_figures(const nlohmann::json& stats) {
  std::map<std::uint64_t, int> reporters;  // by process
  for (const nlohmann::json& node : stats.at("per_node"))
    reporters[node.at("pid")] += node.at("peak_rss_bytes") > 0 ? 1 : 0;
  CHECK(reporters.size() == 2);
  for (const auto& [pid, count] : reporters) CHECK(count == 1);
}

/// Waits until some of the job's tiles are whole, so that there is something to lose.
void wait_until_under_way(Sandbox& sandbox, const std::string& job) {
  const auto until = std::chrono::steady_clock::now() + 60s;
  while (json_of(sandbox, {"status", job, "--json"}).at("fraction").get<double>() < 0.02) {
    REQUIRE(std::chrono::steady_clock::now() < until);
    std::this_thread::sleep_for(10ms);
  }
}

/// What must be in the statistics of a job that has lost node `rank` once.
void check_loss(const nlohmann::json& stats, std::size_t rank, const std::string& why) {
  CHECK(stats.at("epochs") == 2);
  REQUIRE(stats.at("losses").size() == 1);
  const nlohmann::json& loss = stats.at("losses").front();
  CHECK(loss.at("rank") == rank);
  CHECK(loss.at("why") == why);
  CHECK(loss.at("tiles").get<int>() > 0);
  CHECK(loss.at("noticed_s").get<double>() > 0);
}

/// The log tells of the losses that are in the statistics, and no others.
void check_log(const std::string& log, const nlohmann::json& stats, pid_t lost) {
  INFO(log);
  std::vector<std::string> losses;
  for (const std::string& line : lines_of(log)) {
    if (line.find(" lost ") != std::string::npos) losses.push_back(line);
  }
  REQUIRE(losses.size() == stats.at("losses").size());
  const nlohmann::json& loss = stats.at("losses").front();
  const std::string said = " job 1: lost node " + std::to_string(loss.at("rank").get<int>()) +
                           " (process " + std::to_string(lost) +
                           "): " + loss.at("why").get<std::string>() + ", noticed after ";
  CHECK(losses.front().find(said) != std::string::npos);
  const int tiles = loss.at("tiles").get<int>();
  CHECK(losses.front().ends_with("; " + std::to_string(tiles) + " tile" + (tiles == 1 ? "" : "s") +
                                 " again, epoch " + std::to_string(stats.at("epochs").get<int>())));
  for (const char* event : {" job 1: submitted, \"first.json\"", " job 1: begins",
                            " has taken its place", " job 1: done after "})
    CHECK(log.find(event) != std::string::npos);
}

void check_loss_leaves_picture(const std::string& algorithm, int signal, const std::string& why) {
  INFO(algorithm << ", " << why);
  Sandbox sandbox;
  const std::string expected = serial_bytes(sandbox);
  Running up = sandbox.start({"up", "-n", "4", "--log", "farm.log"});
  up.wait_for("graycube down");
  Running submitted = sandbox.start({"submit", first(), "--wait", "--size", kLongSize,
                                     "--algorithm", algorithm, "-o", "a.exr", "--stats", "s.json"});
  submitted.wait_for("1\n");
  wait_until_under_way(sandbox, "1");
  const pid_t lost = pid_of_node(sandbox, 2);
  ::kill(lost, signal);
  const Outcome o = submitted.wait(120s);
  INFO(o.err);
  CHECK(o.status == 0);
  CHECK(file_bytes(sandbox / "a.exr") == expected);
  check_loss(nlohmann::json::parse(file_bytes(sandbox / "s.json")), 2, why);
  CHECK(pid_of_node(sandbox, 2) != lost);
  check_log(file_bytes(sandbox / "farm.log"), sandbox.json("s.json"), lost);
  CHECK(sandbox.run({"down"}).status == 0);
  CHECK(up.wait(10s).status == 0);
  CHECK(sandbox.processes().empty());
}

/// The farm's programs, in a folder from which one can be taken away.
std::string copy_of_programs(const Sandbox& sandbox) {
  const std::filesystem::path from = std::filesystem::path(GRAYCUBE_COMMAND).parent_path();
  std::filesystem::create_directory(sandbox / "bin");
  for (const char* name : {"graycube", "graycube-frontal", "graycube-node", "graycube-fifo"}) {
    std::filesystem::copy_file(from / name, sandbox / "bin" / name);
  }
  return (sandbox / "bin" / "graycube").string();
}

/// Waits until all four nodes are here; returns the ids of their processes, by rank.
std::vector<pid_t> pids_of_whole_farm(Sandbox& sandbox) {
  const auto until = std::chrono::steady_clock::now() + 60s;
  for (;;) {
    std::vector<pid_t> pids;
    for (const nlohmann::json& node : json_of(sandbox, {"nodes", "--json"})) {
      if (node.at("state") != "starting") pids.push_back(node.at("pid").get<pid_t>());
    }
    if (pids.size() == 4) return pids;
    REQUIRE(std::chrono::steady_clock::now() < until);
    std::this_thread::sleep_for(20ms);
  }
}

/// Kills a process; returns the processes once all nodes are here again.
std::vector<pid_t> kill_and_wait(Sandbox& sandbox, pid_t process) {
  ::kill(process, SIGKILL);
  for (;;) {
    const std::vector<pid_t> pids = pids_of_whole_farm(sandbox);
    if (std::ranges::count(pids, process) == 0) return pids;
    std::this_thread::sleep_for(20ms);
  }
}

std::size_t distinct(const std::vector<pid_t>& pids) {
  return std::set<pid_t>(pids.begin(), pids.end()).size();
}

std::vector<std::string> reasons(const nlohmann::json& stats) {
  std::vector<std::string> whys;
  for (const nlohmann::json& loss : stats.at("losses")) whys.push_back(loss.at("why"));
  return whys;
}

/// Renders a job while graycube-node is taken away, and node 3 and then the process that has taken
/// it in are killed. Returns the job's statistics.
nlohmann::json stats_of_job_with_guests(const std::string& algorithm) {
  INFO(algorithm);
  Sandbox sandbox;
  const std::string expected = serial_bytes(sandbox);
  Running up = sandbox.start_program(copy_of_programs(sandbox), {"up", "-n", "4"});
  up.wait_for("graycube down");
  Running submitted = sandbox.start({"submit", first(), "--wait", "--size", kLongSize,
                                     "--algorithm", algorithm, "-o", "a.exr", "--stats", "s.json"});
  submitted.wait_for("1\n");
  wait_until_under_way(sandbox, "1");
  const std::vector<pid_t> before = pids_of_whole_farm(sandbox);
  CHECK(distinct(before) == 4);
  std::filesystem::remove(sandbox / "bin" / "graycube-node");
  const std::vector<pid_t> with_one_less = kill_and_wait(sandbox, before[3]);
  CHECK(distinct(with_one_less) == 3);
  const pid_t host = with_one_less[3];
  CHECK(std::ranges::count(before, host) == 1);
  CHECK(output_of(sandbox, {"nodes"}).find("Process " + std::to_string(host) + " is nodes ") !=
        std::string::npos);
  CHECK(distinct(kill_and_wait(sandbox, host)) == 2);
  const Outcome o = submitted.wait(120s);
  INFO(o.err);
  CHECK(o.status == 0);
  CHECK(file_bytes(sandbox / "a.exr") == expected);
  CHECK(up.err().find("node 3 can't be started (") != std::string::npos);
  CHECK(sandbox.run({"down"}).status == 0);
  CHECK(up.wait(10s).status == 0);
  CHECK(sandbox.processes().empty());
  return sandbox.json("s.json");
}

}  // namespace

TEST_CASE("a killed node costs its job an epoch, and the picture is the serial one") {
  for (const char* algorithm : {"macro", "roth"})
    check_loss_leaves_picture(algorithm, SIGKILL, "killed by signal 9");
}

TEST_CASE("a node that is stopped is missed, and another takes its place") {
  for (const char* algorithm : {"macro", "roth"})
    check_loss_leaves_picture(algorithm, SIGSTOP, "fell silent");
}

TEST_CASE("a node that can't be started runs in another's process, and so does the next") {
  // Nobody traces before all are here again, so that both losses are the job's.
  const nlohmann::json stats = stats_of_job_with_guests("macro");
  CHECK(stats.at("epochs") == 3);
  const std::vector<std::string> whys = reasons(stats);
  CHECK(std::ranges::count(whys, "killed by signal 9") == 3);
  const auto is_of_guest = [](const std::string& why) {
    return why.starts_with("can't be started (") && why.ends_with("'s process");
  };
  CHECK(std::ranges::count_if(whys, is_of_guest) == 3);
  check_process_figures(stats);
}

TEST_CASE("so it does where the others go on without it") {
  const nlohmann::json stats = stats_of_job_with_guests("roth");
  CHECK(stats.at("epochs") >= 2);
  CHECK(reasons(stats).front() == "killed by signal 9");
}

TEST_CASE("a render whose nodes are killed one after another goes on") {
  Sandbox sandbox;
  const std::string expected = serial_bytes(sandbox);
  Running render = sandbox.start({"render", first(), "--size", kLongSize, "--algorithm", "macro",
                                  "-n", "4", "-o", "a.exr", "--stats", "s.json"});
  render.wait_for("rendering");
  std::vector<std::string> killed;
  for (const std::string& process : sandbox.processes()) {
    if (process.find("graycube-node") == std::string::npos || killed.size() == 3) continue;
    ::kill(std::stoi(process), SIGKILL);
    killed.push_back(process);
    std::this_thread::sleep_for(100ms);
  }
  REQUIRE(killed.size() == 3);
  const Outcome o = render.wait(120s);
  INFO(o.err);
  CHECK(o.status == 0);
  CHECK(file_bytes(sandbox / "a.exr") == expected);
  const auto stats = nlohmann::json::parse(file_bytes(sandbox / "s.json"));
  CHECK(stats.at("losses").size() == 3);
  CHECK(sandbox.processes().empty());
  CHECK(sandbox.temporary_files().empty());
}

TEST_CASE("with --retries 0 the first loss ends the job, and tells which part was under way") {
  Sandbox sandbox;
  Running render = sandbox.start({"render", first(), "--size", "3000x3000", "--algorithm", "macro",
                                  "-n", "4", "--retries", "0", "-o", "a.exr"});
  render.wait_for("rendering");
  for (const std::string& process : sandbox.processes()) {
    if (process.find("graycube-node") == std::string::npos) continue;
    ::kill(std::stoi(process), SIGKILL);
    break;
  }
  const Outcome o = render.wait(30s);
  INFO(o.err);
  CHECK(o.status == 1);
  CHECK(o.err.find("graycube: render: node ") != std::string::npos);
  CHECK(o.err.find("killed by signal 9; that was loss 1 of the job, and each time tile ") !=
        std::string::npos);
  CHECK(sandbox.processes().empty());
}

}  // namespace graycube
