#include "host/node_processes.hpp"

#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <sstream>
#include <system_error>
#include <utility>

#include "process/clocks.hpp"
#include "process/process_state.hpp"
#include "process/spawn_plan.hpp"

namespace graycube {
namespace {

/// Without descriptors, processes or memory, starting is tried so often, with so long a pause.
constexpr unsigned kStartTries = 5;
constexpr double kStartPause_s = 0.3;

class Pipe {
 public:
  Pipe() {
    if (::pipe2(ends_.data(), O_CLOEXEC) != 0)
      throw std::system_error(errno, std::generic_category(), "pipe");
  }
  ~Pipe() {
    ::close(ends_[0]);
    close_writing_end();
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;
  int reading_end() const { return ends_[0]; }
  int writing_end() const { return ends_[1]; }
  void close_writing_end() {
    if (ends_[1] >= 0) ::close(std::exchange(ends_[1], -1));
  }

 private:
  std::array<int, 2> ends_{};
};

/// Moves a descriptor that the child must not get for another one: copies are made in an order in
/// which the child's number may already be one of these.
int beyond_inherited(int descriptor) {
  const int moved = ::fcntl(descriptor, F_DUPFD_CLOEXEC, kSecretDescriptor + 1);
  const int error = errno;
  ::close(descriptor);
  if (moved < 0) throw std::system_error(error, std::generic_category(), "the farm's secret");
  return moved;
}

class SecretFile {
 public:
  explicit SecretFile(const Secret& secret)
      : descriptor_(beyond_inherited(make_secret_file(secret))) {}
  ~SecretFile() { ::close(descriptor_); }
  SecretFile(const SecretFile&) = delete;
  SecretFile& operator=(const SecretFile&) = delete;
  int descriptor() const { return descriptor_; }

