#include "frontal/store/job_files.hpp"

#include <algorithm>
#include <charconv>
#include <string_view>
#include <system_error>
#include <vector>

#include "frontal/store/set_aside.hpp"

namespace graycube {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kPrefix = "job-";
/// Files are written under names that end so, or (film/whole_file.cpp) begin so.
constexpr std::string_view kUnfinishedEnding = ".part", kUnfinishedPrefix = ".graycube-";

std::uint32_t last_job_in(const fs::path& folder) {
  std::uint32_t last = 0;
  std::error_code error;
  for (fs::directory_iterator file(folder, error), end; !error && file != end;
       file.increment(error)) {
    last = std::max(last, job_of_file(file->path()).value_or(0));
  }
  return last;
}

}  // namespace

fs::path job_file(const fs::path& folder, std::uint32_t job, const std::string& ending) {
  return folder / (std::string(kPrefix) + std::to_string(job) + ending);
}

std::optional<std::uint32_t> job_of_file(const fs::path& file) {
  const std::string name = file.filename().string();
  if (!name.starts_with(kPrefix)) return std::nullopt;
  const char* const begin = name.data() + kPrefix.size();
  std::uint32_t job = 0;
  const auto [end, error] = std::from_chars(begin, name.data() + name.size(), job);
  if (error != std::errc() || *end != '.' || job == 0) return std::nullopt;
  return job;
}

std::uint32_t last_job_of_files(const fs::path& folder) {
  return std::max(last_job_in(folder), last_job_in(folder / kDamagedFolder));
}

void remove_unfinished_files(const fs::path& folder) {
  std::vector<fs::path> unfinished;
  std::error_code error;
  for (fs::directory_iterator file(folder, error), end; !error && file != end;
       file.increment(error)) {
    const std::string name = file->path().filename().string();
    const bool is_ours = name.starts_with(kPrefix) && name.ends_with(kUnfinishedEnding);
    if (is_ours || name.starts_with(kUnfinishedPrefix)) unfinished.push_back(file->path());
  }
  for (const fs::path& file : unfinished) fs::remove(file, error);
}

}  // namespace graycube
