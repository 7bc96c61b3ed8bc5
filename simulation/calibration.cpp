#include "simulation/calibration.hpp"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <ctime>
#include <mutex>
#include <thread>
#include <vector>

#include "simulation/farm.hpp"
#include "simulation/modelled_machine.hpp"
#include "simulation/thread_clock.hpp"
#include "transport/temporary_folder.hpp"
#include "transport/zmq_sockets.hpp"

namespace graycube::simulation {
namespace {

double process_cpu_seconds() {
  timespec t{};
  ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

/// Sends back whatever comes until a message of one byte does.
void echo(Inbox& inbox) {
  for (;;) {
    void* const sockets[] = {inbox.raw()};
    wait_readable(sockets, {}, std::chrono::seconds(1));
    while (auto m = inbox.receive()) {
      if (m->message.frame.size() == 1) return;
      inbox.send(m->peer, m->message);
    }
  }
}

/// CPU seconds of both sides together for each message of that size, there and back one at a time. So many
/// different ones are sent that they are not in a cache.
double seconds_per_message(Connection& connection, std::size_t bytes, int rounds) {
  constexpr std::size_t kMessages = 128;
  const std::vector<Message> messages(kMessages, Message::of_batch(Bytes(bytes)));
  const double began_s = process_cpu_seconds();
  for (int i = 0; i < rounds; ++i) {
    connection.send(messages[static_cast<std::size_t>(i) % kMessages]);
    while (!connection.receive(std::chrono::seconds(1))) {
    }
  }
  return (process_cpu_seconds() - began_s) / (2.0 * rounds);
}

/// CPU seconds for each time that one of two threads wakes the other and sleeps.
double seconds_per_wakeup(int rounds) {
  std::mutex mutex;
  std::condition_variable changed;
  int turn = 0;
  const auto play = [&](int own) {
    std::unique_lock lock(mutex);
    for (int i = 0; i < rounds; ++i) {
      changed.wait(lock, [&] { return turn == own; });
      turn = 1 - own;
      changed.notify_all();
    }
  };
  const double began_s = process_cpu_seconds();
  std::thread other(play, 1);
  play(0);
  other.join();
  return (process_cpu_seconds() - began_s) / (2.0 * rounds);
}

}  // namespace

double measuring_overhead_s() {
  constexpr int kRounds = 10000;
  const double began_s = thread_cpu_seconds();
  for (int i = 0; i < kRounds; ++i) thread_cpu_seconds();
  return (thread_cpu_seconds() - began_s) / kRounds;
}

PerUnit transport_costs() {
  constexpr int kTries = 5;
  constexpr std::size_t kSmall = 128, kLarge = std::size_t{64} << 10;
  constexpr int kRounds = 200;
  const TemporaryFolder folder;
  ZmqContext here, there;
  Inbox inbox(there, "ipc://" + (folder.path() / "echo").string());
  std::thread far([&] { echo(inbox); });
  PerUnit costs;
  {
    Connection connection(here, inbox.endpoint());
    // The least of a few, since others use the machine too.
    const auto least_s = [&](std::size_t bytes) {
      double least = seconds_per_message(connection, bytes, kRounds);
      for (int i = 1; i < kTries; ++i) {
        least = std::min(least, seconds_per_message(connection, bytes, kRounds));
      }
      return least;
    };
    const double small_s = least_s(kSmall), large_s = least_s(kLarge);
    costs[Unit::kMessageByte] = std::max(0.0, (large_s - small_s) / (2.0 * (kLarge - kSmall)));
    costs[Unit::kMessage] = small_s / 2;
    costs[Unit::kWakeup] = seconds_per_wakeup(10 * kRounds);
    connection.send(Message::of_batch(Bytes(1)));
    far.join();
  }
  return costs;
}

PerUnit measured_costs(const std::string& scene_text, control::JobOptions options,
                       std::uint32_t nodes) {
  options.queue = kMaxQueue;
  options.timeout_s = 0;
  MachineFigures figures;
  // Any costs of about the right size do: they only decide which messages meet.
  for (double& cost : figures.costs.value) cost = 1e-7;
  ModelledMachine machine(figures);
  Farm farm({.nodes = nodes, .threads = 1, .stalled_s = 1e6}, machine);
  farm.render(scene_text, options);  // memory is fresh: the first time takes longer
  CostFit fit(measuring_overhead_s());
  farm.observe = [&](const PerUnit& doings, double seconds) { fit.add(doings, seconds); };
  farm.render(scene_text, options);
  return fit.costs();
}

}  // namespace graycube::simulation
