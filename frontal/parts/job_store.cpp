#include "frontal/parts/job_store.hpp"

#include <algorithm>
#include <fstream>
#include <stdexcept>
#include <utility>

#include "film/picture_files.hpp"
#include "proto/control.hpp"
#include "version.hpp"

namespace graycube {
namespace {

namespace fs = std::filesystem;

class MemoryStore : public JobStore {
 public:
  void keep(const EndedJob& job, Picture picture) override {
    if (picture.rgb.empty()) return;
    job_ = job.info.job;
    picture_ = std::move(picture);
  }
  const Picture* picture(std::uint32_t job) override { return job == job_ ? &picture_ : nullptr; }
  std::vector<EndedJob> recover() override { return {}; }

 private:
  std::uint32_t job_ = 0;
  Picture picture_;
};

/// A larger file is no record that a frontal wrote.
constexpr std::uintmax_t kMaxRecordBytes = 2 * kMaxControlBytes;

class FolderStore : public JobStore {
 public:
  explicit FolderStore(fs::path folder) : folder_(std::move(folder)) {
    std::error_code error;
    fs::create_directories(folder_, error);
    if (error) throw std::runtime_error(folder_.string() + ": " + error.message());
  }

  void keep(const EndedJob& job, Picture picture) override {
    if (!picture.rgb.empty()) {
      write_exr(file(job.info.job, ".exr"), picture, {job.info.scene, kVersion});
      cache_job_ = job.info.job;
      cache_ = std::move(picture);
    }
    write_record(job);
  }

  const Picture* picture(std::uint32_t job) override {
    if (job == cache_job_) return &cache_;
    try {
      cache_ = read_exr(file(job, ".exr"));
      cache_job_ = job;
      return &cache_;
    } catch (const PictureError&) {
      return nullptr;
    }
  }

  std::vector<EndedJob> recover() override {
    std::vector<EndedJob> jobs;
    for (const auto& entry : fs::directory_iterator(folder_)) {
      if (entry.path().extension() != ".json" || entry.file_size() > kMaxRecordBytes) continue;
      if (auto job = read_record(entry.path())) jobs.push_back(std::move(*job));
    }
    std::sort(jobs.begin(), jobs.end(),
              [](const EndedJob& a, const EndedJob& b) { return a.info.job < b.info.job; });
    return jobs;
  }

 private:
  fs::path file(std::uint32_t job, const char* ending) const {
    return folder_ / ("job-" + std::to_string(job) + ending);
  }

  /// Two lines: the job's `job_info` message, and its `done` message with the statistics.
  void write_record(const EndedJob& job) const {
    const fs::path path = file(job.info.job, ".json");
    const fs::path beside = path.string() + ".part";
    {
      std::ofstream out(beside, std::ios::binary);
      out << encode(job.info) << '\n'
          << encode(control::Done{job.info.job, {job.stats_json}}) << '\n';
      if (!out.flush()) throw std::runtime_error(path.string() + ": can't be written");
    }
    fs::rename(beside, path);
  }

  static std::optional<EndedJob> read_record(const fs::path& path) {
    std::ifstream in(path, std::ios::binary);
    std::string info_line, done_line;
    if (!std::getline(in, info_line) || !std::getline(in, done_line)) return std::nullopt;
    const auto info = decode(info_line);
    const auto done = decode(done_line);
    const auto* a = std::get_if<ControlMessage>(&info);
    const auto* b = std::get_if<ControlMessage>(&done);
    if (a == nullptr || b == nullptr) return std::nullopt;
    const auto* job = std::get_if<control::JobInfo>(a);
    const auto* stats = std::get_if<control::Done>(b);
    if (job == nullptr || stats == nullptr) return std::nullopt;
    const bool is_deadlocked =
        job->state == JobState::kFailed && job->message.find(": deadlock: ") != std::string::npos;
    return EndedJob{*job, stats->stats.text, is_deadlocked};
  }

  fs::path folder_;
  std::uint32_t cache_job_ = 0;
  Picture cache_;
};

}  // namespace

std::unique_ptr<JobStore> make_memory_store() { return std::make_unique<MemoryStore>(); }

std::unique_ptr<JobStore> make_folder_store(const fs::path& folder) {
  return std::make_unique<FolderStore>(folder);
}

}  // namespace graycube
