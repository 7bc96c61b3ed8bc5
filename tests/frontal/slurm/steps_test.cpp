// When hosts of an allocation are asked for, and asked for again.
#include "frontal/slurm/steps.hpp"

#include "catch.hpp"
#include "frontal/slurm/engine.hpp"

using namespace graycube::slurm;

namespace {

using Names = std::vector<std::string>;
const std::set<std::string> kNobody;

}  // namespace

TEST_CASE("each host of an allocation gets one step") {
  Steps steps({"n1", "n2"}, false, 100);
  CHECK(steps.take_starts(kNobody, 100) == Names{"n1", "n2"});
  CHECK(steps.take_starts(kNobody, 200).empty());
}

TEST_CASE("a step that ends is started again, after longer and longer pauses") {
  Steps steps({"n1"}, false, 100);
  double now_s = 100, pause_s = kFirstPause_s;
  for (int failure = 0; failure < 12; ++failure) {
    REQUIRE(steps.take_starts(kNobody, now_s) == Names{"n1"});
    const std::string told = steps.ended("n1", "exited with status 1", now_s);
    CHECK(told.find("host n1") == 0);
    CHECK(told.find("exited with status 1") != std::string::npos);
    CHECK(steps.take_starts(kNobody, now_s + pause_s - 0.01).empty());
    now_s += pause_s;
    pause_s = std::min(kLongestPause_s, 2 * pause_s);
  }
}

TEST_CASE("pauses begin anew once a host has joined, and each host has its own") {
  Steps steps({"n1", "n2"}, false, 100);
  for (int failure = 0; failure < 5; ++failure) {
    steps.take_starts(kNobody, 100 + 100 * failure);
    steps.ended("n1", "failed", 100 + 100 * failure);
  }
  REQUIRE(steps.take_starts(kNobody, 1000) == Names{"n1"});
  CHECK(steps.take_ends({"n1", "n2"}, 1001).empty());
  steps.ended("n1", "failed", 1002);
  steps.ended("n2", "failed", 1002);
  CHECK(steps.take_starts(kNobody, 1002 + kFirstPause_s) == Names{"n1", "n2"});
}

TEST_CASE("a step that brings no host is ended, and so is one whose host stays lost") {
  Steps steps({"n1"}, false, 100);
  steps.take_starts(kNobody, 100);
  CHECK(steps.take_ends(kNobody, 100 + kJoinPatience_s).empty());
  CHECK(steps.take_ends(kNobody, 101 + kJoinPatience_s) == Names{"n1"});
  CHECK(steps.take_ends(kNobody, 102 + kJoinPatience_s).empty());
  steps.ended("n1", "killed by signal 9", 200);
  REQUIRE(steps.take_starts(kNobody, 300) == Names{"n1"});
  CHECK(steps.take_ends({"n1"}, 400).empty());
  CHECK(steps.take_ends(kNobody, 400 + kJoinPatience_s).empty());
  CHECK(steps.take_ends(kNobody, 401 + kJoinPatience_s) == Names{"n1"});
}

TEST_CASE("hosts of an earlier frontal may come back before steps are started for them") {
  Steps steps({"n1", "n2"}, true, 100);
  CHECK(steps.take_starts(kNobody, 100).empty());
  CHECK(steps.take_starts({"n2"}, 100 + kComeBack_s) == Names{"n1"});
}

TEST_CASE("hosts of an allocation are read with their CPUs, and nothing else is") {
  CHECK(hosts_of("n1:4,n2:2") == Hosts{{"n1", 4}, {"n2", 2}});
  for (const char* wrong : {"", "n1", "n1:", ":4", "n1:0", "n1:x", "n1:4x", "n1:4,,n2:4", ","}) {
    INFO(wrong);
    CHECK_FALSE(hosts_of(wrong));
  }
}

TEST_CASE("a step of Slurm never waits, never ends others, and has no secret on its command line") {
  const StepSetting setting{"/opt/graycube", "tcp://10.0.0.1:7411", "5ec2e7", 4};
  std::string line;
  for (const std::string& word : step_command(setting, "n3", 16)) line += word + ' ';
  for (const char* needed :
       {"--overlap", "--immediate=", "--kill-on-bad-exit=0", "--no-kill", "--nodelist=n3",
        "--cpus-per-task=16", "join tcp://10.0.0.1:7411", "--slots 4", "--name n3", "--key -"}) {
    INFO(needed);
    CHECK(line.find(needed) != std::string::npos);
  }
  CHECK(line.find(setting.key_text) == std::string::npos);
}
