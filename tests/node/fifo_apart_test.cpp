// A node whose received rays wait in a process apart: what it asks of that process, and what it
// makes of the rays that come back.
#include "node/parts/fifo/fifo_apart.hpp"

#include "catch.hpp"
#include "node/node_at_work.hpp"
#include "node/one_ball.hpp"
#include "node/parts/fifo/ray_fifo.hpp"
#include "node/sent_mail.hpp"
#include "proto/model_slice.hpp"

using namespace graycube;
using namespace graycube::testing;

namespace {

constexpr std::uint32_t kPlaces = 3;

control::Load load(FifoMode fifo = FifoMode::kProcess) {
  control::Load m = load_of({2, 1, 1, {8}, {}});
  m.flow = FlowMode::kBlocking;
  m.queue = kPlaces;
  m.link_credit_bytes = kPlaces * kRayBytes;
  m.fifo = fifo;
  return m;
}

/// Rank 0 of two nodes, whose half of space is the left one, when a picture has begun.
struct Half : NodeAtWork {
  explicit Half(const control::Load& how = load())
      : NodeAtWork(*Hypercube::of_size(2), Rank{0}, how, encode_model(one_ball())) {
    begin();
  }
  void receive(std::uint32_t pixel) {
    const RayTask ray = ray_into_nothing(pixel);
    node.on_neighbour(encode_rays(stamp_of(Rank{1}), {&ray, 1}, BatchType::kRays));
  }
  /// What the node says to its FIFO's process.
  std::vector<FifoWord> words() {
    std::vector<FifoWord> words;
    for (const Bytes& m : node.take_for_fifo()) {
      words.push_back(static_cast<FifoWord>(m.front()));
      said_.insert(said_.end(), m.begin(), m.end());
    }
    return words;
  }
  /// Has a FIFO take what was said, and the node take what that hands out.
  void let_fifo_answer() {
    Bytes answers;
    REQUIRE_FALSE(fifo_.take(std::exchange(said_, {}), answers));
    REQUIRE(stream_.take(answers, [&](FifoWord, auto ray) { node.on_fifo(ray); }));
  }
  /// The pixel of the ray that is traced next.
  std::optional<std::uint32_t> next_pixel() {
    auto work = node.take_work();
    if (!work) return std::nullopt;
    const auto* rays = std::get_if<RayWork>(&work->what);
    REQUIRE(rays != nullptr);
    REQUIRE(rays->rays.size() == 1);
    const std::uint32_t pixel = rays->rays.front().pixel;
    node.give_result(bench_.run(*std::move(work)));
    return pixel;
  }
  /// The text of the error by which the node has failed its job; empty if it hasn't.
  std::string failure() {
    for (const Node::Outgoing& o : node.take_outgoing()) {
      if (o.to || looks_like_batch(o.message.frame)) continue;
      const auto decoded = decode(o.message.text());
      const auto* m = std::get_if<ControlMessage>(&decoded);
      const auto* error = m == nullptr ? nullptr : std::get_if<control::NodeError>(m);
      if (error != nullptr) return error->message;
    }
    return {};
  }

 private:
  RayFifo fifo_{kPlaces};
  FifoStream stream_;
  Bytes said_;
  Workbench bench_;
};

/// A ray as a FIFO hands it out.
Bytes handed(const BatchStamp& stamp, std::uint32_t pixel = 1) {
  const RayTask ray = ray_into_nothing(pixel);
  return encode_rays(stamp, {&ray, 1}, BatchType::kRays);
}

}  // namespace

TEST_CASE("received rays go to the FIFO's process, and come back one by one in order") {
  Half half;
  half.receive(1);
  CHECK(half.words() == std::vector{FifoWord::kPut, FifoWord::kAsk});
  half.receive(2);
  half.receive(3);
  CHECK(half.words() == std::vector{FifoWord::kPut, FifoWord::kPut});
  half.let_fifo_answer();
  CHECK(half.next_pixel() == 1u);
  CHECK(half.words() == std::vector{FifoWord::kAsk});
  CHECK_FALSE(half.next_pixel());
  half.let_fifo_answer();
  CHECK(half.next_pixel() == 2u);
  half.words();
  half.let_fifo_answer();
  CHECK(half.next_pixel() == 3u);
  CHECK(half.words().empty());
}

TEST_CASE("a node is not done while its FIFO's process has rays") {
  Half half;
  half.assign({0});
  half.work();
  CHECK_FALSE(half.node.has_unfinished());
  half.receive(1);
  half.words();
  CHECK(half.node.has_unfinished());
  half.let_fifo_answer();
  CHECK(half.node.has_unfinished());
  CHECK(half.next_pixel() == 1u);
  half.node.take_work();  // sends the ray's light
  CHECK_FALSE(half.node.has_unfinished());
}

