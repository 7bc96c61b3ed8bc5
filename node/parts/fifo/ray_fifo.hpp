// The queue in the process that holds a node's FIFO: takes what the node puts in, and hands it out
// one by one, in order, to whoever asks. A state machine like the node's brain.
#pragma once

#include <array>
#include <cstddef>
#include <deque>
#include <optional>
#include <span>
#include <string_view>

#include "node/parts/fifo/fifo_words.hpp"

namespace graycube {

class RayFifo {
 public:
  /// The queue holds so many rays.
  explicit RayFifo(std::size_t places) : places_(places) {}

  /// Takes what came from the node, in whatever parts, and adds what it is to be told to `answers`.
  /// Returns why it can't go on, if it can't: then the process is to end.
  [[nodiscard]] std::optional<std::string_view> take(std::span<const std::byte> bytes,
                                                     Bytes& answers);
  std::size_t size() const { return line_.size(); }

 private:
  using Ray = std::array<std::byte, kFifoRayBytes>;
  std::optional<std::string_view> on_message(FifoWord word, std::span<const std::byte> ray);
  void hand_out(Bytes& answers);

  std::size_t places_;
  FifoStream stream_;
  std::deque<Ray> line_;
  /// An evaluator waits for a ray.
  bool is_asked_ = false;
};

}  // namespace graycube
