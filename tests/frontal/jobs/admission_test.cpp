// Long scenes are taken into the store beside the frontal, and jobs numbered as scenes came.
#include "frontal/admission/admission.hpp"

#include "catch.hpp"
#include "frontal/frontal.hpp"
#include "frontal/jobs_farm.hpp"
#include "frontal/watched_store.hpp"
#include "frontal/writing_thread.hpp"

using namespace graycube;
using namespace graycube::testing;

namespace {

SharedBytes long_scene(char fill = ' ') { return bytes_of(std::string(kLongScene, fill)); }

control::Submit request(const std::string& key = {}) { return {"a scene", {}, key}; }

/// A farm whose first job is job 2.
struct Farm : JobsFarm {
  explicit Farm(bool keeps_jobs = false)
      : JobsFarm(1, std::make_unique<WatchedStore>(), keeps_jobs) {}

  std::vector<std::string>& calls() { return static_cast<WatchedStore&>(*store).calls; }
  void give(const PeerId& from, SharedBytes scene, const std::string& key = {}) {
    CHECK_FALSE(jobs.submit({from, request(key), std::move(scene)}));
  }
  /// Takes the long scene that is next.
  void admit() {
    const auto work = jobs.take_admission();
    REQUIRE(work);
    CHECK_FALSE(jobs.take_admission());
    jobs.give_result(admit_scene(*work));
  }
};

/// The numbers of jobs that a client was told of, in order.
std::vector<std::uint32_t> numbers(const SentPost& sent, const PeerId& peer) {
  std::vector<std::uint32_t> numbers;
  for (const auto& m : sent.told<control::Accepted>(peer)) numbers.push_back(m.job);
  return numbers;
}

using Numbers = std::vector<std::uint32_t>;

}  // namespace

TEST_CASE("a long scene is neither copied nor touched before another thread is given it") {
  Farm farm;
  const SharedBytes scene = long_scene();
  farm.give("a", scene);
  CHECK(farm.calls().empty());
  const auto work = farm.jobs.take_admission();
  REQUIRE(work);
  CHECK(work->scene.bytes().data() == scene.bytes().data());
  CHECK(farm.jobs.is_admitting());
  CHECK(SentPost(farm.post).all.empty());
  CHECK_FALSE(farm.jobs.take_work());

  farm.jobs.give_result(admit_scene(*work));
  CHECK_FALSE(farm.jobs.is_admitting());
  CHECK(farm.calls() == std::vector<std::string>{"write scene 2", "add 2"});
  CHECK(numbers(SentPost(farm.post), "a") == Numbers{2});
  const auto next = farm.jobs.take_work();
  REQUIRE(next);
  CHECK(next->scene.bytes().data() == scene.bytes().data());
}

TEST_CASE("jobs are numbered as their scenes came, short ones behind a long one too") {
  Farm farm;
  farm.give("a", long_scene());
  farm.give("b", bytes_of("short"));
  farm.give("c", long_scene());
  farm.give("d", bytes_of("short"));
  CHECK(SentPost(farm.post).all.empty());
  farm.admit();
  {
    const SentPost sent(farm.post);
    CHECK(numbers(sent, "a") == Numbers{2});
    CHECK(numbers(sent, "b") == Numbers{3});
    CHECK(sent.all.size() == 2);
  }
  farm.admit();
  const SentPost sent(farm.post);
  CHECK(numbers(sent, "c") == Numbers{4});
  CHECK(numbers(sent, "d") == Numbers{5});
  CHECK(farm.submit() == 6);
  CHECK(farm.calls() == std::vector<std::string>{"write scene 2", "add 2", "add 3", "write scene 4",
                                                 "add 4", "add 5", "add 6"});
}

TEST_CASE("a scene that is submitted again under its key while it is taken makes one job") {
  Farm farm;
  farm.give("a", long_scene(), "key");
  farm.give("b", long_scene(), "key");
  farm.give("c", long_scene('x'), "key");
  for (int i = 0; i < 3; ++i) farm.admit();
  const SentPost sent(farm.post);
  CHECK(numbers(sent, "a") == Numbers{2});
  CHECK(numbers(sent, "b") == Numbers{2});
  REQUIRE(sent.told<control::Failed>("c").size() == 1);
  CHECK(sent.told<control::Failed>("c").front().errors.front().where == "key");
  CHECK(farm.calls() == std::vector<std::string>{"write scene 2", "add 2"});
}

