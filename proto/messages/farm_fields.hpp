// The fields of the messages about a farm itself, as control_fields.hpp lists all others.
#pragma once

#include "proto/messages/clients.hpp"
#include "proto/messages/field_limits.hpp"
#include "proto/messages/to_nodes.hpp"

namespace graycube::control {

void each_field(auto&, Is<Farm> auto&) {}

void each_field(auto& visit, Is<FarmInfo> auto& m) {
  constexpr FieldLimits kNodes{.max = kMaxNodes};
  visit("pid", m.pid);
  visit("endpoint", m.endpoint);
  visit("version", m.version);
  visit("started_s", m.started_s, kSeconds);
  visit("nodes", m.nodes, kNodes);
  visit("nodes_here", m.nodes_here, kNodes);
  visit("queued", m.queued);
  visit("running", m.running);
  visit("ended", m.ended);
}

void each_field(auto& visit, Is<Host> auto& m) {
  visit("rank", m.rank, kRankRange);
  visit("incarnation", m.incarnation);
}

}  // namespace graycube::control
