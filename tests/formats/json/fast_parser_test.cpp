#include <array>
#include <charconv>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <string_view>

#include "catch.hpp"
#include "fuzz/json_fuzz.hpp"

using namespace graycube;

namespace {

/// Valid JSON of every form that is to be read fast, with an array or object at its root.
class RandomJson {
 public:
  explicit RandomJson(std::uint64_t seed) : random_(seed) {}

  std::size_t below(std::size_t end) { return random_() % end; }

  std::string document() { return gap() + container(4) + gap(); }

  std::string number() {
    static constexpr std::array<std::string_view, 25> kHard{
        "0",
        "-0",
        "-0.0",
        "0e0",
        "-0E+00",
        "1e5",
        "1E+05",
        "1e-05",
        "9007199254740993",
        "-9007199254740993",
        "18446744073709551615",
        "18446744073709551616",
        "-9223372036854775808",
        "-9223372036854775809",
        "9223372036854775807",
        "123456789012345678901234567890",
        "1e-400",
        "-1e-9999",
        "4.9e-324",
        "2.2250738585072011e-308",
        "1.7976931348623157e308",
        "1.7976931348623158e+308",
        "0.1",
        "0.000000000000000000000000000000000000000012345678901234567891",
        "1e0000000000022"};
    const std::size_t form = below(6);
    if (form == 0) return std::string(kHard[below(kHard.size())]);
    if (form == 1) return std::to_string(static_cast<std::int64_t>(random_()) >> below(64));
    if (form == 2) return std::to_string(random_() >> below(64));
    if (form == 3) return any_double();
    std::string text = below(2) == 0 ? "-" : "";
    text += below(4) == 0 ? "0" : std::to_string(1 + below(9)) + digits(below(25));
    if (form == 4) text += "." + digits(1 + below(30));
    if (below(2) == 0) return text;
    const std::array<std::string, 3> signs{"", "+", "-"};
    return text + (below(2) == 0 ? "e" : "E") + signs[below(3)] + std::to_string(below(280));
  }

 private:
  std::string any_double() {
    const auto value = std::bit_cast<double>(random_());
    if (!(value - value == 0)) return "0.5";
    std::array<char, 64> text;
    const auto end = std::to_chars(text.data(), text.data() + text.size(), value);
    return {text.data(), end.ptr};
  }

  std::string digits(std::size_t count) {
    std::string text;
    while (count-- > 0) text += static_cast<char>('0' + below(10));
    return text;
  }

  std::string gap() {
    static constexpr std::string_view kBlanks = " \t\n\r";
    std::string text;
    for (std::size_t n = below(3) == 0 ? below(5) : 0; n > 0; --n) text += kBlanks[below(4)];
    if (below(200) == 0) text.append(below(200), ' ');
    return text;
  }

  std::string string() {
    static constexpr std::array<std::string_view, 20> kParts{"a",
                                                             "Z",
                                                             "é",
                                                             "→",
                                                             "😀",
                                                             "\x7F",
                                                             "/",
                                                             "{[,:]}",
                                                             "\\n",
                                                             "\\\"",
                                                             "\\\\",
                                                             "\\/",
                                                             "\\b\\f\\r\\t",
                                                             "\\u0000",
                                                             "\\u00e9",
                                                             "\\u20AC",
                                                             "\\ud83d\\uDE00",
                                                             "\\uFFFF",
                                                             " ",
                                                             "plain words"};
    std::string text = "\"";
    const std::size_t kinds = below(2) == 0 ? 8 : kParts.size();
    for (std::size_t n = below(8); n > 0; --n) text += kParts[below(kinds)];
    if (below(50) == 0) text.append(below(300), 'x');
    return text + '"';
  }

  std::string container(std::size_t depth) {
    const bool is_object = below(2) == 0;
    std::string text(1, is_object ? '{' : '[');
    const std::size_t count = below(5);
    for (std::size_t i = 0; i < count; ++i) {
      if (i > 0) text += ",";
      text += gap();
      // Duplicate keys, often.
      if (is_object) text += (below(3) == 0 ? "\"k\"" : string()) + gap() + ":" + gap();
      text += value(depth) + gap();
    }
    if (count == 0) text += gap();
    return text + (is_object ? '}' : ']');
  }

