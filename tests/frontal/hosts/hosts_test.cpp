// Which nodes run on which hosts.
#include "frontal/parts/hosts/hosts.hpp"

#include <algorithm>
#include <random>
#include <set>

#include "catch.hpp"

using namespace graycube;

namespace {

constexpr double kSilence_s = 2;

control::Join machine(const std::string& name, std::uint32_t slots, std::uint32_t cores = 4,
                      const std::string& tag = "") {
  return {name, tag.empty() ? name : tag, "/tmp/" + name, cores, 1u << 30, slots, 77, "test"};
}

struct Farm {
  Hosts hosts{kSilence_s};
  double now_s = 100;
  std::uint32_t nodes;
  std::uint32_t next_incarnation = 1;
  std::map<Rank, std::uint32_t> incarnations;

  explicit Farm(std::uint32_t of) : nodes(of) {
    for (std::uint32_t rank = 0; rank < nodes; ++rank) want(rank);
  }
  void want(std::uint32_t rank) {
    incarnations[Rank{rank}] = next_incarnation;
    hosts.want({Rank{rank}, next_incarnation++});
  }
  void join(const std::string& name, std::uint32_t slots, std::uint32_t cores = 4) {
    REQUIRE_FALSE(hosts.join(name, machine(name, slots, cores), now_s));
  }
  void place(bool in_need = false) { hosts.place(nodes, in_need, now_s); }
  /// The ranks on the host of that name.
  std::vector<std::uint32_t> on(const std::string& name) const {
    std::vector<std::uint32_t> ranks;
    for (const auto& [host, nodes_there] : hosts.nodes_by_host()) {
      if (hosts.name_of(host) != name) continue;
      for (const Rank rank : nodes_there) ranks.push_back(rank.value);
    }
    return ranks;
  }
  bool ended(const std::string& name, std::uint32_t rank, bool was_here) {
    return hosts.ended(name, {Rank{rank}, incarnations[Rank{rank}]}, was_here, now_s);
  }
};

using Ranks = std::vector<std::uint32_t>;

/// What a host was told to run.
Ranks told_to_run(Hosts& hosts, const PeerId& peer) {
  Ranks ranks;
  for (const auto& [to, order] : hosts.take_orders()) {
    if (to != peer || !std::holds_alternative<control::RunNodes>(order)) continue;
    for (const auto& node : std::get<control::RunNodes>(order).nodes) ranks.push_back(node.rank);
  }
  return ranks;
}

}  // namespace

TEST_CASE("consecutive ranks lie on one host") {
  Farm farm(8);
  farm.join("a", 4);
  farm.join("b", 4);
  farm.place();
  CHECK(farm.on("a") == Ranks{0, 1, 2, 3});
  CHECK(farm.on("b") == Ranks{4, 5, 6, 7});
  CHECK(farm.hosts.waiting().empty());
  CHECK(told_to_run(farm.hosts, "b") == Ranks{4, 5, 6, 7});
}

TEST_CASE("nodes are shared out among all hosts, however many slots the first one has") {
  Farm farm(8);
  farm.join("a", 64);
  farm.join("b", 64);
  farm.join("c", 64);
  farm.place();
  CHECK(farm.on("a") == Ranks{0, 1, 2, 3});
  CHECK(farm.on("b") == Ranks{4, 5, 6, 7});
  CHECK(farm.on("c").empty());
}

TEST_CASE("nodes without a slot wait, but in need go to where fewest share a core") {
  Farm farm(8);
  farm.join("small", 2, 1);
  farm.join("large", 2, 4);
  farm.place();
  CHECK(farm.on("small").size() == 2);
  CHECK(farm.on("large").size() == 2);
  CHECK(farm.hosts.waiting().size() == 4);
  farm.place(true);
  CHECK(farm.hosts.waiting().empty());
  CHECK(farm.on("large").size() == 6);
  CHECK(farm.on("small").size() == 2);
}

TEST_CASE("a host gets no more nodes for its cores than a named number, even in need") {
  Farm farm(64);
  farm.join("one", 2, 1);
  farm.place(true);
  CHECK(farm.on("one").size() == kMostNodesOnCore);
  CHECK_FALSE(farm.hosts.has_room(farm.now_s));
}

TEST_CASE("a node that is started again comes back to its host, beside its neighbours") {
  Farm farm(8);
  farm.join("a", 4);
  farm.join("b", 4);
  farm.place();
  REQUIRE(farm.ended("b", 6, true));
  farm.want(6);
  farm.place();
  CHECK(farm.on("b") == Ranks{4, 5, 6, 7});
}

