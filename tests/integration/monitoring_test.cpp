// How those who run a farm see what it does: its metrics, the dashboard of them, and its log.
#include <signal.h>

#include <algorithm>
#include <regex>
#include <set>
#include <thread>

#include "catch.hpp"
#include "frontal/telling/metrics_parser.hpp"
#include "integration/browser.hpp"
#include "integration/farm.hpp"

namespace graycube {
namespace {

using testing::MetricsParser;
using testing::ParsedMetrics;

std::string first() { return scene_file("first.json").string(); }

ParsedMetrics scrape(const Browser& browser) {
  const WebAnswer answer = browser.get("/metrics");
  REQUIRE(answer.status == 200);
  return MetricsParser::parse(answer.body);
}

void check_none_went_back(const ParsedMetrics& before, const ParsedMetrics& after) {
  for (const auto& [name, value] : before.samples) {
    if (name.find("_total") == std::string::npos) continue;
    INFO(name);
    REQUIRE(after.samples.contains(name));
    CHECK(after.samples.at(name) >= value);
  }
}

void wait_for_loss(const Browser& browser) {
  const auto until = std::chrono::steady_clock::now() + 30s;
  while (scrape(browser).samples.at("graycube_losses_total{kind=\"node\"}") == 0) {
    REQUIRE(std::chrono::steady_clock::now() < until);
    std::this_thread::sleep_for(20ms);
  }
}

std::string joined(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += line + "\n";
  return text;
}

}  // namespace

TEST_CASE("a farm's metrics tell what its jobs did, and no counter goes back") {
  Sandbox sandbox;
  Farm farm(sandbox, {"--http", "127.0.0.1:*"});
  const Browser browser(farm.up().out());
  const ParsedMetrics before = scrape(browser);
  CHECK(before.samples.at("graycube_rays_total{kind=\"primary\"}") == 0);
  const Arguments picture{first(), "--size", "96x64", "--algorithm", "macro"};
  const std::string job = submit(sandbox, picture);
  ok(sandbox, {"watch", job});
  const ParsedMetrics one = scrape(browser);
  check_none_went_back(before, one);
  CHECK(one.samples.at("graycube_rays_total{kind=\"primary\"}") >= 96 * 64);
  CHECK(one.samples.at("graycube_jobs_total{outcome=\"done\"}") == 1);
  const auto told = nlohmann::json::parse(ok(sandbox, {"status", job, "--json"}));
  CHECK(one.samples.at("graycube_tiles_total") == told["tiles"].get<double>());
  CHECK(one.samples.at("graycube_evaluator_seconds_total{state=\"busy\"}") > 0);
  CHECK(one.samples.at("graycube_message_bytes_total{content=\"slices\"}") > 0);
  CHECK(one.samples.at("graycube_nodes{state=\"idle\"}") == 4);
  const std::string endless =
      submit(sandbox, {first(), "--size", "3000x3000", "--samples", "8", "--algorithm", "macro"});
  wait_for_state(sandbox, endless, "rendering");
  const ParsedMetrics during = scrape(browser);
  CHECK(during.samples.at("graycube_current_jobs{state=\"running\"}") == 1);
  CHECK(during.samples.at("graycube_nodes{state=\"busy\"}") == 4);
  const auto pid = nlohmann::json::parse(ok(sandbox, {"nodes", "--json"}))[1]["pid"];
  REQUIRE(::kill(pid.get<pid_t>(), SIGKILL) == 0);
  wait_for_loss(browser);
  ok(sandbox, {"cancel", endless});
  const ParsedMetrics after = scrape(browser);
  check_none_went_back(one, during);
  check_none_went_back(during, after);
  CHECK(after.samples.at("graycube_epochs_total") == 1);
  CHECK(after.samples.at("graycube_jobs_total{outcome=\"cancelled\"}") == 1);
  // It is for reading, by this server's name only.
  CHECK(browser.ask("POST /metrics").status == 401);
  CHECK(browser.get("/metrics", "Host: example.com\r\n").status == 403);
}

TEST_CASE(
    "every metric that the dashboard or the page about metrics names is there, and the reverse") {
  Sandbox sandbox;
  Farm farm(sandbox, {"--http", "127.0.0.1:*"});
  const auto types = scrape(Browser(farm.up().out())).types;
  const std::filesystem::path root = scene_file("..");
  for (const char* file : {"deploy/grafana/graycube.json", "docs/monitoring.md"}) {
    const std::string text = file_bytes(root / file);
    std::set<std::string> named;
    const std::regex name("graycube_[a-z_]+");
    for (std::sregex_iterator at(text.begin(), text.end(), name), end; at != end; ++at)
      named.insert(at->str());
    for (const std::string& metric : named) {
      INFO(file << " names " << metric);
      CHECK(types.contains(metric));
    }
    for (const auto& [metric, type] : types) {
      INFO(file << " has no " << metric);
      CHECK(named.contains(metric));
    }
  }
}

TEST_CASE("the log is told to clients as it is written, and followed to the farm's end") {
  Sandbox sandbox;
  Farm farm(sandbox, {"--log", "farm.log"});
  Running after_all = sandbox.start({"log", "--follow"});
  after_all.wait_for("farm: up with 4 nodes");
  Running follower = sandbox.start({"log", "--follow", "--lines", "0"});
  // It is there once it has told of a job that came after its start.
  for (int jobs = 0; follower.out().empty(); ++jobs) {
    REQUIRE(jobs < 100);
    ok(sandbox, {"submit", first(), "--size", "16x16", "--wait", "-q"});
  }
  const auto lines = lines_of(ok(sandbox, {"log"}));
  CHECK(ok(sandbox, {"log", "--lines", "1"}) == lines.back() + "\n");
  const auto json = nlohmann::json::parse(ok(sandbox, {"log", "--lines", "1", "--json"}));
  CHECK(json["job"].get<int>() >= 1);
  CHECK(json["trouble"] == false);
  CHECK(lines.back().ends_with(json["text"].get<std::string>()));
  ok(sandbox, {"down"});
  const Outcome all = after_all.wait(10s), newer = follower.wait(10s);
  CHECK(all.status == 0);
  CHECK(newer.status == 0);
  CHECK(farm.up().wait(10s).status == 0);
  const auto logged = lines_of(file_bytes(sandbox / "farm.log"));
  // The file also has the lines of those who aren't the frontal.
  for (const std::string& line : lines) {
    INFO(line);
    CHECK(std::ranges::count(logged, line) == 1);
  }
  CHECK(all.out.starts_with(joined(lines)));
  CHECK(lines_of(all.out).back().ends_with(" farm: goes down"));
  CHECK(all.out.ends_with(newer.out));
  CHECK(newer.out.find(": done after ") != std::string::npos);
  CHECK(newer.out.find("farm: up") == std::string::npos);
}

}  // namespace graycube
