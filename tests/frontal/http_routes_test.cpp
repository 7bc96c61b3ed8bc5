#include "frontal/http_routes.hpp"

#include <vector>

#include "catch.hpp"
#include "frontal/parts/picture_answers.hpp"
#include "process/temporary_folder.hpp"
#include "proto/control.hpp"

namespace graycube {
namespace {

/// Routes to a frontal that answers when the test says so.
struct Site {
  TemporaryFolder folder;
  std::vector<std::pair<ControlMessage, HttpRoutes::Heard>> asked;
  HttpRoutes routes{
      {.ask = [this](const ControlMessage& question,
                     HttpRoutes::Heard heard) { asked.emplace_back(question, heard); },
       .aside =
           [](const std::function<void()>& work, const std::function<void()>& then) {
             work();
             then();
           }},
      folder.path(),
      2};

  /// Where the answer goes, which may come later.
  std::shared_ptr<std::optional<HttpAnswer>> ask(std::string_view method, std::string_view target) {
    auto answer = std::make_shared<std::optional<HttpAnswer>>();
    routes.answer(method, target, [answer](HttpAnswer a) { *answer = std::move(a); });
    return answer;
  }
  void hear(std::size_t question, std::optional<Message> message) {
    const HttpRoutes::Heard heard = asked.at(question).second;
    heard(std::move(message));
  }
};

Message message_of(const ControlMessage& message) { return Message::of_text(encode(message)); }

TEST_CASE("paths are forwarded as questions, and answers come back as they are") {
  Site site;
  const auto jobs = site.ask("GET", "/api/jobs?x=1");
  const auto job = site.ask("GET", "/api/jobs/7");
  const auto cancel = site.ask("POST", "/api/jobs/8/cancel");
  REQUIRE(site.asked.size() == 3);
  CHECK(std::holds_alternative<control::List>(site.asked[0].first));
  CHECK(std::get<control::Status>(site.asked[1].first).job == 7);
  CHECK(std::get<control::Cancel>(site.asked[2].first).job == 8);
  CHECK_FALSE(*jobs);
  const Message list = message_of(control::Jobs{});
  site.hear(0, list);
  CHECK((*jobs)->status == 200);
  CHECK((*jobs)->body == list.text());
  site.hear(1, message_of(control::Failed{7, FailureCode::kUnknownJob, {}, {}}));
  CHECK((*job)->status == 404);
  site.hear(2, message_of(control::Failed{8, FailureCode::kBadRequest, {}, {}}));
  CHECK((*cancel)->status == 409);
}

TEST_CASE("what isn't there, or can't be done, is refused without asking the frontal") {
  Site site;
  CHECK((*site.ask("GET", "/nothing"))->status == 404);
  CHECK((*site.ask("GET", "/jobs/x.png"))->status == 404);
  CHECK((*site.ask("GET", "/api/jobs/1/cancel"))->status == 405);
  CHECK((*site.ask("POST", "/api/jobs"))->status == 405);
  CHECK((*site.ask("GET", "/"))->type == "text/html; charset=utf-8");
  CHECK(site.asked.empty());
}

TEST_CASE("a frontal that doesn't answer is told of as a bad gateway") {
  Site site;
  const auto jobs = site.ask("GET", "/api/jobs");
  const auto picture = site.ask("GET", "/jobs/1.png");
  site.hear(0, std::nullopt);
  site.hear(1, std::nullopt);
  CHECK((*jobs)->status == 502);
  CHECK((*picture)->status == 502);
}

TEST_CASE("pictures come row by row, few at a time, and the next begins when one has ended") {
  Site site;
  const Picture whole{2, 4, std::vector<float>(24, 0.5F), {}, {}};
  const auto first = site.ask("GET", "/jobs/1.png"), second = site.ask("GET", "/jobs/2.png"),
             third = site.ask("GET", "/jobs/3.png");
  REQUIRE(site.asked.size() == 2);
  site.hear(1, message_of(control::Failed{2, FailureCode::kNotDone, {}, {}}));
  CHECK((*second)->status == 409);
  REQUIRE(site.asked.size() == 3);
  CHECK(std::get<control::Fetch>(site.asked[2].first).job == 3);
  for (std::uint32_t row = 0; row < 4; row += 2) {
    CHECK_FALSE(*first);
    const std::size_t question = row == 0 ? 0 : 3;
    const auto fetch = std::get<control::Fetch>(site.asked.at(question).first);
    CHECK(fetch.first_row == row);
    const Answer answer = picture_rows(whole, {1, row, 2});
    const Reply& reply = std::get<Reply>(answer);
    site.hear(question, Message::of_text(encode(reply.message), reply.payload));
  }
  REQUIRE(*first);
  CHECK((*first)->type == "image/png");
  CHECK((*first)->body.substr(1, 3) == "PNG");
  CHECK_FALSE(*third);
  // Nothing is left of the file that it was made in.
  CHECK(std::filesystem::is_empty(site.folder.path()));
}

}  // namespace
}  // namespace graycube
