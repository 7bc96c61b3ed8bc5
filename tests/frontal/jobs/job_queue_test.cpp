#include "frontal/parts/job_queue.hpp"

#include "catch.hpp"

using namespace graycube;

namespace {

QueuedJob job_of(const std::string& scene) {
  QueuedJob job;
  job.info.scene = scene;
  return job;
}

}  // namespace

TEST_CASE("jobs are numbered as they come, and leave in that order") {
  JobQueue queue;
  CHECK(queue.is_empty());
  CHECK(queue.add(job_of("a")) == 1);
  CHECK(queue.add(job_of("b")) == 2);
  const QueuedJob first = queue.take_first();
  CHECK(first.info.scene == "a");
  CHECK(first.info.job == 1);
  CHECK(first.work.job == 1);
  CHECK(queue.add(job_of("c")) == 3);
  CHECK(queue.take_first().info.scene == "b");
}

TEST_CASE("a number that an earlier frontal used is not used again") {
  JobQueue queue;
  queue.number_beyond(41);
  queue.number_beyond(7);
  CHECK(queue.add(job_of("a")) == 42);
}

TEST_CASE("a job is found while it waits, and can be taken out") {
  JobQueue queue;
  for (const char* scene : {"a", "b", "c"}) queue.add(job_of(scene));
  REQUIRE(queue.find(2) != nullptr);
  CHECK(queue.find(2)->scene == "b");
  CHECK(queue.find(4) == nullptr);
  const auto removed = queue.remove(2);
  REQUIRE(removed);
  CHECK(removed->info.scene == "b");
  CHECK_FALSE(queue.remove(2));
  CHECK(queue.all().size() == 2);
}

TEST_CASE("the queue is full at its limit") {
  JobQueue queue;
  for (std::size_t i = 0; i < kMaxQueuedJobs; ++i) {
    CHECK_FALSE(queue.is_full());
    queue.add(job_of("a"));
  }
  CHECK(queue.is_full());
  queue.take_first();
  CHECK_FALSE(queue.is_full());
}
