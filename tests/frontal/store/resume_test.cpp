// What a frontal does with the jobs that another one has left, and with a job submitted twice.
#include "catch.hpp"
#include "formats/graycube/write_scene.hpp"
#include "frontal/jobs.hpp"
#include "frontal/sent_post.hpp"
#include "frontal/store/database_store.hpp"
#include "process/temporary_folder.hpp"
#include "trace/corner_scene.hpp"

using namespace graycube;
using namespace graycube::testing;

namespace {

control::Submit request(const std::string& key, std::uint32_t samples = 1) {
  control::Submit m;
  m.scene_name = "a scene";
  m.options.samples = samples;
  m.key = key;
  return m;
}

/// The jobs of one frontal after another, in the same folder.
struct Farm {
  explicit Farm(const TemporaryFolder& folder)
      : store(open_database_store(folder.path(), {}, [](const std::string&) {})) {}

  FrontalOptions options{.cube = *Hypercube::of_size(2), .version = "test", .keeps_jobs = true};
  std::unique_ptr<JobStore> store;
  Post post = post_of(2);
  FarmLog log;
  Jobs jobs{options, *store, post, log};

  Answer try_submit(const std::string& key, std::uint32_t samples = 1,
                    const std::string& text = "{}") {
    return jobs.submit(request(key, samples), std::as_bytes(std::span(text)));
  }
  std::uint32_t submit(const std::string& key = {}, std::uint32_t samples = 1,
                       const std::string& text = "{}") {
    return granted<control::Accepted>(try_submit(key, samples, text)).job;
  }
  JobState state_of(std::uint32_t job) { return granted<control::JobInfo>(jobs.status(job)).state; }
};

}  // namespace

TEST_CASE(
    "another frontal takes up the queue in order, what was on first, with scenes and options") {
  const TemporaryFolder folder;
  const std::string scene = write_scene_text(corner_scene());
  {
    Farm farm(folder);
    for (std::uint32_t i = 1; i <= 3; ++i) CHECK(farm.submit({}, i, scene) == i);
    CHECK(farm.jobs.take_work()->job == 1);
  }
  Farm farm(folder);
  for (std::uint32_t i = 1; i <= 3; ++i) {
    CHECK(farm.state_of(i) == JobState::kQueued);
    const auto work = farm.jobs.take_work();
    REQUIRE(work);
    CHECK(work->job == i);
    CHECK(work->options.samples == i);
    CHECK(prepare(*work, [] { return 0.0; }).scene.has_value());
    farm.jobs.cancel(i);
  }
  CHECK_FALSE(farm.jobs.take_work());
  CHECK(farm.submit() == 4);
}

TEST_CASE("a farm that stops leaves its jobs to the next frontal, and tells who watches them") {
  const TemporaryFolder folder;
  {
    Farm farm(folder);
    farm.submit();
    farm.submit();
    farm.jobs.take_work();
    farm.jobs.watch("first watcher", 1);
    farm.jobs.watch("second watcher", 2);
    farm.post.take();
    farm.jobs.stop();
    const SentPost sent(farm.post);
    CHECK(sent.told<control::Bye>("first watcher").size() == 1);
    CHECK(sent.told<control::Bye>("second watcher").size() == 1);
    CHECK_FALSE(farm.jobs.take_work());
  }
  Farm farm(folder);
  CHECK(farm.state_of(1) == JobState::kQueued);
  CHECK(farm.state_of(2) == JobState::kQueued);
}

TEST_CASE("what is submitted again under its key is the same job, for another frontal, too") {
  const TemporaryFolder folder;
  {
    Farm farm(folder);
    CHECK(farm.submit("a") == 1);
    CHECK(farm.submit("b") == 2);
    CHECK(farm.submit("a") == 1);
    farm.jobs.cancel(1);
    CHECK(farm.submit("a") == 1);
    // Without a key it is another job.
    CHECK(farm.submit() == 3);
    CHECK(farm.submit() == 4);
  }
  Farm farm(folder);
  CHECK(farm.submit("a") == 1);
  CHECK(farm.submit("b") == 2);
  CHECK(granted<control::Jobs>(farm.jobs.list()).jobs.size() == 4);
}

TEST_CASE("another scene or other options under a key that is known are refused") {
  const TemporaryFolder folder;
  Farm farm(folder);
  farm.submit("a");
  CHECK(refused(farm.try_submit("a", 2)) == FailureCode::kBadRequest);
  CHECK(refused(farm.try_submit("a", 1, "[]")) == FailureCode::kBadRequest);
  CHECK(granted<control::Jobs>(farm.jobs.list()).jobs.size() == 1);
}

TEST_CASE("a store in memory knows keys, too") {
  const FrontalOptions options{.cube = *Hypercube::of_size(2), .version = "test"};
  const auto store = make_memory_store();
  Post post = post_of(2);
  FarmLog log;
  Jobs jobs(options, *store, post, log);
  CHECK(granted<control::Accepted>(jobs.submit(request("a"), {})).job == 1);
  CHECK(granted<control::Accepted>(jobs.submit(request("a"), {})).job == 1);
  CHECK(granted<control::Accepted>(jobs.submit(request("b"), {})).job == 2);
}

TEST_CASE("when all numbers are used, no job is taken any more") {
  const TemporaryFolder folder;
  {
    Farm farm(folder);
    EndedJob last;
    last.info.job = 0xFFFF'FFFF;
    last.info.state = JobState::kFailed;
    farm.store->keep(last, {});
  }
  Farm farm(folder);
  CHECK(refused(farm.try_submit({})) == FailureCode::kFailed);
}

TEST_CASE("a job that brings down one frontal after another as it begins is given up") {
  const TemporaryFolder folder;
  for (int death = 0; death < 5; ++death) {
    Farm farm(folder);
    if (death == 0) farm.submit();
    if (death == 0) farm.submit();
    CHECK(farm.jobs.take_work()->job == 1);
  }
  Farm farm(folder);
  CHECK_FALSE(farm.jobs.take_work());
  CHECK(farm.state_of(1) == JobState::kFailed);
  CHECK(granted<control::JobInfo>(farm.jobs.status(1)).message ==
        "the frontal: has died 5 times as soon as this job began; it isn't tried again");
  CHECK(farm.jobs.take_work()->job == 2);
}

TEST_CASE("a job that got on before each frontal's death goes on for ever") {
  const TemporaryFolder folder;
  for (int death = 0; death < 9; ++death) {
    Farm farm(folder);
    if (death == 0) farm.submit();
    CHECK(farm.jobs.take_work()->job == 1);
    farm.store->record_tiles(1, Bytes(1));
  }
}

TEST_CASE("clients hear how many jobs there are") {
  const TemporaryFolder folder;
  Farm farm(folder);
  for (int i = 0; i < 4; ++i) farm.submit();
  farm.jobs.take_work();
  farm.jobs.cancel(4);
  control::FarmInfo info;
  farm.jobs.count(info);
  CHECK(info.running == 1);
  CHECK(info.queued == 2);
  CHECK(info.ended == 1);
}
