// Which job is on, which clients hear of it, and how jobs end.
#include "frontal/jobs.hpp"

#include "catch.hpp"
#include "frontal/jobs_farm.hpp"

using namespace graycube;
using namespace graycube::testing;

using Farm = JobsFarm;

TEST_CASE("one job is on at a time, the others wait in order, and all are listed") {
  Farm farm;
  for (std::uint32_t i = 1; i <= 3; ++i) CHECK(farm.submit() == i);
  CHECK(farm.jobs.take_work()->job == 1);
  CHECK_FALSE(farm.jobs.take_work());
  CHECK(farm.state_of(1) == JobState::kLoading);
  CHECK(farm.state_of(2) == JobState::kQueued);
  CHECK(refused(farm.jobs.status(4)) == FailureCode::kUnknownJob);
  farm.jobs.cancel(1);
  CHECK(farm.jobs.take_work()->job == 2);
  const auto listed = granted<control::Jobs>(farm.jobs.list()).jobs;
  REQUIRE(listed.size() == 3);
  for (std::uint32_t i = 0; i < 3; ++i) CHECK(listed[i].job == i + 1);
  CHECK(listed[0].state == JobState::kCancelled);
}

TEST_CASE("what is on is listed however many jobs wait behind it") {
  Farm farm;
  for (std::size_t i = 0; i < kMaxJobsListed + 9; ++i) farm.submit();
  CHECK(farm.jobs.take_work()->job == 1);
  const auto listed = granted<control::Jobs>(farm.jobs.list()).jobs;
  REQUIRE(listed.size() == kMaxJobsListed);
  CHECK(listed.front().job == 1);
  CHECK(listed.back().job == kMaxJobsListed);
}

TEST_CASE(
    "a scene that can't be read ends its job as bad input, and watchers "
    "are told") {
  Farm farm;
  const std::uint32_t job = farm.submit({}, "no scene");
  CHECK(granted<control::Progress>(farm.jobs.watch("a", job)).state == JobState::kQueued);
  farm.load_next();
  const auto failed = SentPost(farm.post).told<control::Failed>("a");
  REQUIRE(failed.size() == 1);
  CHECK(failed.front().code == FailureCode::kBadInput);
  CHECK(farm.state_of(job) == JobState::kFailed);
  // A client that asks later hears that it failed.
  CHECK(granted<control::Failed>(farm.jobs.watch("b", job)).code == FailureCode::kFailed);
}

TEST_CASE("a job that is cancelled while it is prepared stays cancelled") {
  Farm farm;
  const std::uint32_t job = farm.submit();
  const auto work = farm.jobs.take_work();
  CHECK(granted<control::JobInfo>(farm.jobs.cancel(job)).state == JobState::kCancelled);
  farm.jobs.give_result(prepare(*work, [] { return 0.0; }));
  if (farm.jobs.waits_to_be_loaded()) farm.jobs.load();
  CHECK(farm.state_of(job) == JobState::kCancelled);
  CHECK(SentPost(farm.post).all.empty());
  CHECK(refused(farm.jobs.cancel(job)) == FailureCode::kBadRequest);
  CHECK(refused(farm.jobs.cancel(9)) == FailureCode::kUnknownJob);
}

TEST_CASE("a job that waits can be cancelled, and those who watch it hear of it") {
  Farm farm;
  farm.submit();
  const std::uint32_t second = farm.submit();
  farm.load_next();
  SentPost(farm.post);
  farm.jobs.watch("a", second);
  CHECK(granted<control::JobInfo>(farm.jobs.cancel(second)).message == "cancelled");
  CHECK(SentPost(farm.post).told<control::Failed>("a").front().code == FailureCode::kCancelled);
  CHECK(farm.jobs.keep_nodes_busy());
}

TEST_CASE("a lost node sends a job that is loaded into its next epoch, and leaves others alone") {
  Farm farm;
  const std::uint32_t job = farm.submit();
  const auto work = farm.jobs.take_work();
  const NodeLoss loss{Rank{1}, "node 1", "died", 0.1};
  farm.jobs.nodes_were_lost({loss});
  CHECK(farm.state_of(job) == JobState::kLoading);
  farm.jobs.give_result(prepare(*work, [] { return 0.0; }));
  REQUIRE(farm.jobs.waits_to_be_loaded());
  farm.jobs.load();
  SentPost(farm.post);
  farm.jobs.nodes_were_lost({loss});
  CHECK(SentPost(farm.post).names() ==
        std::vector<std::string>{"node 0: prepare", "node 1: prepare"});
  // Only the process that takes the node's place needs its slice.
  REQUIRE(farm.jobs.waits_to_be_loaded());
  farm.jobs.load();
  CHECK(SentPost(farm.post).names() == std::vector<std::string>{"node 1: load"});
}

