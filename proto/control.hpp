// Control messages as JSON text and back. Encoding is total: what it gives, decode takes, as long
// as the values lie in their fields' ranges. Decoding takes anybody's bytes and throws nothing.
// Fields unknown here are ignored, so that newer senders may add some.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <variant>

#include "proto/messages.hpp"

namespace graycube {

/// The value of "graycube" in every message.
inline constexpr int kControlVersion = 1;
/// Longest JSON frame, and how deep arrays and objects may nest in it.
inline constexpr std::size_t kMaxControlBytes = std::size_t{1} << 20;
inline constexpr std::size_t kMaxControlNesting = 32;

/// Why a text is not a control message: the field ("options/width"; empty for the whole) and what
/// is wrong.
struct ControlError {
  std::string field;
  std::string why;
  friend bool operator==(const ControlError&, const ControlError&) = default;
};

using ControlResult = std::variant<ControlMessage, ControlError>;

/// One line of JSON. Strings are made printable: what is not UTF-8 is replaced, control characters
/// become spaces, the rest is cut at the field's length.
std::string encode(const ControlMessage& message);

[[nodiscard]] ControlResult decode(std::string_view text);

/// The message's name on the wire.
std::string_view type_of(const ControlMessage& message);

/// The names of all messages, in the order of the variant's alternatives.
std::span<const std::string_view> control_types();

}  // namespace graycube
