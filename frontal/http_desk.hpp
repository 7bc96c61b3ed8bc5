// Where web requests ask the frontal: questions of the web server's thread wait here for the
// frontal's, which answers each once. So the brain knows nothing of HTTP, and no socket is needed.
#pragma once

#include <cstdint>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "frontal/parts/post.hpp"
#include "transport/message.hpp"
#include "transport/zmq_sockets.hpp"

namespace graycube {

class HttpDesk {
 public:
  struct Question {
    std::uint64_t number = 0;
    Message message;
  };

  /// `frontal` wakes the frontal's thread.
  explicit HttpDesk(Wakeup& frontal) : frontal_(frontal) {}

  // Called by the web server's thread
  void ask(Question question) {
    {
      const std::lock_guard lock(mutex_);
      questions_.push_back(std::move(question));
    }
    frontal_.signal();
  }

  // Called by the frontal's thread
  std::vector<Question> take() {
    const std::lock_guard lock(mutex_);
    return std::exchange(questions_, {});
  }
  /// The name by which the frontal's brain knows who asked; none of the doors' peers has such.
  static PeerId peer_of(std::uint64_t number) { return kLetter + std::to_string(number); }
  static std::optional<std::uint64_t> number_of(const PeerId& peer) {
    if (peer.empty() || peer.front() != kLetter) return std::nullopt;
    return std::stoull(peer.substr(1));
  }

 private:
  static constexpr char kLetter = 'h';

  Wakeup& frontal_;
  std::mutex mutex_;
  std::vector<Question> questions_;
};

}  // namespace graycube
