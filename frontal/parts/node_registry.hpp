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

/// The farm gives up when so many node processes in a row end before their hello, and no other node
/// can be their host. After so many hosts in a row that ended before their guests' hello, none is
/// asked any more.
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
  /// A node that is to run in another one's process.
  struct Hosting {
    Process guest, host;
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
  /// Forgets all nodes, and starts those of another hypercube.
  void begin_anew(const Hypercube& cube, double now_s);
  /// The node's process is, or is going to be, on that host: two hosts' processes may have the same
  /// id.
  void set_host(Rank rank, std::uint32_t host) { nodes_[rank.value].host = host; }
  /// No process can be started for the rank: chooses a node that is here, whose process is to be
  /// that node, too. There may be none; and while the farm has never been whole nobody gets a host,
  /// since then the farm itself is at fault.
  std::optional<Hosting> host(Rank rank, double now_s);
  /// A process says which node it is. Returns a refusal if that can't be.
  [[nodiscard]] std::optional<Refusal> hello(const PeerId& peer, const control::Hello& hello,
                                             double now_s);
  std::optional<Rank> rank_of(const PeerId& peer) const;
  void heard(Rank rank, double now_s) { nodes_[rank.value].last_heard_s = now_s; }
  /// Tells that the frontal heard nobody for so long, so that it doesn't count as silence.
  void was_held_up(double seconds);
  /// Takes the nodes that were silent for too long, one of each process; these are to be ended.
  /// `is_only_slow(rank, pid)`: the process is given more time.
  std::vector<Rank> take_silent(double now_s,
                                const std::function<bool(Rank, std::uint64_t)>& is_only_slow);
  /// The node's process is to be ended.
  void kill(Rank rank) { kills_.push_back({rank, nodes_[rank.value].incarnation}); }
  /// Forgets a node's process: its messages no longer count, and the rank must be started again.
  Lost lose(Rank rank, double now_s);
  /// The node, and those that share its process and end with it.
  std::vector<Rank> in_process_of(Rank rank) const;
  bool is_current(const Process& process) const {
    return nodes_[process.rank.value].incarnation == process.incarnation;
  }
  /// The process has ended, or will send nothing more.
  void has_left(Rank rank) { nodes_[rank.value].has_left = true; }

  bool all_here() const;
  bool is_here(Rank rank) const { return nodes_[rank.value].is_here; }
  std::uint32_t count_here() const;
  bool all_left() const;
  /// Endpoints of the nodes' inboxes, and the nodes' start numbers; indexed by rank.
  std::vector<std::string> endpoints() const;
  /// The same for nodes of other hosts; empty where there is none.
  std::vector<std::string> remote_endpoints() const;
  std::vector<std::uint32_t> incarnations() const;
  /// The nodes as shown to people; `are_busy`: the nodes that are here work on a job.
  control::NodeList list(bool are_busy) const;

  std::vector<Process> take_starts() { return std::exchange(starts_, {}); }
  std::vector<Process> take_kills() { return std::exchange(kills_, {}); }
  std::vector<Hosting> take_hostings() { return std::exchange(hostings_, {}); }

 private:
  struct Record {
    std::uint32_t incarnation = 0;
    /// Whether it has said hello; the members below are known since then.
    bool is_here = false;
    /// That of its host's process, if it is a guest, also before it has said hello.
    std::uint64_t pid = 0;
    bool is_guest = false;
    std::uint32_t host = 0;
    std::string endpoint, remote_endpoint;
    std::uint32_t threads = 1;
    double last_heard_s = 0;
    bool has_left = false;
  };

  std::optional<Rank> host_for(Rank rank) const;
  bool share_process(const Record& a, const Record& b) const {
    return a.pid != 0 && a.pid == b.pid && a.host == b.host;
  }

  Hypercube cube_;
  Patience patience_;
  std::vector<Record> nodes_;  // by rank
  std::map<PeerId, Rank> peers_;
  std::uint32_t next_incarnation_ = 1;
  std::vector<Process> starts_, kills_;
  std::vector<Hosting> hostings_;
  bool was_whole_ = false;
  /// Processes in a row that ended before their hello, and guests in a row that were lost before
  /// theirs.
  unsigned failed_starts_ = 0, failed_guests_ = 0;
};

}  // namespace graycube