TEST_CASE("a silent host is lost with its nodes, and in need others take them") {
  Farm farm(8);
  farm.join("a", 4);
  farm.join("b", 4);
  farm.place();
  farm.now_s += kSilence_s - 0.1;
  farm.hosts.heard("a", farm.now_s);
  CHECK(farm.hosts.take_silent(farm.now_s).empty());
  farm.now_s += 0.1;
  const auto lost = farm.hosts.take_silent(farm.now_s);
  REQUIRE(lost.size() == 1);
  CHECK(lost[0].name == "b (process 77)");
  CHECK(lost[0].silent_s == Approx(kSilence_s));
  CHECK(lost[0].nodes == std::vector{Rank{4}, Rank{5}, Rank{6}, Rank{7}});
  CHECK_FALSE(farm.hosts.is_here("b"));
  for (const Rank rank : lost[0].nodes) farm.want(rank.value);
  farm.place();
  CHECK(farm.hosts.waiting().size() == 4);
  farm.place(true);
  CHECK(farm.on("a").size() == 8);
}

TEST_CASE("time in which the frontal heard nobody is no silence") {
  Farm farm(2);
  farm.join("a", 2);
  farm.now_s += 30;
  farm.hosts.was_held_up(30);
  CHECK(farm.hosts.take_silent(farm.now_s).empty());
}

TEST_CASE("a host on which processes fail to start gets none for a while") {
  Farm farm(1);
  farm.join("bad", 1);
  for (unsigned i = 0; i < kMaxFailedOnHost; ++i) {
    farm.place();
    REQUIRE(farm.ended("bad", 0, false));
    farm.want(0);
  }
  farm.place(true);
  CHECK(farm.on("bad").empty());
  CHECK(farm.hosts.slots(farm.now_s) == 0);
  farm.join("good", 1);
  farm.place();
  CHECK(farm.on("good") == Ranks{0});
  farm.now_s += kBarred_s;
  CHECK(farm.hosts.slots(farm.now_s) == 2);
}

TEST_CASE("a process that ends is told of once, and only by the host that has it") {
  Farm farm(2);
  farm.join("a", 1);
  farm.join("b", 1);
  farm.place();
  CHECK_FALSE(farm.ended("b", 0, true));
  CHECK_FALSE(farm.ended("nobody", 0, true));
  CHECK(farm.ended("a", 0, true));
  CHECK_FALSE(farm.ended("a", 0, true));
}

TEST_CASE("hosts of one machine reach each other's sockets, others don't") {
  Hosts hosts(kSilence_s);
  REQUIRE_FALSE(hosts.join("a", machine("a", 1, 1, "tag"), 1));
  REQUIRE_FALSE(hosts.join("b", machine("b", 1, 1, "tag"), 1));
  REQUIRE_FALSE(hosts.join("c", machine("c", 1, 1, "other"), 1));
  CHECK(hosts.are_local(1, 1));
  CHECK(hosts.are_local(1, 2));
  CHECK_FALSE(hosts.are_local(1, 3));
}

TEST_CASE("hosts that say nonsense can't join, nor twice over one connection") {
  Hosts hosts(kSilence_s);
  control::Join relative = machine("a", 1);
  relative.folder = "tmp";
  CHECK(hosts.join("a", relative, 1)->where == "folder");
  CHECK_FALSE(hosts.join("a", machine("a", 1), 1));
  CHECK(hosts.join("a", machine("a", 1), 1).has_value());
}

TEST_CASE("whatever joins and goes, each node is on one host or waits, and slots are kept") {
  const unsigned first = GENERATE(range(0u, 200u));
  INFO("seed " << first);
  std::mt19937 random(first);
  const auto dice = [&](std::uint32_t sides) {
    return static_cast<std::uint32_t>(random() % sides);
  };
  Farm farm(1u << dice(6));
  std::set<std::string> here;
  unsigned joined = 0;
  for (int turn = 0; turn < 60; ++turn) {
    farm.now_s += 0.1;
    for (const std::string& name : here) farm.hosts.heard(name, farm.now_s);
    const std::uint32_t rank = dice(farm.nodes);
    switch (dice(4)) {
      case 0: {
        const std::string name = "h" + std::to_string(joined++);
        farm.join(name, 1 + dice(8), 1 + dice(4));
        here.insert(name);
        break;
      }
      case 1:
        if (here.empty()) break;
        if (const auto lost = farm.hosts.leave(*here.begin(), farm.now_s)) {
          for (const Rank r : lost->nodes) farm.want(r.value);
        }
        here.erase(here.begin());
        break;
      case 2:
        if (const auto host = farm.hosts.host_of(Rank{rank})) {
          CHECK(farm.ended(farm.hosts.name_of(*host), rank, dice(2) == 0));
          farm.want(rank);
        }
        break;
      default: farm.place(dice(2) == 0); break;
    }
    std::set<std::uint32_t> seen;
    for (const auto& [host, ranks] : farm.hosts.nodes_by_host()) {
      for (const Rank r : ranks) CHECK(seen.insert(r.value).second);
    }
    for (const auto& process : farm.hosts.waiting()) CHECK(seen.insert(process.rank.value).second);
    CHECK(seen.size() == farm.nodes);
    for (const control::HostInfo& info : farm.hosts.list(farm.now_s)) {
      CHECK(info.nodes <= std::max(info.slots, info.cores * kMostNodesOnCore));
      CHECK(info.nodes == farm.on(info.host).size());
    }
  }
}
