#include "node/parts/fifo/ray_fifo.hpp"

#include <random>
#include <vector>

#include "catch.hpp"
#include "node/parts/fifo/fifo_words.hpp"

using namespace graycube;

namespace {

/// Bytes in place of a ray, by which it is told apart from others.
Bytes ray_of(std::uint8_t number) { return Bytes(kFifoRayBytes, std::byte{number}); }
Bytes put(std::uint8_t number) { return fifo_message(FifoWord::kPut, ray_of(number)); }
const Bytes kAsk = fifo_message(FifoWord::kAsk);

Bytes joined(const std::vector<Bytes>& messages) {
  Bytes all;
  for (const Bytes& m : messages) all.insert(all.end(), m.begin(), m.end());
  return all;
}

struct Heard {
  FifoWord word;
  Bytes ray;
  friend bool operator==(const Heard&, const Heard&) = default;
};

/// The messages in a stream that arrives in parts of random sizes.
std::vector<Heard> heard_in(const Bytes& stream, std::mt19937_64& random, std::size_t most) {
  FifoStream cut;
  std::vector<Heard> heard;
  for (std::size_t from = 0; from < stream.size();) {
    const std::size_t count = std::min<std::size_t>(random() % most + 1, stream.size() - from);
    REQUIRE(cut.take(std::span(stream).subspan(from, count), [&](FifoWord word, auto ray) {
      heard.push_back({word, Bytes(ray.begin(), ray.end())});
    }));
    from += count;
  }
  return heard;
}

/// The numbers of the rays that are handed out.
std::vector<int> handed(RayFifo& fifo, const std::vector<Bytes>& messages) {
  Bytes answers;
  REQUIRE_FALSE(fifo.take(joined(messages), answers));
  std::vector<int> numbers;
  FifoStream stream;
  REQUIRE(stream.take(answers, [&](FifoWord word, std::span<const std::byte> ray) {
    CHECK(word == FifoWord::kHand);
    CHECK(Bytes(ray.begin(), ray.end()) == ray_of(std::to_integer<std::uint8_t>(ray[0])));
    numbers.push_back(std::to_integer<int>(ray[0]));
  }));
  return numbers;
}

}  // namespace

TEST_CASE("messages between a node and its FIFO are the same in whatever parts they arrive") {
  std::mt19937_64 random(7);
  for (int trial = 0; trial < 200; ++trial) {
    std::vector<Bytes> messages;
    std::vector<Heard> expected;
    for (std::uint64_t n = random() % 30; n > 0; --n) {
      const auto word = static_cast<FifoWord>(1 + random() % 3);
      const Bytes ray = word == FifoWord::kAsk ? Bytes() : ray_of(static_cast<std::uint8_t>(n));
      messages.push_back(fifo_message(word, ray));
      expected.push_back({word, ray});
    }
    CHECK(heard_in(joined(messages), random, trial % 2 == 0 ? 3 : 1000) == expected);
  }
}

TEST_CASE("bytes that begin no message are told") {
  for (const int first : {0, 4, 255}) {
    FifoStream stream;
    const Bytes wrong = joined({put(1), Bytes{static_cast<std::byte>(first)}});
    int whole = 0;
    CHECK_FALSE(stream.take(wrong, [&](FifoWord, auto) { ++whole; }));
    CHECK(whole == 1);
  }
}

TEST_CASE("a FIFO hands out rays in order, each when it is asked for, and none twice") {
  RayFifo fifo(4);
  CHECK(handed(fifo, {put(1), put(2)}).empty());
  CHECK(handed(fifo, {kAsk}) == std::vector{1});
  CHECK(handed(fifo, {put(3), kAsk, put(4), kAsk}) == std::vector{2, 3});
  CHECK(fifo.size() == 1);
}

TEST_CASE("a FIFO that was asked while it was empty hands out the next ray at once") {
  RayFifo fifo(4);
  CHECK(handed(fifo, {kAsk}).empty());
  CHECK(handed(fifo, {put(5), put(6)}) == std::vector{5});
  CHECK(fifo.size() == 1);
}

TEST_CASE("a FIFO takes no more rays than it has places for") {
  RayFifo fifo(2);
  Bytes answers;
  CHECK_FALSE(fifo.take(joined({put(1), put(2)}), answers));
  CHECK(fifo.take(put(3), answers) == "more rays came than there are places for");
  CHECK(fifo.size() == 2);
}

TEST_CASE("a FIFO refuses what no node says") {
  Bytes answers;
  RayFifo twice(2), handing(2), nonsense(2);
  CHECK(twice.take(joined({kAsk, kAsk}), answers) ==
        "a ray was asked for before the last one was handed out");
  CHECK(handing.take(fifo_message(FifoWord::kHand, ray_of(1)), answers) ==
        "no message of a node came");
  CHECK(nonsense.take(Bytes{std::byte{77}}, answers) == "no message of a node came");
  CHECK(answers.empty());
}
