// Records of ended jobs as frontals wrote them before there was a database: a file job-N.json with
// two lines, the job's `job_info` message and its `done` message with the statistics.
#pragma once

#include <filesystem>
#include <vector>

#include "frontal/parts/job_store.hpp"
#include "frontal/store/set_aside.hpp"

namespace graycube {

/// The folder below a store's in which records lie that the database has taken over.
inline constexpr const char* kImportedFolder = "imported";

/// Reads all records; those that can't be read are set aside.
std::vector<EndedJob> read_earlier_records(const std::filesystem::path& folder, const Warn& warn);
/// Moves them to where they aren't read again.
void put_away_earlier_records(const std::filesystem::path& folder, const Warn& warn);

}  // namespace graycube
