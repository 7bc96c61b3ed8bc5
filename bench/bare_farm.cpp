// bare_farm NODES…: the cost of a farm's processes before they trace anything. Forks as many
// processes as a farm has nodes, which open the sockets that nodes have, greet the hub and their
// neighbours in the hypercube, and end: nothing of Graycube but its transport. Prints three lines
// for each number: forked only; with their sockets; linked, too.
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <charconv>
#include <chrono>
#include <cstdio>
#include <exception>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "bench/clocks.hpp"
#include "memory/kept_heap.hpp"
#include "process/clocks.hpp"
#include "process/temporary_folder.hpp"
#include "topology/hypercube.hpp"
#include "transport/zmq_sockets.hpp"

namespace graycube::bench {
namespace {

enum class Stage { kForked, kSockets, kLinks };

std::string name_of(Stage stage) {
  switch (stage) {
    case Stage::kForked: return "forked";
    case Stage::kSockets: return "with sockets";
    case Stage::kLinks: return "linked";
  }
  return {};
}

std::string endpoint_of(const TemporaryFolder& folder, const std::string& name) {
  return "ipc://" + (folder / name).string();
}

Message some_message() { return Message::of_text("hello"); }

void receive(Connection& connection) {
  while (!connection.receive(std::chrono::milliseconds(1000))) {
  }
}

std::string receive(Inbox& inbox) {
  for (;;) {
    if (const auto m = inbox.receive()) return m->peer;
    Readable* const sockets[] = {&inbox};
    wait_readable(sockets, {}, std::chrono::milliseconds(1000));
  }
}

/// Does what the node of that rank does before it could begin.
void run_process(Rank rank, const Hypercube& cube, Stage stage, const TemporaryFolder& folder) {
  if (stage == Stage::kForked) return;
  keep_freed_memory(1, 0);
  const auto endpoint = [&](Rank of) { return endpoint_of(folder, std::to_string(of.value)); };
  ZmqContext context;
  Inbox inbox(context, endpoint(rank));
  Connection hub(context, endpoint_of(folder, "hub"));
  hub.send(some_message());
  // All inboxes are there now.
  receive(hub);
  if (stage == Stage::kLinks) {
    std::vector<Connection> links;
    std::size_t greeted_by = 0;
    for (std::uint32_t bit = 0; bit < cube.dimension(); ++bit) {
      const Rank peer = cube.neighbour(rank, bit);
      if (peer < rank) {
        ++greeted_by;
        continue;
      }
      links.emplace_back(context, endpoint(peer)).send(some_message());
    }
    for (; greeted_by > 0; --greeted_by) inbox.send(receive(inbox), some_message());
    for (Connection& link : links) receive(link);
    hub.send(some_message());
    receive(hub);
  }
  // Ends as a node does.
  ::_exit(0);
}

/// Answers all processes once each of them has spoken.
void answer_all(Inbox& hub, std::uint32_t processes) {
  std::vector<std::string> peers;
  while (peers.size() < processes) peers.push_back(receive(hub));
  for (const std::string& peer : peers) hub.send(peer, some_message());
}

void measure(const Hypercube& cube, Stage stage) {
  // Kept as by the nodes' common parent: no process looks for the system's protocols itself.
  const ZmqContext first;
  const TemporaryFolder folder;
  int start[2];
  if (::pipe(start) != 0) throw std::runtime_error("no pipe");
  CpuClock own;
  for (std::uint32_t r = 0; r < cube.nodes(); ++r) {
    const pid_t pid = ::fork();
    if (pid < 0) throw std::runtime_error("no process");
    if (pid > 0) continue;
    ::close(start[1]);
    char none = 0;
    [[maybe_unused]] const auto ended = ::read(start[0], &none, 1);
    run_process(Rank{r}, cube, stage, folder);
    ::_exit(0);
  }
  double cpu_s = own.lap();
  long faults = 0;
  {
    ZmqContext context;
    Inbox hub(context, endpoint_of(folder, "hub"));
    ::close(start[1]);
    ::close(start[0]);
    if (stage != Stage::kForked) answer_all(hub, cube.nodes());
    if (stage == Stage::kLinks) answer_all(hub, cube.nodes());
  }
  for (std::uint32_t i = 0; i < cube.nodes(); ++i) {
    rusage usage{};
    int status = 0;
    if (::wait4(-1, &status, 0, &usage) < 0 || status != 0)
      throw std::runtime_error("a process failed");
    cpu_s += seconds_of(usage.ru_utime) + seconds_of(usage.ru_stime);
    faults += usage.ru_minflt;
  }
  std::printf("%4u processes, %-12s %6.2f ms of CPU and %4ld page faults each\n", cube.nodes(),
              name_of(stage).c_str(), 1e3 * cpu_s / cube.nodes(),
              faults / static_cast<long>(cube.nodes()));
  std::fflush(stdout);
}

Hypercube cube_of(std::string_view text) {
  std::uint32_t nodes = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), nodes);
  const auto cube = Hypercube::of_size(nodes);
  if (error != std::errc() || end != text.data() + text.size() || !cube) {
    throw std::runtime_error(std::string(text) + ": expected a power of two, 1 to " +
                             std::to_string(kMaxNodes));
  }
  return *cube;
}

}  // namespace
}  // namespace graycube::bench

int main(int argc, char** argv) {
  try {
    if (argc < 2) throw std::runtime_error("usage: bare_farm NODES…");
    for (int i = 1; i < argc; ++i) {
      const auto cube = graycube::bench::cube_of(argv[i]);
      using graycube::bench::Stage;
      for (const Stage stage : {Stage::kForked, Stage::kSockets, Stage::kLinks})
        graycube::bench::measure(cube, stage);
    }
  } catch (const std::exception& e) {
    std::fprintf(stderr, "bare_farm: %s\n", e.what());
    return 1;
  }
  return 0;
}
