// Places in long work at which it ends when nobody waits for it any more.
#pragma once

#include <atomic>

namespace graycube {

/// Thrown out of work that was to stop. No std::exception: it is no error, and whoever words errors
/// must not catch it.
struct WorkStopped {};

/// As long as one stands on a thread, stop_if_asked() there looks at its flag. Whoever sets it up
/// catches WorkStopped and throws the state of the work away.
class Stoppable {
 public:
  /// The flag must outlive this.
  explicit Stoppable(const std::atomic<bool>& flag) : before_(current()) { current() = &flag; }
  ~Stoppable() { current() = before_; }
  Stoppable(const Stoppable&) = delete;
  Stoppable& operator=(const Stoppable&) = delete;

  static const std::atomic<bool>*& current() {
    thread_local const std::atomic<bool>* flag = nullptr;
    return flag;
  }

 private:
  const std::atomic<bool>* before_;
};

/// Throws WorkStopped if the thread's work is to stop. To be called often enough that little time
/// passes between calls, but not for every ray.
inline void stop_if_asked() {
  const std::atomic<bool>* const flag = Stoppable::current();
  if (flag != nullptr && flag->load(std::memory_order_relaxed)) [[unlikely]]
    throw WorkStopped{};
}

}  // namespace graycube
