#include "proto/statistics.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace graycube {
namespace {

using Json = nlohmann::ordered_json;
using control::NodeStats;

std::uint64_t total(const std::vector<NodeStats>& nodes, std::uint64_t NodeStats::*field) {
  std::uint64_t sum = 0;
  for (const NodeStats& n : nodes) sum += n.*field;
  return sum;
}

double total(const std::vector<NodeStats>& nodes, double NodeStats::*field) {
  double sum = 0;
  for (const NodeStats& n : nodes) sum += n.*field;
  return sum;
}

Json node_json(const NodeStats& n) {
  return {{"rank", n.rank},
          {"gray", n.gray},
          {"pid", n.pid},
          {"cpu_s", n.cpu_s},
          {"start_cpu_s", n.start_cpu_s},
          {"busy_s", n.busy_s},
          {"idle_s", n.idle_s},
          {"blocked_s", n.blocked_s},
          {"window_s", n.window_s},
          {"rays_in", n.rays_in},
          {"rays_out", n.rays_out},
          {"queue_peak", n.queue_peak},
          {"primitives", n.primitives},
          {"outbox_peak", n.outbox_peak},
          {"open_peak", n.open_peak},
          {"open_bytes_peak", n.open_bytes_peak},
          {"answers", n.answers},
          {"memory_bytes", n.memory_bytes},
          {"models_borrowed", n.models_borrowed},
          {"tiles_taken_over", n.tiles_taken_over},
          {"rays_taken_over", n.rays_taken_over},
          {"peak_rss_bytes", n.peak_rss_bytes}};
}

/// Adds what is told of FIFOs that are processes apart.
void add_fifos(const Statistics& s, Json& j) {
  if (s.fifo == FifoMode::kThread) return;
  j["choices"]["fifo"] = to_string(s.fifo);
  j["messages"]["fifo_messages"] = total(s.per_node, &NodeStats::fifo_messages);
  for (std::size_t i = 0; i < s.per_node.size(); ++i) {
    j["per_node"][i]["fifo_wait_s"] = s.per_node[i].fifo_wait_s;
    j["per_node"][i]["fifo_cpu_s"] = s.per_node[i].fifo_cpu_s;
  }
}

Json balance_json(const Statistics& s) {
  double most = 0;
  for (const NodeStats& n : s.per_node) most = std::max(most, n.busy_s);
  const double mean = s.per_node.empty() ? 0
                                         : total(s.per_node, &NodeStats::busy_s) /
                                               static_cast<double>(s.per_node.size());
  const double available = static_cast<double>(s.nodes) * s.threads * s.render_s;
  const auto share = [&](double seconds) { return available > 0 ? seconds / available : 0.0; };
  return {{"efficiency", most > 0 ? mean / most : 1.0},
          {"blocked_fraction", share(total(s.per_node, &NodeStats::blocked_s))},
          {"window_fraction", share(total(s.per_node, &NodeStats::window_s))}};
}

Json subdivision_json(const Statistics& s) {
  const auto sum = [&](std::uint64_t NodeStats::*field) { return total(s.per_node, field); };
  Json j{{"way", to_string(s.subdivision.way)}};
  if (has_links(s.subdivision.way)) j["entry"] = to_string(entry_of(s.subdivision));
  j["cells"] = sum(&NodeStats::cells);
  j["cells_visited"] = sum(&NodeStats::cells_visited);
  j["primitives_tested"] = sum(&NodeStats::primitives_tested);
  j["tests_saved"] = sum(&NodeStats::tests_saved);
  j["boxes_tested"] = sum(&NodeStats::boxes_tested);
  j["boxes_rejected"] = sum(&NodeStats::boxes_rejected);
  j["spheres_tested"] = sum(&NodeStats::spheres_tested);
  j["spheres_rejected"] = sum(&NodeStats::spheres_rejected);
  j["nodes_descended"] = sum(&NodeStats::nodes_descended);
  j["entry_links"] = sum(&NodeStats::entry_links);
  j["rays_not_shot"] = sum(&NodeStats::rays_not_shot);
  return j;
}

Json sliding_json(const SlidingFigures& f) {
  return {{"slides", f.slides},         {"boundaries", f.boundaries},
          {"slices", f.slices},         {"slice_bytes", f.slice_bytes},
          {"primitives", f.primitives}, {"new_primitives", f.new_primitives},
          {"recut_s", f.recut_s},       {"build_s", f.build_s},
          {"slide_s", f.slide_s},       {"generations_peak", f.generations_peak}};
}

Json losses_json(const Statistics& s) {
  Json losses = Json::array();
  for (const Loss& loss : std::span(s.losses).first(std::min(s.losses.size(), kMaxLossesListed))) {
    Json j{{"why", loss.why}, {"noticed_s", loss.noticed_s}, {"tiles", loss.tiles}};
    if (loss.rank) j["rank"] = *loss.rank;
    losses.push_back(std::move(j));
  }
  return losses;
}

}  // namespace

