#include "one_line.hpp"

#include "catch.hpp"

using namespace graycube;

TEST_CASE("text that comes from elsewhere can't forge a line, nor command a terminal") {
  CHECK(one_line("a\nb\r\tc", 100) == "a\\nb\\r\\tc");
  CHECK(one_line("\x1b[2J\x7f", 100) == "\\x1b[2J\\x7f");
  CHECK(one_line(std::string_view("\0", 1), 100) == "\\x00");
  // C1 control characters, as UTF-8 and as a byte alone, and separators of lines.
  CHECK(one_line("\xc2\x9b"
                 "2J",
                 100) == "\\x9b2J");
  CHECK(one_line("\x9b"
                 "2J",
                 100) == "\\x9b2J");
  CHECK(one_line("\xe2\x80\xa8", 100) == "\\u2028");
  // What turns the direction of writing lets a text look like another.
  CHECK(one_line("\xe2\x80\xae"
                 "gpj.exe",
                 100) == "\\u202egpj.exe");
  // An escape that was written is told from one that was made.
  CHECK(one_line("\\n", 100) == "\\\\n");
  CHECK(one_line("Würfel — 立方体.json", 100) == "Würfel — 立方体.json");
}

TEST_CASE("a text that is too long is cut between characters, and says so") {
  CHECK(one_line("abcdef", 6) == "abcdef");
  CHECK(one_line("abcdefg", 6) == "abc…");
  CHECK(one_line("aäöüß", 6) == "aä…");
  CHECK(one_line("ab\x01\x01", 6) == "ab…");
  CHECK(one_line("abcdefg", 2).empty());
  for (std::size_t longest = 0; longest < 12; ++longest)
    CHECK(one_line("ä\n€\x1b𝄞end", longest).size() <= longest);
}