TEST_CASE("while its FIFO's process has rays a node begins no pixels") {
  Half half;
  half.assign({0});
  half.receive(1);
  CHECK(half.node.wait_reason() == WaitReason::kFetching);
  CHECK_FALSE(half.node.may_have_work());
  CHECK_FALSE(half.node.take_work());
  half.words();
  half.let_fifo_answer();
  CHECK(half.node.wait_reason() == WaitReason::kReady);
  CHECK(half.next_pixel() == 1u);
  const auto next = half.node.take_work();
  REQUIRE(next);
  CHECK(std::holds_alternative<TileWork>(next->what));
}

TEST_CASE("the room of a ray is given back when an evaluator takes it, not when it is fetched") {
  Half half;
  half.receive(1);
  half.words();
  half.node.take_outgoing();
  half.let_fifo_answer();
  const auto granted = [&half] {
    std::size_t grants = 0;
    for (const Node::Outgoing& o : half.node.take_outgoing()) {
      if (!looks_like_batch(o.message.frame)) continue;
      grants += std::get<BatchHeader>(peek_header(o.message.frame)).type == BatchType::kLinkCredit;
    }
    return grants;
  };
  CHECK(granted() == 0);
  half.next_pixel();
  CHECK(granted() == 1);
}

TEST_CASE("more rays than the queue has places for fail the job") {
  Half half;
  for (std::uint32_t i = 0; i < kPlaces; ++i) half.receive(i);
  CHECK(half.failure().empty());
  half.receive(9);
  CHECK(half.failure() == "node 1 sent more rays than the queue has places for");
}

TEST_CASE("a ray that is broken, or whose turn it is not, fails the job") {
  const BatchStamp due{1, 0, 1, 0, 0};
  BatchStamp second = due, stranger = due;
  second.sequence = 1;
  stranger.sender = 0;
  for (const Bytes& ray : {handed(second), handed(stranger)}) {
    Half half;
    half.receive(1);
    half.node.on_fifo(ray);
    CHECK(half.failure() == "its FIFO's process handed out a ray that was not due");
    CHECK(half.node.wait_reason() == WaitReason::kFetching);
  }
  Half unasked;
  unasked.node.on_fifo(handed(due));
  CHECK(unasked.failure() == "its FIFO's process handed out a ray that was not due");
  Half half;
  half.receive(1);
  Bytes broken = handed(due);
  broken.back() = std::byte{255};
  broken[kBatchHeaderBytes + 24] = std::byte{255};
  half.node.on_fifo(std::span(broken).first(broken.size() - 1));
  CHECK(half.failure() == "its FIFO's process handed out a broken ray");
}

TEST_CASE("a process is needed from a job's load to its end, and a new one for a new epoch") {
  Half half;
  CHECK(half.node.fifo_order() == FifoOrder{1, 0, kPlaces});
  half.receive(1);
  half.tell(control::Prepare{1, 1});
  CHECK(half.node.fifo_order() == FifoOrder{1, 1, kPlaces});
  CHECK(half.words().empty());
  half.node.on_fifo(handed({1, 0, 1, 0, 0}));  // of the epoch before
  CHECK(half.failure().empty());
  CHECK(half.node.wait_reason() == WaitReason::kWindow);
  half.tell(control::Finish{1});
  CHECK_FALSE(half.node.fifo_order());
}

TEST_CASE("the end of its FIFO's process fails a node's job, and nothing when there is none") {
  Half half;
  half.node.on_fifo_end("FIFO (process 7): killed by signal 9");
  CHECK(half.failure() == "FIFO (process 7): killed by signal 9");
  half.tell(control::Finish{1});
  half.node.on_fifo_end("FIFO (process 7): killed by signal 9");
  CHECK(half.failure().empty());
}

TEST_CASE("a report counts the messages between a node and its FIFO's process") {
  Half half;
  half.receive(1);
  half.words();
  half.let_fifo_answer();
  half.tell(control::Finish{1});
  std::uint64_t messages = 0;
  for (const Node::Outgoing& o : half.node.take_outgoing()) {
    if (looks_like_batch(o.message.frame)) continue;
    const auto decoded = decode(o.message.text());
    const auto* report = std::get_if<control::NodeReport>(&std::get<ControlMessage>(decoded));
    if (report != nullptr) messages = report->stats.fifo_messages;
  }
  CHECK(messages == 3);
}

TEST_CASE("no process is needed for a FIFO in the node's own, for credit, and without links") {
  CHECK_FALSE(Half(load(FifoMode::kThread)).node.fifo_order());
  control::Load m = load();
  CHECK(is_fifo_apart(m, 1));
  CHECK_FALSE(is_fifo_apart(m, 0));
  m.flow = FlowMode::kCredit;
  CHECK_FALSE(is_fifo_apart(m, 1));
  m = load();
  m.algorithm = Algorithm::kRoth;
  CHECK_FALSE(is_fifo_apart(m, 1));
}
