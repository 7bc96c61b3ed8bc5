#include "process/log_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "process/clocks.hpp"
#include "process/log_line.hpp"

namespace graycube {
namespace {

std::string text_of(int error) { return std::generic_category().message(error); }

}  // namespace

LogFile::LogFile(const std::filesystem::path& file, std::string_view first)
    : file_(file),
      // Not to wait for whoever may read it one day, if it is a pipe.
      descriptor_(::open(file.c_str(),
                         O_WRONLY | O_APPEND | O_CREAT | O_CLOEXEC | O_NOCTTY | O_NONBLOCK, 0600)) {
  if (descriptor_ < 0) throw std::runtime_error(file.string() + ": " + text_of(errno));
  struct stat status {};
  if (::fstat(descriptor_, &status) == 0 && S_ISREG(status.st_mode) &&
      status.st_uid == ::geteuid() && (status.st_mode & 077) != 0) {
    ::fchmod(descriptor_, 0600);
  }
  const std::string problem = append(log_line(seconds_of(CLOCK_REALTIME), first));
  if (problem.empty()) return;
  ::close(descriptor_);
  throw std::runtime_error(problem);
}

LogFile::~LogFile() { ::close(descriptor_); }

std::string LogFile::append(std::string_view line) {
  const std::string text = (is_in_line_ ? "\n" : "") + std::string(line);
  // One call for a line: lines of several processes don't mix.
  const ssize_t written = ::write(descriptor_, text.data(), text.size());
  if (written == static_cast<ssize_t>(text.size())) {
    is_in_line_ = false;
    return {};
  }
  const int error = written < 0 ? errno : ENOSPC;
  if (written > 0) is_in_line_ = text[static_cast<std::size_t>(written) - 1] != '\n';
  if (std::exchange(has_failed_, true)) return {};
  return file_.string() + ": " + text_of(error);
}

}  // namespace graycube
