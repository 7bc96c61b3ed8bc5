// Control messages as JSON text and back. Any message can be encoded, and decode accepts the result
// if the values lie in their fields' ranges. Decoding takes anybody's bytes and throws nothing.
// Unknown fields are ignored, so that newer senders may add some.
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

/// One line of JSON. Strings are made printable: bytes that are not UTF-8 are replaced, control
/// characters become spaces, and text beyond the field's length is cut off.
std::string encode(const ControlMessage& message);

[[nodiscard]] ControlResult decode(std::string_view text);

/// The message's name on the wire.
std::string_view type_of(const ControlMessage& message);

/// The names of all messages, in the order of the variant's alternatives.
std::span<const std::string_view> control_types();

}  // namespace graycube
