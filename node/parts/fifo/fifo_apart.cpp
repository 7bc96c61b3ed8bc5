#include "node/parts/fifo/fifo_apart.hpp"

#include "node/parts/fifo/fifo_words.hpp"

namespace graycube {

void FifoApart::put(std::uint32_t bit, std::span<const RayTask> rays, Mail& mail) {
  if (rays.size() > places_ - held()) {
    return mail.fail("node " + std::to_string(mail.peer(bit).value) +
                     " sent more rays than the queue has places for");
  }
  for (const RayTask& ray : rays) {
    // The number tells whether rays come back in order, the sender where their credit belongs.
    const BatchStamp stamp{mail.job(), mail.epoch(), mail.peer(bit).value, 0, put_++};
    mail.to_fifo(fifo_message(FifoWord::kPut, encode_rays(stamp, {&ray, 1}, BatchType::kRays)));
    ++messages_;
  }
}

void FifoApart::ask(Mail& mail) {
  if (held() == 0 || is_asked_) return;
  is_asked_ = true;
  mail.to_fifo(fifo_message(FifoWord::kAsk));
  ++messages_;
}

std::optional<FifoApart::Handed> FifoApart::on_hand(std::span<const std::byte> ray,
                                                    const BatchLimits& limits, Mail& mail) {
  const BatchResult result = decode_rays(ray, limits, came_, BatchType::kRays);
  const auto* header = std::get_if<BatchHeader>(&result);
  if (header == nullptr || came_.size() != 1) {
    mail.fail("its FIFO's process handed out a broken ray");
    return std::nullopt;
  }
  const BatchStamp& stamp = header->stamp;
  if (stamp.job != mail.job() || stamp.epoch != mail.epoch()) return std::nullopt;
  std::uint32_t bit = 0;
  while (bit < links_ && mail.peer(bit) != Rank{stamp.sender}) ++bit;
  if (!is_asked_ || stamp.sequence != handed_ || bit == links_) {
    mail.fail("its FIFO's process handed out a ray that was not due");
    return std::nullopt;
  }
  ++messages_;
  ++handed_;
  is_asked_ = false;
  return Handed{bit, came_.front()};
}

void FifoApart::reset() {
  put_ = 0;
  handed_ = 0;
  is_asked_ = false;
}

}  // namespace graycube
