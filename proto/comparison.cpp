#include "proto/comparison.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace graycube {

using Json = nlohmann::ordered_json;

Figures figures_of(const std::string& statistics) {
  const Json j = Json::parse(statistics);
  Figures f;
  f.wall_s = j.at("wall_s");
  f.cpu_s = j.at("cpu_s");
  f.frontal_cpu_s = j.at("frontal_cpu_s");
  f.render_s = j.at("phases").at("render_s");
  f.efficiency = j.at("balance").at("efficiency");
  f.blocked_fraction = j.at("balance").at("blocked_fraction");
  f.endgame_s = j.at("endgame_s");
  const auto count = [&](const char* group, const char* key) {
    return j.at(group).at(key).get<std::uint64_t>();
  };
  f.forwarded = count("forwarded", "shadow") + count("forwarded", "secondary") +
                count("forwarded", "primary");
  for (const char* kind : {"ray", "contribution", "sum"}) {
    f.messages += count("messages", (std::string(kind) + "_batches").c_str());
    f.message_bytes += count("messages", (std::string(kind) + "_bytes").c_str());
  }
  f.light_bytes = count("messages", "contribution_bytes");
  f.rounds = count("token", "rounds");
  for (const char* kind : {"primary", "shadow", "reflection", "refraction"})
    f.rays += count("rays", kind);
  f.cells = count("subdivision", "cells");
  f.tests = count("subdivision", "primitives_tested");
  for (const Json& n : j.at("per_node")) {
    f.largest_memory_bytes =
        std::max(f.largest_memory_bytes, n.at("memory_bytes").get<std::uint64_t>());
    f.queue_peak = std::max(f.queue_peak, n.at("queue_peak").get<std::uint64_t>());
    f.nodes.push_back({n.at("busy_s"), n.at("blocked_s"), n.at("window_s"), n.at("idle_s"),
                       n.value("fifo_wait_s", 0.0)});
  }
  return f;
}

std::string to_string(RowOutcome outcome) {
  switch (outcome) {
    case RowOutcome::kReference: return "reference";
    case RowOutcome::kSame: return "same";
    case RowOutcome::kDifferent: return "DIFFERENT";
    case RowOutcome::kDeadlocked: return "deadlocked";
    case RowOutcome::kFailed: return "FAILED";
  }
  return {};
}

std::string simulation_json(const std::string& scene, const std::vector<SimulatedRow>& rows) {
  Json j{{"scene", scene}, {"rows", Json::array()}};
  for (const SimulatedRow& r : rows) {
    Json row{{"nodes", r.nodes},
             {"time_s", r.time_s},
             {"distribution_s", r.distribution_s},
             {"host_load", r.host_load},
             {"predicted_over_measured", r.predicted_over_measured},
             {"outcome", to_string(r.row.outcome)},
             {"why", r.row.why}};
    if (r.hosts > 0) {
      row["hosts"] = r.hosts;
      row["bytes_between_hosts"] = r.bytes_between_hosts;
      row["bytes_with_frontal"] = r.bytes_with_frontal;
    }
    for (const auto& [name, seconds] : r.costs) row["costs"][name] = seconds;
    row["statistics"] = r.row.statistics.empty() ? Json() : Json::parse(r.row.statistics);
    j["rows"].push_back(std::move(row));
  }
  return j.dump();
}

std::string comparison_json(const std::string& scene, std::uint32_t nodes,
                            const std::vector<ComparedRow>& rows) {
  Json j{{"scene", scene}, {"nodes", nodes}, {"rows", Json::array()}};
  for (const ComparedRow& r : rows) {
    Json row{{"name", r.name},
             {"arguments", r.arguments},
             {"outcome", to_string(r.outcome)},
             {"why", r.why}};
    row["statistics"] = r.statistics.empty() ? Json() : Json::parse(r.statistics);
    j["rows"].push_back(std::move(row));
  }
  return j.dump();
}

}  // namespace graycube
