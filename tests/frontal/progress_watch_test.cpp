#include "frontal/parts/progress_watch.hpp"

#include "catch.hpp"

using namespace graycube;

TEST_CASE("what a job waits for is told by its stage, with the time since it last got on") {
  control::JobInfo job;
  job.job = 3;
  job.tiles = 12;
  ProgressWatch watch;
  watch.see(job, JobStage::kPreparing, 10);
  watch.see(job, JobStage::kPreparing, 11);
  CHECK(watch.waits_for(job, JobStage::kPreparing, 12.5) ==
        "its scene to be read and cut, for 2.5 s");
  watch.see(job, JobStage::kRendering, 20);
  job.tiles_whole = 5;
  watch.see(job, JobStage::kRendering, 21);
  CHECK(watch.waits_for(job, JobStage::kRendering, 24) == "the light of 7 of 12 tiles, for 3.0 s");
  job.tiles_whole = 12;
  watch.see(job, JobStage::kRendering, 25);
  CHECK(watch.waits_for(job, JobStage::kRendering, 25) ==
        "the nodes' verdict that all is done, for 0.0 s");
  // Another job begins anew, however alike it looks.
  job.job = 4;
  watch.see(job, JobStage::kRendering, 90);
  CHECK(watch.waits_for(job, JobStage::kRendering, 91).ends_with(", for 1.0 s"));
}
