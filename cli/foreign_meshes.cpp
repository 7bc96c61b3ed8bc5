#include "cli/foreign_meshes.hpp"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <optional>
#include <string>
#include <system_error>
#include <utility>

#include "cli/interrupts.hpp"
#include "formats/mesh/mesh_file.hpp"
#include "formats/mesh/part_stream.hpp"
#include "process/spawn_plan.hpp"

namespace graycube {
namespace {

namespace fs = std::filesystem;

constexpr const char* kProgram = "graycube-meshes";

/// Why the file can't be read, if that is seen without opening it.
std::optional<MeshFault> fault_of_file(const fs::path& file) {
  std::error_code error;
  const auto size = fs::file_size(file, error);
  if (error) return MeshFault{"can't be read: " + error.message()};
  if (size > kMaxMeshFileBytes)
    return MeshFault{"larger than " + std::to_string(kMaxMeshFileBytes) + " bytes"};
  return std::nullopt;
}

/// The program at work on a file; it ends with this object at the latest.
class Reader {
 public:
  Reader(const fs::path& program, const fs::path& file) {
    std::array<int, 2> pipe{};
    if (::pipe2(pipe.data(), O_CLOEXEC) != 0)
      throw std::system_error(errno, std::generic_category());
    SpawnPlan plan;
    plan.open_as(STDIN_FILENO, "/dev/null", O_RDONLY);
    plan.pass_as(STDOUT_FILENO, pipe[1]);
    plan.open_as(STDERR_FILENO, "/dev/null", O_WRONLY);
    plan.handle_as_usual({SIGPIPE});
    error_ = plan.spawn(pid_, {program.string(), file.string()});
    ::close(pipe[1]);
    output_ = pipe[0];
  }
  ~Reader() {
    ::close(output_);
    if (pid_ <= 0 || has_ended_) return;
    ::kill(pid_, SIGKILL);
    wait_for_end(pid_);
  }
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;

  /// The errno of starting it; 0 if it runs.
  int start_error() const { return error_; }

  /// What it writes, to its end or to one byte more than is accepted.
  std::string output() {
    std::string bytes;
    std::array<char, 65536> chunk;
    while (bytes.size() <= kMaxPartStreamBytes) {
      throw_if_interrupted();
      pollfd waits{output_, POLLIN, 0};
      if (::poll(&waits, 1, 100) <= 0) continue;
      const ssize_t count = ::read(output_, chunk.data(), chunk.size());
      if (count < 0 && errno == EINTR) continue;
      if (count <= 0) break;
      bytes.append(chunk.data(), static_cast<std::size_t>(count));
    }
    return bytes;
  }

  /// How it ended: a wait status.
  int wait() {
    has_ended_ = true;
    return wait_for_end(pid_);
  }

 private:
  pid_t pid_ = -1;
  int output_ = -1, error_ = 0;
  bool has_ended_ = false;
};

MeshFault fault_of_end(int status) {
  if (WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU)
    return {"assimp took too long to read it"};
  if (WIFSIGNALED(status))
    return {"assimp failed on it (signal " + std::to_string(WTERMSIG(status)) + ")"};
  return {"assimp failed on it (status " + std::to_string(WEXITSTATUS(status)) + ")"};
}

}  // namespace

fs::path mesh_reader_program() {
  std::error_code error;
  const fs::path self = fs::read_symlink("/proc/self/exe", error);
  return error ? fs::path(kProgram) : self.parent_path() / kProgram;
}

std::variant<std::vector<MeshPart>, MeshFault> read_foreign_meshes(const fs::path& file,
                                                                   const fs::path& program) {
  if (auto fault = fault_of_file(file)) return *std::move(fault);
  if (::access(program.c_str(), X_OK) != 0) {
    return MeshFault{
        "this build reads only .stl and .off: install assimp (Debian: libassimp-dev) "
        "and build graycube again, which then has " +
        std::string(kProgram)};
  }
  const InterruptsHeld held;
  Reader reader(program, fs::absolute(file));
  if (reader.start_error() != 0)
    return MeshFault{program.string() + ": " + std::strerror(reader.start_error())};
  const std::string bytes = reader.output();
  if (bytes.size() > kMaxPartStreamBytes)
    return MeshFault{"its meshes take more than " + std::to_string(kMaxPartStreamBytes) + " bytes"};
  const int status = reader.wait();
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) return fault_of_end(status);
  return decode_parts(bytes);
}

}  // namespace graycube
