// graycube-node: one corner of the hypercube. The main thread is the mailroom: it owns every
// socket.
#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "geometry/simd.hpp"
#include "memory/kept_heap.hpp"
#include "node/evaluator_pool.hpp"
#include "node/fifo_process.hpp"
#include "node/node.hpp"
#include "node/parts/neighbour_door.hpp"
#include "process/descriptors.hpp"
#include "transport/endpoint.hpp"
#include "transport/secret.hpp"
#include "version.hpp"

namespace graycube {
namespace {

/// Bytes of a node's heap that lie in large pages as they are needed: most nodes need one or two.
constexpr std::size_t kLargeHeap = std::size_t{64} << 20;

struct NodeArguments {
  std::vector<std::uint32_t> ranks, incarnations;
  std::uint32_t threads = 1;
  std::string frontal, folder;
  /// What the farm's own processes know.
  Secret secret{};
};

std::string inbox_of(const NodeArguments& a, std::size_t number) {
  return "ipc://" + a.folder + "/node-" + std::to_string(a.ranks[number]);
}

/// A program that lies beside this one.
std::filesystem::path program_beside(const char* name) {
  return std::filesystem::read_symlink("/proc/self/exe").parent_path() / name;
}

class Mailroom {
 public:
  /// Opens the sockets of the node whose place in the arguments is `number`.
  Mailroom(const NodeArguments& a, std::size_t number)
      : inbox_(context_, inbox_of(a, number)),
        frontal_(context_, a.frontal),
        rank_{a.ranks[number]},
        node_({rank_, a.incarnations[number], static_cast<std::uint64_t>(::getpid()),
               inbox_.endpoint(), a.threads, kVersion}),
        pool_(node_, wakeup_),
        door_(rank_, a.secret),
        fifo_(program_beside("graycube-fifo")) {
    node_.measure = [this, measure = std::move(node_.measure)](control::NodeStats& stats) {
      measure(stats);
      stats.fifo_cpu_s = fifo_.cpu_s();
      stats.cpu_s += stats.fifo_cpu_s;
    };
    Message hello = node_.hello();
    hello.payload = Bytes(a.secret.begin(), a.secret.end());
    frontal_.send(std::move(hello));
  }

  void run() {
    for (;;) {
      const int descriptors[] = {wakeup_.descriptor(), fifo_.descriptor()};
      wait_readable(sockets_, descriptors, std::chrono::seconds(1));
      wakeup_.clear();
      const bool ended = pool_.with_node([&] {
        take_mail();
        outgoing_ = node_.take_outgoing();
        for_fifo_ = node_.take_for_fifo();
        fifo_order_ = node_.fifo_order();
        return node_.is_shut_down();
      });
      // Outside the lock: evaluators never wait for a socket.
      for (Node::Outgoing& o : outgoing_) send(o);
      if (ended) return;
      serve_fifo();
    }
  }

 private:
  void take_mail() {
    while (auto m = inbox_.receive()) {
      if (door_.lets_in(m->peer, m->message)) node_.on_neighbour(m->message.frame);
    }
    for (auto& [to, link] : links_) {
      while (const auto m = link.receive_view()) node_.on_neighbour(m->frame);
    }
    fifo_.receive([this](std::span<const std::byte> ray) { node_.on_fifo(ray); });
    if (auto why = fifo_.take_failure()) node_.on_fifo_end(*std::move(why));
    while (auto m = frontal_.receive()) node_.on_frontal(*m);
  }

  void serve_fifo() {
    if (!fifo_.serve(fifo_order_)) wakeup_.signal();
    fifo_.send(for_fifo_);
  }

  void send(Node::Outgoing& o) {
    if (!o.to) return frontal_.send(std::move(o.message));
    if (!connects_to(rank_, *o.to)) {
      // Whoever has not greeted yet has not begun any job either.
      const std::string* const peer = door_.connection_to(*o.to);
      if (peer != nullptr) inbox_.send(*peer, std::move(o.message));
      return;
    }
    auto link = links_.find(*o.to);
    if (link == links_.end()) {
      link = links_.emplace(*o.to, Connection(context_, node_.endpoints()[o.to->value])).first;
      sockets_.push_back(&link->second);
    }
    door_.sign(o.message);
    link->second.send(std::move(o.message));
  }

