// Where finished jobs are kept: in memory for a private farm, in a folder for a daemon.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "film/film.hpp"
#include "proto/messages.hpp"

namespace graycube {

/// A job that has ended: done, failed or cancelled.
struct EndedJob {
  control::JobInfo info;
  /// The statistics file; "{}" when nothing is known.
  std::string stats_json = "{}";
  bool has_stats() const { return stats_json != "{}"; }
  /// Of jobs that an earlier frontal left it is known by their messages.
  bool is_deadlocked = false;
};

class JobStore {
 public:
  virtual ~JobStore() = default;
  /// `picture` is empty (no pixels) unless the job is done. Throws std::runtime_error when it can't
  /// be kept.
  virtual void keep(const EndedJob& job, Picture picture) = 0;
  /// The picture of a job that is done; null when it isn't kept (any longer). Valid until the next
  /// call.
  virtual const Picture* picture(std::uint32_t job) = 0;
  /// The jobs that an earlier frontal left, oldest first.
  virtual std::vector<EndedJob> recover() = 0;
};

/// Keeps the last picture.
std::unique_ptr<JobStore> make_memory_store();
/// Keeps every picture as job-N.exr, with job-N.json beside it; the folder is made when it isn't
/// there. Throws std::runtime_error when it can't be.
std::unique_ptr<JobStore> make_folder_store(const std::filesystem::path& folder);

}  // namespace graycube
