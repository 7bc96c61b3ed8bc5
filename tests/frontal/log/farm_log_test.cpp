// What a farm tells of what happens on it.
#include "frontal/parts/farm_log.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "catch.hpp"
#include "frontal/jobs_farm.hpp"

using namespace graycube;
using namespace graycube::testing;

namespace {

using Kind = FarmEvent::Kind;

struct Farm : JobsFarm {
  std::vector<std::string> told() {
    std::vector<std::string> texts;
    for (const FarmEvent& e : log.take()) texts.push_back(e.text);
    return texts;
  }
};

}  // namespace

TEST_CASE("a job's way is told: accepted, begun, what it lost, and how it ended") {
  Farm farm;
  farm.jobs.set_time({10, 1000});
  farm.submit();
  farm.load_next();
  farm.jobs.nodes_were_lost({{Rank{1}, "node 1 (process 77)", "killed by signal 9", 0.14}});
  farm.jobs.set_time({12.5, 1002.5});
  farm.jobs.cancel(1);
  CHECK(farm.told() == std::vector<std::string>{
                           "job 1: submitted, \"a scene\"", "job 1: begins",
                           "job 1: lost node 1 (process 77): killed by signal 9, noticed after "
                           "0.1 s; 0 tiles again, epoch 2",
                           "job 1: cancelled after 2.5 s: cancelled"});
  // A node that no job misses is told of, too, and so is the process that takes its place.
  farm.jobs.nodes_were_lost({{Rank{0}, "node 0", "ended with status 1", 0}});
  for (const std::uint32_t rank : {0u, 1u, 0u}) farm.log.node_is_here(Rank{rank}, 90 + rank);
  CHECK(farm.told() ==
        std::vector<std::string>{"lost node 0: ended with status 1, noticed after 0.0 s",
                                 "node 0: process 90 has taken its place",
                                 "node 1: process 91 has taken its place"});
}

TEST_CASE("submissions that are refused are told of with the reason") {
  Farm farm;
  control::JobOptions serial;
  serial.algorithm = Algorithm::kSerial;
  CHECK(refused(farm.try_submit({"a \"scene\"", serial, {}})) == FailureCode::kBadRequest);
  CHECK(farm.told() == std::vector<std::string>{
                           "refused: a submission of \"a 'scene'\": --algorithm: serial runs in "
                           "the command itself, without a farm"});
}

TEST_CASE("of nodes that are lost with one process each is told, and of their hosts") {
  Farm farm;
  farm.jobs.set_time({10, 1000});
  farm.submit();
  farm.load_next();
  farm.told();
  farm.jobs.nodes_were_lost({{Rank{0}, "node 0", "died", 0.1}, {Rank{1}, "node 1", "died", 0.1}});
  farm.log.node_has_host("node 1", "can't be started (why): it runs in node 0's process");
  CHECK(farm.told() == std::vector<std::string>{
                           "job 1: lost node 0: died, noticed after 0.1 s; 0 tiles again, epoch 2",
                           "job 1: lost node 1: died, noticed after 0.1 s; 0 tiles again, epoch 2",
                           "node 1 can't be started (why): it runs in node 0's process"});
}

TEST_CASE("of refusals that come fast only the number is told") {
  FarmLog log;
  log.set_time(1000);
  for (unsigned i = 0; i < kMaxRefusalsTold + 5; ++i) log.hello_is_refused(3, "no secret");
  CHECK(log.take().size() == kMaxRefusalsTold);
  log.set_time(1000 + kRefusalSpan_s);
  const auto later = log.take();
  REQUIRE(later.size() == 1);
  CHECK(later.front().text == "5 more refusals like the last ones");
  log.stranger_is_refused({"10.0.0.5", RefusalReason::kWrongKey});
  log.stranger_is_refused({"", RefusalReason::kNotZmq});
  log.crowd_is_refused(1, 1024);
  const auto last = log.take();
  REQUIRE(last.size() == 3);
  CHECK(last[0].text ==
        "refused: a connection from 10.0.0.5 without the farm's key: it has another key");
  CHECK(last[1].text == "refused: a connection without the farm's key: it doesn't speak ZeroMQ");
  CHECK(last[2].text == "refused: 1 connection beyond the 1024 that clients may have");
}

