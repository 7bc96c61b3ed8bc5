// What clients are told who ask for a farm's log.
#include "frontal/telling/log_desk.hpp"

#include "catch.hpp"
#include "frontal/sent_post.hpp"

using namespace graycube;
using namespace graycube::testing;

namespace {

struct Desk {
  Post post = post_of(1);
  LogDesk desk{77};

  void add(int lines) {
    for (int i = 0; i < lines; ++i) {
      FarmEvent event;
      event.text = "line";
      event.unix_s = i;
      desk.add(event);
    }
  }
  void ask(const std::string& who, const control::Log& request, double now_s = 0) {
    desk.ask(who, request, now_s, post);
  }
  /// What somebody was told since this was last asked: "first-last" of the numbers, "" for none.
  std::vector<std::string> told(const std::string& who) {
    std::vector<std::string> told;
    for (const auto& m : SentPost(post).told<control::LogLines>(who)) {
      CHECK(m.pid == 77);
      std::string text;
      if (!m.lines.empty())
        text = std::to_string(m.lines.front().number) + "-" + std::to_string(m.lines.back().number);
      told.push_back(text + (m.is_end ? " end" : ""));
    }
    return told;
  }
};

using Told = std::vector<std::string>;

}  // namespace

TEST_CASE("the newest lines are told, in order, and of many the oldest first") {
  Desk d;
  d.add(10);
  d.ask("a", {0, 0, 3, 0});
  CHECK(d.told("a") == Told{"8-10"});
  d.ask("a", {77, 4, 100, 0});
  CHECK(d.told("a") == Told{"5-10"});
  d.ask("a", {0, 0, 0, 0});
  CHECK(d.told("a") == Told{""});
  d.add(2000);
  // Only the last ones are kept, and a message has at most so many.
  d.ask("a", {0, 0, kMaxLinesKept, 0});
  CHECK(d.told("a") == Told{"1011-1410"});
  d.ask("a", {77, 1410, kMaxLinesKept, 0});
  CHECK(d.told("a") == Told{"1411-1810"});
}

TEST_CASE("lines that another frontal has numbered don't count as known") {
  Desk d;
  d.add(3);
  d.ask("a", {76, 1000, 100, 0});
  CHECK(d.told("a") == Told{"1-3"});
}

TEST_CASE("who waits for a line is told when one comes, or when the time is up") {
  Desk d;
  d.add(2);
  d.ask("a", {77, 2, 100, 10}, 5);
  d.ask("b", {77, 1, 100, 10}, 5);
  CHECK(d.told("b") == Told{"2-2"});
  d.desk.answer_waits(14.9, d.post);
  CHECK(d.told("a").empty());
  d.desk.answer_waits(15, d.post);
  CHECK(d.told("a") == Told{""});
  d.ask("a", {77, 2, 100, 10}, 20);
  d.add(1);
  d.desk.answer_waits(20, d.post);
  CHECK(d.told("a") == Told{"3-3"});
  d.add(1);
  d.desk.answer_waits(40, d.post);
  CHECK(d.told("a").empty());  // it was told once
}

TEST_CASE("the oldest of too many that wait is answered without a line") {
  Desk d;
  for (std::size_t i = 0; i <= kMaxLogWaits; ++i) d.ask(std::to_string(i), {77, 0, 100, 10});
  const SentPost sent(d.post);
  CHECK(sent.all.size() == 1);
  CHECK(sent.all.front().to == "0");
}

TEST_CASE("the farm's end is told with the last line, and at once afterwards") {
  Desk d;
  d.ask("a", {77, 0, 100, 10});
  d.add(1);
  d.desk.end();
  d.desk.answer_waits(0, d.post);
  CHECK(d.told("a") == Told{"1-1 end"});
  d.ask("a", {77, 1, 100, 10});
  CHECK(d.told("a") == Told{" end"});
  // Not before the last line.
  d.add(500);
  d.ask("a", {77, 1, kMaxLinesKept, 10});
  CHECK(d.told("a") == Told{"2-401"});
}

TEST_CASE("the longest lines still fit into a message") {
  Desk d;
  FarmEvent event;
  event.unix_s = 1.0e9 / 3;
  event.job = 0xFFFFFFFF;
  event.text = std::string(kMaxTextBytes, '"');
  for (std::size_t i = 0; i < kMaxLinesAnswered; ++i) d.desk.add(event);
  d.ask("a", {0, 0, kMaxLinesKept, 0});
  CHECK(d.told("a") == Told{"1-" + std::to_string(kMaxLinesAnswered)});
}
