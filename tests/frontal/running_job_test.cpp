#include "frontal/parts/running_job.hpp"

#include <nlohmann/json.hpp>

#include "catch.hpp"
#include "frontal/prepared.hpp"
#include "frontal/sent_post.hpp"
#include "trace/corner_scene.hpp"

using namespace graycube;
using namespace graycube::testing;

namespace {

constexpr std::uint32_t kNodes = 2;

/// Job 3 on two nodes.
struct OnTwo {
  FrontalOptions farm{.cube = *Hypercube::of_size(kNodes), .version = "test"};
  CpuMeter cpu{[] { return 10.0; }, [] { return 4.0; }};
  Post post = post_of(kNodes);
  FarmLog log;
  control::JobOptions options;
  RunningJob job;

  explicit OnTwo(control::JobOptions o = {})
      : options(std::move(o)), job(farm, queued(options), {100, 5000}, cpu, log) {}

  static QueuedJob queued(const control::JobOptions& options) {
    QueuedJob q;
    q.info.job = 3;
    q.info.scene = "a scene";
    q.work.options = options;
    q.submitted_at_s = 90;
    return q;
  }
  void prepare_as(Algorithm algorithm) {
    job.prepared(prepared(corner_scene(), options, kNodes, algorithm));
  }
  void start() {
    job.load(101, post);
    job.on_ready(Rank{0}, {3, 0, 1, 1, 1, 0});
    CHECK_FALSE(job.can_start());
    job.on_ready(Rank{1}, {3, 0, 1, 1, 1, 0});
    REQUIRE(job.can_start());
    job.start({7, 8}, 103, post);
  }
  /// Sends all credit of the tiles that were handed out, and of those handed out then.
  void trace_all() {
    std::vector<std::uint64_t> sent(kNodes, 0);
    for (;;) {
      const SentPost sent_post(post);
      bool any = false;
      for (const Post::Outgoing& o : sent_post.all) {
        std::vector<std::uint32_t> tiles;
        const BatchLimits limits{.tile_count = 1 << 20, .nodes = kNodes};
        if (!looks_like_batch(o.message.frame)) continue;
        REQUIRE(decode_assignment(o.message.frame, limits, tiles).index() == 0);
        const std::uint32_t rank = o.to == peer_of(0) ? 0 : 1;
        for (const std::uint32_t tile : tiles) {
          any = true;
          const std::uint64_t units = job_plan.primary_rays(tile);
          const Bytes batch =
              encode_contributions({3, 0, rank, 7, sent[rank]++},
                                   {{{tile, Credit::from_words({units, 0, 0, 0, 0})}}}, {});
          REQUIRE_FALSE(job.on_light(Rank{0}, batch, post));
        }
      }
      if (!any) return;
    }
  }
  TilePlan job_plan = *prepared(corner_scene(), {}, kNodes, Algorithm::kRoth).plan;
};

}  // namespace

TEST_CASE("a job goes through its stages, of which clients are told five") {
  OnTwo on;
  CHECK(on.job.stage() == JobStage::kPreparing);
  CHECK(on.job.info().state == JobState::kLoading);
  CHECK(on.job.info().started_s == 5000);
  on.prepare_as(Algorithm::kRoth);
  CHECK(on.job.stage() == JobStage::kPrepared);
  CHECK(on.job.info().state == JobState::kLoading);
  CHECK(on.job.info().algorithm == Algorithm::kRoth);
  CHECK_FALSE(on.job.is_loaded());
  on.job.load(101, on.post);
  CHECK(on.job.is_loaded());
  CHECK(on.job.info().state == JobState::kBuilding);
  CHECK(SentPost(on.post).names() == std::vector<std::string>{"node 0: load", "node 1: load"});
  on.job.on_ready(Rank{1}, {3, 0, 1, 1, 1, 0});
  // A message for another job counts as little as one that the same node repeats.
  on.job.on_ready(Rank{0}, {2, 0, 1, 1, 1, 0});
  on.job.on_ready(Rank{1}, {3, 0, 1, 1, 1, 0});
  CHECK_FALSE(on.job.can_start());
  on.job.on_ready(Rank{0}, {3, 0, 1, 1, 1, 0});
  CHECK(on.job.can_start());
  on.job.start({7, 8}, 103, on.post);
  CHECK(on.job.info().state == JobState::kRendering);
  const SentPost sent(on.post);
  CHECK(sent.told<control::Start>(peer_of(1)).front().incarnations ==
        std::vector<std::uint32_t>{7, 8});
  CHECK(sent.names() == std::vector<std::string>{"node 0: start", "node 1: start",
                                                 "node 0: assignment", "node 1: assignment"});
}

