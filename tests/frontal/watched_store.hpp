// A job store that an earlier frontal has left job 1 in, of which a test sees how it is used.
#pragma once

#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "frontal/parts/job_store.hpp"

namespace graycube::testing {

class WatchedStore : public JobStore {
 public:
  std::vector<std::string> calls;
  bool is_full = false;
  /// Who wrote a scene last.
  std::thread::id writer;

  void add(const AcceptedJob& job, std::span<const std::byte>) override {
    calls.push_back("add " + std::to_string(job.info.job));
    keys_.emplace_back(job.key, KeyedJob{job.info.job, job.content});
  }
  std::optional<KeyedJob> find_key(const std::string& key) override {
    for (const auto& [known, job] : keys_) {
      if (known == key) return job;
    }
    return std::nullopt;
  }
  void keep(const EndedJob& job, Picture picture) override {
    calls.push_back("keep as " + std::string(to_string(job.info.state)));
    if (!picture.rgb.empty()) hold(job.info.job, std::move(picture));
  }
  const Picture* picture(std::uint32_t job) override { return job == held_ ? &picture_ : nullptr; }
  bool must_read(std::uint32_t job) const override { return job == 1 && held_ != 1; }
  void hold(std::uint32_t job, Picture picture) override {
    held_ = job;
    picture_ = std::move(picture);
  }
  void write_scene(std::uint32_t job, std::span<const std::byte>) override {
    writer = std::this_thread::get_id();
    write("write scene " + std::to_string(job));
  }
  void write_picture(const control::JobInfo&, const Picture&) override { write("write"); }
  std::optional<Picture> read_picture(std::uint32_t) override {
    calls.push_back("read");
    return Picture{2, 1, std::vector<float>(6, 0.5F), {}, {}};
  }
  std::vector<EndedJob> recover() override {
    EndedJob job;
    job.info.job = 1;
    job.info.state = JobState::kDone;
    return {job};
  }

 private:
  void write(std::string what) {
    if (is_full) throw std::runtime_error("the disk is full");
    calls.push_back(std::move(what));
  }

  std::uint32_t held_ = 0;
  Picture picture_;
  std::vector<std::pair<std::string, KeyedJob>> keys_;
};

}  // namespace graycube::testing
