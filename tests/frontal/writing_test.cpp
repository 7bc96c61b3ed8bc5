// Which clients may have the frontal write files.

#include "catch.hpp"
#include "frontal/frontal.hpp"
#include "frontal/parts/picture_answers.hpp"
#include "frontal/watched_store.hpp"
#include "process/temporary_folder.hpp"
#include "proto/control.hpp"

using namespace graycube;
using namespace graycube::testing;

namespace {

/// The answer of a frontal that has no job to a request.
control::Failed refusal(bool is_private, const ControlMessage& request) {
  const auto store = make_memory_store();
  Frontal frontal({.cube = *Hypercube::of_size(2), .version = "test", .is_private = is_private},
                  *store);
  const Message message = Message::of_text(encode(request));
  frontal.on_message("client", message);
  for (const Frontal::Outgoing& o : frontal.take_outgoing()) {
    if (o.to != "client") continue;
    const auto decoded = decode(o.message.text());
    const auto* answer = std::get_if<ControlMessage>(&decoded);
    REQUIRE(answer != nullptr);
    REQUIRE(std::holds_alternative<control::Failed>(*answer));
    return std::get<control::Failed>(*answer);
  }
  FAIL("no answer");
  return {};
}

}  // namespace

TEST_CASE("only a private frontal writes files") {
  const control::Failed failed = refusal(false, control::Write{1, "/nowhere/a.exr", ""});
  CHECK(failed.code == FailureCode::kBadRequest);
  CHECK(failed.errors.front().why == "only a private frontal writes files");
}

TEST_CASE("a picture that isn't there is not written") {
  CHECK(refusal(true, control::Write{1, "/nowhere/a.exr", ""}).code == FailureCode::kUnknownJob);
}

namespace {

template <typename Answer>
std::vector<Answer> told(Frontal& frontal, const PeerId& peer) {
  std::vector<Answer> answers;
  for (const Frontal::Outgoing& o : frontal.take_outgoing()) {
    const auto decoded = decode(o.message.text());
    const auto* answer = std::get_if<ControlMessage>(&decoded);
    if (o.to == peer && answer != nullptr && std::holds_alternative<Answer>(*answer))
      answers.push_back(std::get<Answer>(*answer));
  }
  return answers;
}

}  // namespace

TEST_CASE("a picture is written aside: the answer comes when it is, and no job begins before") {
  const TemporaryFolder folder;
  WatchedStore store;
  store.hold(1, Picture{4, 2, std::vector<float>(24, 0.5F), {}, {}});
  Frontal frontal({.cube = *Hypercube::of_size(1), .version = "test", .is_private = true}, store);
  const std::string file = (folder / "a.png").string();
  const auto ask = [&](const PeerId& peer) {
    frontal.on_message(peer, Message::of_text(encode(control::Write{1, "", file})));
  };
  ask("a");
  CHECK(told<control::Written>(frontal, "a").empty());
  const auto work = frontal.take_writing();
  REQUIRE(work);
  CHECK_FALSE(frontal.take_writing());
  ask("b");
  const auto refused = told<control::Failed>(frontal, "b");
  REQUIRE(refused.size() == 1);
  CHECK(refused.front().code == FailureCode::kBusy);
  const Message scene = Message::of_text(encode(control::Submit{"scene", {}}), Bytes(1));
  frontal.on_message("a", scene);
  CHECK_FALSE(frontal.take_work());
  const auto answer =
      write_picture(*work->picture, work->request, work->origin, [] { return 0.0; });
  frontal.give_result(WritingResult{work->peer, answer});
  CHECK(told<control::Written>(frontal, "a").size() == 1);
  CHECK(std::filesystem::file_size(file) > 0);
  CHECK(frontal.take_work());
}
