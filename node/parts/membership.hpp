// Who a node is and who the others are: its seat, where they listen, who has greeted, and which job
// and epoch is on.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "node/parts/seat.hpp"
#include "proto/batch.hpp"
#include "proto/messages.hpp"
#include "transport/message.hpp"

namespace graycube {

struct NodeIdentity {
  Rank rank;
  /// The node's start number, given by whoever started it.
  std::uint32_t incarnation = 0;
  std::uint64_t pid = 0;
  std::string endpoint;
  std::uint32_t threads = 1;
  std::string version;
  /// For nodes of other hosts; empty where there are none.
  std::string remote_endpoint{};
};

/// Which of two neighbours connects to the other; it greets the other each time that the frontal
/// welcomes the nodes.
inline bool connects_to(Rank from, Rank to) { return from < to; }

class Membership {
 public:
  explicit Membership(NodeIdentity identity) : id_(std::move(identity)) {}

  const NodeIdentity& id() const { return id_; }
  control::Hello hello() const;
  void report(control::NodeStats& stats) const;

  /// False, and nothing changes, when the welcome is to another farm.
  [[nodiscard]] bool join(const control::Welcome& welcome);
  bool has_joined() const { return seat_.has_value(); }
  /// The node must have joined.
  const Seat& seat() const { return *seat_; }
  std::vector<Rank> peers() const;
  /// Endpoints of all nodes' inboxes, indexed by rank; an empty string while there is no such node.
  const std::vector<std::string>& endpoints() const { return endpoints_; }
  /// Whether this node is to greet the one across that bit.
  bool is_to_greet(std::uint32_t bit) const;

  /// A neighbour may have heard the frontal's welcome first: its greeting waits. Further ones are
  /// of no use.
  void keep_early(std::span<const std::byte> greeting);
  std::vector<Bytes> take_early();
  void has_greeted(std::uint32_t bit) { greeted_[bit] = true; }
  bool have_all_greeted() const;

  /// From here on batches of that job and epoch count, whoever sends them.
  void begin(std::uint32_t job, std::uint32_t epoch);
  /// The same for a later epoch of the job.
  void begin_epoch(std::uint32_t epoch) { begin(job_, epoch); }
  /// From here on only batches from processes with these start numbers count; indexed by rank.
  void accept_only(std::vector<std::uint32_t> incarnations) {
    incarnations_ = std::move(incarnations);
  }
  std::uint32_t job() const { return job_; }
  std::uint32_t epoch() const { return epoch_; }
  bool is_now(std::uint32_t job, std::uint32_t epoch) const {
    return job == job_ && epoch == epoch_;
  }
  bool is_of_now(const BatchStamp& stamp) const;
  /// The stamp of the first batch that this node sends.
  BatchStamp stamp() const { return {job_, epoch_, id_.rank.value, id_.incarnation, 0}; }

 private:
  NodeIdentity id_;
  std::optional<Seat> seat_;
  std::vector<std::string> endpoints_;
  std::vector<bool> greeted_;  // by bit
  std::vector<Bytes> early_greetings_;
  std::vector<std::uint32_t> incarnations_;
  std::uint32_t job_ = 0, epoch_ = 0;
};

}  // namespace graycube
