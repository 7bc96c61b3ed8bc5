// graycube-frontal: cuts scenes, hands them to its nodes, accumulates their light, serves clients.
#include <signal.h>
#include <sys/prctl.h>
#include <sys/signalfd.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <iostream>
#include <thread>

#include "frontal/doors.hpp"
#include "frontal/frontal.hpp"
#include "frontal/http_server.hpp"
#include "frontal/loop_watch.hpp"
#include "frontal/parts/patience.hpp"
#include "frontal/preparation_thread.hpp"
#include "frontal/slurm/engine.hpp"
#include "frontal/store/checkpoint_store.hpp"
#include "frontal/store/database_store.hpp"
#include "frontal/writing_thread.hpp"
#include "host/node_processes.hpp"
#include "memory/kept_heap.hpp"
#include "process/clocks.hpp"
#include "process/descriptors.hpp"
#include "process/log_thread.hpp"
#include "process/process_state.hpp"
#include "process/temporary_folder.hpp"
#include "transport/endpoint.hpp"
#include "transport/farm_key.hpp"
#include "transport/secret.hpp"
#include "transport/zmq_sockets.hpp"
#include "version.hpp"

namespace graycube {
namespace {

namespace fs = std::filesystem;

struct FrontalArguments {
  std::uint32_t nodes = 1, threads = 1;
  std::string listen, state, http, key, log;
  /// Hosts run the nodes: those that join, and those of an allocation of Slurm, which get so many
  /// each.
  bool is_joined = false;
  std::string slurm;
  std::uint32_t slots = 1;
  /// An earlier frontal of this farm has died.
  bool is_again = false;
  KeepRule keep;
  /// Of a private frontal: where tiles are recorded, and the digest of what decides the picture.
  std::string checkpoint;
  std::uint64_t picture_content = 0;
  bool is_private = false, ends_jobs = false, is_quiet = false;
  /// 0 for what is usual.
  double silence_s = 0;
  std::uint32_t retries = kDefaultRetries;
  FlowLimits limits{};
};

/// Bytes of the frontal's heap that lie in large pages as they are needed, for slices, the picture
/// and light that waits.
constexpr std::size_t kLargeHeap = std::size_t{256} << 20;
/// Nodes that don't leave within so many seconds after `shutdown` are killed.
constexpr double kGrace_s = 2;
constexpr auto kTick = std::chrono::milliseconds(50);
/// Open files and sockets of a frontal beside those that lead to nodes, clients and browsers; and
/// of a node, in the largest hypercube.
constexpr std::uint32_t kOwnDescriptors = 64, kNodeDescriptors = 64;

Moment this_moment() { return {seconds_of(CLOCK_MONOTONIC), seconds_of(CLOCK_REALTIME)}; }

double silence_of(const FrontalArguments& a) {
  if (a.silence_s > 0) return a.silence_s;
  // Hosts tell by themselves whether nodes only wait for a core.
  return a.is_joined ? kSilence_s : usual_silence_s(a.nodes, std::thread::hardware_concurrency());
}

/// A descriptor of the signals that ask for the end, and of SIGCHLD, which wakes the loop.
int signal_descriptor() {
  sigset_t set;
  ::sigemptyset(&set);
  for (const int s : {SIGINT, SIGTERM, SIGHUP, SIGCHLD}) ::sigaddset(&set, s);
  ::pthread_sigmask(SIG_BLOCK, &set, nullptr);
  return ::signalfd(-1, &set, SFD_NONBLOCK | SFD_CLOEXEC);
}

class FrontalProcess {
 public:
  FrontalProcess(const FrontalArguments& a, int signals)
      : signals_(signals),
        log_(a.log,
             "frontal: process " + std::to_string(::getpid()) + " begins, Graycube " + kVersion),
        shows_all_(!a.is_private && !a.is_quiet),
        shows_trouble_(!a.is_private),
        threads_(a.threads),
        is_joined_(a.is_joined),
        doors_({.folder = folder_.path(),
                .listen = a.is_private && !a.is_joined ? "" : a.listen,
                .key_file = a.key,
                .others = static_cast<int>(kOwnDescriptors + a.nodes + kMaxHttpConnections),
                .address_for_nodes = a.is_joined ? tcp_host_of(a.listen) : ""}),
        secret_(doors_.keys() ? doors_.keys()->node_secret : make_secret()),
        store_(make_store(a)),
        processes_(own_folder() / "graycube-node", folder_.path(), secret_),
        frontal_({.cube = *Hypercube::of_size(a.nodes),
                  .most_nodes_on_hosts = a.is_joined ? std::optional(a.nodes) : std::nullopt,
                  .nodes_port = doors_.port_for_far_nodes(),
                  .threads = a.threads,
                  .heartbeat_s = ping_interval_s(silence_of(a)),
                  .silence_s = silence_of(a),
                  .start_patience_s = start_patience_s(a.nodes),
                  .is_only_slow = [](std::uint64_t pid) { return can_run(static_cast<long>(pid)); },
                  .standstill_s = standstill_s(silence_of(a)),
                  .retries = a.retries,
                  .version = kVersion,
                  .limits = a.limits,
                  .is_private = a.is_private,
                  .keeps_jobs = !a.state.empty() && !a.ends_jobs,
                  .records_tiles = store_->records_tiles(),
                  .picture_content = a.picture_content,
                  .endpoint = doors_.for_clients(),
                  .pid = static_cast<std::uint64_t>(::getpid()),
                  .started_s = seconds_of(CLOCK_REALTIME),
                  .secret = secret_,
                  .node_folder = folder_.path().string()},
                 *store_),
        preparation_(wakeup_),
        writing_thread_(wakeup_) {
    frontal_.set_cpu_meter({[this] { return process_cpu_seconds() + processes_.start_cpu_s(); },
                            [this] { return own_start_cpu_s_ + processes_.start_cpu_s(); }});
    if (!a.slurm.empty()) begin_steps(a);
    if (!a.http.empty()) {
      const std::string token = hex_of(make_secret());
      http_.emplace(a.http, token, folder_.path(), desk_);
      std::cout << "page " << http_->url() << std::endl << "token " << token << std::endl;
    }
    std::cout << "folder " << folder_.path().string() << std::endl;
    if (!doors_.key_file().empty()) std::cout << "key " << doors_.key_file() << std::endl;
    std::cout << "listening " << doors_.for_clients() << std::endl;
    own_start_cpu_s_ = process_cpu_seconds();
  }

