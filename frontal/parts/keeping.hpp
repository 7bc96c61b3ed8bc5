// Pictures that go to the job store and come from it: slow work, which is done beside the mailroom.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "film/film.hpp"
#include "frontal/parts/job_store.hpp"

namespace graycube {

/// The picture of a job that is complete is to be developed, and written to the store.
struct KeepingWork {
  control::JobInfo job;
  std::shared_ptr<const Film> film;
  /// Must outlive the work.
  JobStore* store = nullptr;
};

struct KeepingResult {
  std::uint32_t job = 0;
  Picture picture;
  /// Why it could not be kept; empty if it was.
  std::string error;
};

/// Any thread may call it, one at a time.
KeepingResult keep_picture(KeepingWork work);

/// A picture that the store has, but not in memory, is to be read.
struct ReadingWork {
  std::uint32_t job = 0;
  /// Must outlive the work.
  JobStore* store = nullptr;
};

struct ReadingResult {
  std::uint32_t job = 0;
  /// Nothing if there is none, or none that can be read.
  std::optional<Picture> picture;
};

/// Any thread may call it, one at a time.
ReadingResult read_picture(const ReadingWork& work);

}  // namespace graycube
