#include "keep_rule.hpp"

#include "catch.hpp"
#include "content_digest.hpp"

using namespace graycube;

TEST_CASE("jobs are kept by their number or by days, and nothing else is a rule") {
  CHECK(parse_keep_rule("500") == KeepRule{500, 0});
  CHECK(parse_keep_rule("30d") == KeepRule{0, 30});
  CHECK(parse_keep_rule("1000000") == KeepRule{1'000'000, 0});
  CHECK(parse_keep_rule("36500d") == KeepRule{0, 36'500});
  for (const char* text : {"", "d", "0", "0d", "-1", "+5", "5.5", "5D", "5dd", "5 d", " 5", "5h",
                           "1000001", "36501d", "99999999999999999999"}) {
    INFO(text);
    CHECK_FALSE(parse_keep_rule(text));
  }
}

TEST_CASE(
    "contents that differ have different digests, by a bit, their length or where parts end") {
  const auto digest = [](auto... parts) {
    ContentDigest all;
    (all.add(std::string_view(parts)), ...);
    return all.value();
  };
  CHECK(digest("a scene of twenty bytes") == digest("a scene of twenty bytes"));
  CHECK(digest("a scene of twenty bytes") != digest("a scene of twenty bytet"));
  CHECK(digest("ab", "c") != digest("a", "bc"));
  CHECK(digest("a") != digest(std::string_view("a\0", 2)));
  CHECK(digest("") != digest());
}