  /// Runs until the farm is down; returns why it gave up, or nothing.
  std::string run() {
    double down_since_s = 0;
    for (;;) {
      const Moment now = this_moment();
      loop_watch_.begin(now.now_s);
      frontal_.on_time(now);
      take_events();
      if (frontal_.is_going_down()) {
        if (down_since_s == 0) down_since_s = now.now_s;
        const bool have_nodes_ended = is_joined_ ? frontal_.all_nodes_left() : processes_.empty();
        const bool is_over = have_nodes_ended || now.now_s - down_since_s > kGrace_s;
        if (is_over && !frontal_.is_keeping() && !frontal_.is_admitting())
          return frontal_.fatal_error();
      }
      const auto sockets = doors_.sockets();
      const int descriptors[] = {wakeup_.descriptor(), signals_};
      const std::string held_up = loop_watch_.end(seconds_of(CLOCK_MONOTONIC));
      if (!held_up.empty()) frontal_.process_tells(held_up, true);
      frontal_.had_a_turn(loop_watch_.last_turn_s());
      wait_readable(sockets, descriptors, kTick);
      wakeup_.clear();
    }
  }

 private:
  static fs::path own_folder() { return fs::read_symlink("/proc/self/exe").parent_path(); }

  void begin_steps(const FrontalArguments& a) {
    slurm_.emplace(*slurm::hosts_of(a.slurm),
                   slurm::StepSetting{(own_folder() / "graycube").string(), doors_.for_clients(),
                                      text_of_farm_key(read_farm_key(doors_.key_file())), a.slots},
                   a.is_again, seconds_of(CLOCK_MONOTONIC));
  }

  std::unique_ptr<JobStore> make_store(const FrontalArguments& a) {
    // A private farm's command has its own terminal: all that it should hear of there is this.
    const auto warn = [this](const std::string& sentence) {
      log_.write(seconds_of(CLOCK_REALTIME), "job store: " + sentence, true);
    };
    if (!a.checkpoint.empty()) return make_checkpoint_store(a.checkpoint, warn);
    if (a.is_private) return make_memory_store();
    const fs::path folder = a.state.empty() ? folder_.path() / "jobs" : fs::path(a.state);
    return open_database_store(folder, {a.keep, a.state.empty() || a.ends_jobs}, warn);
  }