  std::string value(std::size_t depth) {
    static constexpr std::array<std::string_view, 3> kWords{"true", "false", "null"};
    const std::size_t form = below(depth > 0 ? 8 : 4);
    if (form == 0) return std::string(kWords[below(3)]);
    if (form == 1) return string();
    return form < 4 ? number() : container(depth - 1);
  }

  std::mt19937_64 random_;
};

/// Changes that leave most texts wrong, and some right.
std::string mutated(std::string text, RandomJson& random) {
  static constexpr std::array<std::string_view, 34> kPieces{"\"",
                                                            "\\",
                                                            "{",
                                                            "}",
                                                            "[",
                                                            "]",
                                                            ",",
                                                            ":",
                                                            " ",
                                                            "\n",
                                                            std::string_view("\0", 1),
                                                            "\x1F",
                                                            "\x80",
                                                            "\xC0\x80",
                                                            "\xED\xA0\x80",
                                                            "\xF4\x90\x80\x80",
                                                            "\xEF\xBB\xBF",
                                                            "0",
                                                            "00",
                                                            "-",
                                                            "+",
                                                            ".",
                                                            "e",
                                                            "1e999",
                                                            "1e99999999999999999999",
                                                            "\\ud800",
                                                            "\\udc00",
                                                            "\\u12",
                                                            "\\x",
                                                            "tru",
                                                            "nul",
                                                            "NaN",
                                                            "/**/",
                                                            "0x1"};
  for (std::size_t n = 1 + random.below(3); n > 0; --n) {
    const std::size_t at = random.below(text.size() + 1);
    const std::string_view piece = kPieces[random.below(kPieces.size())];
    switch (random.below(5)) {
      case 0: text.insert(at, piece); break;
      case 1: text.replace(at, 1, piece); break;
      case 2: text.erase(at, 1 + random.below(3)); break;
      case 3: text.resize(at); break;
      default: text += piece;
    }
  }
  return text;
}

std::string repeated(std::string_view piece, std::size_t count) {
  std::string text;
  while (count-- > 0) text += piece;
  return text;
}

}  // namespace

TEST_CASE("valid texts are read fast, to the same tree as carefully", "[json_fast]") {
  for (std::uint64_t seed = 1; seed <= 3000; ++seed) {
    const std::string text = RandomJson(seed).document();
    INFO("seed " << seed << ": " << text);
    REQUIRE(fuzz_json(text));
    REQUIRE(fuzz_json("\xEF\xBB\xBF" + text));
  }
}

TEST_CASE("numbers of every form are the same to the bit", "[json_fast]") {
  RandomJson random(7);
  for (int round = 0; round < 200; ++round) {
    std::string text = "[";
    for (int i = 0; i < 100; ++i) text += random.number() + (i % 3 == 0 ? " ," : ",");
    text += "1]";
    INFO(text);
    REQUIRE(fuzz_json(text));
  }
}

TEST_CASE("long numbers below the least double are the same to the bit", "[json_fast]") {
  for (const char* number :
       {"2.4703282292062327e-324", "2.4703282292062328e-324", "0.12345678901234567890e-330",
        "-123456789012345678901234567890e-400", "4.9406564584124654e-324"})
    fuzz_json("[" + std::string(number) + "]");
}

TEST_CASE("mutated texts give the same tree or the same error", "[json_fast]") {
  for (std::uint64_t seed = 1; seed <= 10000; ++seed) {
    RandomJson random(seed);
    const std::string text = mutated(random.document(), random);
    INFO("seed " << seed << ": " << text);
    fuzz_json(text);
  }
}

TEST_CASE("a text cut or with another byte anywhere gives the same tree or error", "[json_fast]") {
  const std::string text =
      "\xEF\xBB\xBF{\"a\": [1.5e-3, -0, \"x\\u00e9\\ud83d\\ude00\", {\"b\": null}], \"é\": true}\n";
  for (std::size_t at = 0; at < text.size(); ++at) {
    fuzz_json(text.substr(0, at));
    for (int byte = 0; byte < 256; ++byte) {
      std::string other = text;
      other[at] = static_cast<char>(byte);
      fuzz_json(other);
      other[at] = text[at];
      fuzz_json(other.insert(at, 1, static_cast<char>(byte)));
    }
  }
}

