// The fields of the messages between the frontal and hosts, as control_fields.hpp lists all others.
#pragma once

#include "proto/messages/field_limits.hpp"
#include "proto/messages/hosts.hpp"

namespace graycube::control {

/// Paths of local sockets have at most 107 bytes.
inline constexpr FieldLimits kFolder{.length = 107};
inline constexpr FieldLimits kSlots{.min = 1, .max = kMaxNodes};
inline constexpr FieldLimits kRanks{.min = 0, .max = kMaxNodes - 1, .length = kMaxNodes};

void each_field(auto& visit, Is<HostInfo> auto& m) {
  visit("host", m.host);
  visit("cores", m.cores, at_least_one());
  visit("memory_bytes", m.memory_bytes);
  visit("slots", m.slots, kSlots);
  visit("nodes", m.nodes, {.max = kMaxNodes});
  visit("pid", m.pid);
  visit("state", m.state, kText);
}

void each_field(auto& visit, Is<Join> auto& m) {
  visit("host", m.host);
  visit("tag", m.tag);
  visit("folder", m.folder, kFolder);
  visit("cores", m.cores, at_least_one());
  visit("memory_bytes", m.memory_bytes);
  visit("slots", m.slots, kSlots);
  visit("pid", m.pid);
  visit("version", m.version);
}

void each_field(auto& visit, Is<NodeEnded> auto& m) {
  visit("rank", m.rank, kRankRange);
  visit("incarnation", m.incarnation);
  visit("how", m.how, kText);
  visit("was_started", m.was_started);
}

void each_field(auto& visit, Is<Alive> auto& m) {
  visit("sequence", m.sequence);
  visit("stopped", m.stopped, kRanks);
}

void each_field(auto&, Is<Leave> auto&) {}

void each_field(auto& visit, Is<Joined> auto& m) {
  visit("nodes_port", m.nodes_port, {.min = 1, .max = 65535});
  visit("threads", m.threads, kThreadRange);
  visit("heartbeat_ms", m.heartbeat_ms, at_least_one());
  visit("silence_ms", m.silence_ms, at_least_one());
}

void each_field(auto& visit, Is<NodeToRun> auto& m) {
  visit("rank", m.rank, kRankRange);
  visit("incarnation", m.incarnation);
}

void each_field(auto& visit, Is<RunNodes> auto& m) {
  visit("nodes", m.nodes, {.length = kMaxNodes});
}

void each_field(auto& visit, Is<EndNode> auto& m) {
  visit("rank", m.rank, kRankRange);
  visit("incarnation", m.incarnation);
}

}  // namespace graycube::control