TEST_CASE("events that nobody takes are dropped, the oldest first, and long names are cut") {
  FarmLog log;
  control::JobInfo job;
  job.scene = std::string(kMaxNameLogged - 1, 'x') + "äy";
  for (job.job = 1; job.job <= kMaxUntakenEvents + 7; ++job.job) log.job_is_accepted(job, false);
  const auto events = log.take();
  REQUIRE(events.size() == kMaxUntakenEvents);
  CHECK(events.front().job == 8);
  CHECK(events.front().text ==
        "job 8: submitted, \"" + job.scene.substr(0, kMaxNameLogged - 1) + "…\"");
}

TEST_CASE("a job that doesn't get on is told of now and then, with what it waits for") {
  Farm farm;
  farm.jobs.set_time({100, 1000});
  farm.submit();
  farm.jobs.take_work();
  farm.jobs.check_time();
  farm.told();
  std::vector<double> told_at_s;
  for (double now_s = 100; now_s <= 400; now_s += 1) {
    farm.jobs.set_time({now_s, 900 + now_s});
    farm.jobs.check_time();
    for (const FarmEvent& e : farm.log.take()) {
      CHECK(e.kind == Kind::kJobStands);
      CHECK(e.text.starts_with("job 1: doesn't get on: waits for its scene to be read and cut"));
      told_at_s.push_back(now_s - 100);
    }
  }
  CHECK(told_at_s == std::vector<double>{30, 60, 120, 240});
}

TEST_CASE("what is told is counted: jobs by their ends, losses, epochs, refusals") {
  Farm farm;
  farm.jobs.set_time({10, 1000});
  farm.submit();
  farm.submit();
  farm.try_submit({"a scene", {.algorithm = Algorithm::kSerial}, {}});
  farm.load_next();
  farm.jobs.nodes_were_lost({{Rank{1}, "node 1", "killed by signal 9", 0.14}});
  farm.jobs.cancel(1);
  farm.jobs.cancel(2);
  farm.jobs.nodes_were_lost({{Rank{0}, "node 0", "ended with status 1", 0}});
  for (unsigned i = 0; i < 2 * kMaxRefusalsTold; ++i) farm.log.hello_is_refused(i, "a stranger");
  for (int i = 0; i < 3; ++i) farm.log.stranger_is_refused({"192.0.2.1", RefusalReason::kNoKey});
  const control::FarmCounts& c = farm.log.counts();
  CHECK(c.jobs_accepted == 2);
  CHECK(c.jobs_cancelled == 2);
  CHECK(c.jobs_done + c.jobs_failed == 0);
  CHECK(c.nodes_lost == 2);
  CHECK(c.epochs == 1);
  CHECK(c.refused_submissions == 1);
  CHECK(c.refused_nodes == 2 * kMaxRefusalsTold);
  CHECK(c.refused_clients == 3);
}

TEST_CASE("nodes' reports are added up, and peaks are those of the last job") {
  FarmLog log;
  const control::NodeStats a{.busy_s = 1.5, .queue_peak = 7, .primary = 3, .ray_bytes = 10};
  const control::NodeStats b{.busy_s = 0.25, .queue_peak = 9, .primary = 4, .ray_bytes = 20};
  const control::NodeStats both[] = {a, b};
  log.nodes_reported(both, 100);
  CHECK(log.counts().last_queue_peak == 9);
  log.nodes_reported(std::span(&a, 1), 100);
  CHECK(log.counts().primary == 10);
  CHECK(log.counts().busy_s == 3.25);
  CHECK(log.counts().ray_bytes == 40);
  CHECK(log.counts().slice_bytes == 200);
  CHECK(log.counts().slice_batches == 3);
  CHECK(log.counts().last_queue_peak == 7);
}