  void take_events() {
    take_signals();
    if (slurm_) {
      const double now_s = seconds_of(CLOCK_MONOTONIC);
      for (const std::string& told : slurm_->work(frontal_.host_names(), now_s))
        frontal_.process_tells(told, true);
    }
    for (const NodeExit& e : take_exits()) {
      const Frontal::Process process{e.node.rank, e.node.incarnation};
      e.was_started ? frontal_.on_node_exit(process, e.how)
                    : frontal_.on_start_failure(process, e.how);
    }
    if (auto result = preparation_.take())
      std::visit([this](auto& r) { frontal_.give_result(std::move(r)); }, *result);
    for (const TurnedAway& refusal : doors_.take_refusals()) frontal_.turned_away(refusal);
    if (const std::uint64_t refused = Doors::take_crowded_out())
      frontal_.crowded_out(refused, kMaxClientConnections);
    while (auto m = doors_.receive()) {
      frontal_.on_time(this_moment());
      m->is_host ? frontal_.on_host_message(m->peer, m->message)
                 : frontal_.on_message(m->peer, m->message);
      flush();
    }
    for (const HttpDesk::Question& q : desk_.take()) {
      frontal_.on_message(HttpDesk::peer_of(q.number), q.message);
      flush();
    }
    work_aside();
    preparation_.work_only_for(frontal_.job_that_is_on());
    if (preparation_.is_free()) {
      if (auto work = frontal_.take_work()) {
        preparation_.give(std::move(*work));
      } else if (auto recut = frontal_.take_recut()) {
        preparation_.give(std::move(*recut));
      }
    }
    flush();
  }

  /// Where hosts run the nodes, this process's children are none.
  std::vector<NodeExit> take_exits() {
    return is_joined_ ? std::vector<NodeExit>() : processes_.reap();
  }

  /// Hands pictures, and scenes that are long, to the thread that writes and reads them.
  void work_aside() {
    if (auto result = writing_thread_.take())
      std::visit([this](auto& r) { frontal_.give_result(std::move(r)); }, *result);
    if (!writing_thread_.is_free()) return;
    if (auto work = frontal_.take_keeping()) {
      writing_thread_.give(*std::move(work));
    } else if (auto admission = frontal_.take_admission()) {
      writing_thread_.give(*std::move(admission));
    } else if (auto writing = frontal_.take_writing()) {
      writing_thread_.give(*std::move(writing));
    } else if (auto reading = frontal_.take_reading()) {
      writing_thread_.give(*reading);
    }
  }

  void take_signals() {
    signalfd_siginfo info{};
    while (::read(signals_, &info, sizeof info) == sizeof info) {
      if (info.ssi_signo != SIGCHLD) frontal_.go_down();
    }
  }

  void send(Frontal::Outgoing& o) {
    if (const auto number = HttpDesk::number_of(o.to)) {
      if (http_) http_->answer(*number, std::move(o.message));
    } else {
      doors_.send(o.to, std::move(o.message));
    }
  }

  void flush() {
    for (const FarmEvent& e : frontal_.take_events())
      log_.write(e.unix_s, e.text, shows_all_ || (shows_trouble_ && e.is_trouble));
    for (Frontal::Outgoing& o : frontal_.take_outgoing()) send(o);
    for (const Frontal::Process& k : frontal_.take_kills()) processes_.end({k.rank, k.incarnation});
    if (frontal_.is_going_down()) return;
    std::vector<NodeStart> starts;
    for (const Frontal::Process& s : frontal_.take_starts())
      starts.push_back({s.rank, s.incarnation});
    processes_.start(starts, {doors_.for_nodes(), threads_}, this_moment().now_s);
    for (const auto& [guest, host] : frontal_.take_hostings())
      processes_.host({guest.rank, guest.incarnation}, {host.rank, host.incarnation});
  }

