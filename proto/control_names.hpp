// The names of enum values in control messages and on the command line.
#pragma once

#include <array>
#include <string_view>

#include "proto/messages.hpp"

namespace graycube::control_names {

/// The names of an enum's values, in their order.
template <class E>
struct Names;

template <>
struct Names<Algorithm> {
  static constexpr std::array<std::string_view, 4> kAll{"auto", "serial", "roth", "macro"};
};
template <>
struct Names<Grain> {
  static constexpr std::array<std::string_view, 3> kAll{"pixel", "line", "tile"};
};
template <>
struct Names<ShadowMode> {
  static constexpr std::array<std::string_view, 3> kAll{"horizon", "forward", "local"};
};
template <>
struct Names<PartitionMode> {
  static constexpr std::array<std::string_view, 3> kAll{"regular", "balanced", "auto"};
};
template <>
struct Names<FlowMode> {
  static constexpr std::array<std::string_view, 2> kAll{"credit", "blocking"};
};
template <>
struct Names<SumsMode> {
  static constexpr std::array<std::string_view, 2> kAll{"direct", "tree"};
};
template <>
struct Names<ReturnsMode> {
  static constexpr std::array<std::string_view, 2> kAll{"frontal", "sender"};
};
template <>
struct Names<BoundariesMode> {
  static constexpr std::array<std::string_view, 2> kAll{"fixed", "sliding"};
};
template <>
struct Names<Subdivision> {
  static constexpr std::array<std::string_view, 6> kAll{"surfaces", "roth",   "linked",
                                                        "arnaldi",  "octree", "kaplan"};
};
template <>
struct Names<Entry> {
  static constexpr std::array<std::string_view, 3> kAll{"usual", "descent", "extremal"};
};
template <>
struct Names<JobState> {
  static constexpr std::array<std::string_view, 7> kAll{
      "queued", "loading", "building", "rendering", "done", "failed", "cancelled"};
};
template <>
struct Names<NodeState> {
  static constexpr std::array<std::string_view, 4> kAll{"starting", "idle", "busy", "lost"};
};
template <>
struct Names<FailureCode> {
  static constexpr std::array<std::string_view, 10> kAll{
      "bad_input", "failed",   "cancelled", "timeout",     "unknown_job",
      "busy",      "not_done", "too_large", "bad_request", "deadlock"};
};

template <class E>
constexpr std::string_view name_of(E value) {
  const auto i = static_cast<std::size_t>(value);
  return i < Names<E>::kAll.size() ? Names<E>::kAll[i] : std::string_view{};
}

}  // namespace graycube::control_names
