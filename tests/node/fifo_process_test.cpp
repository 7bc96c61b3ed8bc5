// A real process that holds a FIFO, as a node's main thread starts, serves and ends it.
#include "node/fifo_process.hpp"

#include <poll.h>

#include <chrono>
#include <cstdint>
#include <vector>

#include "catch.hpp"

using namespace graycube;

namespace {

/// More than enough for anything here on a busy machine.
constexpr auto kPatience = std::chrono::seconds(60);

Bytes ray_of(std::uint32_t number) {
  Bytes ray(kFifoRayBytes);
  for (std::size_t i = 0; i < 4; ++i) ray[i] = static_cast<std::byte>(number >> (8 * i));
  return ray;
}

std::uint32_t number_of(std::span<const std::byte> ray) {
  std::uint32_t number = 0;
  for (std::size_t i = 0; i < 4; ++i) number |= std::to_integer<std::uint32_t>(ray[i]) << (8 * i);
  return number;
}

const Bytes kAsk = fifo_message(FifoWord::kAsk);

struct Fifo {
  FifoProcess process{GRAYCUBE_FIFO};
  std::vector<std::uint32_t> came;

  /// Takes in what comes until `is_enough()`, or fails the test.
  template <typename Enough>
  void receive_until(Enough&& is_enough) {
    const auto until = std::chrono::steady_clock::now() + kPatience;
    while (!is_enough()) {
      REQUIRE(std::chrono::steady_clock::now() < until);
      pollfd item{process.descriptor(), POLLIN, 0};
      ::poll(&item, 1, 100);
      process.receive([this](std::span<const std::byte> ray) { came.push_back(number_of(ray)); });
    }
  }
  std::string failure() {
    std::optional<std::string> why;
    receive_until([&] {
      why = process.take_failure();
      return why.has_value();
    });
    return *why;
  }
};

}  // namespace

TEST_CASE("a process hands out rays in order, more of them than fit between it and the node") {
  constexpr std::uint32_t kRays = 20000;  // a few megabytes
  Fifo fifo;
  REQUIRE(fifo.process.serve(FifoOrder{1, 0, kRays}));
  std::vector<Bytes> puts;
  for (std::uint32_t i = 0; i < kRays; ++i) puts.push_back(fifo_message(FifoWord::kPut, ray_of(i)));
  fifo.process.send(puts);
  for (std::uint32_t i = 0; i < kRays; ++i) {
    fifo.process.send({kAsk});
    fifo.receive_until([&] { return fifo.came.size() > i; });
    if (fifo.came.back() != i) FAIL("ray " << fifo.came.back() << " in place of " << i);
  }
  CHECK(fifo.process.cpu_s() > 0);
  CHECK_FALSE(fifo.process.take_failure());
}

TEST_CASE("a new order gets a new process, which is empty; without one there is none") {
  Fifo fifo;
  REQUIRE(fifo.process.serve(FifoOrder{1, 0, 4}));
  fifo.process.send({fifo_message(FifoWord::kPut, ray_of(1))});
  REQUIRE(fifo.process.serve(FifoOrder{1, 1, 4}));
  fifo.process.send({kAsk, fifo_message(FifoWord::kPut, ray_of(2))});
  fifo.receive_until([&] { return !fifo.came.empty(); });
  CHECK(fifo.came == std::vector<std::uint32_t>{2});
  REQUIRE(fifo.process.serve(std::nullopt));
  CHECK(fifo.process.cpu_s() == 0);
  fifo.process.send({kAsk});
  fifo.process.receive([](std::span<const std::byte>) { FAIL("a ray from nobody"); });
  CHECK_FALSE(fifo.process.take_failure());
}

TEST_CASE("how a process ended is told once, and none is started in its place for that order") {
  Fifo fifo;
  REQUIRE(fifo.process.serve(FifoOrder{1, 0, 1}));
  // One ray more than it has places for.
  const Bytes put = fifo_message(FifoWord::kPut, ray_of(1));
  fifo.process.send({put, put});
  const std::string why = fifo.failure();
  CHECK(why.starts_with("FIFO (process "));
  CHECK(why.ends_with("): exited with status 1"));
  CHECK_FALSE(fifo.process.take_failure());
  REQUIRE(fifo.process.serve(FifoOrder{1, 0, 1}));
  CHECK(fifo.process.cpu_s() == 0);
  REQUIRE(fifo.process.serve(FifoOrder{2, 0, 1}));
  fifo.process.send({kAsk, put});
  fifo.receive_until([&] { return !fifo.came.empty(); });
  CHECK(fifo.came == std::vector<std::uint32_t>{1});
}

TEST_CASE("a process that can't be started is told with its program") {
  FifoProcess process("/nowhere/graycube-fifo");
  CHECK_FALSE(process.serve(FifoOrder{1, 0, 1}));
  process.send({kAsk});
  CHECK(process.take_failure() == "FIFO: /nowhere/graycube-fifo: No such file or directory");
  CHECK(process.serve(FifoOrder{1, 0, 1}));
}
