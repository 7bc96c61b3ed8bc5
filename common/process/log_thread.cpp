#include "process/log_thread.hpp"

#include <poll.h>
#include <signal.h>
#include <unistd.h>

#include <utility>

#include "process/clocks.hpp"
#include "process/log_line.hpp"

namespace graycube {
namespace {

/// It is waited so many milliseconds for standard error to take a line.
constexpr int kShowPatience_ms = 200;

}  // namespace

LogThread::LogThread(const std::filesystem::path& file, std::string_view first)
    : file_(file.empty() ? nullptr : std::make_unique<LogFile>(file, first)),
      thread_([this] { run(); }) {}

LogThread::~LogThread() {
  {
    const std::lock_guard lock(mutex_);
    is_ending_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

void LogThread::write(double unix_s, std::string_view text, bool is_shown) {
  if (!file_ && !is_shown) return;
  std::string line = log_line(unix_s, text);
  const std::lock_guard lock(mutex_);
  if (lines_.size() >= kMaxWaitingLines) {
    ++dropped_;
    return;
  }
  lines_.push_back({std::move(line), is_shown});
  changed_.notify_all();
}

void LogThread::run() {
  // Whoever read the lines may have gone: then writing fails, and ends nothing.
  sigset_t pipe;
  ::sigemptyset(&pipe);
  ::sigaddset(&pipe, SIGPIPE);
  ::pthread_sigmask(SIG_BLOCK, &pipe, nullptr);
  std::unique_lock lock(mutex_);
  for (;;) {
    changed_.wait(lock, [this] { return is_ending_ || !lines_.empty(); });
    if (lines_.empty()) return;
    const std::deque<Line> lines = std::exchange(lines_, {});
    const std::size_t dropped = std::exchange(dropped_, 0);
    lock.unlock();
    for (const Line& line : lines) write(line);
    if (dropped > 0) {
      const std::string told = "log: " + std::to_string(dropped) +
                               " lines are missing here, since they came too fast to be written";
      write({log_line(seconds_of(CLOCK_REALTIME), told), true});
    }
    lock.lock();
  }
}

void LogThread::write(const Line& line) {
  if (file_) {
    const std::string problem = file_->append(line.text);
    if (!problem.empty())
      show(log_line(seconds_of(CLOCK_REALTIME), "log: lines are missing in " + problem));
  }
  if (line.is_shown) show(line.text);
}

void LogThread::show(std::string_view line) {
  pollfd terminal{STDERR_FILENO, POLLOUT, 0};
  const int ready = ::poll(&terminal, 1, is_stuck_ ? 0 : kShowPatience_ms);
  is_stuck_ = ready <= 0;
  if (is_stuck_) return;
  // A line is shorter than what a pipe takes at once (PIPE_BUF).
  if (::write(STDERR_FILENO, line.data(), line.size()) < 0) is_stuck_ = true;
}

}  // namespace graycube
