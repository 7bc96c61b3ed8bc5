// The messages that a node sends, in order; and the numbers of the batches sent and received on
// each link, by which a loss is noticed.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "proto/batch.hpp"
#include "proto/control.hpp"
#include "topology/rank.hpp"
#include "transport/message.hpp"

namespace graycube {

class Mail {
 public:
  struct Outgoing {
    /// The neighbour's rank; nothing for the frontal.
    std::optional<Rank> to;
    Message message;
  };
  /// Numbers of batches that the token carries (coordination/termination.hpp).
  struct Counted {
    /// Batches to neighbours that may make a passive node active; batches of light to the frontal.
    std::uint64_t work = 0, light = 0;
  };

  /// `first`: the stamp of what is sent before any job.
  explicit Mail(const BatchStamp& first) : first_(first) {}
  /// The neighbours, by bit.
  void set_peers(const std::vector<Rank>& peers);
  /// A job, or an epoch of one, begins: batches with this stamp are numbered from 0.
  void begin(const BatchStamp& first);

  void to_frontal(const ControlMessage& message);
  /// Tells the frontal that this epoch can't be brought to its end.
  void fail(std::string why);
  /// The same where another epoch would end in the same way: the job fails.
  void fail_for_good(std::string why);
  /// To the process that holds this node's FIFO (fifo/fifo_words.hpp).
  void to_fifo(Bytes message) { for_fifo_.push_back(std::move(message)); }
  /// A greeting or its answer: neither is numbered.
  void signal(std::uint32_t bit, BatchType type);
  /// `encode(stamp)` makes the batch; its size is returned.
  template <typename Encode>
  std::size_t to_neighbour(std::uint32_t bit, Encode&& encode) {
    Link& link = links_[bit];
    return post(link.peer, encode(stamped(link.sent++)));
  }
  /// The same for rays, tiles and light.
  template <typename Encode>
  std::size_t work_to_neighbour(std::uint32_t bit, Encode&& encode) {
    ++counted_.work;
    return to_neighbour(bit, std::forward<Encode>(encode));
  }
  template <typename Encode>
  std::size_t light_to_frontal(Encode&& encode) {
    ++counted_.light;
    return post(std::nullopt, encode(stamped(sent_to_frontal_++)));
  }
  /// The numbers of batches sent since this was last called.
  Counted take_counted() { return std::exchange(counted_, {}); }

  /// Whether nothing was lost before a batch that came; the next one is due from here on.
  [[nodiscard]] bool is_next_from(std::uint32_t bit, std::uint64_t sequence) {
    return sequence == links_[bit].came++;
  }
  [[nodiscard]] bool is_next_from_frontal(std::uint64_t sequence) {
    return sequence == came_from_frontal_++;
  }
  /// Says on standard error that something which came was of no use, and counts it.
  void drop(const char* what, std::string_view why);
  std::uint64_t drops() const { return drops_; }
  Rank peer(std::uint32_t bit) const { return links_[bit].peer; }
  std::uint32_t job() const { return first_.job; }
  std::uint32_t epoch() const { return first_.epoch; }

  bool is_empty() const { return outgoing_.empty() && for_fifo_.empty(); }
  std::vector<Outgoing> take() { return std::exchange(outgoing_, {}); }
  std::vector<Bytes> take_for_fifo() { return std::exchange(for_fifo_, {}); }

 private:
  struct Link {
    Rank peer;
    std::uint64_t sent = 0, came = 0;
  };
  BatchStamp stamped(std::uint64_t sequence) const;
  std::size_t post(std::optional<Rank> to, Bytes batch);

  BatchStamp first_;
  std::vector<Link> links_;  // by bit
  std::uint64_t sent_to_frontal_ = 0, came_from_frontal_ = 0;
  std::vector<Outgoing> outgoing_;
  std::vector<Bytes> for_fifo_;
  Counted counted_;
  std::uint64_t drops_ = 0;
};

}  // namespace graycube
