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
  using Process = std::pair<std::string, std::uint64_t>;  // two hosts may have the same ids
  std::map<Process, std::vector<std::uint32_t>> ranks;
  for (const control::NodeInfo& node : nodes) {
    if (node.pid != 0) ranks[{node.host, node.pid}].push_back(node.rank);
  }
  std::string text;
  for (const auto& [process, of_process] : ranks) {
    if (of_process.size() < 2) continue;
    text += "Process " + std::to_string(process.second) + " is " + names_of(of_process) +
            ", as none could be started for a node that was lost.\n";
  }
  return text;
}

/// Behind an empty line a table with a line for each host; nothing if there is none.
std::string hosts_text(const std::vector<control::HostInfo>& hosts) {
  if (hosts.empty()) return "";
  constexpr double kGibibyte = 1u << 30;
  std::vector<std::vector<std::string>> rows{
      {"HOST", "CORES", "MEMORY", "SLOTS", "NODES", "PID", "STATE"}};
  for (const control::HostInfo& host : hosts) {
    rows.push_back({host.host, std::to_string(host.cores),
                    number_text("%.1f GiB", static_cast<double>(host.memory_bytes) / kGibibyte),
                    std::to_string(host.slots), std::to_string(host.nodes),
                    std::to_string(host.pid), host.state});
  }
  return "\n" + table_text(rows);
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

std::string nodes_text(const control::NodeList& list) {
  const bool has_hosts = !list.hosts.empty();
  std::vector<std::vector<std::string>> rows{{"NODE", "GRAY"}};
  if (has_hosts) rows.front().push_back("HOST");
  for (const char* name : {"PID", "STATE", "THREADS", "ENDPOINT"}) rows.front().push_back(name);
  for (const control::NodeInfo& node : list.nodes) {
    std::vector<std::string> row{std::to_string(node.rank), std::to_string(node.gray)};
    if (has_hosts) row.push_back(node.host.empty() ? "-" : node.host);
    row.push_back(node.pid == 0 ? "-" : std::to_string(node.pid));
    row.emplace_back(to_string(node.state));
    row.push_back(std::to_string(node.threads));
    row.push_back(node.endpoint.empty() ? "-" : node.endpoint);
    rows.push_back(std::move(row));
  }
  return table_text(rows) + shared_processes_text(list.nodes) + hosts_text(list.hosts);
}

}  // namespace graycube