TEST_CASE("what the careful parser refuses is never read fast", "[json_fast]") {
  const std::string zero(1, '\0');
  for (const std::string& text : std::initializer_list<std::string>{"",
                                                                    " ",
                                                                    "[",
                                                                    "]",
                                                                    "{",
                                                                    "[]]",
                                                                    "[[]",
                                                                    "{}}",
                                                                    "{} {}",
                                                                    "[1,]",
                                                                    "[,1]",
                                                                    "{\"a\":1,}",
                                                                    "[1 2]",
                                                                    "[1\"a\"]",
                                                                    "[\"a\"1]",
                                                                    "[\"a\"\"b\"]",
                                                                    "{\"a\" 1}",
                                                                    "{1:2}",
                                                                    "[01]",
                                                                    "[1.]",
                                                                    "[.5]",
                                                                    "[-]",
                                                                    "[+1]",
                                                                    "[1e]",
                                                                    "[1e+]",
                                                                    "[1e400]",
                                                                    "[-1e400]",
                                                                    "[truex]",
                                                                    "[true1]",
                                                                    "[nulll]",
                                                                    "[nul]",
                                                                    "[\"\\ud800\"]",
                                                                    "[\"\\ud800\\u0041\"]",
                                                                    "[\"\\udc00\"]",
                                                                    "[\"\\u12g4\"]",
                                                                    "[\"\\a\"]",
                                                                    "[\"\n\"]",
                                                                    "[\"a]",
                                                                    "[\"\xC0\x80\"]",
                                                                    "[\"\xED\xA0\x80\"]",
                                                                    "[1" + zero + "]",
                                                                    "[true" + zero + "]",
                                                                    "[]" + zero,
                                                                    "[\"" + zero + "\"]",
                                                                    "[1]x",
                                                                    "[1]\xC2\xA0",
                                                                    "[1\x0C]"}) {
    INFO(text);
    REQUIRE(JsonTree(text).syntax_error());
    REQUIRE_FALSE(fuzz_json(text));
  }
}

TEST_CASE("the limits on nesting and strings hold on either way", "[json_fast]") {
  for (const std::uint32_t excess : {0u, 1u}) {
    const std::uint32_t depth = kMaxJsonNesting + excess, length = kMaxJsonString + excess;
    const bool allowed = excess == 0;
    REQUIRE(fuzz_json(repeated("[", depth) + repeated("]", depth)) == allowed);
    REQUIRE(fuzz_json(repeated("[", depth) + "1" + repeated("]", depth)) == allowed);
    REQUIRE(fuzz_json(repeated("{\"\":", depth - 1) + "[]" + repeated("}", depth - 1)) == allowed);
    REQUIRE(fuzz_json("[\"" + repeated("x", length) + "\"]") == allowed);
    REQUIRE(fuzz_json("[\"\\n" + repeated("x", length - 1) + "\"]") == allowed);
    REQUIRE(fuzz_json("{\"" + repeated("x", length) + "\":1}") == allowed);
  }
  fuzz_json(repeated("[", 100000));
  fuzz_json(repeated("{\"a\":[", 5000));
}

TEST_CASE("all example scenes are read fast", "[json_fast]") {
  std::size_t scenes = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(GRAYCUBE_SCENES)) {
    if (entry.path().extension() != ".json") continue;
    std::ifstream file(entry.path(), std::ios::binary);
    const std::string text(std::istreambuf_iterator<char>(file), {});
    INFO(entry.path());
    REQUIRE(fuzz_json(text));
    ++scenes;
  }
  REQUIRE(scenes > 0);
}

TEST_CASE("a padded text gives back the text it took") {
  for (const std::string& text : {std::string(), std::string("{}"), std::string(1000, 'x')}) {
    PaddedText padded{std::string(text)};
    REQUIRE(padded.view() == text);
    REQUIRE(std::string_view(padded.view().data() + text.size(), kTextPadding) ==
            std::string(kTextPadding, '\0'));
    REQUIRE(std::move(padded).take() == text);
    REQUIRE(PaddedText(std::string_view(text)).view() == text);
  }
}
