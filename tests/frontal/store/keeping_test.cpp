// Pictures go to the store and come from it beside the frontal, which answers meanwhile.
#include "frontal/parts/keeping.hpp"

#include "catch.hpp"
#include "frontal/frontal.hpp"
#include "frontal/jobs_farm.hpp"
#include "frontal/prepared.hpp"
#include "frontal/watched_store.hpp"

using namespace graycube;
using namespace graycube::testing;

namespace {

/// Jobs of a farm of one node, the first of which is job 2.
struct Farm : JobsFarm {
  Farm() : JobsFarm(1, std::make_unique<WatchedStore>()) {}

  WatchedStore& watched() { return static_cast<WatchedStore&>(*store); }
  std::uint32_t submit() { return JobsFarm::submit({.algorithm = Algorithm::kRoth}); }
  /// Renders a job to the point where its picture is to be kept.
  void render(std::uint32_t job) {
    const auto work = jobs.take_work();
    REQUIRE(work);
    auto prepared = prepare(*work, [] { return 0.0; });
    const TilePlan plan = *prepared.scene->plan;
    jobs.give_result(std::move(prepared));
    jobs.load();
    jobs.on_node(Rank{0}, control::Ready{job, 0, 1, 1, 1, 0});
    REQUIRE(jobs.can_start());
    jobs.start({7});
    for (std::uint64_t sent = 0;;) {
      std::vector<std::uint32_t> tiles;
      for (const Post::Outgoing& o : SentPost(post).all) {
        if (!looks_like_batch(o.message.frame)) continue;
        REQUIRE(decode_assignment(o.message.frame, {.tile_count = 1 << 20, .nodes = 1}, tiles)
                    .index() == 0);
        for (const std::uint32_t tile : tiles) {
          const Credit credit = Credit::from_words({plan.primary_rays(tile), 0, 0, 0, 0});
          jobs.on_light(Rank{0},
                        encode_contributions({job, 0, 0, 7, sent++}, {{{tile, credit}}}, {}));
        }
      }
      if (tiles.empty()) break;
    }
    control::NodeReport report;
    report.job = job;
    jobs.on_node(Rank{0}, report);
  }
};

}  // namespace

TEST_CASE("while a picture is written all is answered, and the job isn't done before it is") {
  Farm farm;
  const std::uint32_t job = farm.submit(), next = farm.submit();
  farm.render(job);
  auto work = farm.jobs.take_keeping();
  REQUIRE(work);
  CHECK_FALSE(farm.jobs.take_keeping());
  // The writer is held up here.
  CHECK(farm.info(job).state == JobState::kRendering);
  CHECK(farm.info(job).fraction == 1);
  CHECK(farm.info(job).message == "waits for its picture to be written");
  CHECK(granted<control::Jobs>(farm.jobs.list()).jobs.size() == 3);
  CHECK(granted<control::Progress>(farm.jobs.watch("a", job)).fraction == 1);
  CHECK(refused(farm.jobs.fetch({job, 0, 1, 0})) == FailureCode::kNotDone);
  CHECK(refused(farm.jobs.cancel(job)) == FailureCode::kBadRequest);
  CHECK_FALSE(farm.jobs.take_work());
  farm.jobs.nodes_were_lost({{Rank{0}, "node 0", "killed by signal 9", 0}});
  farm.jobs.check_time();
  CHECK(SentPost(farm.post).told<control::Done>("a").empty());
  CHECK(farm.info(next).message == "waits for job 2's picture to be kept");
  farm.watched().calls.clear();

  farm.jobs.give_result(keep_picture(*std::move(work)));
  CHECK(farm.watched().calls == std::vector<std::string>{"write", "keep as done"});
  CHECK(SentPost(farm.post).told<control::Done>("a").size() == 1);
  CHECK(farm.info(job).state == JobState::kDone);
  CHECK(granted<control::Picture>(farm.jobs.fetch({job, 0, 1, 0})).rows == 1);
  CHECK(farm.jobs.take_work()->job == next);
}

TEST_CASE("a job whose picture can't be written has failed, and tells why") {
  Farm farm;
  const std::uint32_t job = farm.submit();
  farm.render(job);
  farm.watched().is_full = true;
  farm.watched().calls.clear();
  farm.jobs.watch("a", job);
  farm.jobs.give_result(keep_picture(*farm.jobs.take_keeping()));
  CHECK(farm.info(job).state == JobState::kFailed);
  CHECK(farm.info(job).message == "the disk is full");
  CHECK(SentPost(farm.post).told<control::Failed>("a").size() == 1);
  CHECK(farm.watched().calls == std::vector<std::string>{"keep as failed"});
}

TEST_CASE("rows of a picture that must be read are sent once it is, and others aren't held up") {
  WatchedStore store;
  Frontal frontal({.cube = *Hypercube::of_size(1), .version = "test"}, store);
  const auto names = [&] {
    std::vector<std::string> sent;
    for (const Frontal::Outgoing& o : frontal.take_outgoing()) {
      const auto decoded = decode(o.message.text());
      sent.push_back(o.to + ": " + std::string(type_of(std::get<ControlMessage>(decoded))));
    }
    return sent;
  };
  const auto ask = [&](const PeerId& peer, const ControlMessage& m) {
    frontal.on_message(peer, Message::of_text(encode(m)));
  };
  ask("a", control::Fetch{1, 0, 1, 0});
  ask("b", control::Fetch{1, 0, 1, 0});
  const auto work = frontal.take_reading();
  REQUIRE(work);
  CHECK_FALSE(frontal.take_reading());
  ask("c", control::Status{1});
  CHECK(names() == std::vector<std::string>{"c: job_info"});
  frontal.give_result(read_picture(*work));
  CHECK(names() == std::vector<std::string>{"a: picture", "b: picture"});
  ask("a", control::Fetch{1, 0, 1, 0});
  CHECK(names() == std::vector<std::string>{"a: picture"});
  CHECK(store.calls == std::vector<std::string>{"read"});
  CHECK_FALSE(frontal.take_reading());
}
