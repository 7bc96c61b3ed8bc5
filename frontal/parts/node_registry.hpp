// The node processes: which are to be started or ended, which have said hello, and when each was
// last heard.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "frontal/parts/post.hpp"
#include "topology/hypercube.hpp"

namespace graycube {

/// The farm gives up when so many node processes in a row end before their hello.
inline constexpr unsigned kMaxFailedStarts = 8;
/// A silent node whose process is there and could run may be silent for so many times as long as
/// another: on a busy machine it may only wait for its turn.
inline constexpr double kPatienceWithSlow = 10;

class NodeRegistry {
 public:
  /// A process for a rank, with its start number.
  struct Process {
    Rank rank;
    std::uint32_t incarnation = 0;
  };
  /// A node that was lost.
  struct Lost {
    /// For people: its rank, and its process if it had said hello.
    std::string name;
    /// Seconds since it was last heard, or started.
    double silent_s = 0;
    /// Processes end before their hello again and again.
    bool is_hopeless = false;
  };

  /// How long nodes may say nothing.
  struct Patience {
    /// For so many seconds, or until hello.
    double silence_s = 10, start_s = 60;
  };

  /// A node that says nothing for longer than that is taken for dead. Every rank gets a process.
  NodeRegistry(const Hypercube& cube, const Patience& patience);

  /// A new process is to be started for the rank, which must have none.
  void start(Rank rank, double now_s);
  /// A process says which node it is. Returns a refusal if that can't be.
  [[nodiscard]] std::optional<Refusal> hello(const PeerId& peer, const control::Hello& hello,
                                             double now_s);
  std::optional<Rank> rank_of(const PeerId& peer) const;
  void heard(Rank rank, double now_s) { nodes_[rank.value].last_heard_s = now_s; }
  /// Tells that the frontal heard nobody for so long, so that it doesn't count as silence.
  void was_held_up(double seconds);
  /// Takes the nodes that were silent for too long; their processes are to be ended.
  /// `is_only_slow(pid)`: the process is given more time.
  std::vector<Rank> take_silent(double now_s,
                                const std::function<bool(std::uint64_t)>& is_only_slow);
  /// The node's process is to be ended.
  void kill(Rank rank) { kills_.push_back({rank, nodes_[rank.value].incarnation}); }
  /// Forgets a node's process: its messages no longer count, and the rank must be started again.
  Lost lose(Rank rank, double now_s);
  bool is_current(const Process& process) const {
    return nodes_[process.rank.value].incarnation == process.incarnation;
  }
  /// The process has ended, or will send nothing more.
  void has_left(Rank rank) { nodes_[rank.value].has_left = true; }

  bool all_here() const;
  std::uint32_t count_here() const;
  bool all_left() const;
  /// Endpoints of the nodes' inboxes, and the nodes' start numbers; indexed by rank.
  std::vector<std::string> endpoints() const;
  std::vector<std::uint32_t> incarnations() const;
  /// The nodes as shown to people; `are_busy`: the nodes that are here work on a job.
  control::NodeList list(bool are_busy) const;

  std::vector<Process> take_starts() { return std::exchange(starts_, {}); }
  std::vector<Process> take_kills() { return std::exchange(kills_, {}); }

 private:
  struct Record {
    std::uint32_t incarnation = 0;
    /// Whether it has said hello; the members below are known since then.
    bool is_here = false;
    std::uint64_t pid = 0;
    std::string endpoint;
    std::uint32_t threads = 1;
    double last_heard_s = 0;
    bool has_left = false;
  };

  Hypercube cube_;
  Patience patience_;
  std::vector<Record> nodes_;  // by rank
  std::map<PeerId, Rank> peers_;
  std::uint32_t next_incarnation_ = 1;
  std::vector<Process> starts_, kills_;
  /// Processes in a row that ended before their hello.
  unsigned failed_starts_ = 0;
};

}  // namespace graycube