TEST_CASE("a long scene that can't be written is refused with the reason, and uses no number") {
  Farm farm;
  farm.give("a", long_scene());
  farm.give("b", bytes_of("short"));
  static_cast<WatchedStore&>(*farm.store).is_full = true;
  farm.admit();
  const SentPost sent(farm.post);
  REQUIRE(sent.told<control::Failed>("a").size() == 1);
  CHECK(sent.told<control::Failed>("a").front().errors.front().why == "the disk is full");
  CHECK(numbers(sent, "b") == Numbers{2});
}

TEST_CASE("the queue's limit holds for long scenes, too") {
  Farm farm;
  for (std::size_t i = 0; i + 1 < kMaxQueuedJobs; ++i) farm.submit({}, "short");
  farm.give("a", long_scene());
  farm.give("b", long_scene());
  farm.admit();
  CHECK_FALSE(farm.jobs.take_admission());
  const SentPost sent(farm.post);
  CHECK(numbers(sent, "a").size() == 1);
  REQUIRE(sent.told<control::Failed>("b").size() == 1);
  CHECK(sent.told<control::Failed>("b").front().code == FailureCode::kBusy);
}

TEST_CASE("scenes that wait to be taken are bounded by their number and their bytes") {
  const SharedBytes longest = Bytes(kMaxSubmitBytes);
  const auto submit = [](Farm& farm, const SharedBytes& scene) {
    return farm.jobs.submit({"a", request(), scene});
  };
  Farm farm;
  for (std::size_t bytes = 0; bytes < kMaxWaitingSceneBytes; bytes += longest.size())
    CHECK_FALSE(submit(farm, longest));
  CHECK(refused(submit(farm, bytes_of("x")).value()) == FailureCode::kBusy);
  Farm other;
  CHECK_FALSE(submit(other, long_scene()));
  for (std::size_t i = 1; i < kMaxWaitingSubmissions; ++i) CHECK_FALSE(submit(other, {}));
  CHECK(refused(submit(other, {}).value()) == FailureCode::kBusy);
}

TEST_CASE(
    "when the farm stops a scene that is being taken is a job, and those behind are refused") {
  const bool keeps_jobs = GENERATE(false, true);
  WatchedStore store;
  Frontal frontal({.cube = *Hypercube::of_size(1), .version = "test", .keeps_jobs = keeps_jobs},
                  store);
  const auto submit = [&](const PeerId& peer) {
    frontal.on_message(peer, Message::of_text(encode(request()), long_scene()));
  };
  const auto answers = [&] {
    std::vector<std::string> sent;
    for (const Frontal::Outgoing& o : frontal.take_outgoing()) {
      const auto decoded = decode(o.message.text());
      sent.push_back(o.to + ": " + std::string(type_of(std::get<ControlMessage>(decoded))));
    }
    return sent;
  };
  submit("a");
  submit("b");
  const auto work = frontal.take_admission();
  REQUIRE(work);
  frontal.go_down();
  submit("c");
  CHECK(answers() == std::vector<std::string>{"b: failed", "c: failed"});
  CHECK(frontal.is_admitting());
  frontal.give_result(admit_scene(*work));
  CHECK(answers() == std::vector<std::string>{"a: accepted"});
  CHECK_FALSE(frontal.is_admitting());
  CHECK_FALSE(frontal.take_admission());
  CHECK_FALSE(frontal.take_work());
  const std::vector<std::string> kept{"write scene 2", "add 2"};
  const std::vector<std::string> ended{"write scene 2", "add 2", "keep as cancelled"};
  CHECK(store.calls == (keeps_jobs ? kept : ended));
}

TEST_CASE("the loop's thread doesn't write long scenes") {
  Farm farm;
  farm.give("a", long_scene());
  Wakeup wakeup;
  WritingThread thread(wakeup);
  thread.give(*farm.jobs.take_admission());
  CHECK_FALSE(thread.is_free());
  for (;;) {
    auto result = thread.take();
    if (!result) continue;
    farm.jobs.give_result(std::get<AdmissionResult>(*result));
    break;
  }
  CHECK(numbers(SentPost(farm.post), "a") == Numbers{2});
  CHECK(static_cast<WatchedStore&>(*farm.store).writer != std::this_thread::get_id());
}
