#include "frontal/parts/job_store.hpp"

#include <algorithm>
#include <deque>
#include <utility>

#include "frontal/parts/job_queue.hpp"

namespace graycube {
namespace {

/// Keys that are remembered: of as many jobs as can wait and be listed.
constexpr std::size_t kMaxKeys = kMaxQueuedJobs + kMaxJobsListed;

class MemoryStore : public JobStore {
 public:
  void add(const AcceptedJob& job, std::span<const std::byte>) override {
    if (job.key.empty()) return;
    if (keys_.size() == kMaxKeys) keys_.pop_front();
    keys_.push_back({job.key, {job.info.job, job.content}});
  }
  std::optional<KeyedJob> find_key(const std::string& key) override {
    const auto at = std::ranges::find(keys_, key, [](const auto& k) { return k.first; });
    if (at == keys_.end()) return std::nullopt;
    return at->second;
  }
  void keep(const EndedJob& job, Picture picture) override {
    if (picture.rgb.empty()) return;
    job_ = job.info.job;
    picture_ = std::move(picture);
  }
  const Picture* picture(std::uint32_t job) override { return job == job_ ? &picture_ : nullptr; }

 private:
  std::uint32_t job_ = 0;
  Picture picture_;
  std::deque<std::pair<std::string, KeyedJob>> keys_;
};

}  // namespace

std::unique_ptr<JobStore> make_memory_store() { return std::make_unique<MemoryStore>(); }

}  // namespace graycube
