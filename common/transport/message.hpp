// What travels over a link: one frame, or two where a control message has a binary payload behind it.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace graycube {

using Bytes = std::vector<std::byte>;

inline std::string_view text_of(std::span<const std::byte> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

struct Message {
  Bytes frame;
  Bytes payload;

  static Message of_text(std::string_view text, Bytes payload = {}) {
    Message m;
    const auto bytes = std::as_bytes(std::span(text.data(), text.size()));
    m.frame.assign(bytes.begin(), bytes.end());
    m.payload = std::move(payload);
    return m;
  }
  static Message of_batch(Bytes batch) { return {std::move(batch), {}}; }

  std::string_view text() const { return text_of(frame); }
};

/// A message that somebody else holds.
struct MessageView {
  std::span<const std::byte> frame;
  std::span<const std::byte> payload;

  MessageView() = default;
  MessageView(const Message& m) : frame(m.frame), payload(m.payload) {}

  std::string_view text() const { return text_of(frame); }
};

}  // namespace graycube
