// graycube-node: one corner of the hypercube. The main thread is the node's mailroom: it owns the
// sockets.
#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <string>
#include <vector>

#include "geometry/simd.hpp"
#include "memory/kept_heap.hpp"
#include "node/guests.hpp"
#include "node/mailroom.hpp"
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
  FarmAccess farm;
};

int fail(const std::string& what, const std::string& where, const std::string& why, int status) {
  std::fprintf(stderr, "graycube-node: %s: %s: %s\n", what.c_str(), where.c_str(), why.c_str());
  return status;
}

/// An error of a node ends the whole process, whichever of its nodes it is.
[[noreturn]] void end_process(Rank rank, const std::string& why) {
  ::_exit(fail("node " + std::to_string(rank.value), "transport", why, 1));
}

/// Runs the node whose place in the arguments is `number`, and those that it hosts.
int run_node(const NodeArguments& a, std::size_t number) {
  // A terminal's Ctrl-C is for the command, which stops its nodes in order.
  ::signal(SIGINT, SIG_IGN);
  keep_freed_memory(a.farm.threads, kLargeHeap);
  const Rank rank{a.ranks[number]};
  // Beyond what is caught: a node that fails must not wait for its guests.
  Guests guests(a.farm, end_process);
  try {
    Mailroom mailroom(a.farm, rank, a.incarnations[number], false,
                      [&guests](const control::Host& guest) { guests.take_in(guest); });
    mailroom.run();
    guests.wait();
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
    // The system takes back what a process has, threads and sockets above all, for less than it
    // takes to give it up. Should the last goodbye not have left, the frontal sees the process end.
    ::_exit(0);
#endif
  } catch (const TransportError& e) {
    end_process(rank, e.what());
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
  app.add_option("--threads", a.farm.threads)->check(CLI::Range(1u, kMaxThreads));
  app.add_option("--frontal", a.farm.frontal, "The frontal's endpoint")->required();
  app.add_option("--address", a.farm.address, "Where nodes listen for those of other hosts");
  app.add_option("--folder", a.farm.folder, "Where nodes listen for their neighbours")->required();
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
  if (const auto problem = endpoint_problem(a.farm.frontal, !a.farm.address.empty()))
    return fail("usage", a.farm.frontal, *problem, 2);
  for (const std::uint32_t rank : a.ranks) {
    const std::string inbox = inbox_of(a.farm, Rank{rank});
    if (const auto problem = endpoint_problem(inbox)) return fail("usage", inbox, *problem, 2);
  }
  if (const auto problem = choose_simd_from_environment()) {
    return fail("environment", "GRAYCUBE_SIMD", *problem, 2);
  }
  const auto secret = take_secret(kSecretDescriptor);
  if (!secret) return fail("usage", "command line", "nodes are started by graycube-frontal", 2);
  a.farm.secret = *secret;
  raise_descriptor_limit();
  return fork_nodes(a);
}

}  // namespace
}  // namespace graycube

int main(int argc, char** argv) { return graycube::run_main(argc, argv); }
