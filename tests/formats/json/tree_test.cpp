#include "formats/json/tree.hpp"

#include <bit>
#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <random>
#include <string>
#include <vector>

#include "catch.hpp"

using namespace graycube;

namespace {

/// The tree as the library's own document, to compare it with what the library read itself.
nlohmann::json to_library(const JsonTree& tree, JsonIndex at) {
  switch (tree.kind(at)) {
    case JsonKind::kNull: return nullptr;
    case JsonKind::kFalse: return false;
    case JsonKind::kTrue: return true;
    case JsonKind::kNumber: return tree.number(at);
    case JsonKind::kString: return std::string(tree.string(at));
    case JsonKind::kArray: {
      auto array = nlohmann::json::array();
      for (JsonIndex c = tree.first_child(at); c != tree.end(at); c = tree.next(c))
        array.push_back(to_library(tree, c));
      return array;
    }
    case JsonKind::kObject: {
      auto object = nlohmann::json::object();
      for (JsonIndex c = tree.first_child(at); c != tree.end(at); c = tree.next(c))
        object[std::string(tree.key(c))] = to_library(tree, c);
      return object;
    }
  }
  return nullptr;
}

std::uint64_t bits(double v) { return std::bit_cast<std::uint64_t>(v); }

double number_in(const std::string& text) {
  const JsonTree tree(text);
  INFO(text);
  REQUIRE_FALSE(tree.syntax_error());
  REQUIRE(tree.kind(0) == JsonKind::kNumber);
  return tree.number(0);
}

/// Random JSON, mostly valid, from pieces that go wrong in every way when they meet.
std::string random_json(std::mt19937_64& random, int depth) {
  static const std::vector<std::string> kScalars = {"0",
                                                    "-0",
                                                    "1.5",
                                                    "-2e3",
                                                    "1E+2",
                                                    "0.1e-7",
                                                    "null",
                                                    "true",
                                                    "false",
                                                    "\"\"",
                                                    "\"a\\nb\\u00e9\"",
                                                    "\"\\ud83d\\ude00\"",
                                                    "\"\xC3\xA9\"",
                                                    "9007199254740993",
                                                    "123456789012345678901234567890.5"};
  static const std::vector<std::string> kBroken = {"01",
                                                   "1.",
                                                   ".5",
                                                   "-",
                                                   "+1",
                                                   "1e",
                                                   "tru",
                                                   "nan",
                                                   "\"\\x\"",
                                                   "\"\\ud83d\"",
                                                   "\"\\udc00\"",
                                                   "\"\xC0\x80\"",
                                                   "\"\xED\xA0\x80\"",
                                                   "\"\xF5\x80\x80\x80\"",
                                                   "\"\t\"",
                                                   "\"open",
                                                   "[1,]",
                                                   "{\"a\" 1}",
                                                   "{a:1}",
                                                   "[1 2]",
                                                   "",
                                                   "\"\\u12g4\"",
                                                   "\"\xE2\x82\"",
                                                   "{\"a\":1,}"};
  const auto pick = [&](std::size_t n) { return static_cast<std::size_t>(random() % n); };
  if (pick(60) == 0) return kBroken[pick(kBroken.size())];
  if (depth == 0 || pick(3) == 0) return kScalars[pick(kScalars.size())];
  const bool object = pick(2) == 0;
  std::string text(1, object ? '{' : '[');
  const std::size_t count = pick(4);
  for (std::size_t i = 0; i < count; ++i) {
    if (i > 0) text += pick(2) == 0 ? "," : " ,\n\t";
    if (object) text += "\"k" + std::to_string(i) + (pick(5) == 0 ? "\\u0041" : "") + "\":";
    text += random_json(random, depth - 1);
  }
  return text + (object ? '}' : ']');
}

}  // namespace

TEST_CASE(
    "a JSON tree holds what the library's own document holds, and refuses what that refuses") {
  std::mt19937_64 random(20240601);
  int refused = 0;
  for (int i = 0; i < 20000; ++i) {
    const std::string text = random_json(random, 4);
    INFO(text);
    const JsonTree tree(text);
    const auto expected = nlohmann::json::parse(text, nullptr, false);
    REQUIRE(tree.syntax_error().has_value() == expected.is_discarded());
    if (expected.is_discarded()) {
      ++refused;
      continue;
    }
    REQUIRE(to_library(tree, 0) == expected);
  }
  // Both outcomes must have been exercised.
  REQUIRE(refused > 1000);
  REQUIRE(refused < 19000);
}

TEST_CASE("every double is read back from its digits, in any of the usual forms") {
  std::mt19937_64 random(7);
  for (int i = 0; i < 100000; ++i) {
    const double v = std::bit_cast<double>(random());
    if (!std::isfinite(v)) continue;
    char text[64];
    for (const char* form : {"%.17g", "%.25e"}) {
      std::snprintf(text, sizeof text, form, v);
      REQUIRE(bits(number_in(text)) == bits(v));
    }
  }
}

