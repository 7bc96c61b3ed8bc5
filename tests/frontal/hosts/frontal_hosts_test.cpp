// A frontal whose nodes run on hosts: from the first that joins to the loss of one.
#include <map>

#include "catch.hpp"
#include "formats/graycube/write_scene.hpp"
#include "frontal/frontal.hpp"
#include "proto/control.hpp"
#include "trace/corner_scene.hpp"

using namespace graycube;

namespace {

MessageView view_of(std::string_view text, std::string_view payload = {}) {
  MessageView view;
  view.frame = std::as_bytes(std::span(text));
  const auto bytes = std::as_bytes(std::span(payload));
  if (!bytes.empty()) view.payload = Bytes(bytes.begin(), bytes.end());
  return view;
}

constexpr double kSilence_s = 2, kSettled_s = 4;

/// A frontal, and hosts whose nodes say hello as soon as they are told to run.
struct Farm {
  std::unique_ptr<JobStore> store = make_memory_store();
  Frontal frontal;
  double now_s = 100;
  std::map<PeerId, std::string> names;  // of hosts that answer pings
  std::map<std::uint32_t, std::pair<std::string, control::Welcome>> welcomes;
  std::vector<ControlMessage> answers;  // to the client
  std::map<PeerId, std::vector<ControlMessage>> to_hosts;
  bool nodes_start = true;

  explicit Farm(std::uint32_t most)
      : frontal({.cube = *Hypercube::of_size(most),
                 .most_nodes_on_hosts = most,
                 .nodes_port = 5555,
                 .heartbeat_s = 0.5,
                 .silence_s = kSilence_s,
                 .version = "test"},
                *store) {
    frontal.on_time({now_s, now_s});
  }

  void say(const PeerId& host, const ControlMessage& m) {
    const std::string text = encode(m);
    frontal.on_host_message(host, view_of(text));
    work();
  }
  void join(const std::string& host, std::uint32_t slots, const std::string& tag = "") {
    names[host] = host;
    say(host,
        control::Join{host, tag.empty() ? host : tag, "/tmp/" + host, 4, 1, slots, 50, "test"});
  }
  void ask(const ControlMessage& m) {
    const std::string text = encode(m);
    frontal.on_message("client", view_of(text));
    work();
  }
  std::uint32_t submit() {
    const std::string text = encode(control::Submit{.scene_name = "s"});
    const std::string scene = write_scene_text(testing::corner_scene());
    frontal.on_message("client", view_of(text, scene));
    work();
    return last<control::Accepted>().job;
  }
  template <typename M>
  M last() {
    for (auto m = answers.rbegin(); m != answers.rend(); ++m) {
      if (const auto* of_type = std::get_if<M>(&*m)) return *of_type;
    }
    FAIL("no such answer");
    return {};
  }
  void pass(double seconds) {
    for (double passed = 0; passed < seconds; passed += 0.1) {
      now_s += 0.1;
      frontal.on_time({now_s, now_s});
      work();
    }
  }
  control::NodeList nodes() {
    ask(control::Nodes{});
    return last<control::NodeList>();
  }
  std::map<std::string, std::vector<std::uint32_t>> ranks_by_host() {
    std::map<std::string, std::vector<std::uint32_t>> ranks;
    for (const control::NodeInfo& node : nodes().nodes) ranks[node.host].push_back(node.rank);
    return ranks;
  }
  /// Delivers what the frontal sends, until it sends nothing more.
  void work() {
    for (auto sent = frontal.take_outgoing(); !sent.empty(); sent = frontal.take_outgoing()) {
      for (const auto& [to, message] : sent) {
        const auto decoded = decode(message.text());
        const auto* m = std::get_if<ControlMessage>(&decoded);
        REQUIRE(m != nullptr);
        if (to == "client") {
          answers.push_back(*m);
        } else if (names.contains(to)) {
          on_host(to, *m);
        } else if (const auto* welcome = std::get_if<control::Welcome>(m)) {
          welcomes[static_cast<std::uint32_t>(std::stoul(to.substr(to.find('#') + 1)))] = {
              to, *welcome};
        }
      }
    }
  }
  void on_host(const PeerId& host, const ControlMessage& m) {
    to_hosts[host].push_back(m);
    const auto tell = [&](const PeerId& from, const ControlMessage& told, bool is_host) {
      const std::string text = encode(told);
      const MessageView view = view_of(text);
      is_host ? frontal.on_host_message(from, view) : frontal.on_message(from, view);
    };
    if (const auto* ping = std::get_if<control::Ping>(&m))
      tell(host, control::Alive{ping->sequence, {}}, true);
    const auto* run = std::get_if<control::RunNodes>(&m);
    if (run == nullptr) return;
    for (const auto& [rank, incarnation] : run->nodes) {
      if (!nodes_start) {
        tell(host, control::NodeEnded{rank, incarnation, "no memory", false}, true);
        continue;
      }
      const std::string name = std::to_string(rank);
      tell(host + "/" + std::to_string(incarnation) + "#" + name,
           control::Hello{rank, 1000 + rank, incarnation, "ipc:///tmp/" + host + "/" + name, 1,
                          "test", "tcp://" + host + ":" + name},
           false);
    }
  }
};

using Ranks = std::vector<std::uint32_t>;

}  // namespace

