// Writes pictures' files beside the mailroom, which must stay quick to answer: a large one takes
// seconds.
#pragma once

#include <condition_variable>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

#include "frontal/parts/picture_answers.hpp"
#include "frontal/parts/writing.hpp"
#include "process/clocks.hpp"
#include "transport/zmq_sockets.hpp"

namespace graycube {

/// One piece of work at a time. The thread starts with the first.
class WritingThread {
 public:
  explicit WritingThread(Wakeup& mailroom) : mailroom_(mailroom) {}
  /// Waits until what is under way is written: files come whole or not at all.
  ~WritingThread() {
    if (thread_.joinable()) thread_.join();
  }
  WritingThread(const WritingThread&) = delete;
  WritingThread& operator=(const WritingThread&) = delete;

  /// The last work's result must have been taken.
  void give(WritingWork work) {
    if (thread_.joinable()) thread_.join();
    thread_ = std::thread([this, w = std::move(work)] {
      Answer answer = write_picture(*w.picture, w.request, w.origin, process_cpu_seconds);
      const std::lock_guard lock(mutex_);
      result_ = WritingResult{w.peer, std::move(answer)};
      mailroom_.signal();
    });
  }
  std::optional<WritingResult> take() {
    const std::lock_guard lock(mutex_);
    return std::exchange(result_, std::nullopt);
  }

 private:
  Wakeup& mailroom_;
  std::mutex mutex_;
  std::optional<WritingResult> result_;
  std::thread thread_;
};

}  // namespace graycube
