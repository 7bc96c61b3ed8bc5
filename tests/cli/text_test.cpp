#include "catch.hpp"
#include "cli/display/job_text.hpp"
#include "cli/display/json_text.hpp"
#include "cli/display/table.hpp"
#include "cli/failure.hpp"
#include "cli/farm/client.hpp"

namespace graycube {
namespace {

TEST_CASE("any text is a JSON string, as it is if it is UTF-8") {
  CHECK(json_string("a b") == "\"a b\"");
  CHECK(json_string("\"\\\n") == "\"\\\"\\\\\\u000a\"");
  CHECK(json_string("\xC3\xA4\xE2\x82\xAC\xF0\x9F\x98\x80") ==
        "\"\xC3\xA4\xE2\x82\xAC\xF0\x9F\x98\x80\"");
  // Alone, too long, a surrogate, beyond the last: each byte is replaced.
  for (const std::string_view bad : {"\xC3", "\x80", "\xC0\xAF", "\xED\xA0\x80", "\xF5\x80"}) {
    std::string replaced = "\"";
    for (std::size_t i = 0; i < bad.size(); ++i) replaced += "\xEF\xBF\xBD";
    CHECK(json_string(bad) == replaced + "\"");
  }
}

TEST_CASE("columns line up under their headers, whatever the alphabet") {
  CHECK(table_text({{"A", "NAME", "B"}, {"1", "é", "x"}, {"22", "plate", ""}}) ==
        "A   NAME   B\n1   é      x\n22  plate\n");
  CHECK(table_text({}).empty());
}

TEST_CASE("an error stays one line, whatever is in it") {
  CHECK(line_of({"scene", "a\nb.json", "no\tgood\r\n"}) == "graycube: scene: a b.json: no good  ");
  CHECK(line_of({"farm", "", "gone"}) == "graycube: farm: gone");
}

TEST_CASE("a failed job tells each error, and bad input from failure") {
  control::Failed failed;
  failed.job = 7;
  failed.errors = {{"node 3 (process 4711)", "killed by signal 9"}, {"", "and more"}};
  failed.code = FailureCode::kFailed;
  const Failure failure = failure_of(failed, "render");
  CHECK(failure.status() == ExitStatus::kFailed);
  REQUIRE(failure.problems().size() == 2);
  CHECK(line_of(failure.problems()[0]) ==
        "graycube: render: node 3 (process 4711): killed by signal 9");
  CHECK(line_of(failure.problems()[1]) == "graycube: render: job 7: and more");
  failed.code = FailureCode::kBadInput;
  CHECK(failure_of(failed, "scene").status() == ExitStatus::kBadInput);
  failed.errors.clear();
  CHECK(failure_of(failed, "scene").problems().size() == 1);
}

TEST_CASE("a deadlock is a failure that has statistics, by its code and not by its words") {
  control::Failed failed{7, FailureCode::kFailed, {{"", "deadlock: so it says"}}, {}};
  CHECK_FALSE(failure_of(failed, "render").is_deadlock());
  failed.code = FailureCode::kDeadlock;
  failed.stats = RawObject{"{\"nodes\":4}"};
  const Failure failure = failure_of(failed, "render");
  CHECK(failure.is_deadlock());
  CHECK(failure.status() == ExitStatus::kFailed);
  CHECK(failure.statistics() == "{\"nodes\":4}");
}

TEST_CASE("a job's lines tell what is known of it and nothing else") {
  control::JobInfo job;
  job.job = 3;
  job.scene = "plate.json";
  job.nodes = 8;
  const std::string queued = job_text(job);
  CHECK(queued.find("state: queued\n") != std::string::npos);
  CHECK(queued.find("time left") == std::string::npos);
  CHECK(queued.find("checks") == std::string::npos);
  CHECK(queued.find("parts") == std::string::npos);
  job.state = JobState::kRendering;
  job.tiles = 10;
  job.tiles_whole = 5;
  job.fraction = 0.5;
  job.eta_s = 2.0;
  job.rounds = 2;
  const std::string running = job_text(job);
  CHECK(running.find("done: 50 %, 5 of 10 parts of the picture are final\n") != std::string::npos);
  CHECK(running.find("checks whether all is done: 2\n") != std::string::npos);
  CHECK(running.find("time left: 2.0 s\n") != std::string::npos);
}

TEST_CASE("jobs and nodes are tables with a header") {
  control::JobInfo job;
  job.job = 12;
  job.scene = "plate.json";
  job.message = "node 1: killed by signal 9";
  const std::string jobs = jobs_text({job});
  CHECK(jobs.starts_with("JOB  STATE"));
  CHECK(jobs.find("\n12   queued") != std::string::npos);
  CHECK(jobs.find("node 1: killed by signal 9\n") != std::string::npos);
  control::NodeInfo node;
  node.rank = 1;
  node.gray = 1;
  CHECK(nodes_text({{node}, {}}) ==
        "NODE  GRAY  PID  STATE     THREADS  ENDPOINT\n1     1     -    starting  1        -\n");
}

TEST_CASE("a process that is several nodes is told of below the table, others are not") {
  std::vector<control::NodeInfo> nodes(5);
  for (std::uint32_t rank = 0; rank < 5; ++rank) nodes[rank].rank = rank;
  nodes[1].pid = 71;
  nodes[0].pid = nodes[2].pid = nodes[3].pid = 40;
  const std::string text = nodes_text({nodes, {}});
  const std::string below = text.substr(text.find("Process"));
  CHECK(below ==
        "Process 40 is nodes 0, 2 and 3, as none could be started for a node that was lost.\n");
}

TEST_CASE("where nodes run on hosts, the hosts are told, and what they have") {
  control::NodeList list{std::vector<control::NodeInfo>(3), {}};
  list.nodes[0].host = "n1";
  list.nodes[1].host = "n2";
  list.nodes[0].pid = list.nodes[1].pid = 71;  // of two machines
  list.hosts = {{"n1", 16, 3ull << 29, 8, 1, 70, "runs nodes"}};
  CHECK(nodes_text(list) ==
        "NODE  GRAY  HOST  PID  STATE     THREADS  ENDPOINT\n"
        "0     0     n1    71   starting  1        -\n"
        "0     0     n2    71   starting  1        -\n"
        "0     0     -     -    starting  1        -\n"
        "\n"
        "HOST  CORES  MEMORY   SLOTS  NODES  PID  STATE\n"
        "n1    16     1.5 GiB  8      1      70   runs nodes\n");
}

}  // namespace
}  // namespace graycube