TEST_CASE("whole numbers are rounded to the nearest double, and minus zero keeps its sign") {
  REQUIRE(number_in("-7") == -7);
  REQUIRE(number_in("9007199254740993") == 9007199254740992.0);
  REQUIRE(number_in("-9007199254740993") == -9007199254740992.0);
  REQUIRE(number_in("18446744073709551615") == 18446744073709551616.0);
  REQUIRE(number_in("-18446744073709551615") == -18446744073709551616.0);
  REQUIRE(bits(number_in("-0")) == bits(-0.0));
  REQUIRE(bits(number_in("0")) == bits(0.0));
}

TEST_CASE("numbers too small for a double become zero") {
  REQUIRE(number_in("1e-999") == 0);
  REQUIRE(std::signbit(number_in("-1e-999")));
  REQUIRE(number_in("0." + std::string(400, '0') + "1") == 0);
  REQUIRE(number_in("0." + std::string(400, '0') + "1e401") == 1);
  REQUIRE(number_in("1" + std::string(400, '0') + "e-400") == 1);
  REQUIRE(number_in("1e-99999999999999999999999") == 0);
  REQUIRE(number_in("0e999") == 0);
  REQUIRE(number_in("5e-324") == 5e-324);
}

TEST_CASE("a number beyond a double is an error at its place") {
  for (const std::string& number :
       {std::string("1e999"), std::string("-1e999"), std::string("123456e400"),
        "1" + std::string(400, '0'), std::string("1e99999999999999999999999")}) {
    const std::string text = R"({"a": [1, {"b" : )" + number + " }]}";
    const JsonTree tree(text);
    INFO(text);
    REQUIRE(tree.syntax_error());
    CHECK(tree.syntax_error()->offset == text.find(number));
    CHECK(tree.syntax_error()->message ==
          "expected a finite number, found " + number.substr(0, 40));
    CHECK(tree.pointer(tree.syntax_error()->value) == "/a/1/b");
  }
}

TEST_CASE("syntax errors tell what was expected, what was found and where") {
  struct Case {
    std::string text;
    std::uint64_t offset;
    std::string pointer, message;
  };
  const std::vector<Case> cases = {
      {"", 0, "", "expected a value, found the end of the text"},
      {" \n", 2, "", "expected a value, found the end of the text"},
      {"[1, tru]", 4, "/1", "expected a value, found 't'"},
      {"[1, ]", 4, "/1", "expected a value, found ']'"},
      {"[1, +1]", 4, "/1", "expected a value, found '+'"},
      {"{\"a\" \"bcd\"}", 5, "", "expected ':' after the key, found '\"'"},
      {"{\"a\"::1}", 5, "/a", "expected a value, found ':'"},
      {"{\"a\": 1,}", 8, "/a", "expected a key in double quotes, found '}'"},
      {"{a: 1}", 1, "", "expected a key in double quotes, found 'a'"},
      {"{\"a\": 1 \"b\": 2}", 8, "/a", "expected ',' or '}', found '\"'"},
      {"[12 345]", 4, "/0", "expected ',' or ']', found '3'"},
      {"[12\"x\"]", 3, "/0", "expected ',' or ']', found '\"'"},
      {"[12[", 3, "/0", "expected ',' or ']', found '['"},
      {"[01]", 2, "/0", "expected ',' or ']', found '1'"},
      {"[1, \x07]", 4, "/1", "expected a value, found byte 0x07"},
      {"[1] x", 4, "/0", "expected the end of the text, found 'x'"},
      {"[1] 22", 4, "/0", "expected the end of the text, found '2'"},
      {"[1]" + std::string(1, '\0'), 3, "/0", "expected the end of the text, found byte 0x00"},
      {"1" + std::string(1, '\0') + "2", 1, "", "expected the end of the text, found byte 0x00"},
      {"\xEF\xBB\xBF[}", 4, "/0", "expected a value, found '}'"},
      {"[-x]", 2, "/0", "invalid number; expected digit after '-'"},
      {"[\"ab", 4, "/0", "invalid string: missing closing quote"},
      {"[\"\xC0\x80\"]", 2, "/0", "invalid string: ill-formed UTF-8 byte"},
      {"[\"; last read: - \\x\"]", 18, "/0",
       "invalid string: forbidden character after backslash"}};
  for (const Case& c : cases) {
    const JsonTree tree(c.text);
    INFO(c.text);
    REQUIRE(tree.syntax_error());
    CHECK(tree.syntax_error()->message == c.message);
    CHECK(tree.syntax_error()->offset == c.offset);
    CHECK(tree.pointer(tree.syntax_error()->value) == c.pointer);
  }
}

