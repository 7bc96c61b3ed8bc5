#include "node/parts/ray_store.hpp"

#include <algorithm>
#include <map>
#include <random>
#include <vector>

#include "catch.hpp"
#include "node/parts/outbox.hpp"

using namespace graycube;

namespace {

RayTask ray(std::uint32_t number, RayKind kind, std::uint16_t depth) {
  RayTask r;
  r.pixel = number;
  r.kind = kind;
  r.depth = depth;
  return r;
}

}  // namespace

TEST_CASE("the store gives the deepest rays, kind by kind, and says across which links they came") {
  std::mt19937 dice(7);
  const auto below = [&](std::uint32_t n) { return static_cast<std::uint32_t>(dice() % n); };
  RayStore store;
  std::map<std::uint32_t, std::uint32_t> link_of;
  std::map<std::uint32_t, RayTask> held;
  std::uint32_t number = 0;
  for (int turn = 0; turn < 2000; ++turn) {
    const std::uint32_t link = below(4);
    std::vector<RayTask> rays;
    for (std::uint32_t i = below(40); i > 0; --i) {
      const auto kind = static_cast<RayKind>(1 + below(3));
      rays.push_back(ray(number, kind, static_cast<std::uint16_t>(below(5))));
      link_of[number] = link;
      held[number] = rays.back();
      ++number;
    }
    store.add(rays, link);
    REQUIRE(store.size() == held.size());
    const std::size_t most = below(45);
    std::map<std::uint32_t, std::size_t> credited, expected;
    const std::vector<RayTask> taken =
        store.take(most, [&](std::uint32_t l, std::size_t count) { credited[l] += count; });
    REQUIRE(taken.size() == std::min(most, held.size()));
    for (const RayTask& r : taken) {
      REQUIRE(held.at(r.pixel) == r);
      held.erase(r.pixel);
      ++expected[link_of.at(r.pixel)];
    }
    REQUIRE(credited == expected);
    if (taken.empty()) continue;
    // A generation's shadow rays come before its others, and those before the generation above.
    const auto rank = [](const RayTask& r) {
      return 2 * r.depth + (r.kind == RayKind::kShadow ? 1 : 0);
    };
    REQUIRE(std::is_sorted(taken.begin(), taken.end(),
                           [&](const RayTask& a, const RayTask& b) { return rank(a) > rank(b); }));
    for (const auto& [n, r] : held) REQUIRE(rank(r) <= rank(taken.back()));
    std::size_t changes = 0;
    for (std::size_t i = 1; i < taken.size(); ++i) {
      changes += taken[i].kind != taken[i - 1].kind || taken[i].depth != taken[i - 1].depth;
    }
    REQUIRE(changes < 15);
  }
  CHECK(number > 30000);
}

TEST_CASE("as in 1987 the store gives rays as they came") {
  RayStore store;
  store.set_fifo(true);
  std::vector<std::uint32_t> links;
  const std::vector<RayTask> rays = {ray(0, RayKind::kReflection, 1), ray(1, RayKind::kShadow, 4),
                                     ray(2, RayKind::kRefraction, 2)};
  store.add(rays, 3);
  store.add({rays.data(), 1}, 1);
  const auto taken = store.take(
      9, [&](std::uint32_t link, std::size_t count) { links.insert(links.end(), count, link); });
  REQUIRE(taken.size() == 4);
  CHECK(std::equal(rays.begin(), rays.end(), taken.begin()));
  CHECK(links == std::vector<std::uint32_t>{3, 3, 3, 1});
  CHECK(store.is_empty());
}

TEST_CASE("an outbox gives rays in the order in which they came, however it is emptied") {
  std::mt19937 dice(11);
  Outbox outbox;
  std::uint32_t added = 0, sent = 0;
  for (int turn = 0; turn < 5000; ++turn) {
    std::vector<RayTask> rays;
    for (std::size_t i = dice() % 50; i > 0; --i) rays.push_back(ray(added++, RayKind::kShadow, 0));
    outbox.add(rays);
    const std::size_t count = std::min<std::size_t>(outbox.size(), dice() % 52);
    for (const RayTask& r : outbox.oldest(count)) REQUIRE(r.pixel == sent++);
    outbox.drop_oldest(count);
    REQUIRE(outbox.size() == added - sent);
  }
  CHECK(sent > 100'000);
  outbox.clear();
  CHECK(outbox.is_empty());
}

TEST_CASE("what is sent from a long outbox moves few of the rays behind it") {
  constexpr std::size_t kRays = 100'000, kBatch = 100;
  Outbox outbox;
  outbox.add(std::vector<RayTask>(kRays));
  std::size_t moves = 0;
  while (!outbox.is_empty()) {
    const RayTask* next = outbox.oldest(1).data() + kBatch;
    outbox.drop_oldest(kBatch);
    if (!outbox.is_empty() && outbox.oldest(1).data() != next) moves += outbox.size();
  }
  CHECK(moves > 0);
  CHECK(moves <= kRays);
}
