#include "cli/display/job_text.hpp"

#include <cmath>
#include <map>

#include "cli/display/local_time.hpp"
#include "cli/display/progress.hpp"
#include "cli/display/table.hpp"

namespace graycube {
namespace {

std::string percent(double fraction) {
  return std::to_string(static_cast<int>(std::floor(100 * fraction + 1e-9))) + " %";
}

std::string time_taken(const control::JobInfo& job) {
  if (!job.started_s || !job.finished_s) return "-";
  return duration_text(*job.finished_s - *job.started_s);
}

/// "nodes 1, 2 and 3"
std::string names_of(const std::vector<std::uint32_t>& ranks) {
  std::string text = "nodes ";
  for (std::size_t i = 0; i < ranks.size(); ++i) {
    if (i > 0) text += i + 1 < ranks.size() ? ", " : " and ";
    text += std::to_string(ranks[i]);
  }
  return text;
}

/// A line for each process that is several nodes.
std::string shared_processes_text(const std::vector<control::NodeInfo>& nodes) {
  std::map<std::uint64_t, std::vector<std::uint32_t>> ranks;  // by process
  for (const control::NodeInfo& node : nodes) {
    if (node.pid != 0) ranks[node.pid].push_back(node.rank);
  }
  std::string text;
  for (const auto& [pid, of_process] : ranks) {
    if (of_process.size() < 2) continue;
    text += "Process " + std::to_string(pid) + " is " + names_of(of_process) +
            ", as none could be started for a node that was lost.\n";
  }
  return text;
}

}  // namespace

std::string jobs_text(const std::vector<control::JobInfo>& jobs) {
  std::vector<std::vector<std::string>> rows{
      {"JOB", "STATE", "DONE", "ALGORITHM", "CHECKS", "SUBMITTED", "TOOK", "SCENE", "MESSAGE"}};
  for (const control::JobInfo& job : jobs) {
    rows.push_back({std::to_string(job.job), std::string(to_string(job.state)),
                    percent(job.fraction), std::string(to_string(job.algorithm)),
                    std::to_string(job.rounds), local_time(job.submitted_s), time_taken(job),
                    job.scene, job.message});
  }
  return table_text(rows);
}

std::string job_text(const control::JobInfo& job) {
  std::string text;
  const auto line = [&](const char* name, const std::string& value) {
    text += std::string(name) + ": " + value + "\n";
  };
  line("job", std::to_string(job.job));
  line("scene", job.scene);
  line("state", std::string(to_string(job.state)));
  line("algorithm", std::string(to_string(job.algorithm)) + ", " + std::to_string(job.nodes) +
                        (job.nodes == 1 ? " node" : " nodes"));
  if (job.tiles > 0) {
    line("done", percent(job.fraction) + ", " + final_parts_text(job.tiles_whole, job.tiles));
  }
  if (job.rounds > 0) line("checks whether all is done", std::to_string(job.rounds));
  if (job.eta_s) line("time left", duration_text(*job.eta_s));
  line("submitted", local_time(job.submitted_s));
  if (job.started_s) line("started", local_time(*job.started_s));
  if (job.finished_s) line("finished", local_time(*job.finished_s));
  if (job.started_s && job.finished_s) line("took", time_taken(job));
  if (!job.message.empty()) line("message", job.message);
  return text;
}

std::string nodes_text(const std::vector<control::NodeInfo>& nodes) {
  std::vector<std::vector<std::string>> rows{
      {"NODE", "GRAY", "PID", "STATE", "THREADS", "ENDPOINT"}};
  for (const control::NodeInfo& node : nodes) {
    rows.push_back({std::to_string(node.rank), std::to_string(node.gray),
                    node.pid == 0 ? "-" : std::to_string(node.pid),
                    std::string(to_string(node.state)), std::to_string(node.threads),
                    node.endpoint.empty() ? "-" : node.endpoint});
  }
  return table_text(rows) + shared_processes_text(nodes);
}

}  // namespace graycube
