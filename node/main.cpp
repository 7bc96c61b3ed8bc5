// graycube-node: one corner of the hypercube. The main thread is the mailroom: it owns every socket.
#include <signal.h>
#include <sys/prctl.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <map>

#include "node/evaluator_pool.hpp"
#include "node/node.hpp"
#include "geometry/simd.hpp"
#include "transport/allocator.hpp"
#include "transport/endpoint.hpp"
#include "version.hpp"

namespace graycube {
namespace {

struct NodeArguments {
  std::uint32_t rank = 0, incarnation = 0, threads = 1;
  std::string frontal, inbox;
};

class Mailroom {
 public:
  explicit Mailroom(const NodeArguments& a)
      : inbox_(context_, a.inbox),
        frontal_(context_, a.frontal),
        node_({Rank{a.rank}, a.incarnation, static_cast<std::uint64_t>(::getpid()),
               inbox_.endpoint(), a.threads, kVersion}),
        pool_(node_, wakeup_) {
    frontal_.send(node_.hello());
  }

  void run() {
    for (;;) {
      Readable* const sockets[] = {&inbox_, &frontal_};
      const int descriptors[] = {wakeup_.descriptor()};
      wait_readable(sockets, descriptors, std::chrono::seconds(1));
      wakeup_.clear();
      const bool ended = pool_.with_node([&] {
        while (auto m = inbox_.receive()) node_.on_neighbour(m->message.frame);
        while (auto m = frontal_.receive()) node_.on_frontal(*m);
        outgoing_ = node_.take_outgoing();
        return node_.is_shut_down();
      });
      // Outside the lock: evaluators never wait for a socket.
      for (Node::Outgoing& o : outgoing_) send(o);
      if (ended) return;
    }
  }

 private:
  void send(Node::Outgoing& o) {
    if (!o.to) return frontal_.send(std::move(o.message));
    auto link = links_.find(*o.to);
    if (link == links_.end()) {
      link = links_.emplace(*o.to, Connection(context_, node_.endpoints()[o.to->value])).first;
    }
    link->second.send(std::move(o.message));
  }

  ZmqContext context_;
  Wakeup wakeup_;
  Inbox inbox_;
  Connection frontal_;
  std::map<Rank, Connection> links_;
  Node node_;
  EvaluatorPool pool_;
  std::vector<Node::Outgoing> outgoing_;
};

int run_main(int argc, char** argv) {
  CLI::App app{"A node of a Graycube farm; started by graycube-frontal."};
  app.set_version_flag("--version", std::string("graycube-node ") + kVersion);
  NodeArguments a;
  app.add_option("--rank", a.rank)->required()->check(CLI::Range(0u, kMaxNodes - 1));
  app.add_option("--incarnation", a.incarnation)->required();
  app.add_option("--threads", a.threads)->check(CLI::Range(1u, kMaxThreads));
  app.add_option("--frontal", a.frontal, "The frontal's endpoint")->required();
  app.add_option("--inbox", a.inbox, "Where to listen for neighbours")->required();
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& e) {
    return app.exit(e);
  } catch (const CLI::ParseError& e) {
    std::fprintf(stderr, "graycube-node: usage: command line: %s\n", e.what());
    return 2;
  }
  for (const std::string& endpoint : {a.frontal, a.inbox}) {
    if (const auto problem = endpoint_problem(endpoint)) {
      std::fprintf(stderr, "graycube-node: usage: %s: %s\n", endpoint.c_str(), problem->c_str());
      return 2;
    }
  }
  if (const std::string problem = choose_simd_from_environment(); !problem.empty()) {
    std::fprintf(stderr, "graycube-node: environment: GRAYCUBE_SIMD: %s\n", problem.c_str());
    return 2;
  }
  // A node never outlives its frontal.
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  // A terminal's Ctrl-C is for the command, which stops its nodes in order.
  ::signal(SIGINT, SIG_IGN);
  keep_freed_memory(a.threads);
  try {
    Mailroom(a).run();
  } catch (const TransportError& e) {
    std::fprintf(stderr, "graycube-node: node %u: %s\n", a.rank, e.what());
    return 1;
  }
  return 0;
}

}  // namespace
}  // namespace graycube

int main(int argc, char** argv) { return graycube::run_main(argc, argv); }