TEST_CASE(
    "when all light is here the nodes report, and with the last report "
    "the job is over") {
  OnTwo on;
  on.prepare_as(Algorithm::kRoth);
  on.start();
  CHECK_FALSE(on.job.finish_when_complete(104, on.post));
  on.trace_all();
  CHECK(on.job.info().tiles_whole == on.job.info().tiles);
  CHECK_FALSE(on.job.finish_when_complete(105, on.post));
  CHECK(on.job.stage() == JobStage::kReporting);
  CHECK(on.job.info().state == JobState::kRendering);
  CHECK(SentPost(on.post).names() == std::vector<std::string>{"node 0: finish", "node 1: finish"});
  // Nodes are asked for reports only once.
  CHECK_FALSE(on.job.finish_when_complete(106, on.post));
  CHECK(SentPost(on.post).all.empty());
  control::NodeReport report{3, 0, {}};
  on.job.on_report(report);
  CHECK_FALSE(on.job.is_over());
  report.stats.rank = 1;
  report.job = 2;
  on.job.on_report(report);
  CHECK_FALSE(on.job.is_over());
  report.job = 3;
  on.job.on_report(report);
  CHECK(on.job.is_over());
  const auto stats = nlohmann::json::parse(on.job.statistics(110, on.cpu, {}));
  CHECK(stats["phases"]["build_s"] == 2);
  CHECK(stats["phases"]["render_s"] == 2);
  CHECK(stats["wall_s"] == 20);
}

TEST_CASE("the log tells of the same losses as the statistics, and of the same epoch") {
  OnTwo on;
  on.prepare_as(Algorithm::kRoth);
  on.start();
  CHECK_FALSE(on.job.lose({{Rank{1}, "node 1 (process 77)", "killed by signal 9", 0.25}}, on.post));
  CHECK_FALSE(on.job.on_error(Rank{0}, {3, 1, "a batch was lost"}, on.post));
  const auto stats = nlohmann::json::parse(on.job.statistics(110, on.cpu, {}));
  const auto events = on.log.take();
  REQUIRE(events.size() == 2);
  REQUIRE(stats["losses"].size() == 2);
  for (std::size_t i = 0; i < 2; ++i) {
    CHECK(events[i].kind == FarmEvent::Kind::kNodeIsLost);
    CHECK(events[i].job == 3);
    REQUIRE(events[i].loss);
    CHECK(stats["losses"][i]["rank"] == *events[i].loss->rank);
    CHECK(stats["losses"][i]["why"] == events[i].loss->why);
    CHECK(stats["losses"][i]["noticed_s"] == events[i].loss->noticed_s);
    CHECK(stats["losses"][i]["tiles"] == events[i].loss->tiles);
  }
  CHECK(events[0].loss->tiles > 0);
  CHECK(events[1].text.ends_with(" again, epoch " + stats["epochs"].dump()));
}

TEST_CASE(
    "how much is done and how long it will take is told while a job is "
    "rendered") {
  OnTwo on;
  CHECK(on.job.progress_at(100).fraction == 0);
  on.prepare_as(Algorithm::kRoth);
  on.start();
  CHECK_FALSE(on.job.progress_at(110).eta_s);
  on.trace_all();
  const control::Progress done = on.job.progress_at(113);
  CHECK(done.fraction == 1);
  CHECK(done.eta_s == 0.0);
  CHECK(on.job.info_at(113).fraction == 1);
  CHECK(on.job.info().fraction == 0);
}

