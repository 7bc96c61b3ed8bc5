#include "cli/display/progress.hpp"

#include "catch.hpp"

namespace graycube {
namespace {

control::Progress halfway() {
  control::Progress p;
  p.state = JobState::kRendering;
  p.fraction = 0.5;
  p.eta_s = 75;
  p.tiles = 64;
  p.tiles_whole = 32;
  p.rounds = 1;
  return p;
}

/// The text that a display prints into a file, which is no terminal.
std::string printed(const std::vector<control::Progress>& steps, bool is_quiet) {
  std::FILE* file = std::tmpfile();
  REQUIRE(file != nullptr);
  {
    ProgressDisplay display(file, is_quiet);
    for (const auto& p : steps) display.show(p);
  }
  std::string text(static_cast<std::size_t>(std::ftell(file)), '\0');
  std::rewind(file);
  REQUIRE(std::fread(text.data(), 1, text.size(), file) == text.size());
  std::fclose(file);
  return text;
}

TEST_CASE("durations are told in the units that matter") {
  CHECK(duration_text(0) == "0 ms");
  CHECK(duration_text(-3) == "0 ms");
  CHECK(duration_text(0.8501) == "850 ms");
  CHECK(duration_text(0.9996) == "1.0 s");
  CHECK(duration_text(3.44) == "3.4 s");
  CHECK(duration_text(9.96) == "10 s");
  CHECK(duration_text(59.6) == "1 min 0 s");
  CHECK(duration_text(200) == "3 min 20 s");
  CHECK(duration_text(7500) == "2 h 5 min");
}

TEST_CASE("progress tells the share, the time left, final parts and checks for the end") {
  CHECK(progress_text(halfway()) ==
        "rendering 50 %, 1 min 15 s left, 32 of 64 parts of the picture are final, "
        "1 check whether all is done");
  control::Progress queued;
  CHECK(progress_text(queued) == "queued");
}

TEST_CASE("a hundred per cent is shown only when it is reached") {
  control::Progress p = halfway();
  p.fraction = 0.99999;
  CHECK(progress_text(p).starts_with("rendering 99 %"));
  p.fraction = 1;
  CHECK(progress_text(p).starts_with("rendering 100 %"));
  CHECK(progress_text(p).find("left") == std::string::npos);
}

TEST_CASE("what is behind the bar is not cut off on a terminal of 80 columns") {
  CHECK(progress_bar(halfway(), 80).ends_with("left, 32 of 64 parts final, 1 end check"));
}

TEST_CASE("the bar is half full at half time, and never as wide as the terminal") {
  CHECK(progress_bar(halfway(), 100).starts_with("[############-------------] 50 %, 1 min"));
  for (std::size_t columns = 0; columns < 200; ++columns) {
    CHECK(progress_bar(halfway(), columns).size() <= (columns == 0 ? 0 : columns - 1));
  }
}

TEST_CASE(
    "where no terminal is, a line comes for each change of state or round, not for each tile") {
  std::vector<control::Progress> steps(1);
  for (std::uint32_t tile = 0; tile <= 64; ++tile) {
    auto p = halfway();
    p.rounds = tile < 60 ? 0 : 1 + tile / 64;
    p.tiles_whole = tile;
    p.fraction = tile / 64.0;
    steps.push_back(p);
  }
  const std::string text = printed(steps, false);
  CHECK(std::count(text.begin(), text.end(), '\n') == 4);  // queued, rendering, two rounds
  CHECK(text.find('\r') == std::string::npos);
}

TEST_CASE("a quiet display shows nothing") { CHECK(printed({halfway()}, true).empty()); }

}  // namespace
}  // namespace graycube
