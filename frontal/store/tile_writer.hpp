// Appends records of tiles to files, in a thread of its own: a slow disk holds nobody up.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <filesystem>
#include <future>
#include <mutex>
#include <optional>
#include <thread>

#include "frontal/store/set_aside.hpp"
#include "transport/message.hpp"

namespace graycube {

/// Records that may wait for the disk. Beyond that they are dropped: their tiles would be traced
/// again.
inline constexpr std::size_t kMaxWaitingRecordBytes = std::size_t{64} << 20;

/// The disk is asked to write no oftener, and by another thread: that may take seconds, in which
/// records go on being written. Only the machine's end, not the process's, loses what isn't on the
/// disk yet.
inline constexpr std::chrono::seconds kDiskInterval{1};

class TileWriter {
 public:
  /// `warn` is called by the thread.
  explicit TileWriter(Warn warn);
  /// Writes what waits, and ends.
  ~TileWriter();
  TileWriter(const TileWriter&) = delete;
  TileWriter& operator=(const TileWriter&) = delete;

  void append(std::filesystem::path file, Bytes records);
  /// Removes the file, be it one of records or not, once what was appended before is written.
  void remove(std::filesystem::path file);

 private:
  struct Task {
    std::filesystem::path file;
    Bytes records;
    bool removes = false;
  };
  void give(Task task);
  void run();
  void carry_out(const Task& task);
  void write(const Task& task);
  /// Has the disk write what was written, unless it still writes what came before.
  void ask_disk();
  /// Waits until all of it is there.
  void reach_disk();
  /// The disk's: an errno or 0.
  void take_answer(int error);
  void fail(int error);

  Warn warn_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Task> tasks_;
  std::size_t waiting_bytes_ = 0;
  bool is_ending_ = false, has_warned_ = false;
  // Of the thread alone: the file that is open, and since when it isn't on the disk.
  std::filesystem::path open_;
  int file_ = -1;
  std::optional<std::chrono::steady_clock::time_point> unsafe_since_;
  /// The disk's answer, an errno or 0, while it writes.
  std::future<int> disk_;
  std::thread thread_;
};

}  // namespace graycube