std::string statistics_json(const Statistics& s) {
  const auto sum = [&](std::uint64_t NodeStats::*field) { return total(s.per_node, field); };
  Json j;
  j["graycube"] = s.version;
  j["scene"] = s.scene;
  if (!s.failed.empty()) j["failed"] = s.failed;
  j["algorithm"] = to_string(s.algorithm);
  j["nodes"] = s.nodes;
  j["threads"] = s.threads;
  j["dimension"] = s.dimension;
  j["grid"] = s.grid;
  j["image"] = {{"width", s.image.width}, {"height", s.image.height}, {"samples", s.image.samples}};
  j["primitives"] = s.primitives;
  j["objects"] = s.objects;
  j["choices"] = {{"scatter", s.scatter},
                  {"shadows", to_string(s.shadows)},
                  {"partition", to_string(s.partition)},
                  {"flow", to_string(s.flow)},
                  {"sums", to_string(s.sums)},
                  {"returns", to_string(s.returns)},
                  {"mesh", to_string(s.mesh)},
                  {"boundaries", to_string(s.boundaries)}};
  j["wall_s"] = s.wall_s;
  j["cpu_s"] = s.cpu_s;
  j["frontal_cpu_s"] = s.frontal_cpu_s;
  j["start_cpu_s"] = s.start_cpu_s;
  j["phases"] = {{"load_s", s.load_s},
                 {"partition_s", s.partition_s},
                 {"build_s", s.build_s},
                 {"render_s", s.render_s}};
  j["rays"] = {{"primary", sum(&NodeStats::primary)},
               {"shadow", sum(&NodeStats::shadow)},
               {"reflection", sum(&NodeStats::reflection)},
               {"refraction", sum(&NodeStats::refraction)}};
  j["shadow"] = {{"skipped_by_horizon", sum(&NodeStats::skipped_by_horizon)}};
  j["forwarded"] = {{"shadow", sum(&NodeStats::forwarded_shadow)},
                    {"secondary", sum(&NodeStats::forwarded_secondary)},
                    {"primary", sum(&NodeStats::forwarded_primary)}};
  j["messages"] = {{"ray_batches", sum(&NodeStats::ray_batches)},
                   {"ray_bytes", sum(&NodeStats::ray_bytes)},
                   {"contribution_batches", sum(&NodeStats::contribution_batches)},
                   {"contribution_bytes", sum(&NodeStats::contribution_bytes)},
                   {"sum_batches", sum(&NodeStats::sum_batches)},
                   {"sum_bytes", sum(&NodeStats::sum_bytes)},
                   {"answer_batches", sum(&NodeStats::answer_batches)},
                   {"answer_bytes", sum(&NodeStats::answer_bytes)}};
  j["distribution"] = {{"slices", s.slices},
                       {"slice_bytes", s.slice_bytes},
                       {"link_batches", sum(&NodeStats::slice_batches)},
                       {"link_bytes", sum(&NodeStats::slice_bytes)}};
  j["subdivision"] = subdivision_json(s);
  if (s.boundaries == BoundariesMode::kSliding) j["sliding"] = sliding_json(s.sliding);
  j["epochs"] = s.epochs;
  j["losses"] = losses_json(s);
  j["resumed_tiles"] = s.resumed_tiles;
  j["token"] = {{"rounds", s.token_rounds}, {"hops", s.token_hops}};
  double endgame_s = s.per_node.empty() ? 0 : s.per_node.front().endgame_s;
  for (const NodeStats& n : s.per_node) endgame_s = std::min(endgame_s, n.endgame_s);
  j["endgame_s"] = endgame_s;
  j["balance"] = balance_json(s);
  j["contributions"] = {{"non_finite", sum(&NodeStats::non_finite)},
                        {"clamped", sum(&NodeStats::clamped)}};
  j["malformed_drops"] = sum(&NodeStats::malformed_drops);
  j["per_node"] = Json::array();
  for (const NodeStats& n : s.per_node) j["per_node"].push_back(node_json(n));
  add_fifos(s, j);
  return j.dump();
}

std::string with_command_times(const std::string& text, double wall_s, double cpu_s,
                               double load_s) {
  Json j = Json::parse(text, nullptr, false);
  if (!j.is_object() || !j.contains("cpu_s") || !j["cpu_s"].is_number()) return text;
  j["wall_s"] = wall_s;
  j["cpu_s"] = j["cpu_s"].get<double>() + cpu_s;
  const Json::json_pointer in_phases("/phases/load_s");
  if (j.contains(in_phases) && j[in_phases].is_number())
    j[in_phases] = j[in_phases].get<double>() + load_s;
  return j.dump();
}

}  // namespace graycube
