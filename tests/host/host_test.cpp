// A host's brain: what it does when the frontal speaks, and when it doesn't.
#include "host/host.hpp"

#include "catch.hpp"

using namespace graycube;

namespace {

struct Machine {
  double now_s = 1000;
  Host host{control::Join{.host = "n1", .folder = "/tmp/x", .slots = 4}, now_s};

  /// The messages of a type that it sends.
  template <typename M>
  std::vector<M> sent() {
    std::vector<M> sent;
    for (const ControlMessage& m : host.take_outgoing()) {
      if (const auto* of_type = std::get_if<M>(&m)) sent.push_back(*of_type);
    }
    return sent;
  }
  void say(const ControlMessage& m) { host.on_message(m, now_s); }
  void join() {
    say(control::Joined{5555, 2, 500, 2000});
    REQUIRE(host.state() == Host::State::kJoined);
    host.take_outgoing();
  }
  /// Time passes in steps, as it does for a process that runs.
  void pass(double seconds, bool has_nodes = true) {
    for (double passed = 0; passed < seconds; passed += 0.05) {
      now_s += 0.05;
      host.on_time(now_s, has_nodes);
    }
  }
};

}  // namespace

TEST_CASE("a host asks to join at once, and runs what it is told to") {
  Machine m;
  CHECK(m.sent<control::Join>().size() == 1);
  m.say(control::RunNodes{{{0, 1}}});
  CHECK(m.host.take_starts().empty());  // it hasn't joined
  m.join();
  m.say(control::RunNodes{{{2, 7}, {3, 8}}});
  CHECK(m.host.take_starts() == std::vector<NodeStart>{{Rank{2}, 7}, {Rank{3}, 8}});
  m.say(control::EndNode{3, 8});
  CHECK(m.host.take_kills() == std::vector<NodeStart>{{Rank{3}, 8}});
}

TEST_CASE("a host reports how nodes end, and answers pings with what is stopped") {
  Machine m;
  m.join();
  m.host.on_exit({{Rank{2}, 7}, "killed by signal 9"});
  m.host.on_exit({{Rank{3}, 8}, "no memory", false});
  const auto ended = m.sent<control::NodeEnded>();
  REQUIRE(ended.size() == 2);
  CHECK(ended[0] == control::NodeEnded{2, 7, "killed by signal 9", true});
  CHECK_FALSE(ended[1].was_started);
  m.say(control::Ping{41});
  CHECK(m.host.take_ping() == 41);
  CHECK_FALSE(m.host.take_ping());
  m.host.answer_ping(41, {3});
  CHECK(m.sent<control::Alive>() == std::vector{control::Alive{41, {3}}});
}

TEST_CASE("when the frontal falls silent nodes are killed, and another frontal is looked for") {
  Machine m;
  m.join();
  m.pass(1.8);
  m.say(control::Ping{1});
  m.pass(1.9);
  CHECK(m.host.state() == Host::State::kJoined);
  CHECK_FALSE(m.host.take_kill_all());
  m.pass(0.2);
  CHECK(m.host.state() == Host::State::kJoining);
  CHECK(m.host.take_kill_all());
  CHECK(m.host.take_reconnect());
  CHECK(m.sent<control::Join>().size() == 1);
  m.join();
  m.say(control::RunNodes{{{0, 9}}});
  CHECK(m.host.take_starts().size() == 1);
}

TEST_CASE("a host ends when no frontal comes back") {
  Machine m;
  m.join();
  m.pass(2 + kRejoin_s - 0.2);
  CHECK(m.host.state() == Host::State::kJoining);
  m.pass(0.5);
  CHECK(m.host.state() == Host::State::kOver);
  CHECK(m.host.failure().find("silent") != std::string::npos);
}

TEST_CASE("a host waits longer for a frontal that was never there, and asks again") {
  Machine m;
  m.pass(kFirstJoin_s - 0.2, false);
  CHECK(m.host.state() == Host::State::kJoining);
  CHECK(m.host.take_reconnect());
  m.pass(0.5, false);
  CHECK(m.host.state() == Host::State::kOver);
  CHECK(m.host.failure() == "nobody answers");
}

TEST_CASE("time in which the host itself didn't run is no silence of the frontal") {
  Machine m;
  m.join();
  m.now_s += 60;
  m.host.on_time(m.now_s, true);
  CHECK(m.host.state() == Host::State::kJoined);
}

TEST_CASE("a host that the frontal takes for lost begins anew") {
  Machine m;
  m.join();
  m.say(control::Failed{0, FailureCode::kBadRequest, {{"", "taken for lost"}}, {}});
  CHECK(m.host.state() == Host::State::kJoining);
  CHECK(m.host.take_kill_all());
  CHECK(m.sent<control::Join>().size() == 1);
}

TEST_CASE("a host that is refused says why") {
  Machine m;
  m.say(control::Failed{0, FailureCode::kBadRequest, {{"version", "of another Graycube"}}, {}});
  CHECK(m.host.state() == Host::State::kOver);
  CHECK(m.host.failure() == "version: of another Graycube");
}

TEST_CASE("at the farm's end nodes have a while to end by themselves") {
  Machine m;
  m.join();
  m.say(control::Shutdown{});
  m.pass(1);
  CHECK(m.host.state() == Host::State::kEnding);
  CHECK_FALSE(m.host.take_kill_all());
  m.host.on_time(m.now_s, false);
  CHECK(m.host.state() == Host::State::kOver);
  CHECK(m.host.failure().empty());

  Machine slow;
  slow.join();
  slow.say(control::Shutdown{});
  slow.pass(kHostGrace_s + 0.1);
  CHECK(slow.host.take_kill_all());
}

TEST_CASE("a host that is asked to leave says so and kills its nodes") {
  Machine m;
  m.join();
  m.host.leave(m.now_s);
  CHECK(m.sent<control::Leave>().size() == 1);
  CHECK(m.host.take_kill_all());
  m.host.on_time(m.now_s, false);
  CHECK(m.host.state() == Host::State::kOver);
  CHECK(m.host.failure().empty());
}
