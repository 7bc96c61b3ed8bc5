#include "cli/display/farm_text.hpp"

#include "cli/display/json_text.hpp"
#include "cli/display/local_time.hpp"
#include "process/log_line.hpp"

namespace graycube {

std::string farm_text(const control::FarmInfo& farm) {
  std::string text;
  const auto line = [&](const char* name, const std::string& value) {
    text += std::string(name) + ": " + value + "\n";
  };
  line("frontal", "process " + std::to_string(farm.pid) + " at " + farm.endpoint);
  line("version", farm.version);
  line("started", local_time(farm.started_s));
  line("nodes", std::to_string(farm.nodes_here) + " of " + std::to_string(farm.nodes));
  line("jobs", std::to_string(farm.running) + " running, " + std::to_string(farm.queued) +
                   " queued, " + std::to_string(farm.ended) + " ended");
  return text;
}

std::string farm_json(const control::FarmInfo& farm) {
  const std::string pid = std::to_string(farm.pid);
  const std::uint32_t jobs = farm.queued + farm.running + farm.ended;
  return "{\"pid\":" + pid + ",\"frontal\":{\"pid\":" + pid +
         ",\"endpoint\":" + json_string(farm.endpoint) +
         ",\"version\":" + json_string(farm.version) +
         ",\"started\":" + json_seconds(farm.started_s) +
         "},\"nodes\":" + std::to_string(farm.nodes) +
         ",\"nodes_here\":" + std::to_string(farm.nodes_here) +
         ",\"jobs\":" + std::to_string(jobs) + ",\"queued\":" + std::to_string(farm.queued) +
         ",\"running\":" + std::to_string(farm.running) +
         ",\"ended\":" + std::to_string(farm.ended) + "}\n";
}

std::string log_text(const control::LogLine& line) { return log_line(line.unix_s, line.text); }

std::string log_json(const control::LogLine& line) {
  const std::string job = line.job == 0 ? "" : ",\"job\":" + std::to_string(line.job);
  return "{\"time\":" + json_seconds(line.unix_s) + job +
         ",\"trouble\":" + (line.is_trouble ? "true" : "false") +
         ",\"text\":" + json_string(line.text) + "}\n";
}

}  // namespace graycube