TEST_CASE("a farm waits for hosts, and deals its nodes when they have room for all") {
  Farm farm(8);
  farm.pass(60);
  CHECK(farm.welcomes.empty());
  farm.join("a", 4);
  farm.join("b", 4);
  CHECK(farm.to_hosts["a"].size() >= 2);
  CHECK(std::holds_alternative<control::Joined>(farm.to_hosts["a"].front()));
  CHECK(farm.ranks_by_host() ==
        std::map<std::string, Ranks>{{"a", {0, 1, 2, 3}}, {"b", {4, 5, 6, 7}}});
  CHECK(farm.welcomes.size() == 8);
  const control::NodeList list = farm.nodes();
  REQUIRE(list.hosts.size() == 2);
  CHECK(list.hosts[1].nodes == 4);
}

TEST_CASE("nodes of a host are told of local sockets, others of TCP ports") {
  Farm farm(4);
  farm.join("a", 2);
  farm.join("b", 2);
  REQUIRE(farm.welcomes.size() == 4);
  CHECK(farm.welcomes[0].second.endpoints ==
        std::vector<std::string>{"ipc:///tmp/a/0", "ipc:///tmp/a/1", "tcp://b:2", "tcp://b:3"});
  CHECK(farm.welcomes[3].second.endpoints ==
        std::vector<std::string>{"tcp://a:0", "tcp://a:1", "ipc:///tmp/b/2", "ipc:///tmp/b/3"});
}

TEST_CASE("hosts on one machine use its sockets") {
  Farm farm(2);
  farm.join("a", 1, "machine");
  farm.join("b", 1, "machine");
  CHECK(farm.welcomes[0].second.endpoints ==
        std::vector<std::string>{"ipc:///tmp/a/0", "ipc:///tmp/b/1"});
}

TEST_CASE("with too few hosts the farm is as large as they allow, and grows with others") {
  Farm farm(8);
  farm.join("a", 3);
  farm.pass(kSettled_s);
  CHECK(farm.ranks_by_host() == std::map<std::string, Ranks>{{"a", {0, 1}}});
  farm.join("b", 2);
  farm.join("c", 2);
  farm.pass(kSettled_s);
  CHECK(farm.ranks_by_host() == std::map<std::string, Ranks>{{"a", {0, 1}}, {"b", {2, 3}}});
  farm.ask(control::Farm{});
  CHECK(farm.last<control::FarmInfo>().nodes == 4);
  CHECK(farm.last<control::FarmInfo>().nodes_here == 4);
}

