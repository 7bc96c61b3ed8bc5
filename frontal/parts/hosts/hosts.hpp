// The machines that have joined a farm, and which nodes each runs. A frontal that starts its nodes
// itself has none of these.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "frontal/parts/node_registry.hpp"
#include "frontal/parts/post.hpp"

namespace graycube {

/// A host on which so many processes in a row ended before their hello gets no nodes for so many
/// seconds.
inline constexpr unsigned kMaxFailedOnHost = 4;
inline constexpr double kBarred_s = 60;
/// Nodes beyond its slots that a host gets, rather than leave a job without them: until it has so
/// many for each core.
inline constexpr std::uint32_t kMostNodesOnCore = 8;

class Hosts {
 public:
  using Process = NodeRegistry::Process;
  using Number = std::uint32_t;

  /// A host that is gone, and the nodes that went with it.
  struct Lost {
    /// For people: its name, and its process.
    std::string name;
    double silent_s = 0;
    std::vector<Rank> nodes;
  };
  /// A host that gets a node.
  struct Placed {
    Rank node;
    Number host;
  };

  /// A host that says nothing for longer than `silence_s` is taken for lost.
  explicit Hosts(double silence_s) : silence_s_(silence_s) {}

  /// Returns why the host can't join.
  [[nodiscard]] std::optional<Refusal> join(const PeerId& peer, const control::Join& about,
                                            double now_s);
  bool is_here(const PeerId& peer) const { return numbers_.contains(peer); }
  void heard(const PeerId& peer, double now_s);
  void alive(const PeerId& peer, const control::Alive& m);
  /// The host goes; nothing if there is no such host.
  std::optional<Lost> leave(const PeerId& peer, double now_s);
  /// Takes the hosts that were silent for too long.
  std::vector<Lost> take_silent(double now_s);
  /// Tells that the frontal heard nobody for so long, so that it doesn't count as silence.
  void was_held_up(double seconds);

  /// The process is to run on some host; one that waits for the same rank doesn't any longer.
  void want(const Process& process);
  /// Finds hosts for nodes that wait, of `nodes` in all. Consecutive ranks go to one host, into its
  /// share of the slots; beyond that only if `in_need`, to where fewest nodes share a core.
  std::vector<Placed> place(std::uint32_t nodes, bool in_need, double now_s);
  /// What the hosts are to be told, since it was last asked.
  std::vector<std::pair<PeerId, ControlMessage>> take_orders() {
    return std::exchange(orders_, {});
  }
  /// The node's process is to be ended.
  void kill(const Process& process);
  /// The node runs in the process of `host`, which is on the same host.
  void has_host(Rank guest, Rank host);
  /// The process has ended, before its hello or after: it takes no slot any longer. False if it was
  /// none of that host's.
  [[nodiscard]] bool ended(const PeerId& peer, const Process& process, bool was_here, double now_s);
  /// Forgets all nodes, as others take their places.
  void clear();

  /// The nodes that wait for a host.
  const std::vector<Process>& waiting() const { return waiting_; }
  /// Slots of hosts that may get nodes.
  std::uint32_t slots(double now_s) const;
  /// Since when the hosts, and whether they may get nodes, are as they are now.
  double changed_s() const { return changed_s_; }
  std::size_t size() const { return hosts_.size(); }
  /// Whether a node that waits would find a place in need.
  bool has_room(double now_s) const;
  /// Whether some host has more than its share of so many nodes, so that they are better dealt
  /// anew.
  bool is_uneven(std::uint32_t nodes, double now_s) const;

  std::optional<Number> host_of(Rank node) const;
  std::map<Number, std::vector<Rank>> nodes_by_host() const;
  std::vector<PeerId> peers() const;
  std::set<std::string> names() const;
  const std::string& name_of(Number host) const { return hosts_.at(host).about.host; }
  const std::string& folder_of(Number host) const { return hosts_.at(host).about.folder; }
  /// Whether nodes of the two reach each other's local sockets.
  bool are_local(Number a, Number b) const;
  /// Whether the node's host answers, and says that nothing keeps the node's process from running.
  bool can_run(Rank node, double now_s) const;
  /// The hosts as shown to people.
  std::vector<control::HostInfo> list(double now_s) const;

 private:
  struct Host {
    PeerId peer;
    control::Join about;
    double last_heard_s = 0;
    std::map<Rank, std::uint32_t> nodes;  // and their start numbers
    std::vector<std::uint32_t> stopped;   // ranks
    unsigned failed_starts = 0;
    double barred_until_s = 0;

    bool takes_nodes(double now_s) const { return now_s >= barred_until_s; }
    std::uint32_t room(std::uint32_t share) const;
    std::uint32_t room_in_need() const;
  };

  Lost remove(Number number, double now_s);
  void give(Number number, const Process& process);
  /// The most nodes that a host gets of so many: the smallest power of two with which all find a
  /// slot, so that dimensions of the hypercube lie inside hosts.
  std::uint32_t share_of(std::uint32_t nodes, double now_s) const;
  std::optional<Number> host_for(const Process& process, std::uint32_t share, double now_s) const;
  std::optional<Number> host_in_need(double now_s) const;

  double silence_s_;
  std::map<Number, Host> hosts_;
  std::map<PeerId, Number> numbers_;
  std::map<Rank, Number> places_;
  std::vector<Process> waiting_;  // by rank
  std::vector<std::pair<PeerId, ControlMessage>> orders_;
  std::map<Number, control::RunNodes> starts_;
  Number next_number_ = 1;
  double changed_s_ = 0;
};

}  // namespace graycube
