// The fields of every control message with their limits, listed once for the writer and the reader:
// each_field(visit, message) calls visit(name, member[, limits]) for each. A member of type
// std::optional may be missing, as may one whose limits say so; every other one must be there.
#pragma once

#include <cstdint>

#include "proto/messages.hpp"
#include "proto/messages/farm_fields.hpp"
#include "proto/messages/farm_figure_fields.hpp"
#include "proto/messages/field_limits.hpp"
#include "proto/messages/host_fields.hpp"
#include "proto/messages/sliding_fields.hpp"
#include "shading/settings.hpp"

namespace graycube {

namespace control {

/// Messages whose `rank` names the node whose slice is meant.
template <class M>
concept IsAboutSlice = Is<M, Lend> || Is<M, Copy> || Is<M, Share> || Is<M, HandOn>;

/// Messages that have no field but job and epoch.
template <class M>
concept IsAboutEpoch = Is<M, Prepare> || Is<M, AllWhole> || Is<M, Dealt>;

void each_field(auto& visit, Is<NodeStats> auto& m) {
  visit("rank", m.rank, kRankRange);
  visit("gray", m.gray, kRankRange);
  visit("pid", m.pid);
  visit("cpu_s", m.cpu_s, kSeconds);
  visit("start_cpu_s", m.start_cpu_s, {.min = 0, .has_default = true});
  visit("fifo_wait_s", m.fifo_wait_s, kRareSeconds);
  visit("fifo_cpu_s", m.fifo_cpu_s, kRareSeconds);
  visit("fifo_messages", m.fifo_messages, kRare);
  visit("busy_s", m.busy_s, kSeconds);
  visit("idle_s", m.idle_s, kSeconds);
  visit("blocked_s", m.blocked_s, kSeconds);
  visit("window_s", m.window_s, kSeconds);
  visit("rays_in", m.rays_in);
  visit("rays_out", m.rays_out);
  visit("queue_peak", m.queue_peak);
  visit("primitives", m.primitives);
  visit("peak_rss_bytes", m.peak_rss_bytes);
  visit("primary", m.primary);
  visit("shadow", m.shadow);
  visit("reflection", m.reflection);
  visit("refraction", m.refraction);
  visit("skipped_by_horizon", m.skipped_by_horizon);
  visit("forwarded_shadow", m.forwarded_shadow);
  visit("forwarded_secondary", m.forwarded_secondary);
  visit("forwarded_primary", m.forwarded_primary, kRare);
  visit("ray_batches", m.ray_batches);
  visit("ray_bytes", m.ray_bytes);
  visit("contribution_batches", m.contribution_batches);
  visit("contribution_bytes", m.contribution_bytes);
  visit("sum_batches", m.sum_batches, kDefaulted);
  visit("sum_bytes", m.sum_bytes, kDefaulted);
  visit("non_finite", m.non_finite);
  visit("clamped", m.clamped);
  visit("malformed_drops", m.malformed_drops);
  visit("outbox_peak", m.outbox_peak);
  visit("memory_bytes", m.memory_bytes);
  visit("models_borrowed", m.models_borrowed);
  visit("tiles_taken_over", m.tiles_taken_over);
  visit("rays_taken_over", m.rays_taken_over);
  visit("endgame_s", m.endgame_s, kSeconds);
  visit("cells", m.cells, kDefaulted);
  visit("cells_visited", m.cells_visited, kDefaulted);
  visit("primitives_tested", m.primitives_tested, kDefaulted);
  visit("tests_saved", m.tests_saved, kRare);
  visit("boxes_tested", m.boxes_tested, kRare);
  visit("boxes_rejected", m.boxes_rejected, kRare);
  visit("spheres_tested", m.spheres_tested, kRare);
  visit("spheres_rejected", m.spheres_rejected, kRare);
  visit("nodes_descended", m.nodes_descended, kRare);
  visit("entry_links", m.entry_links, kRare);
  visit("rays_not_shot", m.rays_not_shot, kRare);
  visit("open_peak", m.open_peak, kRare);
  visit("open_bytes_peak", m.open_bytes_peak, kRare);
  visit("answers", m.answers, kRare);
  visit("answer_batches", m.answer_batches, kRare);
  visit("answer_bytes", m.answer_bytes, kRare);
  visit("slice_batches", m.slice_batches, kRare);
  visit("slice_bytes", m.slice_bytes, kRare);
}

void each_field(auto& visit, Is<JobOptions> auto& m) {
  visit("algorithm", m.algorithm, kDefaulted);
  visit("grain", m.grain, kDefaulted);
  visit("shadows", m.shadows, kDefaulted);
  visit("partition", m.partition, kDefaulted);
  visit("scatter", m.scatter, {.max = kMaxScatter, .has_default = true});
  visit("flow", m.flow, kDefaulted);
  visit("queue", m.queue, {.min = 1, .max = kMaxQueue, .has_default = true});
  visit("fifo", m.fifo, kRare);
  visit("threads", m.threads, {.max = kMaxThreads, .has_default = true});
  visit("timeout_s", m.timeout_s, {.min = 0, .has_default = true});
  visit("width", m.width, {.min = 1, .max = kMaxImageSide});
  visit("height", m.height, {.min = 1, .max = kMaxImageSide});
  visit("samples", m.samples, {.min = 1, .max = kMaxSamples});
  visit("max_depth", m.max_depth, {.max = kMaxDepth});
  visit("aov", m.aov, kAovText);
  visit("sums", m.sums, kDefaulted);
  visit("subdivision", m.subdivision.way, kRare);
  visit("entry", m.subdivision.entry, kRare);
  visit("returns", m.returns, kRare);
  visit("mesh", m.mesh, kRare);
  visit("boundaries", m.boundaries, kRare);
}

void each_field(auto& visit, Is<GridLayout> auto& m) {
  constexpr FieldLimits kSide{.min = 1, .max = kMaxGridSide};
  // Edges may lie beyond the picture, but not by more than this.
  constexpr double kFarEdge = 1 << 30;
  constexpr FieldLimits kEdges{.min = -kFarEdge, .max = kFarEdge, .length = kMaxGridSide - 1};
  visit("columns", m.columns, kSide);
  visit("rows", m.rows, kSide);
  visit("scatter", m.scatter, {.min = 1, .max = kMaxScatter});
  visit("column_edges", m.column_edges, kEdges);
  visit("row_edges", m.row_edges, kEdges);
  visit("own_edges", m.own_edges,
        {.min = 1, .max = kMaxImageSide, .length = kMaxNodes, .has_default = true});
  visit("slab_depths", m.slab_depths,
        {.min = 0, .length = kMaxSlabs - 1, .has_default = true, .is_rare = true});
}

void each_field(auto& visit, Is<TokenProgress> auto& m) {
  visit("round", m.round);
  visit("hops", m.hops);
}

void each_field(auto& visit, Is<ErrorItem> auto& m) {
  visit("where", m.where, kText);
  visit("why", m.why, kText);
}

void each_field(auto& visit, Is<NodeInfo> auto& m) {
  visit("rank", m.rank, kRankRange);
  visit("gray", m.gray, kRankRange);
  visit("pid", m.pid);
  visit("state", m.state);
  visit("endpoint", m.endpoint);
  visit("threads", m.threads, kThreadRange);
  visit("host", m.host, kRare);
}

// ---- node → frontal

void each_field(auto& visit, Is<Hello> auto& m) {
  visit("rank", m.rank, kRankRange);
  visit("pid", m.pid);
  visit("incarnation", m.incarnation);
  visit("endpoint", m.endpoint);
  visit("threads", m.threads, kThreadRange);
  visit("version", m.version);
  visit("remote_endpoint", m.remote_endpoint, kRare);
}

void each_field(auto& visit, Is<Ready> auto& m) {
  visit("job", m.job, at_least_one());
  visit("epoch", m.epoch);
  visit("primitives", m.primitives);
  visit("objects", m.objects);
  visit("leaves", m.leaves);
  visit("build_s", m.build_s, kSeconds);
}

void each_field(auto& visit, Is<EpochAck> auto& m) {
  visit("job", m.job, at_least_one());
  visit("epoch", m.epoch);
}

void each_field(auto& visit, Is<TokenRound> auto& m) {
  visit("job", m.job, at_least_one());
  visit("epoch", m.epoch);
  visit("round", m.round);
  visit("hops", m.hops);
  visit("black", m.black);
  visit("count", m.count);
}

void each_field(auto& visit, Is<Terminated> auto& m) {
  visit("job", m.job, at_least_one());
  visit("epoch", m.epoch);
  visit("rounds", m.rounds);
  visit("hops", m.hops);
  visit("contribution_batches", m.contribution_batches);
}

void each_field(auto& visit, Is<NodeReport> auto& m) {
  visit("job", m.job, at_least_one());
  visit("epoch", m.epoch);
  visit("stats", m.stats);
}

void each_field(auto& visit, Is<Pong> auto& m) {
  visit("sequence", m.sequence);
  visit("moves", m.moves, kRare);
  visit("working", m.working, kRare);
}

void each_field(auto& visit, Is<NodeError> auto& m) {
  visit("job", m.job);
  visit("epoch", m.epoch, kDefaulted);
  visit("message", m.message, kText);
  visit("is_final", m.is_final, kRare);
}

void each_field(auto& visit, Is<WaitReport> auto& m) {
  visit("job", m.job, at_least_one());
  visit("epoch", m.epoch);
  visit("ping", m.ping);
  visit("is_stalled", m.is_stalled);
  visit("waits_for", m.waits_for, {.max = kMaxDimension - 1});
  visit("moves", m.moves);
  visit("granted", m.granted, {.length = kMaxDimension});
  visit("received", m.received, {.length = kMaxDimension});
}

void each_field(auto& visit, Is<Borrow> auto& m) {
  visit("job", m.job, at_least_one());
  visit("epoch", m.epoch);
  visit("rank", m.rank, kRankRange);
  visit("room_bytes", m.room_bytes);
}

void each_field(auto&, Is<Goodbye> auto&) {}

// ---- frontal → node

void each_field(auto& visit, Is<Welcome> auto& m) {
  visit("nodes", m.nodes, {.min = 1, .max = kMaxNodes});
  visit("version", m.version);
  visit("endpoints", m.endpoints, {.length = kMaxNodes});
  visit("heartbeat_ms", m.heartbeat_ms, at_least_one());
}

void each_field(auto& visit, Is<Load> auto& m) {
  visit("job", m.job, at_least_one());
  visit("epoch", m.epoch);
  visit("algorithm", m.algorithm);
  visit("threads", m.threads, kThreadRange);
  visit("grid", m.grid);
  visit("grain", m.grain);
  visit("tile_size", m.tile_size, {.min = 1, .max = kMaxImageSide});
  visit("shadows", m.shadows);
  visit("flow", m.flow);
  visit("queue", m.queue, {.min = 1, .max = kMaxQueue});
  visit("fifo", m.fifo, kRare);
  visit("link_credit_bytes", m.link_credit_bytes);
  visit("window_tiles", m.window_tiles, at_least_one());
  visit("batch_bytes", m.batch_bytes, at_least_one());
  visit("outbox_rays", m.outbox_rays, {.min = 1, .has_default = true});
  visit("class_places", m.class_places, {.min = 1, .has_default = true});
  visit("horizon_bytes", m.horizon_bytes);
  visit("borrow_bytes", m.borrow_bytes);
  visit("is_replica", m.is_replica);
  visit("makes_copies", m.makes_copies);
  visit("sums", m.sums, kDefaulted);
  visit("subdivision", m.subdivision.way, kRare);
  visit("entry", m.subdivision.entry, kRare);
  visit("returns", m.returns, kRare);
  visit("mesh", m.mesh, kRare);
  visit("boundaries", m.boundaries, kRare);
}

void each_field(auto& visit, IsAboutSlice auto& m) {
  visit("job", m.job, at_least_one());
  visit("epoch", m.epoch);
  visit("rank", m.rank, kRankRange);
}

void each_field(auto& visit, Is<Relieved> auto& m) {
  visit("job", m.job, at_least_one());
  visit("epoch", m.epoch);
  visit("tiles", m.tiles, at_least_one());
}

void each_field(auto& visit, IsAboutEpoch auto& m) {
  visit("job", m.job, at_least_one());
  visit("epoch", m.epoch);
}

void each_field(auto& visit, Is<Start> auto& m) {
  visit("job", m.job, at_least_one());
  visit("epoch", m.epoch);
  visit("incarnations", m.incarnations, {.length = kMaxNodes});
  visit("open_tiles", m.open_tiles, {.length = kMaxNodes, .has_default = true, .is_rare = true});
}

void each_field(auto& visit, Is<Finish> auto& m) { visit("job", m.job, at_least_one()); }
void each_field(auto& visit, Is<Ping> auto& m) { visit("sequence", m.sequence); }
void each_field(auto&, Is<Shutdown> auto&) {}

// ---- client → frontal

void each_field(auto& visit, Is<Submit> auto& m) {
  visit("scene_name", m.scene_name);
  visit("options", m.options);
  visit("key", m.key, kKey);
}

void each_field(auto& visit, Is<Status> auto& m) { visit("job", m.job, at_least_one()); }
void each_field(auto&, Is<List> auto&) {}
void each_field(auto& visit, Is<Watch> auto& m) { visit("job", m.job, at_least_one()); }
void each_field(auto& visit, Is<Cancel> auto& m) { visit("job", m.job, at_least_one()); }
void each_field(auto&, Is<Nodes> auto&) {}

void each_field(auto& visit, Is<Fetch> auto& m) {
  visit("job", m.job, at_least_one());
  visit("first_row", m.first_row, {.max = kMaxImageSide});
  visit("rows", m.rows, {.max = kMaxImageSide});
  visit("plane", m.plane, kPlaneRange);
}

void each_field(auto& visit, Is<Write> auto& m) {
  visit("job", m.job, at_least_one());
  visit("exr", m.exr, kText);
  visit("png", m.png, kText);
}

void each_field(auto&, Is<Down> auto&) {}

// ---- frontal → client

void each_field(auto& visit, Is<Accepted> auto& m) { visit("job", m.job, at_least_one()); }

void each_field(auto& visit, Is<JobInfo> auto& m) {
  visit("job", m.job, at_least_one());
  visit("state", m.state);
  visit("scene", m.scene);
  visit("algorithm", m.algorithm);
  visit("nodes", m.nodes, {.max = kMaxNodes});
  visit("fraction", m.fraction, kFraction);
  visit("eta_s", m.eta_s, kSeconds);
  visit("rounds", m.rounds);
  visit("submitted_s", m.submitted_s, kSeconds);
  visit("started_s", m.started_s, kSeconds);
  visit("finished_s", m.finished_s, kSeconds);
  visit("message", m.message, kText);
  visit("tiles", m.tiles);
  visit("tiles_whole", m.tiles_whole);
  visit("choices", m.choices, kText);
}

void each_field(auto& visit, Is<Jobs> auto& m) {
  visit("jobs", m.jobs, {.length = kMaxJobsListed});
}

void each_field(auto& visit, Is<Progress> auto& m) {
  visit("job", m.job, at_least_one());
  visit("state", m.state);
  visit("fraction", m.fraction, kFraction);
  visit("eta_s", m.eta_s, kSeconds);
  visit("tiles_whole", m.tiles_whole);
  visit("tiles", m.tiles);
  visit("rounds", m.rounds);
  visit("token", m.token);
}

void each_field(auto& visit, Is<NodeList> auto& m) {
  visit("nodes", m.nodes, {.length = kMaxNodes});
  visit("hosts", m.hosts, {.length = kMaxNodes, .has_default = true, .is_rare = true});
}

void each_field(auto& visit, Is<Done> auto& m) {
  visit("job", m.job, at_least_one());
  visit("stats", m.stats, {.length = kMaxStatsBytes});
}

void each_field(auto& visit, Is<Picture> auto& m) {
  visit("job", m.job, at_least_one());
  visit("width", m.width, {.min = 1, .max = kMaxImageSide});
  visit("height", m.height, {.min = 1, .max = kMaxImageSide});
  visit("first_row", m.first_row, {.max = kMaxImageSide});
  visit("rows", m.rows, {.max = kMaxImageSide});
  visit("plane", m.plane, kPlaneRange);
  visit("aov", m.aov, kAovText);
}

void each_field(auto& visit, Is<Written> auto& m) {
  visit("job", m.job, at_least_one());
  visit("width", m.width, {.min = 1, .max = kMaxImageSide});
  visit("height", m.height, {.min = 1, .max = kMaxImageSide});
  visit("cpu_s", m.cpu_s, kSeconds);
}

void each_field(auto& visit, Is<Failed> auto& m) {
  visit("job", m.job);
  visit("code", m.code);
  visit("errors", m.errors, {.length = kMaxErrorsListed});
  visit("stats", m.stats, {.length = kMaxStatsBytes});
}

void each_field(auto&, Is<Bye> auto&) {}

}  // namespace control
}  // namespace graycube