TEST_CASE("a broken batch of light fails the job; one of another job is let go") {
  OnTwo on;
  on.prepare_as(Algorithm::kRoth);
  on.start();
  CHECK_FALSE(on.job.on_light(Rank{0}, encode_contributions({2, 0, 0, 7, 5}, {}, {}), on.post));
  Bytes broken = encode_contributions({3, 0, 0, 7, 0}, {}, {});
  broken.push_back({});
  const auto wrong = on.job.on_light(Rank{0}, broken, on.post);
  REQUIRE(wrong);
  CHECK(wrong->state == JobState::kFailed);
  CHECK(wrong->errors.front().where == "the frontal");
}

TEST_CASE("a batch of light that is missing begins the next epoch") {
  OnTwo on;
  on.prepare_as(Algorithm::kMacro);
  on.start();
  SentPost(on.post);
  const Bytes late = encode_contributions({3, 0, 1, 8, 5}, {}, {});
  CHECK_FALSE(on.job.on_light(Rank{1}, late, on.post));
  CHECK(SentPost(on.post).names() ==
        std::vector<std::string>{"node 0: prepare", "node 1: prepare"});
  CHECK(on.job.info().state == JobState::kRendering);
  // Nobody may trace before both have dropped what is old.
  on.job.on_epoch_ack(Rank{0}, {3, 1}, on.post);
  on.job.on_epoch_ack(Rank{1}, {3, 0}, on.post);
  CHECK_FALSE(on.job.can_start());
  on.job.on_epoch_ack(Rank{1}, {3, 1}, on.post);
  REQUIRE(on.job.can_start());
  on.job.start({7, 8}, 104, on.post);
  const auto start = SentPost(on.post).told<control::Start>(peer_of(0)).front();
  CHECK(start.epoch == 1);
  CHECK(start.open_tiles.size() == kNodes);
}

TEST_CASE("a token that finds the end while a tile is open is an error") {
  OnTwo on;
  on.prepare_as(Algorithm::kMacro);
  on.start();
  on.job.on_terminated({3, 1, 2, 8, 0});
  CHECK_FALSE(on.job.finish_when_complete(104, on.post));
  on.job.on_terminated({3, 0, 2, 8, 0});
  CHECK(on.job.finish_when_complete(104, on.post));
}

TEST_CASE("rounds of the token are told, but for those of another epoch") {
  OnTwo on;
  on.prepare_as(Algorithm::kMacro);
  on.start();
  CHECK_FALSE(on.job.on_round({3, 1, 4, 8, false, 0}));
  CHECK_FALSE(on.job.progress_at(104).token);
  CHECK(on.job.on_round({3, 0, 4, 8, false, 0}));
  CHECK(on.job.progress_at(104).token == control::TokenProgress{4, 8});
}

TEST_CASE(
    "nodes that wait for each other twice alike are a deadlock, which is "
    "named") {
  OnTwo on({.partition = PartitionMode::kRegular, .flow = FlowMode::kBlocking});
  on.prepare_as(Algorithm::kMacro);
  on.start();
  SentPost(on.post);
  for (std::uint64_t ping = 1; ping <= 2; ++ping) {
    CHECK_FALSE(on.job.deadlock());
    for (std::uint32_t rank = 0; rank < kNodes; ++rank) {
      control::WaitReport report{3, 0, ping, true, 0, 5, {7}, {7}};
      on.job.on_wait_report(Rank{rank}, report, ping, 120, on.post);
    }
  }
  REQUIRE(on.job.deadlock());
  CHECK(on.job.deadlock()->code == FailureCode::kDeadlock);
  CHECK(on.job.deadlock()->errors.front() ==
        control::ErrorItem{"--flow blocking",
                           "deadlock: node 0 waits for node 1 waits for node "
                           "0, each for room in a "
                           "full queue; 2 of 2 nodes are blocked"});
  CHECK(SentPost(on.post).names() == std::vector<std::string>{"node 0: finish", "node 1: finish"});
  CHECK_FALSE(on.job.has_lost_patience(120 + kReportPatience_s));
  CHECK(on.job.has_lost_patience(121 + kReportPatience_s));
}

TEST_CASE("a job is overdue when its time is up, if it has a limit") {
  OnTwo limited({.timeout_s = 30}), free;
  CHECK_FALSE(limited.job.is_overdue(130));
  CHECK(limited.job.is_overdue(131));
  CHECK_FALSE(free.job.is_overdue(1e9));
}
