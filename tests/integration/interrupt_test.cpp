// Signals at any moment leave no process, no socket, no file.
#include <signal.h>

#include <fstream>
#include <iterator>
#include <random>
#include <thread>

#include "catch.hpp"
#include "integration/sandbox.hpp"

namespace graycube {
namespace {

/// Checks that no process runs and no file is left, now or very soon.
void check_gone(const Sandbox& sandbox, std::chrono::milliseconds limit) {
  const auto until = std::chrono::steady_clock::now() + limit;
  while (std::chrono::steady_clock::now() < until &&
         !(sandbox.processes().empty() && sandbox.temporary_files().empty())) {
    std::this_thread::sleep_for(5ms);
  }
  CHECK(sandbox.processes().empty());
  CHECK(sandbox.temporary_files().empty());
}

/// One render with a signal after a while. The command has put everything away when it ends.
void interrupt_render(const Arguments& how, int signal, std::chrono::milliseconds after) {
  Sandbox sandbox;
  Arguments arguments{"render",  scene_file("mirrors.json").string(),
                      "-o",      "out.exr",
                      "--png",   "out.png",
                      "--stats", "out.json"};
  arguments.insert(arguments.end(), how.begin(), how.end());
  Running running = sandbox.start(arguments);
  std::this_thread::sleep_for(after);
  running.signal(signal);
  const Outcome o = running.wait(20s);
  INFO("signal " << signal << " after " << after.count() << " ms: " << o.out << o.err);
  check_gone(sandbox, 0ms);
  if (o.status == 0) {
    // The render was done already: then all its files are there.
    CHECK(sandbox.files() == std::vector<std::string>{"out.exr", "out.json", "out.png"});
    return;
  }
  CHECK(sandbox.files().empty());
  CHECK(o.status == 128 + signal);
  if (o.err.empty()) return;  // before it could take notice, so before anything was there
  CHECK(lines_of(o.err).size() == 1);
  CHECK(o.err.starts_with("graycube: render: SIG"));
}

TEST_CASE("Ctrl-C at any moment of a render leaves no process and no file") {
  const unsigned seed = 20260;
  INFO("seed " << seed);
  std::mt19937 random(seed);
  std::uniform_int_distribution<int> delay(0, 700);
  for (int i = 0; i < 10; ++i) {
    interrupt_render({"--algorithm", "macro", "-n", "8", "--size", "500x500"}, SIGINT,
                     std::chrono::milliseconds(delay(random)));
  }
  for (const int ms : {1, 3, 10, 20, 40, 60}) {
    interrupt_render({"--algorithm", "roth", "-n", "4"}, SIGINT, std::chrono::milliseconds(ms));
  }
}

TEST_CASE("a serial render is interrupted at once") {
  for (const int ms : {5, 100, 300}) {
    interrupt_render({"--algorithm", "serial", "--size", "3000x3000"}, SIGINT,
                     std::chrono::milliseconds(ms));
  }
}

TEST_CASE("SIGTERM and a closed terminal end a render in order, too") {
  for (const int signal : {SIGTERM, SIGHUP}) {
    interrupt_render({"--algorithm", "macro", "-n", "4", "--size", "1000x1000"}, signal, 300ms);
  }
}

TEST_CASE("a second Ctrl-C does not disturb the order of the end") {
  Sandbox sandbox;
  Running running = sandbox.start({"render", scene_file("mirrors.json").string(), "--size",
                                   "2000x2000", "--algorithm", "macro", "-n", "8"});
  running.wait_for("rendering");
  for (int i = 0; i < 20; ++i) {
    running.signal(SIGINT);
    std::this_thread::sleep_for(1ms);
  }
  CHECK(running.wait().status == 128 + SIGINT);
  check_gone(sandbox, 0ms);
}

/// The state letters of the processes (proc(5)): T for one that is stopped.
std::string states_of(const std::vector<std::string>& processes) {
  std::string states;
  for (const std::string& process : processes) {
    std::ifstream file("/proc/" + std::to_string(std::stoi(process)) + "/stat");
    const std::string text((std::istreambuf_iterator<char>(file)), {});
    const std::size_t at = text.rfind(") ");
    if (at != std::string::npos) states += text.substr(at + 2, 1);
  }
  return states;
}

TEST_CASE("Ctrl-Z stops a render with its farm, and both go on together") {
  Sandbox sandbox;
  Running running = sandbox.start({"render", scene_file("mirrors.json").string(), "--size",
                                   "700x700", "--algorithm", "macro", "-n", "2"});
  running.wait_for("rendering");
  running.signal(SIGTSTP);
  const auto until = std::chrono::steady_clock::now() + 10s;
  const auto all_are_stopped = [&] {
    return states_of(sandbox.processes()).find_first_not_of('T') == std::string::npos;
  };
  while (!all_are_stopped() && std::chrono::steady_clock::now() < until)
    std::this_thread::sleep_for(5ms);
  CHECK(states_of(sandbox.processes()) == "TTTT");
  running.signal(SIGCONT);
  CHECK(running.wait().status == 0);
  check_gone(sandbox, 0ms);
}

TEST_CASE("a render that is killed takes its farm with it") {
  Sandbox sandbox;
  Running running = sandbox.start({"render", scene_file("mirrors.json").string(), "--size",
                                   "2000x2000", "--algorithm", "macro", "-n", "4"});
  running.wait_for("rendering");
  running.signal(SIGKILL);
  CHECK(running.wait().status == 128 + SIGKILL);
  check_gone(sandbox, 10s);
  CHECK(sandbox.files().empty());
}

TEST_CASE("the processes of a render are found while it runs") {
  // If they weren't found, the other tests here would check nothing.
  Sandbox sandbox;
  Running running = sandbox.start({"render", scene_file("mirrors.json").string(), "--size",
                                   "2000x2000", "--algorithm", "macro", "-n", "4"});
  running.wait_for("rendering");
  CHECK(sandbox.processes().size() == 1 + 1 + 4);
  CHECK_FALSE(sandbox.temporary_files().empty());
  running.signal(SIGINT);
  running.wait();
}

}  // namespace
}  // namespace graycube
