// Names of the files that a job store has for a job: job-7.exr and the like.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace graycube {

/// The file's path; `ending` with its dot.
std::filesystem::path job_file(const std::filesystem::path& folder, std::uint32_t job,
                               const std::string& ending);

/// The job of a file that is named so, with whatever ending; nothing for any other name.
std::optional<std::uint32_t> job_of_file(const std::filesystem::path& file);

/// The largest job that a file of the folder is named after, damaged ones too; 0 if there is none.
std::uint32_t last_job_of_files(const std::filesystem::path& folder);

/// Removes files that a frontal had not written whole when it ended.
void remove_unfinished_files(const std::filesystem::path& folder);

}  // namespace graycube
