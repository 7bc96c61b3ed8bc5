#include "frontal/store/tile_writer.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>
#include <utility>

namespace graycube {

namespace fs = std::filesystem;

namespace {

/// Waits until the file is on the disk; returns an errno or 0.
int write_to_disk(int file) { return ::fdatasync(file) == 0 ? 0 : errno; }

}  // namespace

TileWriter::TileWriter(Warn warn) : warn_(std::move(warn)), thread_([this] { run(); }) {}

TileWriter::~TileWriter() {
  {
    const std::lock_guard lock(mutex_);
    is_ending_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

void TileWriter::append(fs::path file, Bytes records) {
  give({std::move(file), std::move(records), false});
}
void TileWriter::remove(fs::path file) { give({std::move(file), {}, true}); }

void TileWriter::give(Task task) {
  {
    const std::lock_guard lock(mutex_);
    if (waiting_bytes_ + task.records.size() > kMaxWaitingRecordBytes) return;
    waiting_bytes_ += task.records.size();
    tasks_.push_back(std::move(task));
  }
  changed_.notify_all();
}

void TileWriter::run() {
  std::unique_lock lock(mutex_);
  const auto has_work = [this] { return is_ending_ || !tasks_.empty(); };
  for (;;) {
    if (!unsafe_since_) {
      changed_.wait(lock, has_work);
    } else if (!changed_.wait_until(lock, *unsafe_since_ + kDiskInterval, has_work)) {
      lock.unlock();
      ask_disk();
      lock.lock();
      continue;
    }
    if (tasks_.empty()) break;
    const Task task = std::move(tasks_.front());
    tasks_.pop_front();
    lock.unlock();
    carry_out(task);
    lock.lock();
    waiting_bytes_ -= task.records.size();
  }
  reach_disk();
  if (file_ >= 0) ::close(file_);
}

void TileWriter::carry_out(const Task& task) {
  const bool is_open = task.file == open_;
  if (task.removes ? is_open : !is_open) {
    if (!task.removes) reach_disk();
    if (file_ >= 0) ::close(std::exchange(file_, -1));
    open_.clear();
    unsafe_since_.reset();
  }
  if (!task.removes) return write(task);
  std::error_code ignored;
  fs::remove(task.file, ignored);
}

void TileWriter::write(const Task& task) {
  if (open_.empty()) {
    file_ = ::open(task.file.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0600);
    if (file_ < 0) return fail(errno);
    open_ = task.file;
  }
  std::size_t written = 0;
  while (written < task.records.size()) {
    const ssize_t n = ::write(file_, task.records.data() + written, task.records.size() - written);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return fail(errno);
    written += static_cast<std::size_t>(n);
  }
  const auto now = std::chrono::steady_clock::now();
  if (!unsafe_since_) unsafe_since_ = now;
  if (now - *unsafe_since_ >= kDiskInterval) ask_disk();
}

void TileWriter::ask_disk() {
  if (disk_.valid()) {
    if (disk_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) {
      unsafe_since_ = std::chrono::steady_clock::now();  // asked again when as long has passed
      return;
    }
    take_answer(disk_.get());
  }
  unsafe_since_.reset();
  // The file may be closed here meanwhile.
  const int file = ::fcntl(file_, F_DUPFD_CLOEXEC, 0);
  if (file < 0) return fail(errno);
  const auto write_and_close = [file] {
    const int error = write_to_disk(file);
    ::close(file);
    return error;
  };
  try {
    disk_ = std::async(std::launch::async, write_and_close);
  } catch (const std::system_error&) {  // there are no more threads
    take_answer(write_and_close());
  }
}

void TileWriter::reach_disk() {
  if (disk_.valid()) take_answer(disk_.get());
  if (std::exchange(unsafe_since_, std::nullopt)) take_answer(write_to_disk(file_));
}

void TileWriter::take_answer(int error) {
  if (error != 0) fail(error);
}

void TileWriter::fail(int error) {
  if (std::exchange(has_warned_, true)) return;
  warn_("tiles can't be recorded, so that they would be traced again: " +
        std::generic_category().message(error));
}

}  // namespace graycube