TEST_CASE("every value's offset is that of its first byte") {
  const std::string text =
      "\xEF\xBB\xBF {\"a\" : [ 1,-2.5e0 ,\"x\\ny\",[],{ }], \"b\":true,\"c\":\n{}}";
  const JsonTree tree(text);
  REQUIRE_FALSE(tree.syntax_error());
  const std::vector<std::string> starts = {"{\"a", "[ 1", "1,-",  "-2.5", "\"x\\n",
                                           "[],",  "{ }", "true", "{}}"};
  for (std::size_t i = 0; i < starts.size(); ++i)
    CHECK(tree.offset(static_cast<JsonIndex>(i)) == text.find(starts[i]));
  REQUIRE(JsonTree("7").offset(0) == 0);
}

TEST_CASE("pointers escape tildes and slashes and count from zero") {
  const std::string text = R"({"a/b": [1, {"~": [true]}], "": 2})";
  const JsonTree tree(text);
  REQUIRE_FALSE(tree.syntax_error());
  REQUIRE(tree.pointer(0) == "");
  REQUIRE(tree.pointer(1) == "/a~1b");
  REQUIRE(tree.pointer(2) == "/a~1b/0");
  REQUIRE(tree.pointer(4) == "/a~1b/1/~0");
  REQUIRE(tree.pointer(5) == "/a~1b/1/~0/0");
  REQUIRE(tree.pointer(6) == "/");
}

TEST_CASE("nesting and string length are limited") {
  const auto nested = [](std::uint32_t depth) {
    return std::string(depth, '[') + std::string(depth, ']');
  };
  const std::string deepest = nested(kMaxJsonNesting), too_deep = nested(kMaxJsonNesting + 1);
  REQUIRE_FALSE(JsonTree(deepest).syntax_error());
  REQUIRE(JsonTree(too_deep).syntax_error()->message.find("deeper") != std::string::npos);
  const std::string longest = '"' + std::string(kMaxJsonString, 'x') + '"';
  const std::string too_long = '"' + std::string(kMaxJsonString + 1, 'x') + '"';
  const std::string too_long_escaped = "\"\\n" + std::string(kMaxJsonString, 'x') + '"';
  REQUIRE_FALSE(JsonTree(longest).syntax_error());
  REQUIRE(JsonTree(too_long).syntax_error()->message.find("longer") != std::string::npos);
  REQUIRE(JsonTree(too_long_escaped).syntax_error()->message.find("longer") != std::string::npos);
}

TEST_CASE("a text cut anywhere is a syntax error with a place, never a crash") {
  const std::string text = R"({"a": [1.5e-3, "x\u00e9\ud83d\ude00", {"b": null}], "c": true})";
  for (std::size_t length = 0; length < text.size(); ++length) {
    const std::string cut = text.substr(0, length);
    const JsonTree tree(cut);
    REQUIRE(tree.syntax_error());
    REQUIRE(tree.syntax_error()->offset <= cut.size());
    REQUIRE(tree.pointer(tree.syntax_error()->value).size() < cut.size() + 2);
  }
}

TEST_CASE("text positions count lines and bytes from one") {
  const auto positions = text_positions("ab\n\ncd", {0, 1, 2, 3, 4, 5, 6});
  const std::vector<std::pair<int, int>> expected = {{1, 1}, {1, 2}, {1, 3}, {2, 1},
                                                     {3, 1}, {3, 2}, {3, 3}};
  REQUIRE(positions.size() == expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    REQUIRE(positions[i].line == static_cast<std::uint64_t>(expected[i].first));
    REQUIRE(positions[i].column == static_cast<std::uint64_t>(expected[i].second));
  }
}

TEST_CASE("more values than the limit are refused before memory is taken for any") {
  // Two bytes each, the shortest that values can be.
  const auto numbers = [](std::size_t count) {
    std::string text = "[";
    for (std::size_t i = 0; i < count; ++i) text += "0,";
    text.back() = ']';
    return text;
  };
  const std::string many = numbers(kMaxJsonValues);
  const JsonTree tree(many);
  REQUIRE(tree.syntax_error());
  CHECK(tree.syntax_error()->message == "the text has more than 54525952 values");
  CHECK(tree.value_count() == 1);
  CHECK(tree.pointer(0).empty());
  // Commas and brackets in strings are no values, also behind escaped quotes.
  std::string long_string = "[\"\\\"" + std::string(many.size(), '[') + "\"]";
  const JsonTree strings(long_string);
  REQUIRE(strings.syntax_error());
  CHECK(strings.syntax_error()->message.find("string") != std::string::npos);
}
