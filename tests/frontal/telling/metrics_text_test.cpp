// A farm's figures as Prometheus reads them.
#include "frontal/telling/metrics_text.hpp"

#include "catch.hpp"
#include "frontal/telling/metrics_parser.hpp"
#include "proto/control_examples.hpp"

using namespace graycube;
using graycube::testing::MetricsParser;

TEST_CASE("metrics are in the text format, and every figure is there with its own value") {
  const control::FarmMetrics farm = test::example_metrics();
  const auto metrics = MetricsParser::parse(metrics_text(farm));
  const control::FarmCounts& c = farm.counts;
  const std::pair<const char*, double> expected[] = {
      {"graycube_jobs_total{outcome=\"done\"}", static_cast<double>(c.jobs_done)},
      {"graycube_jobs_total{outcome=\"failed\"}", static_cast<double>(c.jobs_failed)},
      {"graycube_jobs_total{outcome=\"cancelled\"}", static_cast<double>(c.jobs_cancelled)},
      {"graycube_accepted_jobs_total", static_cast<double>(c.jobs_accepted)},
      {"graycube_current_jobs{state=\"queued\"}", 3},
      {"graycube_current_jobs{state=\"running\"}", 1},
      {"graycube_running_job_done_ratio", 0.5},
      {"graycube_tiles_total", 1099511627776.0},
      {"graycube_rays_total{kind=\"refraction\"}", static_cast<double>(c.refraction)},
      {"graycube_message_bytes_total{content=\"slices\"}", static_cast<double>(c.slice_bytes)},
      {"graycube_evaluator_seconds_total{state=\"window\"}", c.window_s},
      {"graycube_nodes{state=\"lost\"}", 104},
      {"graycube_refusals_total{kind=\"connection\"}", static_cast<double>(c.refused_connections)},
      {"graycube_frontal_longest_turn_seconds", 0.0625},
      {"graycube_info{version=\"0.4.0\"}", 1},
      {"graycube_start_time_seconds", 1700000000.5}};
  for (const auto& [name, value] : expected) {
    INFO(name);
    REQUIRE(metrics.samples.contains(name));
    CHECK(metrics.samples.at(name) == value);
  }
  // The example's numbers are all different: no figure stands for another.
  std::map<double, std::string> names;
  for (const auto& [name, value] : metrics.samples) {
    if (value == 1 || value == 3 || value == 0.5) continue;  // also in the farm's own fields
    INFO(name << " and " << names[value]);
    CHECK(std::exchange(names[value], name).empty());
  }
}

TEST_CASE("a version is a label whatever is in it") {
  control::FarmMetrics farm;
  farm.farm.version = "a\"b\\c\nd";
  const auto metrics = MetricsParser::parse(metrics_text(farm));
  CHECK(metrics.samples.contains("graycube_info{version=\"a\\\"b\\\\c\\nd\"}"));
}

TEST_CASE("the tests' parser refuses what isn't the text format") {
  const std::string help = "# HELP a_total Counts something.\n", type = "# TYPE a_total counter\n";
  CHECK(MetricsParser::parse(help + type + "a_total{b=\"c\",d=\"e\"} 1\n").samples.size() == 1);
  for (const std::string& text :
       {type + "a_total 1\n", help + "a_total 1\n", help + type, help + type + "a_total 1",
        help + type + "b_total 1\n", help + type + "a_total 1\na_total 2\n",
        help + type + "a_total{b=c} 1\n", help + type + "a_total 1 x\n",
        help + "# TYPE a_total gauge\na_total 1\n", help + type + "a_total 1\n" + help,
        std::string("\n")}) {
    INFO(text);
    CHECK_THROWS(MetricsParser::parse(text));
  }
}
