#include "frontal/parts/ended_jobs.hpp"

#include <stdexcept>

#include "catch.hpp"

using namespace graycube;

namespace {

EndedJob job_of(std::uint32_t number, JobState state = JobState::kDone) {
  EndedJob job;
  job.info.job = number;
  job.info.state = state;
  return job;
}

/// A store with so many jobs of an earlier frontal, which takes no more.
class FullStore : public JobStore {
 public:
  explicit FullStore(std::uint32_t jobs) : jobs_(jobs) {}
  void add(const AcceptedJob&, std::span<const std::byte>) override {}
  std::optional<KeyedJob> find_key(const std::string&) override { return std::nullopt; }
  void keep(const EndedJob&, Picture) override { throw std::runtime_error("the disk is full"); }
  const Picture* picture(std::uint32_t) override { return nullptr; }
  std::vector<EndedJob> recover() override {
    std::vector<EndedJob> jobs;
    for (std::uint32_t i = 1; i <= jobs_; ++i) jobs.push_back(job_of(i));
    return jobs;
  }

 private:
  std::uint32_t jobs_;
};

}  // namespace

TEST_CASE("a job that is kept is found again, with its picture") {
  const auto store = make_memory_store();
  EndedJobs ended(*store);
  Picture picture;
  picture.width = 3;
  picture.rgb = {1, 2, 3};
  CHECK(ended.keep(job_of(5), picture).info.state == JobState::kDone);
  REQUIRE(ended.find(5) != nullptr);
  REQUIRE(ended.picture(5) != nullptr);
  CHECK(ended.picture(5)->width == 3);
  CHECK(ended.find(6) == nullptr);
}

TEST_CASE(
    "a job that can't be stored has failed, and says why; a failed one "
    "stays what it was") {
  FullStore store(0);
  EndedJobs ended(store);
  const EndedJob& done = ended.keep(job_of(1), {});
  CHECK(done.info.state == JobState::kFailed);
  CHECK(done.info.message == "the disk is full");
  CHECK(ended.keep(job_of(2, JobState::kCancelled), {}).info.state == JobState::kCancelled);
}

TEST_CASE("what an earlier frontal left is listed, and only the newest jobs are") {
  FullStore store(kMaxEndedJobs + 3);
  EndedJobs ended(store);
  CHECK(ended.all().size() == kMaxEndedJobs);
  CHECK(ended.all().front().info.job == 4);
  ended.keep(job_of(1000), {});
  CHECK(ended.all().size() == kMaxEndedJobs);
  CHECK(ended.find(4) == nullptr);
  CHECK(ended.all().back().info.job == 1000);
}
