// What a frontal does with the jobs that another one has left, and with a job submitted twice.
#include "catch.hpp"
#include "frontal/jobs_farm.hpp"
#include "frontal/store/database_store.hpp"
#include "process/temporary_folder.hpp"

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
struct Farm : JobsFarm {
  explicit Farm(const TemporaryFolder& folder)
      : JobsFarm(2, open_database_store(folder.path(), {}, [](const std::string&) {}), true) {}

  Answer try_submit(const std::string& key, std::uint32_t samples = 1,
                    const std::string& text = "{}") {
    return JobsFarm::try_submit(request(key, samples), text);
  }
  std::uint32_t submit(const std::string& key = {}, std::uint32_t samples = 1,
                       const std::string& text = "{}") {
    return granted<control::Accepted>(try_submit(key, samples, text)).job;
  }
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

TEST_CASE("a long scene is there for the next frontal, whoever prepares it reads it") {
  const TemporaryFolder folder;
  const std::string scene = JobsFarm::scene() + std::string(kLongScene, ' ');
  {
    Farm farm(folder);
    farm.jobs.submit({"a", request("key"), bytes_of(scene)});
    farm.jobs.give_result(admit_scene(*farm.jobs.take_admission()));
    CHECK(SentPost(farm.post).told<control::Accepted>("a").size() == 1);
  }
  Farm farm(folder);
  const auto work = farm.jobs.take_work();
  REQUIRE(work);
  CHECK(work->scene.empty());
  CHECK(prepare(*work, [] { return 0.0; }).scene.has_value());
  std::filesystem::remove(folder / "job-1.scene");
  farm.jobs.give_result(prepare(*work, [] { return 0.0; }));
  CHECK(farm.info(1).message ==
        "the job store: " + (folder / "job-1.scene").string() + ": No such file or directory");
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
  JobsFarm farm;
  const auto number = [&](const std::string& key) {
    return granted<control::Accepted>(farm.try_submit(request(key))).job;
  };
  CHECK(number("a") == 1);
  CHECK(number("a") == 1);
  CHECK(number("b") == 2);
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
