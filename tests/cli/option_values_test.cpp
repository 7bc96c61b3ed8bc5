#include "cli/option_values.hpp"

#include <bit>
#include <thread>

#include "cli/expect_failure.hpp"

namespace graycube {
namespace {

TEST_CASE("node counts are the powers of two from 1 to 1024") {
  for (std::uint32_t n = 1; n <= 1024; n *= 2) CHECK(parse_nodes("-n", std::to_string(n)) == n);
  for (const char* bad : {"0", "3", "6", "1023", "2048", "-4", "8.0", "8 ", "", "eight", "0x8",
                          "4294967296", "18446744073709551616"}) {
    CHECK(refusal([&] { parse_nodes("-n", bad); }) ==
          "graycube: usage: -n: expected a power of two from 1 to 1024, found \"" +
              std::string(bad) + "\"");
  }
}

TEST_CASE("node counts come one or more, with commas between") {
  CHECK(parse_node_list("-n", "4") == std::vector<std::uint32_t>{4});
  CHECK(parse_node_list("-n", "64,256,1024") == std::vector<std::uint32_t>{64, 256, 1024});
  for (const char* bad : {"", ",", "4,", ",4", "4,,8", "4;8", "4, 8", "4,3"}) {
    INFO(bad);
    CHECK(refusal([&] {
            parse_node_list("-n", bad);
          }).starts_with("graycube: usage: -n: expected a power of two from 1 to 1024"));
  }
  std::string many = "1";
  for (std::size_t i = 0; i < kMaxNodeCounts; ++i) many += ",1";
  CHECK(refusal([&] { parse_node_list("-n", many); }).find("at most 16 numbers") !=
        std::string::npos);
}

TEST_CASE("numbers have a range") {
  CHECK(parse_number("--link-us", "0.5", 0, 10) == 0.5);
  for (const char* bad : {"", "-1", "10.5", "nan", "inf", "1e999", "5us"}) {
    INFO(bad);
    CHECK(refusal([&] { parse_number("--link-us", bad, 0, 10); }) ==
          "graycube: usage: --link-us: expected a number from 0 to 10, found \"" +
              std::string(bad) + "\"");
  }
}

TEST_CASE("the default number of nodes is a power of two that the processors can hold") {
  const std::uint32_t nodes = default_nodes();
  CHECK(std::has_single_bit(nodes));
  CHECK(nodes <= std::max(1u, std::thread::hardware_concurrency()));
  CHECK(2 * nodes > std::thread::hardware_concurrency());
}

TEST_CASE("counts are whole numbers within their limits") {
  CHECK(parse_count("--samples", "1", 1, 64) == 1);
  CHECK(parse_count("--samples", "64", 1, 64) == 64);
  CHECK(parse_count("--max-depth", "0", 0, 1000) == 0);
  for (const char* bad : {"0", "65", "1.5", "", "-1", "1e1"}) {
    CHECK(refusal([&] { parse_count("--samples", bad, 1, 64); }) ==
          "graycube: usage: --samples: expected a whole number from 1 to 64, found \"" +
              std::string(bad) + "\"");
  }
}

TEST_CASE("AOVs are named in any order and told back in one") {
  CHECK(parse_aov_list("--aov", "object,depth") == "depth,object");
  for (const char* bad : {"", "depth,", "depht", "normal,normal"}) {
    CHECK(
        refusal([&] { parse_aov_list("--aov", bad); }) ==
        "graycube: usage: --aov: expected depth,normal,albedo,object, or some of them, each once, "
        "found \"" +
            std::string(bad) + "\"");
  }
}

TEST_CASE("a size is two numbers of pixels around an x") {
  CHECK(parse_size("--size", "640x480") == PictureSize{640, 480});
  CHECK(parse_size("--size", "1x16384") == PictureSize{1, 16384});
  for (const char* bad : {"640", "640x", "x480", "640X480", "640x480x1", "0x5", "5x16385", "-1x5",
                          "640 x 480", "axb", ""}) {
    CHECK(refusal([&] {
            parse_size("--size", bad);
          }).starts_with("graycube: usage: --size: expected WIDTHxHEIGHT"));
  }
  CHECK(refusal([] {
          parse_size("--size", "16384x16384");
        }).starts_with("graycube: usage: --size: expected at most 67108864 pixels"));
}

TEST_CASE("a time limit is a positive number of seconds") {
  CHECK(parse_seconds("--timeout", "90") == 90);
  CHECK(parse_seconds("--timeout", "0.25") == 0.25);
  for (const char* bad : {"0", "-1", "nan", "inf", "1e99", "5s", ""}) {
    CHECK(refusal([&] {
            parse_seconds("--timeout", bad);
          }).starts_with("graycube: usage: --timeout: expected a number of seconds above 0"));
  }
}

TEST_CASE("names are read as written, and a misspelt one is guessed") {
  CHECK(parse_algorithm("--algorithm", "auto") == Algorithm::kAuto);
  CHECK(parse_algorithm("--algorithm", "serial") == Algorithm::kSerial);
  CHECK(parse_algorithm("--algorithm", "roth") == Algorithm::kRoth);
  CHECK(parse_algorithm("--algorithm", "macro") == Algorithm::kMacro);
  CHECK(parse_grain("--grain", "pixel") == Grain::kPixel);
  CHECK(parse_grain("--grain", "line") == Grain::kLine);
  CHECK(parse_grain("--grain", "tile") == Grain::kTile);
  CHECK(refusal([] { parse_algorithm("--algorithm", "marco"); }) ==
        "graycube: usage: --algorithm: expected auto, serial, roth or macro, found \"marco\"; "
        "did you mean \"macro\"?");
  CHECK(refusal([] {
          parse_grain("--grain", "Tile");
        }).starts_with("graycube: usage: --grain: expected pixel, line or tile"));
}

TEST_CASE("how macro works is chosen by name and number") {
  CHECK(parse_shadows("--shadows", "horizon") == ShadowMode::kHorizon);
  CHECK(parse_shadows("--shadows", "forward") == ShadowMode::kForward);
  CHECK(parse_shadows("--shadows", "local") == ShadowMode::kLocal);
  CHECK(parse_partition("--partition", "auto") == PartitionMode::kAuto);
  CHECK(parse_partition("--partition", "regular") == PartitionMode::kRegular);
  CHECK(parse_partition("--partition", "balanced") == PartitionMode::kBalanced);
  CHECK(parse_flow("--flow", "credit") == FlowMode::kCredit);
  CHECK(parse_flow("--flow", "blocking") == FlowMode::kBlocking);
  CHECK(parse_sums("--sums", "direct") == SumsMode::kDirect);
  CHECK(parse_sums("--sums", "tree") == SumsMode::kTree);
  CHECK(parse_returns("--returns", "sender") == ReturnsMode::kSender);
  CHECK(parse_boundaries("--boundaries", "sliding") == BoundariesMode::kSliding);
  CHECK(parse_subdivision("--subdivision", "kaplan") == Subdivision::kKaplan);
  CHECK(parse_entry("--entry", "extremal") == Entry::kExtremal);
  CHECK(parse_scatter("--scatter", "1") == 1);
  CHECK(parse_scatter("--scatter", "8") == 8);
  CHECK(refusal([] {
          parse_scatter("--scatter", "9");
        }).starts_with("graycube: usage: --scatter: expected a whole number from 1 to 8"));
  CHECK(refusal([] {
          parse_shadows("--shadows", "hard");
        }).starts_with("graycube: usage: --shadows: expected horizon, forward or local"));
}

}  // namespace
}  // namespace graycube