TEST_CASE("no job begins before the hosts are there, and one that is on keeps the farm's size") {
  Farm farm(4);
  farm.frontal.on_time({farm.now_s, farm.now_s});
  const std::uint32_t job = farm.submit();
  CHECK_FALSE(farm.frontal.take_work());
  farm.join("a", 2);
  farm.join("b", 2);
  const auto work = farm.frontal.take_work();
  REQUIRE(work);
  CHECK(work->job == job);
  CHECK(work->cube.nodes() == 4);
  farm.say("b", control::Leave{});
  farm.names.erase("b");
  farm.pass(kSettled_s);
  CHECK(farm.ranks_by_host() == std::map<std::string, Ranks>{{"a", {0, 1, 2, 3}}});
  farm.ask(control::Cancel{job});
  farm.pass(kSettled_s);
  CHECK(farm.ranks_by_host() == std::map<std::string, Ranks>{{"a", {0, 1}}});
}

TEST_CASE("a host that falls silent is lost with all its nodes at once") {
  Farm farm(4);
  farm.join("a", 2);
  farm.join("b", 2);
  farm.submit();
  REQUIRE(farm.frontal.take_work());
  farm.names.erase("b");
  farm.frontal.take_events();
  farm.pass(kSilence_s + 0.5);
  CHECK(farm.ranks_by_host() == std::map<std::string, Ranks>{{"a", {0, 1, 2, 3}}});
  std::string log;
  for (const FarmEvent& e : farm.frontal.take_events()) log += e.text + "\n";
  CHECK(log.find("host b (process 50) fell silent; it had 2 nodes") != std::string::npos);
}

TEST_CASE("a late message of a host that was lost is refused, so that it joins anew") {
  Farm farm(2);
  farm.join("a", 2);
  farm.names.erase("a");
  farm.pass(kSilence_s + 0.5);
  farm.names["a"] = "a";
  farm.to_hosts.clear();
  farm.say("a", control::Alive{1, {}});
  REQUIRE_FALSE(farm.to_hosts["a"].empty());
  CHECK(std::holds_alternative<control::Failed>(farm.to_hosts["a"].front()));
}

TEST_CASE("hosts on which nothing starts get nodes no longer, and the farm lives on") {
  Farm farm(2);
  farm.nodes_start = false;
  farm.join("bad", 2);
  farm.pass(5);
  CHECK_FALSE(farm.frontal.is_going_down());
  farm.nodes_start = true;
  farm.join("good", 2);
  farm.pass(kSettled_s);
  CHECK(farm.ranks_by_host() == std::map<std::string, Ranks>{{"good", {0, 1}}});
}

TEST_CASE(
    "a host of another version is refused, and so are hosts where a farm runs its own nodes") {
  Farm farm(2);
  farm.names["old"] = "old";
  farm.say("old", control::Join{"old", "t", "/tmp/x", 1, 1, 1, 1, "0.0.1"});
  REQUIRE(farm.to_hosts["old"].size() == 1);
  const auto* failed = std::get_if<control::Failed>(&farm.to_hosts["old"].front());
  REQUIRE(failed != nullptr);
  CHECK(failed->errors[0].where == "version");

  auto store = make_memory_store();
  Frontal local({.cube = *Hypercube::of_size(2), .version = "test"}, *store);
  const std::string text = encode(control::Join{.host = "x", .folder = "/tmp"});
  local.on_host_message("x", view_of(text));
  const auto sent = local.take_outgoing();
  REQUIRE(sent.size() == 1);
  CHECK(sent[0].message.text().find("runs its nodes itself") != std::string::npos);
  CHECK(local.take_starts().size() == 2);
}

TEST_CASE("what a host may not send changes nothing") {
  Farm farm(2);
  farm.join("a", 2);
  farm.to_hosts.clear();
  farm.say("a", control::Down{});
  CHECK_FALSE(farm.frontal.is_going_down());
  CHECK(std::holds_alternative<control::Failed>(farm.to_hosts["a"].front()));
  const std::string junk = "{";
  farm.frontal.on_host_message("a", view_of(junk));
  farm.work();
  CHECK(farm.ranks_by_host() == std::map<std::string, Ranks>{{"a", {0, 1}}});
}
