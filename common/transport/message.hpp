// Messages sent over a link: one frame, or two if a control message has a binary payload behind
// it.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace graycube {

using Bytes = std::vector<std::byte>;

inline std::string_view text_of(std::span<const std::byte> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

/// Bytes that nobody changes any more, with shared ownership: a model that goes to every node, or a
/// frame that the socket received.
class SharedBytes {
 public:
  SharedBytes() = default;
  SharedBytes(Bytes bytes) {  // NOLINT: implicit
    auto owned = std::make_shared<const Bytes>(std::move(bytes));
    bytes_ = *owned;
    owner_ = std::move(owned);
  }
  /// `bytes` must stay valid as long as their owner lives.
  SharedBytes(std::shared_ptr<const void> owner, std::span<const std::byte> bytes)
      : owner_(std::move(owner)), bytes_(bytes) {}

  std::span<const std::byte> bytes() const { return bytes_; }
  operator std::span<const std::byte>() const { return bytes_; }  // NOLINT: implicit
  std::size_t size() const { return bytes_.size(); }
  bool empty() const { return bytes_.empty(); }

 private:
  std::shared_ptr<const void> owner_;
  std::span<const std::byte> bytes_;
};

struct Message {
  Bytes frame;
  SharedBytes payload;

  static Message of_text(std::string_view text, SharedBytes payload = {}) {
    Message m;
    const auto bytes = std::as_bytes(std::span(text.data(), text.size()));
    m.frame.assign(bytes.begin(), bytes.end());
    m.payload = std::move(payload);
    return m;
  }
  static Message of_batch(Bytes batch) { return {std::move(batch), {}}; }

  std::string_view text() const { return text_of(frame); }
};

/// A message whose frame somebody else holds. The payload can be kept without a copy.
struct MessageView {
  std::span<const std::byte> frame;
  SharedBytes payload;

  MessageView() = default;
  MessageView(const Message& m) : frame(m.frame), payload(m.payload) {}

  std::string_view text() const { return text_of(frame); }
};

}  // namespace graycube
