#include "node/parts/fifo/ray_fifo.hpp"

#include <algorithm>

namespace graycube {

std::optional<std::string_view> RayFifo::take(std::span<const std::byte> bytes, Bytes& answers) {
  std::optional<std::string_view> wrong;
  const bool are_messages = stream_.take(bytes, [&](FifoWord word, std::span<const std::byte> ray) {
    if (!wrong) wrong = on_message(word, ray);
    hand_out(answers);
  });
  if (!wrong && !are_messages) wrong = "no message of a node came";
  return wrong;
}

std::optional<std::string_view> RayFifo::on_message(FifoWord word, std::span<const std::byte> ray) {
  switch (word) {
    case FifoWord::kPut:
      if (line_.size() == places_) return "more rays came than there are places for";
      std::ranges::copy(ray, line_.emplace_back().begin());
      return std::nullopt;
    case FifoWord::kAsk:
      if (is_asked_) return "a ray was asked for before the last one was handed out";
      is_asked_ = true;
      return std::nullopt;
    case FifoWord::kHand: break;
  }
  return "no message of a node came";
}

void RayFifo::hand_out(Bytes& answers) {
  if (!is_asked_ || line_.empty()) return;
  const Bytes message = fifo_message(FifoWord::kHand, line_.front());
  answers.insert(answers.end(), message.begin(), message.end());
  line_.pop_front();
  is_asked_ = false;
}

}  // namespace graycube
