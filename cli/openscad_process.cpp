#include "cli/openscad_process.hpp"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <sstream>
#include <string_view>
#include <system_error>
#include <utility>

#include "cli/interrupts.hpp"
#include "process/spawn_plan.hpp"
#include "process/temporary_folder.hpp"

namespace graycube {
namespace {

namespace fs = std::filesystem;

/// Milliseconds between looks whether the process has ended, if the system can't tell that.
constexpr int kLookMs = 20;
constexpr std::string_view kEmptyModel = "Current top level object is empty.";

/// The folder must be removed on an interrupt, too, so interrupts are held while there is one.
/// Afterwards an importer that is busy with the results may be interrupted at any time.
struct Workplace {
  InterruptsHeld held;
  TemporaryFolder folder;
};

/// The bytes of a file, at most `most`; nothing when there is no such file.
std::optional<std::string> bytes_of(const fs::path& path, std::uint64_t most) {
  std::ifstream file(path, std::ios::binary);
  if (!file) return std::nullopt;
  std::error_code error;
  const std::uint64_t size = std::min<std::uint64_t>(fs::file_size(path, error), most);
  if (error) return std::nullopt;
  std::string bytes(size, '\0');
  file.read(bytes.data(), static_cast<std::streamsize>(size));
  bytes.resize(static_cast<std::size_t>(file.gcount()));
  return bytes;
}

void reap(pid_t pid) {
  ::kill(pid, SIGKILL);
  while (::waitpid(pid, nullptr, 0) < 0 && errno == EINTR) {
  }
}

/// False for the statistics that an export prints, which are of no interest here.
bool is_worth_telling(std::string_view line) {
  return line.starts_with("ERROR") || line.starts_with("WARNING") || line.starts_with("ECHO") ||
         line.starts_with("TRACE") || line.starts_with("DEPRECATED") || line.starts_with("Can't");
}

}  // namespace

std::unique_ptr<OpenscadProcess> OpenscadProcess::find() {
  const char* path = std::getenv("PATH");
  std::stringstream folders(path != nullptr ? path : "");
  for (std::string folder; std::getline(folders, folder, ':');) {
    const fs::path program = fs::path(folder.empty() ? "." : folder) / "openscad";
    std::error_code error;
    if (fs::is_regular_file(program, error) && ::access(program.c_str(), X_OK) == 0) {
      return std::make_unique<OpenscadProcess>(program);
    }
  }
  return nullptr;
}

pid_t OpenscadProcess::start(const fs::path& input, const fs::path& output, const fs::path& log,
                             const std::vector<std::string>& options) {
  constexpr int kWrite = O_WRONLY | O_CREAT | O_TRUNC;
  SpawnPlan plan;
  plan.open_as(STDIN_FILENO, "/dev/null", O_RDONLY);
  plan.open_as(STDOUT_FILENO, "/dev/null", O_WRONLY);
  plan.open_as(STDERR_FILENO, log.c_str(), kWrite);
  plan.handle_as_usual({SIGPIPE});
  std::vector<std::string> words{program_.string(), "-o", output.string(), input.string()};
  words.insert(words.end(), options.begin(), options.end());
  pid_t pid = -1;
  const int error = plan.spawn(pid, std::move(words));
  if (error != 0) {
    throw Failure(ExitStatus::kFailed,
                  Problem{"openscad", program_.string(), std::strerror(error)});
  }
  return pid;
}

std::optional<int> OpenscadProcess::wait_for_end(pid_t pid, int most_seconds) {
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(most_seconds);
  for (;;) {
    int status = 0;
    const pid_t ended = ::waitpid(pid, &status, WNOHANG);
    if (ended == pid) return status;
    if (is_interrupted()) {
      reap(pid);
      throw_if_interrupted();
    }
    if (std::chrono::steady_clock::now() >= deadline) {
      reap(pid);
      return std::nullopt;
    }
    ::poll(nullptr, 0, kLookMs);
  }
}

std::string OpenscadProcess::trouble_in(const std::string& log, int status) {
  std::string last_error;
  std::stringstream lines(log);
  for (std::string line; std::getline(lines, line);) {
    if (!is_worth_telling(line)) continue;
    messages_.push_back(line);
    if (line.starts_with("ERROR")) last_error = line;
  }
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return {};
  if (log.find(kEmptyModel) != std::string::npos) return {};
  if (!last_error.empty()) return "openscad: " + last_error;
  return WIFEXITED(status) ? "openscad ended with status " + std::to_string(WEXITSTATUS(status))
                           : "openscad ended by signal " + std::to_string(WTERMSIG(status));
}

OpenscadProgram::Result OpenscadProcess::run(const fs::path& folder, const fs::path& input,
                                             const std::string& output) {
  const fs::path written = folder / output, log = folder / "log";
  const auto status = wait_for_end(start(input, written, log), most_seconds_);
  throw_if_interrupted();
  Result result;
  if (!status) {
    result.trouble = "openscad took more than " + std::to_string(most_seconds_) + " s";
    return result;
  }
  result.trouble = trouble_in(bytes_of(log, kMaxOpenscadLogBytes).value_or(""), *status);
  if (!result.trouble.empty()) return result;
  if (auto bytes = bytes_of(written, kMaxOpenscadOutputBytes + 1)) result.text = std::move(*bytes);
  if (result.text.size() > kMaxOpenscadOutputBytes) {
    result = {{}, "openscad wrote more than " + std::to_string(kMaxOpenscadOutputBytes) + " bytes"};
  }
  return result;
}

OpenscadProgram::Result OpenscadProcess::evaluate(const std::string& csg, Format format) {
  const Workplace place;
  const fs::path input = place.folder / "part.csg";
  std::ofstream(input, std::ios::binary) << csg;
  return run(place.folder.path(), input, format == Format::kOff ? "part.off" : "part.svg");
}

OpenscadProgram::Result OpenscadProcess::evaluate_file(const fs::path& scad) {
  const Workplace place;
  return run(place.folder.path(), fs::absolute(scad), "model.csg");
}

std::string OpenscadProcess::evaluate_with(const fs::path& scad, std::string_view definitions) {
  const Workplace place;
  const fs::path written = place.folder / "model.csg";
  const std::vector<std::string> options{"-D", std::string(definitions)};
  const pid_t pid = start(fs::absolute(scad), written, place.folder / "log", options);
  const auto status = wait_for_end(pid, most_seconds_);
  throw_if_interrupted();
  if (!status || !WIFEXITED(*status) || WEXITSTATUS(*status) != 0) return {};
  return bytes_of(written, kMaxOpenscadOutputBytes).value_or("");
}

std::vector<std::string> OpenscadProcess::take_messages() { return std::exchange(messages_, {}); }

}  // namespace graycube