  ZmqContext context_;
  Wakeup wakeup_;
  Inbox inbox_;
  Connection frontal_;
  /// Connections to the neighbours that this node connects to.
  std::map<Rank, Connection> links_;
  std::vector<Readable*> sockets_{&inbox_, &frontal_};
  Rank rank_;
  Node node_;
  EvaluatorPool pool_;
  NeighbourDoor door_;
  FifoProcess fifo_;
  std::vector<Node::Outgoing> outgoing_;
  std::vector<Bytes> for_fifo_;
  std::optional<FifoOrder> fifo_order_;
};

int fail(const std::string& what, const std::string& where, const std::string& why, int status) {
  std::fprintf(stderr, "graycube-node: %s: %s: %s\n", what.c_str(), where.c_str(), why.c_str());
  return status;
}

int run_node(const NodeArguments& a, std::size_t number) {
  // A terminal's Ctrl-C is for the command, which stops its nodes in order.
  ::signal(SIGINT, SIG_IGN);
  keep_freed_memory(a.threads, kLargeHeap);
  try {
    Mailroom mailroom(a, number);
    mailroom.run();
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
    // The system takes back what a process has, threads and sockets above all, for less than it
    // takes to give it up. Should the last goodbye not have left, the frontal sees the process end.
    ::_exit(0);
#endif
  } catch (const TransportError& e) {
    return fail("node " + std::to_string(a.ranks[number]), "transport", e.what(), 1);
  }
  return 0;
}

/// Runs a node in a process just forked, once its parent has ended and the frontal has become its
/// parent: then the frontal closes standard input.
int become_node(const NodeArguments& a, std::size_t number, pid_t frontal) {
  char none = 0;
  while (::read(STDIN_FILENO, &none, 1) == -1 && errno == EINTR) {
  }
  // A node never outlives its frontal.
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != frontal) return 1;
  return run_node(a, number);
}

/// Forks a process for each node, writes their ids and ends: all that loading and linking took is
/// done once, and the nodes are children of the frontal (a subreaper) like any others.
int fork_nodes(const NodeArguments& a) {
  // Its first context makes ZeroMQ look for the system's protocols, in dozens of files. It starts
  // no thread, and is kept: while there is one, no other looks again.
  const ZmqContext first;
  const pid_t frontal = ::getppid();
  std::string pids;
  for (std::size_t number = 0; number < a.ranks.size(); ++number) {
    const pid_t pid = ::fork();
    if (pid < 0) {
      // The frontal reads why there are no more.
      pids += std::string(std::strerror(errno)) + '\n';
      break;
    }
    if (pid == 0) {
      // The frontal waits for the end of standard output, so the nodes must not keep it open.
      const int nowhere = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
      ::dup2(nowhere, STDOUT_FILENO);
      ::close(nowhere);
      return become_node(a, number, frontal);
    }
    pids += std::to_string(pid) + '\n';
  }
  std::fputs(pids.c_str(), stdout);
  return 0;
}

int run_main(int argc, char** argv) {
  CLI::App app{"Nodes of a Graycube farm; started by graycube-frontal."};
  app.set_version_flag("--version", std::string("graycube-node ") + kVersion);
  NodeArguments a;
  app.add_option("--rank", a.ranks, "Of each node")
      ->required()
      ->check(CLI::Range(0u, kMaxNodes - 1));
  app.add_option("--incarnation", a.incarnations, "Of each node")->required();
  app.add_option("--threads", a.threads)->check(CLI::Range(1u, kMaxThreads));
  app.add_option("--frontal", a.frontal, "The frontal's endpoint")->required();
  app.add_option("--folder", a.folder, "Where nodes listen for their neighbours")->required();
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& e) {
    return app.exit(e);
  } catch (const CLI::ParseError& e) {
    return fail("usage", "command line", e.what(), 2);
  }
  if (a.ranks.size() != a.incarnations.size()) {
    return fail("usage", "--incarnation", "expected one for each --rank", 2);
  }
  if (const auto problem = endpoint_problem(a.frontal))
    return fail("usage", a.frontal, *problem, 2);
  for (std::size_t number = 0; number < a.ranks.size(); ++number) {
    const std::string inbox = inbox_of(a, number);
    if (const auto problem = endpoint_problem(inbox)) return fail("usage", inbox, *problem, 2);
  }
  if (const auto problem = choose_simd_from_environment()) {
    return fail("environment", "GRAYCUBE_SIMD", *problem, 2);
  }
  const auto secret = take_secret(kSecretDescriptor);
  if (!secret) return fail("usage", "command line", "nodes are started by graycube-frontal", 2);
  a.secret = *secret;
  raise_descriptor_limit();
  return fork_nodes(a);
}

}  // namespace
}  // namespace graycube

int main(int argc, char** argv) { return graycube::run_main(argc, argv); }
