// The limits that fields of control messages have, in their ranges and lengths.
#pragma once

#include <concepts>
#include <cstddef>
#include <type_traits>

#include "film/aov.hpp"
#include "geometry/infinity.hpp"
#include "proto/messages/values.hpp"

namespace graycube {

/// The member's type is `T`, const for the writer and not for the reader.
template <class Member, class T>
concept Is = std::same_as<std::remove_const_t<Member>, T>;

struct FieldLimits {
  /// The range of numbers, also inside arrays; integers must fit their type as well.
  double min = -kInf;
  double max = kInf;
  /// Most bytes of a string, or elements of an array.
  std::size_t length = kMaxNameBytes;
  /// Whether the field may be missing; the member then keeps its default.
  bool has_default = false;
  /// Whether the field is written only if it isn't 0, the first of its names, or empty, which is
  /// its default: most jobs don't use what it is about.
  bool is_rare = false;
};

namespace control {

inline constexpr FieldLimits kText{.length = kMaxTextBytes};
inline constexpr FieldLimits kSeconds{.min = 0};
inline constexpr FieldLimits kRankRange{.max = kMaxNodes - 1};
inline constexpr FieldLimits kThreadRange{.min = 1, .max = kMaxThreads};
inline constexpr FieldLimits kFraction{.min = 0, .max = 1};

inline constexpr FieldLimits kPlaneRange{.max = kAovPlanes, .has_default = true};
inline constexpr FieldLimits kAovText{.has_default = true};
inline constexpr FieldLimits kDefaulted{.has_default = true};
inline constexpr FieldLimits kRare{.has_default = true, .is_rare = true};
inline constexpr FieldLimits kKey{.length = kMaxKeyBytes, .has_default = true, .is_rare = true};
inline constexpr FieldLimits kRareSeconds{.min = 0, .has_default = true, .is_rare = true};

constexpr FieldLimits at_least_one() { return {.min = 1}; }

}  // namespace control
}  // namespace graycube
