#include "cli/display/bars_svg.hpp"

#include "catch.hpp"
#include "proto/statistics.hpp"

namespace graycube {
namespace {

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t n = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++n;
  return n;
}

std::string some_statistics(double fifo_wait_s = 0) {
  Statistics s;
  if (fifo_wait_s > 0) s.fifo = FifoMode::kProcess;
  s.nodes = 2;
  s.render_s = 4;
  s.wall_s = 5;
  for (const double blocked : {3.0, 1.0}) {
    control::NodeStats n;
    n.busy_s = 1;
    n.blocked_s = blocked;
    n.fifo_wait_s = fifo_wait_s;
    n.queue_peak = 7;
    n.memory_bytes = static_cast<std::uint64_t>(1000 * blocked);
    n.forwarded_shadow = 5;
    n.forwarded_primary = 2;
    n.ray_batches = 2;
    s.per_node.push_back(n);
  }
  return statistics_json(s);
}

TEST_CASE("a comparison's figures are those of the statistics") {
  const Figures f = figures_of(some_statistics());
  CHECK(f.wall_s == 5);
  CHECK(f.efficiency == 1);
  CHECK(f.blocked_fraction == Approx(0.5));
  CHECK(f.forwarded == 14);
  CHECK(f.messages == 4);
  CHECK(f.largest_memory_bytes == 3000);
  CHECK(f.queue_peak == 7);
  REQUIRE(f.nodes.size() == 2);
  CHECK(f.nodes[0].blocked_s == 3);
}

TEST_CASE("bars show each node's parts, and rows without a picture say why") {
  const std::vector<ComparedRow> rows{
      {"one", "", RowOutcome::kSame, "", some_statistics()},
      {"<two>", "", RowOutcome::kDeadlocked, "node 0 & node 1", ""}};
  const std::string svg = bars_svg("a & b", rows);
  CHECK(svg.starts_with("<svg "));
  CHECK(svg.ends_with("</svg>\n"));
  CHECK(count(svg, "<rect") == 1 + 4 + 2 * 4);
  CHECK(svg.find("&lt;two&gt;") != std::string::npos);
  CHECK(svg.find("deadlocked: node 0 &amp; node 1") != std::string::npos);
  // A deadlock's bars, up to it, say so too.
  CHECK(count(bars_svg("", {{"one", "", RowOutcome::kDeadlocked, "why", some_statistics()}}),
              ">deadlocked<") == 1);
  // Three quarters of the first node's bar of 84 is blocked.
  CHECK(svg.find("height=\"63.00\" fill=\"#c92a2a\"") != std::string::npos);
}

TEST_CASE("bars have a part for FIFOs if any is a process apart") {
  const auto drawn = [](double fifo_wait_s) {
    return bars_svg("", {{"one", "", RowOutcome::kSame, "", some_statistics(fifo_wait_s)}});
  };
  CHECK(drawn(0).find(">FIFO<") == std::string::npos);
  const std::string svg = drawn(4);
  CHECK(count(svg, ">FIFO<") == 1);
  CHECK(count(svg, "<rect") == 1 + 5 + 2 * 5);
  // Half of the first node's bar of 84.
  CHECK(count(svg, "height=\"42.00\"") == 1);
}

}  // namespace
}  // namespace graycube
