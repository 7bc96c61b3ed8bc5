// The fields of the messages about what a farm does, as control_fields.hpp lists all others.
#pragma once

#include "proto/messages/farm_fields.hpp"
#include "proto/messages/farm_figures.hpp"

namespace graycube::control {

void each_field(auto&, Is<Metrics> auto&) {}

void each_field(auto& visit, Is<FarmCounts> auto& m) {
  visit("jobs_accepted", m.jobs_accepted);
  visit("jobs_done", m.jobs_done);
  visit("jobs_failed", m.jobs_failed);
  visit("jobs_cancelled", m.jobs_cancelled);
  visit("tiles_whole", m.tiles_whole);
  visit("nodes_lost", m.nodes_lost);
  visit("messages_lost", m.messages_lost);
  visit("epochs", m.epochs);
  visit("refused_submissions", m.refused_submissions);
  visit("refused_nodes", m.refused_nodes);
  visit("refused_clients", m.refused_clients);
  visit("refused_connections", m.refused_connections);
  visit("primary", m.primary);
  visit("shadow", m.shadow);
  visit("reflection", m.reflection);
  visit("refraction", m.refraction);
  visit("forwarded_primary", m.forwarded_primary);
  visit("forwarded_shadow", m.forwarded_shadow);
  visit("forwarded_secondary", m.forwarded_secondary);
  visit("ray_batches", m.ray_batches);
  visit("ray_bytes", m.ray_bytes);
  visit("contribution_batches", m.contribution_batches);
  visit("contribution_bytes", m.contribution_bytes);
  visit("sum_batches", m.sum_batches);
  visit("sum_bytes", m.sum_bytes);
  visit("answer_batches", m.answer_batches);
  visit("answer_bytes", m.answer_bytes);
  visit("slice_batches", m.slice_batches);
  visit("slice_bytes", m.slice_bytes);
  visit("malformed_drops", m.malformed_drops);
  visit("busy_s", m.busy_s, kSeconds);
  visit("blocked_s", m.blocked_s, kSeconds);
  visit("window_s", m.window_s, kSeconds);
  visit("idle_s", m.idle_s, kSeconds);
  visit("fifo_wait_s", m.fifo_wait_s, kSeconds);
  visit("nodes_cpu_s", m.nodes_cpu_s, kSeconds);
  visit("last_queue_peak", m.last_queue_peak);
  visit("last_outbox_peak", m.last_outbox_peak);
  visit("last_memory_bytes", m.last_memory_bytes);
}

void each_field(auto& visit, Is<FarmMetrics> auto& m) {
  constexpr FieldLimits kNodes{.max = kMaxNodes};
  visit("farm", m.farm);
  visit("counts", m.counts);
  visit("nodes_starting", m.nodes_starting, kNodes);
  visit("nodes_idle", m.nodes_idle, kNodes);
  visit("nodes_busy", m.nodes_busy, kNodes);
  visit("nodes_lost", m.nodes_lost, kNodes);
  visit("fraction", m.fraction, kFraction);
  visit("frontal_cpu_s", m.frontal_cpu_s, kSeconds);
  visit("longest_turn_s", m.longest_turn_s, kSeconds);
}

void each_field(auto& visit, Is<Log> auto& m) {
  visit("pid", m.pid);
  visit("after", m.after);
  visit("newest", m.newest, {.max = kMaxLinesKept});
  visit("wait_s", m.wait_s, {.min = 0, .max = kMaxLogWait_s});
}

void each_field(auto& visit, Is<LogLine> auto& m) {
  visit("number", m.number, at_least_one());
  visit("unix_s", m.unix_s, kSeconds);
  visit("job", m.job);
  visit("is_trouble", m.is_trouble);
  visit("text", m.text, kText);
}

void each_field(auto& visit, Is<LogLines> auto& m) {
  visit("pid", m.pid);
  visit("is_end", m.is_end);
  visit("lines", m.lines, {.length = kMaxLinesAnswered});
}

}  // namespace graycube::control
