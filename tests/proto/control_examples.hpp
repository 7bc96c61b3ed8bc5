// One message of every type, with every optional field set.
#pragma once

#include <vector>

#include "proto/control.hpp"

namespace graycube::test {

inline control::NodeStats example_stats() {
  control::NodeStats s;
  s.rank = 3;
  s.gray = 2;
  s.pid = 4711;
  s.cpu_s = 1.25;
  s.busy_s = 1.0;
  s.idle_s = 0.1;
  s.blocked_s = 1.0 / 3;
  s.rays_in = 1'000'000'000'000;
  s.rays_out = 7;
  s.queue_peak = 12;
  s.primitives = 103;
  s.peak_rss_bytes = 1ull << 40;
  s.primary = 65536;
  s.shadow = 157297;
  s.reflection = 20349;
  s.refraction = 10879;
  s.start_cpu_s = 0.0625;
  s.sum_batches = 17;
  s.sum_bytes = 170000;
  s.malformed_drops = 1;
  s.outbox_peak = 12345;
  s.memory_bytes = 1ull << 33;
  s.cells = 70000;
  s.cells_visited = 1ull << 34;
  s.primitives_tested = 1ull << 35;
  s.tests_saved = 11;
  s.boxes_tested = 12;
  s.boxes_rejected = 13;
  s.spheres_tested = 14;
  s.spheres_rejected = 15;
  s.nodes_descended = 16;
  s.entry_links = 17;
  s.rays_not_shot = 18;
  s.fifo_wait_s = 1.5;
  s.fifo_cpu_s = 2.0 / 3;
  s.fifo_messages = 1ull << 39;
  s.open_peak = 70001;
  s.open_bytes_peak = 1ull << 36;
  s.answers = 1ull << 37;
  s.answer_batches = 90000;
  s.answer_bytes = 1ull << 38;
  s.forwarded_primary = 1ull << 39;
  s.slice_batches = 800;
  s.slice_bytes = 1ull << 40;
  s.models_borrowed = 3;
  s.endgame_s = 0.125;
  return s;
}

/// Each number is another one, so that none can be taken for another.
inline control::FarmMetrics example_metrics() {
  control::FarmMetrics m;
  m.farm = {4711, "ipc:///run/frontal", "0.4.0", 1700000000.5, 8, 7, 3, 1, 256};
  control::FarmCounts& c = m.counts;
  c.jobs_accepted = 1;
  c.jobs_done = 2;
  c.jobs_failed = 3;
  c.jobs_cancelled = 4;
  c.tiles_whole = 5;
  c.nodes_lost = 6;
  c.messages_lost = 7;
  c.epochs = 8;
  c.refused_submissions = 9;
  c.refused_nodes = 10;
  c.refused_clients = 11;
  c.refused_connections = 12;
  c.primary = 13;
  c.shadow = 14;
  c.reflection = 15;
  c.refraction = 16;
  c.forwarded_primary = 17;
  c.forwarded_shadow = 18;
  c.forwarded_secondary = 19;
  c.ray_batches = 20;
  c.ray_bytes = 21;
  c.contribution_batches = 22;
  c.contribution_bytes = 23;
  c.sum_batches = 24;
  c.sum_bytes = 25;
  c.answer_batches = 26;
  c.answer_bytes = 27;
  c.slice_batches = 28;
  c.slice_bytes = 29;
  c.malformed_drops = 30;
  c.busy_s = 31.25;
  c.blocked_s = 32.25;
  c.window_s = 33.25;
  c.idle_s = 34.25;
  c.fifo_wait_s = 35.25;
  c.nodes_cpu_s = 36.25;
  c.last_queue_peak = 37;
  c.last_outbox_peak = 38;
  c.last_memory_bytes = 39;
  c.tiles_whole = 1ull << 40;
  m.nodes_starting = 101;
  m.nodes_idle = 102;
  m.nodes_busy = 103;
  m.nodes_lost = 104;
  m.fraction = 0.5;
  m.frontal_cpu_s = 105.5;
  m.longest_turn_s = 0.0625;
  return m;
}

inline control::JobOptions example_options() {
  control::JobOptions o;
  o.algorithm = Algorithm::kMacro;
  o.grain = Grain::kLine;
  o.shadows = ShadowMode::kLocal;
  o.partition = PartitionMode::kBalanced;
  o.scatter = 2;
  o.flow = FlowMode::kBlocking;
  o.queue = 64;
  o.fifo = FifoMode::kProcess;
  o.threads = 4;
  o.timeout_s = 90.5;
  o.width = 640;
  o.height = 480;
  o.samples = 2;
  o.max_depth = 0;
  o.aov = "depth,object";
  o.sums = SumsMode::kTree;
  o.subdivision = {Subdivision::kArnaldi, Entry::kDescent};
  o.returns = ReturnsMode::kSender;
  o.mesh = MeshMode::kRing;
  o.boundaries = BoundariesMode::kSliding;
  return o;
}

inline control::JobInfo example_job() {
  control::JobInfo j;
  j.job = 9;
  j.state = JobState::kRendering;
  j.scene = "Bücher \"&\" \\ 100 % 図.json";
  j.algorithm = Algorithm::kRoth;
  j.nodes = 8;
  j.fraction = 0.375;
  j.eta_s = 12.5;
  j.rounds = 4;
  j.submitted_s = 1.7e9;
  j.started_s = 1.7e9 + 0.25;
  j.finished_s = 1.7e9 + 3;
  j.message = "node 3 is lost, its macro-region goes to rank 3's replacement";
  j.tiles = 64;
  j.tiles_whole = 24;
  j.choices = "scatter 4, horizon shadows";
  return j;
}

inline std::vector<ControlMessage> example_messages() {
  using namespace control;
  const GridLayout grid{4, 2, 2, {-1, 16, 40}, {24}, {8, 16, 40, 4, 20, 44}, {0.5, 2.25}};
  const RawObject stats{
      R"({"graycube":"0.1.0","nodes":8,"rays":{"primary":65536},"per_node":[{"rank":0}]})"};
  return {
      Hello{3, 4711, 77, "ipc:///run/graycube/3", 2, "0.1.0", "tcp://10.0.0.3:41577"},
      Ready{9, 1, 103, 40, 812, 0.02},
      EpochAck{9, 2},
      TokenRound{9, 1, 3, 24, true, -5},
      Terminated{9, 1, 4, 32, 1000},
      NodeReport{9, 1, example_stats()},
      Pong{18446744073709551615ull, 5, 2},
      NodeError{3, 2, "out of memory", true},
      WaitReport{9, 1, 5, true, 2, 1000, {1, 2, 3}, {4, 5, 1ull << 60}},
      Borrow{9, 1, 3, 1ull << 30},
      Share{9, 1, 3},
      Goodbye{},
      Welcome{2, "0.1.0", {"ipc://a", ""}, 500},
      Load{9,
           1,
           Algorithm::kMacro,
           2,
           grid,
           Grain::kTile,
           16,
           ShadowMode::kForward,
           FlowMode::kCredit,
           64,
           FifoMode::kProcess,
           1 << 20,
           8,
           65536,
           4000,
           3,
           98304,
           1 << 28,
           true,
           true,
           SumsMode::kTree,
           {Subdivision::kOctree, Entry::kExtremal},
           ReturnsMode::kSender,
           MeshMode::k3d,
           BoundariesMode::kSliding},
      Lend{9, 1, 3},
      Copy{9, 1, 3},
      HandOn{9, 1, 3},
      Relieved{9, 1, 12},
      AllWhole{9, 1},
      Prepare{9, 2},
      Start{9, 2, {77, 4294967295u}, {12, 0}},
      Finish{9},
      Ping{5},
      Shutdown{},
      Submit{"plate.json", example_options(), "5f0c"},
      Status{9},
      List{},
      Watch{9},
      Cancel{9},
      Nodes{},
      Fetch{9, 100, 20, 2},
      Write{9, "/tmp/a.exr", ""},
      Down{},
      Farm{},
      Accepted{9},
      example_job(),
      Jobs{{example_job(), JobInfo{.job = 10, .scene = "b"}}},
      Progress{9, JobState::kDone, 1, 0.0, 64, 64, 4, TokenProgress{4, 32}},
      NodeList{{NodeInfo{3, 2, 4711, NodeState::kBusy, "ipc://a", 2, "n3"}},
               {HostInfo{"n3", 16, 1ull << 36, 8, 4, 4700, "busy"}}},
      FarmInfo{4711, "ipc:///run/frontal", "0.4.0", 1700000000.5, 8, 7, 3, 1, 256},
      Done{9, stats},
      Picture{9, 640, 480, 100, 20, 2, "depth,normal"},
      Written{9, 640, 480, 0.25},
      Failed{9, FailureCode::kDeadlock, {{"--flow blocking", "deadlock: node 0 waits"}}, stats},
      Bye{},
      Slide{9, 1, 3, {16, 40, 48}, {24}},
      Slid{9, 1, 3, 0.25},
      Turn{9, 1, 3, 2},
      Dealt{9, 1},
      Worked{9, 1, 1ull << 40, 77},
      Host{3, 4294967295u},
      Metrics{},
      example_metrics(),
      Log{4711, 1ull << 40, 1000, 20},
      LogLines{
          4711, true, {{1ull << 40, 1700000000.5, 9, true, "job 9: failed"}, {7, 1, 0, false, ""}}},
      Join{"n3", "5f0c:4026531840", "/tmp/graycube-x", 16, 1ull << 36, 8, 4700, "0.4.0"},
      Joined{41577, 2, 500, 2000},
      RunNodes{{{2, 7}, {3, 4294967295u}}},
      EndNode{3, 8},
      NodeEnded{3, 8, "killed by signal 9", false},
      Alive{77, {2, 3}},
      Leave{},
  };
}

}  // namespace graycube::test
