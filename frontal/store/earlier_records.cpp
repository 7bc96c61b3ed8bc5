#include "frontal/store/earlier_records.hpp"

#include <fstream>
#include <system_error>
#include <utility>
#include <variant>

#include "frontal/store/job_files.hpp"
#include "proto/control.hpp"

namespace graycube {
namespace {

namespace fs = std::filesystem;

/// A larger file is no record that a frontal wrote.
constexpr std::uintmax_t kMaxRecordBytes = 2 * kMaxControlBytes;

template <typename M>
std::optional<M> read_line(std::ifstream& in) {
  std::string line;
  if (!std::getline(in, line)) return std::nullopt;
  const auto decoded = decode(line);
  const auto* message = std::get_if<ControlMessage>(&decoded);
  const auto* wanted = message != nullptr ? std::get_if<M>(message) : nullptr;
  return wanted != nullptr ? std::optional<M>(*wanted) : std::nullopt;
}

std::optional<EndedJob> read_record(const fs::path& path) {
  std::error_code error;
  if (fs::file_size(path, error) > kMaxRecordBytes || error) return std::nullopt;
  std::ifstream in(path, std::ios::binary);
  auto info = read_line<control::JobInfo>(in);
  auto done = read_line<control::Done>(in);
  if (!info || !done || info->job != job_of_file(path)) return std::nullopt;
  // Nothing else told of a deadlock.
  const bool is_deadlocked =
      info->state == JobState::kFailed && info->message.find(": deadlock: ") != std::string::npos;
  return EndedJob{std::move(*info), std::move(done->stats.text), is_deadlocked};
}

std::vector<fs::path> records_in(const fs::path& folder) {
  std::vector<fs::path> records;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() == ".json" && job_of_file(entry.path()))
      records.push_back(entry.path());
  }
  return records;
}

}  // namespace

std::vector<EndedJob> read_earlier_records(const fs::path& folder, const Warn& warn) {
  std::vector<EndedJob> jobs;
  for (const fs::path& path : records_in(folder)) {
    if (auto job = read_record(path)) {
      jobs.push_back(std::move(*job));
    } else {
      set_aside(folder, path, "it is no record of a job", warn);
    }
  }
  return jobs;
}

void put_away_earlier_records(const fs::path& folder, const Warn& warn) {
  const auto records = records_in(folder);
  if (records.empty()) return;
  std::error_code error;
  fs::create_directories(folder / kImportedFolder, error);
  for (const fs::path& path : records) {
    if (!error) fs::rename(path, folder / kImportedFolder / path.filename(), error);
  }
  if (error)
    warn(folder.string() + ": records that were taken over stay there: " + error.message());
}

}  // namespace graycube