 private:
  int descriptor_;
};

/// Reads all that comes out of a pipe until its other end is closed.
std::string all_of(int pipe) {
  std::string text;
  std::array<char, 4096> part;
  for (;;) {
    const ssize_t got = ::read(pipe, part.data(), part.size());
    if (got > 0) text.append(part.data(), static_cast<std::size_t>(got));
    if (got == 0 || (got < 0 && errno != EINTR)) return text;
  }
}

/// Runs a program to its end and returns what it wrote. Its CPU time is added to `cpu_s`. Its
/// standard input, and that of processes it leaves behind, ends when it has ended. They inherit the
/// secret. Throws std::system_error when it can't be started.
std::string output_of(const std::vector<std::string>& command, const Secret& secret,
                      double& cpu_s) {
  Pipe input, output;
  const SecretFile secret_file(secret);
  SpawnPlan plan;
  plan.pass_as(STDIN_FILENO, input.reading_end());
  plan.pass_as(STDOUT_FILENO, output.writing_end());
  plan.pass_as(kSecretDescriptor, secret_file.descriptor());
  plan.handle_all_as_usual();
  plan.block_no_signals();
  pid_t pid = 0;
  // All symbols, those of libraries too, are looked up before anything is forked.
  const int error = plan.spawn(pid, command, {"LD_BIND_NOW=1"});
  output.close_writing_end();
  if (error != 0) throw std::system_error(error, std::generic_category(), command.front());
  std::string text = all_of(output.reading_end());
  rusage usage{};
  while (::wait4(pid, nullptr, 0, &usage) == -1 && errno == EINTR) {
  }
  cpu_s += seconds_of(usage.ru_utime) + seconds_of(usage.ru_stime);
  return text;
}

}  // namespace

NodeProcesses::NodeProcesses(std::filesystem::path program, std::filesystem::path folder,
                             const Secret& secret)
    : program_(std::move(program)), folder_(std::move(folder)), secret_(secret) {
  // The nodes' own parent ends at once: they become children of this process.
  ::prctl(PR_SET_CHILD_SUBREAPER, 1);
}

NodeProcesses::~NodeProcesses() {
  for (const auto& [pid, child] : running_) ::kill(pid, SIGKILL);
  for (const auto& [pid, child] : running_) ::waitpid(pid, nullptr, 0);
}

void NodeProcesses::start(std::span<const NodeStart> nodes, const NodeSetting& setting,
                          double now_s) {
  for (const NodeStart& node : nodes) {
    std::erase_if(waiting_, [&](const Waiting& w) { return w.node.rank == node.rank; });
    waiting_.push_back({node, 0});
  }
  if (waiting_.empty() || (nodes.empty() && now_s < next_try_s_)) return;
  next_try_s_ = now_s + kStartPause_s;
  std::string why;
  try {
    start_waiting(setting, why);
  } catch (const std::system_error& e) {
    why = e.what();
  }
  for (Waiting& w : waiting_) {
    if (++w.tries < kStartTries) continue;
    without_process_.push_back({w.node, why, false});
  }
  std::erase_if(waiting_, [](const Waiting& w) { return w.tries >= kStartTries; });
}

/// Those that start wait no longer; `why` tells why others didn't. Throws std::system_error when
/// none can be.
void NodeProcesses::start_waiting(const NodeSetting& setting, std::string& why) {
  std::vector<std::string> command{
      program_.string(), "--threads",     std::to_string(setting.threads),
      "--frontal",       setting.frontal, "--folder",
      folder_.string()};
  if (!setting.address.empty()) command.insert(command.end(), {"--address", setting.address});
  for (const Waiting& w : waiting_) {
    command.insert(command.end(), {"--rank", std::to_string(w.node.rank.value), "--incarnation",
                                   std::to_string(w.node.incarnation)});
  }
  std::istringstream pids(output_of(command, secret_, start_cpu_s_));
  std::size_t started = 0;
  for (pid_t pid = 0; started < waiting_.size() && pids >> pid; ++started)
    running_[pid] = {waiting_[started].node};
  waiting_.erase(waiting_.begin(), waiting_.begin() + static_cast<std::ptrdiff_t>(started));
  pids.clear();
  std::getline(pids >> std::ws, why);
  if (why.empty()) why = program_.string() + " ended";
}

std::map<pid_t, NodeProcesses::Nodes>::iterator NodeProcesses::process_of(const NodeStart& node) {
  return std::ranges::find_if(
      running_, [&](const auto& process) { return std::ranges::count(process.second, node) > 0; });
}

void NodeProcesses::host(const NodeStart& guest, const NodeStart& host) {
  const auto process = process_of(host);
  if (process != running_.end()) return process->second.push_back(guest);
  without_process_.push_back({guest, "its host has ended"});
}

void NodeProcesses::end(const NodeStart& node) {
  const auto process = process_of(node);
  if (process != running_.end()) ::kill(process->first, SIGKILL);
}

void NodeProcesses::end_all() {
  waiting_.clear();
  for (const auto& [pid, nodes] : running_) ::kill(pid, SIGKILL);
}

std::vector<std::uint32_t> NodeProcesses::stopped() const {
  std::vector<std::uint32_t> ranks;
  for (const auto& [pid, nodes] : running_) {
    if (can_run(pid)) continue;
    for (const NodeStart& node : nodes) ranks.push_back(node.rank.value);
  }
  return ranks;
}

std::vector<NodeExit> NodeProcesses::reap() {
  std::vector<NodeExit> exits = std::exchange(without_process_, {});
  for (;;) {
    // Nodes are the only children here. If each were asked for by its id, every message would cost
    // as many calls as there are nodes.
    int status = 0;
    const pid_t pid = ::waitpid(-1, &status, WNOHANG);
    if (pid <= 0) return exits;
    const auto child = running_.find(pid);
    if (child == running_.end()) continue;
    for (const NodeStart& node : child->second) exits.push_back({node, how_it_ended(status)});
    running_.erase(child);
  }
}

}  // namespace graycube
