#include "simulation/calibration.hpp"

#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <condition_variable>
#include <cstring>
#include <ctime>
#include <mutex>
#include <thread>
#include <vector>

#include "process/clocks.hpp"
#include "process/temporary_folder.hpp"
#include "simulation/farm.hpp"
#include "simulation/modelled_machine.hpp"
#include "transport/zmq_sockets.hpp"

namespace graycube::simulation {
namespace {

/// Sweeps the caches, as evaluators do between messages.
class Sweep {
 public:
  void operator()() {
    for (std::size_t i = 0; i < memory_.size(); i += kLine) ++memory_[i];
  }

 private:
  static constexpr std::size_t kBytes = std::size_t{1} << 20, kLine = 64;
  std::vector<unsigned char> memory_ = std::vector<unsigned char>(kBytes);
};

constexpr std::size_t kSmall = 128, kLarge = std::size_t{64} << 10;
constexpr int kRounds = 200, kTries = 3;

/// The other process: sends each message back, answers one of 8 bytes with its CPU seconds so far,
/// and ends when one of 1 byte comes.
void echo(const std::string& endpoint) {
  ZmqContext context;
  Inbox inbox(context, endpoint);
  Sweep sweep;
  for (;;) {
    Readable* const sockets[] = {&inbox};
    wait_readable(sockets, {}, std::chrono::seconds(1));
    while (auto m = inbox.receive()) {
      if (m->message.frame.size() == 1) return;
      sweep();
      Bytes answer(m->message.frame.begin(), m->message.frame.end());
      const double cpu_s = process_cpu_seconds();
      if (answer.size() == sizeof cpu_s) std::memcpy(answer.data(), &cpu_s, sizeof cpu_s);
      inbox.send(m->peer, Message::of_batch(std::move(answer)));
    }
  }
}

Message ask(Connection& connection, const Message& message) {
  connection.send(message);
  for (int i = 0; i < 10; ++i) {
    if (auto answer = connection.receive(std::chrono::seconds(1))) return *std::move(answer);
  }
  throw TransportError("a message to another process of this machine got no answer");
}

/// CPU seconds of both processes so far.
double all_cpu_seconds(Connection& connection) {
  double there_s = 0;
  const Message answer = ask(connection, Message::of_batch(Bytes(sizeof there_s)));
  std::memcpy(&there_s, answer.frame.data(), sizeof there_s);
  return there_s + process_cpu_seconds();
}

/// CPU seconds of both sides together for each message of that size, sweeps included. The least of
/// a few tries counts, since other processes use the machine too.
double seconds_per_message(Connection& connection, std::size_t bytes) {
  Sweep sweep;
  double least_s = 1;
  for (int t = 0; t < kTries; ++t) {
    const double began_s = all_cpu_seconds(connection);
    for (int i = 0; i < kRounds; ++i) {
      ask(connection, Message::of_batch(Bytes(bytes)));
      sweep();
    }
    least_s = std::min(least_s, (all_cpu_seconds(connection) - began_s) / (2.0 * kRounds));
  }
  return least_s;
}

double seconds_per_sweep() {
  Sweep sweep;
  sweep();
  const double began_s = process_cpu_seconds();
  for (int i = 0; i < kRounds; ++i) sweep();
  return (process_cpu_seconds() - began_s) / kRounds;
}

/// CPU seconds of one wakeup: one of two threads wakes the other and sleeps.
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

/// A process of its own that echoes messages; the destructor ends and reaps it.
class EchoProcess {
 public:
  explicit EchoProcess(const std::string& endpoint) : pid_(::fork()) {
    if (pid_ < 0) throw TransportError("no process can be started to exchange messages with");
    if (pid_ > 0) return;
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    try {
      echo(endpoint);
    } catch (const TransportError&) {
    }
    ::_exit(0);
  }
  ~EchoProcess() {
    ::kill(pid_, SIGKILL);
    while (::waitpid(pid_, nullptr, 0) < 0 && errno == EINTR) {
    }
  }
  EchoProcess(const EchoProcess&) = delete;
  EchoProcess& operator=(const EchoProcess&) = delete;

 private:
  pid_t pid_;
};

}  // namespace

double measuring_overhead_s() {
  constexpr int kReadings = 10000;
  const double began_s = thread_cpu_seconds();
  for (int i = 0; i < kReadings; ++i) thread_cpu_seconds();
  return (thread_cpu_seconds() - began_s) / kReadings;
}

PerUnit transport_costs() {
  const TemporaryFolder folder;
  const std::string endpoint = "ipc://" + (folder.path() / "echo").string();
  const EchoProcess other(endpoint);
  ZmqContext context;
  Connection connection(context, endpoint);
  const double sweep_s = seconds_per_sweep();
  const double small_s = seconds_per_message(connection, kSmall);
  const double large_s = seconds_per_message(connection, kLarge);
  PerUnit costs;
  costs[Unit::kMessage] = std::max(0.0, small_s - sweep_s) / 2;
  costs[Unit::kMessageByte] = std::max(0.0, (large_s - small_s) / (2.0 * (kLarge - kSmall)));
  costs[Unit::kWakeup] = seconds_per_wakeup(10 * kRounds);
  return costs;
}

PerUnit measured_costs(const std::string& scene_text, control::JobOptions options,
                       std::uint32_t nodes) {
  options.queue = kMaxQueue;
  // A process apart does no work but that of messages.
  options.fifo = FifoMode::kThread;
  options.timeout_s = 0;
  MachineFigures figures;
  // Costs of about the right size suffice: they only decide which messages meet.
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