TEST_CASE("nodes that are lost with one process cost one epoch, and a place for one costs none") {
  Farm farm;
  const std::uint32_t job = farm.submit();
  farm.load_next();
  SentPost(farm.post);
  farm.jobs.nodes_were_lost({{Rank{0}, "node 0", "died", 0.1}, {Rank{1}, "node 1", "died", 0.1}});
  CHECK(SentPost(farm.post).names() ==
        std::vector<std::string>{"node 0: prepare", "node 1: prepare"});
  farm.jobs.node_has_host({Rank{1}, "node 1", "can't be started", 0});
  CHECK(SentPost(farm.post).all.empty());
  farm.jobs.load();
  CHECK(SentPost(farm.post).names() == std::vector<std::string>{"node 0: load", "node 1: load"});
  CHECK(farm.state_of(job) == JobState::kBuilding);
}

TEST_CASE("a slice that brings one process after another down fails its job") {
  Farm farm;
  const std::uint32_t job = farm.submit();
  farm.load_next();
  for (std::uint32_t loss = 1; loss <= kDefaultRetries + 1; ++loss) {
    CHECK(farm.state_of(job) == JobState::kBuilding);
    farm.jobs.nodes_were_lost({{Rank{1}, "node 1", "died", 0.1}});
    if (farm.jobs.waits_to_be_loaded()) farm.jobs.load();
  }
  CHECK(farm.state_of(job) == JobState::kFailed);
  CHECK(granted<control::JobInfo>(farm.jobs.status(job)).message ==
        "node 1: died; that was loss 4 of the job, and each time its part of the scene was being "
        "subdivided");
}

TEST_CASE("a job whose time is up has failed for that reason") {
  Farm farm;
  farm.jobs.set_time({100, 0});
  const std::uint32_t job = farm.submit({.timeout_s = 5});
  farm.jobs.take_work();
  farm.jobs.watch("a", job);
  farm.jobs.set_time({105, 0});
  farm.jobs.check_time();
  CHECK(farm.state_of(job) == JobState::kLoading);
  farm.jobs.set_time({106, 0});
  farm.jobs.check_time();
  CHECK(SentPost(farm.post).told<control::Failed>("a").front().code == FailureCode::kTimeout);
}

TEST_CASE("a picture is there when its job is done, and not before") {
  Farm farm;
  const std::uint32_t job = farm.submit({.algorithm = Algorithm::kRoth});
  CHECK(refused(farm.jobs.fetch({job, 0, 1, 0})) == FailureCode::kNotDone);
  CHECK(refused(farm.jobs.fetch({job + 1, 0, 1, 0})) == FailureCode::kUnknownJob);
}

TEST_CASE("when the farm stops all jobs are cancelled, and no other begins") {
  Farm farm;
  for (int i = 0; i < 3; ++i) farm.submit();
  farm.load_next();
  farm.jobs.stop();
  for (std::uint32_t job = 1; job <= 3; ++job) CHECK(farm.state_of(job) == JobState::kCancelled);
  CHECK_FALSE(farm.jobs.take_work());
}

TEST_CASE("numbers go on where an earlier frontal stopped") {
  class LeftOver : public JobStore {
    void add(const AcceptedJob&, std::span<const std::byte>) override {}
    std::optional<KeyedJob> find_key(const std::string&) override { return std::nullopt; }
    void keep(const EndedJob&, Picture) override {}
    const Picture* picture(std::uint32_t) override { return nullptr; }
    std::vector<EndedJob> recover() override {
      EndedJob job;
      job.info.job = 17;
      job.info.state = JobState::kDone;
      return {job};
    }
  } store;
  const FrontalOptions options{.cube = *Hypercube::of_size(2), .version = "test"};
  Post post = post_of(2);
  FarmLog log;
  Jobs jobs(options, store, post, log);
  CHECK(granted<control::Accepted>(jobs.submit({}).value()).job == 18);
  CHECK(refused(jobs.fetch({17, 0, 1, 0})) == FailureCode::kFailed);
}

TEST_CASE(
    "an internal error ends the job that is on, by its scene's name, and the next one comes") {
  Farm farm;
  CHECK_FALSE(farm.jobs.fail_internally("nobody's fault"));
  const std::uint32_t first = farm.submit(), second = farm.submit();
  farm.load_next();
  CHECK(farm.jobs.fail_internally("a check failed"));
  CHECK(farm.state_of(first) == JobState::kFailed);
  CHECK(granted<control::JobInfo>(farm.jobs.status(first)).message ==
        "a scene: internal error: a check failed");
  CHECK(farm.jobs.take_work()->job == second);
}
