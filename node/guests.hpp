// Other nodes that run in this process, since no process could be started for them: each has a
// mailroom in a thread of its own, with its own evaluators.
#pragma once

#include <deque>
#include <functional>
#include <mutex>
#include <string>
#include <thread>
#include <utility>

#include "node/mailroom.hpp"

namespace graycube {

class Guests {
 public:
  /// Called, by whichever thread, with a guest's rank and why it can't go on. It must end the
  /// process: that is what the frontal sees.
  using Fail = std::function<void(Rank, const std::string&)>;

  Guests(FarmAccess farm, Fail fail) : farm_(std::move(farm)), fail_(std::move(fail)) {}
  /// Ends when all guests have.
  ~Guests() { wait(); }
  Guests(const Guests&) = delete;
  Guests& operator=(const Guests&) = delete;

  /// From now on the process is that node, too. Any thread may call it; throws TransportError.
  void take_in(const control::Host& node);
  /// Returns once the frontal has ended all guests.
  void wait();

 private:
  struct Guest {
    Guest(const FarmAccess& farm, const control::Host& node, Mailroom::TakeIn take_in)
        : mailroom(farm, Rank{node.rank}, node.incarnation, true, std::move(take_in)) {}
    Mailroom mailroom;
    std::thread thread;
  };
  void run(Mailroom& mailroom, Rank rank);

  FarmAccess farm_;
  Fail fail_;
  std::mutex mutex_;
  /// Its mailrooms stay where they are until the process ends.
  std::deque<Guest> guests_;
};

}  // namespace graycube