  int signals_;
  LogThread log_;
  bool shows_all_, shows_trouble_;
  double own_start_cpu_s_ = 0;
  std::uint32_t threads_;
  bool is_joined_;
  TemporaryFolder folder_;
  Wakeup wakeup_;
  HttpDesk desk_{wakeup_};
  Doors doors_;
  Secret secret_;
  std::unique_ptr<JobStore> store_;
  NodeProcesses processes_;
  Frontal frontal_;
  PreparationThread preparation_;
  WritingThread writing_thread_;
  std::optional<slurm::Engine> slurm_;
  std::optional<HttpServer> http_;
  LoopWatch loop_watch_;
};

/// Why a farm of so many nodes can't run with so many open files for each process.
std::optional<std::string> descriptor_problem(std::uint32_t nodes, std::uint64_t limit) {
  const std::uint32_t needed = std::max(kOwnDescriptors + nodes, kNodeDescriptors);
  if (limit >= needed) return std::nullopt;
  return std::to_string(nodes) + " nodes need " + std::to_string(needed) +
         " open files and sockets, and the system lets a process have " + std::to_string(limit) +
         " (ulimit -Hn)";
}

int fail(const std::string& what, const std::string& why, int status) {
  std::fprintf(stderr, "graycube-frontal: %s: %s\n", what.c_str(), why.c_str());
  return status;
}

int run_main(int argc, char** argv) {
  CLI::App app{"The frontal daemon of a Graycube farm."};
  app.set_version_flag("--version", std::string("graycube-frontal ") + kVersion);
  FrontalArguments a;
  app.add_option("--nodes", a.nodes, "Node processes: a power of two")->required();
  app.add_option("--threads", a.threads, "Evaluator threads per node")
      ->check(CLI::Range(1u, kMaxThreads));
  app.add_option("--listen", a.listen, "Endpoint for clients");
  app.add_option("--key", a.key, "File of the key that clients at a TCP port must show");
  app.add_option("--state", a.state, "Folder in which pictures and jobs are kept");
  app.add_option("--log", a.log, "File to which it is appended what happens");
  app.add_flag("--quiet", a.is_quiet, "Show only what goes wrong on standard error");
  app.add_flag(
      "--ends-jobs", a.ends_jobs,
      "Cancel jobs that have not ended when the farm stops, instead of keeping them there");
  app.add_option("--checkpoint", a.checkpoint, "With --private: a file for tiles that are whole");
  app.add_option("--picture", a.picture_content, "With --checkpoint: a digest of the picture");
  std::string keep;
  app.add_option("--keep", keep, "Ended jobs to keep there: the newest N, or those of DAYSd");
  app.add_option("--silence", a.silence_s, "Seconds until a silent node is taken for dead")
      ->check(CLI::Range(0.1, 3600.0));
  app.add_option("--retries", a.retries, "Losses at which a part of the picture may be under way")
      ->check(CLI::Range(0u, kMaxRetries));
  app.add_option("--outbox-rays", a.limits.outbox_rays, "Rays to be sent that a node may hold")
      ->check(CLI::PositiveNumber);
  app.add_option("--http", a.http, "HOST:PORT for the farm's web page, HOST a loopback address");
  app.add_flag("--joined", a.is_joined, "Hosts that join run the nodes");
  app.add_option("--slurm", a.slurm, "With --joined: the hosts of an allocation, HOST:CPUS,...");
  app.add_option("--slots", a.slots, "With --slurm: nodes of each host")
      ->check(CLI::Range(1u, kMaxNodes));
  app.add_flag("--again", a.is_again, "An earlier frontal of this farm has died");
  app.add_flag("--private", a.is_private,
               "Serve the process that started this one, and end with it");
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& e) {
    return app.exit(e);
  } catch (const CLI::ParseError& e) {
    return fail("usage: command line", e.what(), 2);
  }
  if (!Hypercube::of_size(a.nodes)) {
    return fail("usage: --nodes", "expected a power of two, 1 to " + std::to_string(kMaxNodes), 2);
  }
  if (!keep.empty()) {
    const auto rule = parse_keep_rule(keep);
    if (!rule) return fail("usage: --keep " + keep, kKeepRuleText, 2);
    a.keep = *rule;
  }
  if (a.listen.empty()) a.listen = default_endpoint();
  if (const auto problem = endpoint_problem(a.listen, !a.key.empty() || a.is_joined))
    return fail("usage: --listen", *problem, 2);
  if (a.is_joined && !a.listen.starts_with("tcp://"))
    return fail("usage: --joined", "hosts join at a TCP port: --listen tcp://ADDRESS:PORT", 2);
  if (!a.slurm.empty() && (!a.is_joined || !slurm::hosts_of(a.slurm)))
    return fail("usage: --slurm " + a.slurm, "expected HOST:CPUS,..., with --joined", 2);
  if (!a.http.empty()) {
    if (const auto problem = endpoint_problem("tcp://" + a.http)) {
      return fail("usage: --http", *problem, 2);
    }
  }
  if (const auto problem = descriptor_problem(a.nodes, raise_descriptor_limit()))
    return fail("farm", *problem, 1);
  const int signals = signal_descriptor();
  if (a.is_private) ::prctl(PR_SET_PDEATHSIG, SIGTERM);
  keep_freed_memory(1, kLargeHeap);
  try {
    const std::string error = FrontalProcess(a, signals).run();
    if (!error.empty()) return fail("farm", error, 1);
  } catch (const std::runtime_error& e) {
    return fail("frontal", e.what(), 1);
  }
  return 0;
}

}  // namespace
}  // namespace graycube

int main(int argc, char** argv) { return graycube::run_main(argc, argv); }
