// A node's brain: a state machine. Messages, results of work and the request for work go in;
// messages and work come out. It knows no socket, thread or clock: main.cpp wires those on, the
// simulation others.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "node/parts/distribution/slice_relay.hpp"
#include "node/parts/mail.hpp"
#include "node/parts/membership.hpp"
#include "node/rendering.hpp"
#include "node/work.hpp"
#include "proto/messages.hpp"
#include "transport/message.hpp"

namespace graycube {

class Node {
 public:
  using Outgoing = Mail::Outgoing;

  explicit Node(NodeIdentity identity);

  /// The first message, to be sent when the frontal can be reached.
  Message hello() const;

  void on_frontal(const Message& message);
  /// A batch from a neighbour's inbox link. The sender is read from it and checked.
  void on_neighbour(std::span<const std::byte> batch);
  /// A ray from the process that holds this node's FIFO.
  void on_fifo(std::span<const std::byte> ray);
  /// That process has ended, or could not be started: the job fails.
  void on_fifo_end(std::string why);

  /// Something for an evaluator to do, if there is. When there isn't, whatever waits to be sent
  /// goes out.
  std::optional<Work> take_work();
  void give_result(WorkResult result);
  WaitReason wait_reason() const {
    return rendering_ ? rendering_->wait_reason() : WaitReason::kIdle;
  }
  /// False only when take_work() would certainly give nothing.
  bool may_have_work() const;
  /// Evaluators that the job is to have; those of the node when there is none.
  std::uint32_t threads() const { return has_job_ ? load_.threads : membership_.id().threads; }
  /// Whether rays, primary ones included, or light of the picture are left here.
  bool has_unfinished() const { return rendering_ && rendering_->has_unfinished(); }
  bool has_job() const { return has_job_; }
  /// Between start and the end of a picture: what evaluators' waiting time is measured over.
  bool is_rendering() const { return rendering_ && rendering_->has_begun(); }

  /// Takes the messages to be sent, in order; the caller sends all of them. To be called when all
  /// messages at hand are taken in.
  std::vector<Outgoing> take_outgoing();
  /// The same for messages to the process that holds this node's FIFO; and what it is needed for
  /// now: the caller starts and ends it.
  std::vector<Bytes> take_for_fifo() { return mail_.take_for_fifo(); }
  std::optional<FifoOrder> fifo_order() const;
  /// Nodes that this one's process is to be from now on, too; the caller sees to that.
  std::vector<control::Host> take_guests() { return std::exchange(guests_, {}); }
  bool has_outgoing() const { return !mail_.is_empty(); }
  bool is_shut_down() const { return is_shut_down_; }
  /// Endpoints of all nodes' inboxes, indexed by rank; empty strings until the frontal has told.
  const std::vector<std::string>& endpoints() const { return membership_.endpoints(); }

  /// Fills in the times and memory of a report; the brain has no clock.
  std::function<void(control::NodeStats&)> measure;

 private:
  void on_control(const Message& message);
  void on_welcome(const control::Welcome& m);
  void on_load(const control::Load& m, const SharedBytes& slice);
  void take_slice(const SharedBytes& slice);
  void on_hand_on(const control::HandOn& m, const SharedBytes& slice);
  void on_slice_part(std::uint32_t bit, std::span<const std::byte> batch);
  void on_prepare(const control::Prepare& m);
  void on_start(control::Start m);
  void on_finish(const control::Finish& m);
  void on_ping(const control::Ping& m);
  void on_host(const control::Host& m);
  void greet();
  void on_assignment(std::span<const std::byte> batch);
  void on_signal(std::uint32_t bit, BatchType type);
  void on_batch(std::uint32_t bit, BatchType type, std::span<const std::byte> batch);
  void on_rays(std::uint32_t bit, BatchType type, std::span<const std::byte> batch);

  Rendering* rendering_of(std::uint32_t job, std::uint32_t epoch);
  BuildWork build_work();
  /// The node's seat in the current job's mesh.
  Seat seat() const;
  void adopt(Built& built, double build_s);
  void acknowledge_load_when_greeted();
  void send_ready_when_complete();

  Membership membership_;
  Mail mail_;
  bool is_shut_down_ = false;
  std::vector<control::Host> guests_;
  bool has_job_ = false;
  /// The current job's parameters, or the last job's.
  control::Load load_;
  /// The slice that the job was loaded with, until an evaluator takes it to subdivide it.
  std::optional<SharedBytes> unbuilt_slice_;
  std::size_t slice_bytes_ = 0;
  /// Nothing until the node's own macro-regions are subdivided.
  std::optional<Rendering> rendering_;
  /// Nothing unless the job's slices come over links.
  std::optional<SliceRelay> relay_;
  double build_s_ = 0;
  bool is_ready_sent_ = false, is_load_acknowledged_ = false;
  /// The batch of rays that came last; a member so that its memory serves the next batch.
  std::vector<RayTask> received_;
};

}  // namespace graycube
