#include "cli/display/farm_text.hpp"

#include "cli/display/json_text.hpp"
#include "cli/display/local_time.hpp"

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

}  // namespace graycube
