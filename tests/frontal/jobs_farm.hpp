// The jobs of a farm without its frontal, for tests.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "catch.hpp"
#include "formats/graycube/write_scene.hpp"
#include "frontal/jobs.hpp"
#include "frontal/sent_post.hpp"
#include "trace/corner_scene.hpp"

namespace graycube::testing {

inline Bytes bytes_of(const std::string& text) {
  const auto bytes = std::as_bytes(std::span(text));
  return Bytes(bytes.begin(), bytes.end());
}

struct JobsFarm {
  explicit JobsFarm(std::uint32_t nodes = 2, std::unique_ptr<JobStore> jobs_store = {},
                    bool keeps_jobs = false)
      : options{.cube = *Hypercube::of_size(nodes), .version = "test", .keeps_jobs = keeps_jobs},
        store(jobs_store ? std::move(jobs_store) : make_memory_store()),
        post(post_of(nodes)) {}

  FrontalOptions options;
  std::unique_ptr<JobStore> store;
  Post post;
  FarmLog log;
  Jobs jobs{options, *store, post, log};

  static std::string scene() { return write_scene_text(corner_scene()); }
  /// The answer to a scene that is so short that it is given at once.
  Answer try_submit(const control::Submit& m, const std::string& text = scene()) {
    auto answer = jobs.submit({"a client", m, bytes_of(text)});
    REQUIRE(answer);
    return *std::move(answer);
  }
  std::uint32_t submit(const control::JobOptions& o = {}, const std::string& text = scene()) {
    return granted<control::Accepted>(try_submit({"a scene", o, {}}, text)).job;
  }
  /// Prepares the next job and loads it.
  void load_next() {
    auto work = jobs.take_work();
    REQUIRE(work);
    jobs.give_result(prepare(*work, [] { return 0.0; }));
    if (jobs.waits_to_be_loaded()) jobs.load();
  }
  control::JobInfo info(std::uint32_t job) { return granted<control::JobInfo>(jobs.status(job)); }
  JobState state_of(std::uint32_t job) { return info(job).state; }
};

}  // namespace graycube::testing
