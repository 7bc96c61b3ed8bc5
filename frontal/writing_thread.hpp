// Writes pictures to files and to the job store, and reads them from there, and takes long scenes
// into the store: beside the mailroom, which must stay quick to answer. A large one takes seconds.
#pragma once

#include <mutex>
#include <optional>
#include <thread>
#include <utility>
#include <variant>

#include "frontal/admission/long_scene.hpp"
#include "frontal/parts/keeping.hpp"
#include "frontal/parts/picture_answers.hpp"
#include "frontal/parts/writing.hpp"
#include "overloaded.hpp"
#include "process/clocks.hpp"
#include "transport/zmq_sockets.hpp"

namespace graycube {

/// One piece of work at a time. A thread begins with each, and ends with it.
class WritingThread {
 public:
  using Work = std::variant<WritingWork, KeepingWork, ReadingWork, AdmissionWork>;
  using Result = std::variant<WritingResult, KeepingResult, ReadingResult, AdmissionResult>;

  explicit WritingThread(Wakeup& mailroom) : mailroom_(mailroom) {}
  /// Waits until what is under way is written: files come whole or not at all.
  ~WritingThread() {
    if (thread_.joinable()) thread_.join();
  }
  WritingThread(const WritingThread&) = delete;
  WritingThread& operator=(const WritingThread&) = delete;

  bool is_free() const { return !is_at_work_; }
  /// It must be free.
  void give(Work work) {
    if (thread_.joinable()) thread_.join();
    is_at_work_ = true;
    thread_ = std::thread([this, w = std::move(work)]() mutable {
      Result result = result_of(std::move(w));
      const std::lock_guard lock(mutex_);
      result_ = std::move(result);
      mailroom_.signal();
    });
  }
  /// Afterwards it is free, if there was a result.
  std::optional<Result> take() {
    const std::lock_guard lock(mutex_);
    if (result_) is_at_work_ = false;
    return std::exchange(result_, std::nullopt);
  }

 private:
  static Result result_of(Work work) {
    return std::visit(
        Overloaded{[](WritingWork& w) -> Result {
                     return WritingResult{w.peer, write_picture(*w.picture, w.request, w.origin,
                                                                process_cpu_seconds)};
                   },
                   [](KeepingWork& w) -> Result { return keep_picture(std::move(w)); },
                   [](ReadingWork& w) -> Result { return read_picture(w); },
                   [](AdmissionWork& w) -> Result { return admit_scene(w); }},
        work);
  }

  Wakeup& mailroom_;
  /// Of the mailroom's thread alone.
  bool is_at_work_ = false;
  std::mutex mutex_;
  std::optional<Result> result_;
  std::thread thread_;
};

}  // namespace graycube
