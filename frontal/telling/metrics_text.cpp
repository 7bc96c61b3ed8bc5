#include "frontal/telling/metrics_text.hpp"

#include <prometheus/metric_family.h>
#include <prometheus/text_serializer.h>

#include <initializer_list>
#include <utility>
#include <vector>

namespace graycube {
namespace {

using prometheus::ClientMetric;
using prometheus::MetricFamily;
using prometheus::MetricType;

/// A value of a family whose metrics differ by one label.
template <typename Number>
struct Labelled {
  const char* label;
  Number value;
};

class Families {
 public:
  /// A counter or gauge by its name: counters end in "_total".
  template <typename Number>
  void add(const char* name, const char* help, Number value) {
    metrics_of(name, help).push_back(metric(static_cast<double>(value), {}));
  }
  template <typename Number>
  void add(const char* name, const char* help, const char* label,
           std::initializer_list<Labelled<Number>> values) {
    std::vector<ClientMetric>& metrics = metrics_of(name, help);
    for (const auto& v : values)
      metrics.push_back(metric(static_cast<double>(v.value), {{label, v.label}}));
  }
  void add_version(const std::string& version) {
    metrics_of("graycube_info", "The version of the frontal, as a label.")
        .push_back(metric(1, {{"version", version}}));
  }
  std::string text() const { return prometheus::TextSerializer().Serialize(families_); }

 private:
  std::vector<ClientMetric>& metrics_of(std::string name, const char* help) {
    const MetricType type = name.ends_with("_total") ? MetricType::Counter : MetricType::Gauge;
    return families_.emplace_back(MetricFamily{std::move(name), help, type, {}}).metric;
  }
  static ClientMetric metric(double value, std::vector<ClientMetric::Label> labels) {
    ClientMetric m;
    m.label = std::move(labels);
    m.counter.value = m.gauge.value = value;
    return m;
  }

  std::vector<MetricFamily> families_;
};

void add_jobs(Families& to, const control::FarmMetrics& farm) {
  const control::FarmCounts& c = farm.counts;
  to.add("graycube_accepted_jobs_total", "Jobs that were submitted, or taken up after a restart.",
         c.jobs_accepted);
  to.add<std::uint64_t>(
      "graycube_jobs_total", "Jobs that have ended.", "outcome",
      {{"done", c.jobs_done}, {"failed", c.jobs_failed}, {"cancelled", c.jobs_cancelled}});
  to.add<std::uint32_t>("graycube_current_jobs", "Jobs that wait or are on.", "state",
                        {{"queued", farm.farm.queued}, {"running", farm.farm.running}});
  to.add("graycube_running_job_done_ratio", "The part of the running job that is done; 0 if none.",
         farm.fraction);
  to.add("graycube_tiles_total", "Parts of pictures that have become final.", c.tiles_whole);
  to.add("graycube_epochs_total", "Tries at pictures that losses made necessary.", c.epochs);
  to.add<std::uint64_t>("graycube_losses_total", "Nodes, and messages to nodes, that were lost.",
                        "kind", {{"node", c.nodes_lost}, {"messages", c.messages_lost}});
}

void add_rays(Families& to, const control::FarmCounts& c) {
  to.add<std::uint64_t>("graycube_rays_total", "Rays, each counted where it is created.", "kind",
                        {{"primary", c.primary},
                         {"shadow", c.shadow},
                         {"reflection", c.reflection},
                         {"refraction", c.refraction}});
  to.add<std::uint64_t>("graycube_forwarded_rays_total",
                        "Rays that went to a neighbour, counted each time.", "kind",
                        {{"primary", c.forwarded_primary},
                         {"shadow", c.forwarded_shadow},
                         {"secondary", c.forwarded_secondary}});
}

void add_messages(Families& to, const control::FarmCounts& c) {
  to.add<std::uint64_t>("graycube_messages_total", "Binary messages, by what they hold.", "content",
                        {{"rays", c.ray_batches},
                         {"light", c.contribution_batches},
                         {"sums", c.sum_batches},
                         {"answers", c.answer_batches},
                         {"slices", c.slice_batches}});
  to.add<std::uint64_t>("graycube_message_bytes_total", "Bytes of these messages.", "content",
                        {{"rays", c.ray_bytes},
                         {"light", c.contribution_bytes},
                         {"sums", c.sum_bytes},
                         {"answers", c.answer_bytes},
                         {"slices", c.slice_bytes}});
  to.add("graycube_malformed_messages_total", "Messages that nodes refused.", c.malformed_drops);
}

void add_nodes(Families& to, const control::FarmMetrics& farm) {
  const control::FarmCounts& c = farm.counts;
  to.add<std::uint32_t>("graycube_nodes", "Nodes by what they do.", "state",
                        {{"starting", farm.nodes_starting},
                         {"idle", farm.nodes_idle},
                         {"busy", farm.nodes_busy},
                         {"lost", farm.nodes_lost}});
  to.add<double>("graycube_evaluator_seconds_total",
                 "Time of evaluators: tracing (CPU time), or waiting and for what.", "state",
                 {{"busy", c.busy_s},
                  {"blocked", c.blocked_s},
                  {"window", c.window_s},
                  {"idle", c.idle_s},
                  {"fifo", c.fifo_wait_s}});
  to.add("graycube_nodes_cpu_seconds_total", "CPU time of nodes.", c.nodes_cpu_s);
  to.add("graycube_last_job_queue_peak_rays", "Most rays that waited in a node of the last job.",
         c.last_queue_peak);
  to.add("graycube_last_job_outbox_peak_rays",
         "Most rays that waited in a node of the last job to be sent.", c.last_outbox_peak);
  to.add("graycube_last_job_node_memory_bytes",
         "The largest node's part of the last job's scene, subdivided.", c.last_memory_bytes);
}

void add_frontal(Families& to, const control::FarmMetrics& farm) {
  const control::FarmCounts& c = farm.counts;
  to.add_version(farm.farm.version);
  to.add("graycube_start_time_seconds", "When the frontal was started, in Unix time.",
         farm.farm.started_s);
  to.add("graycube_frontal_cpu_seconds_total", "CPU time of the frontal, with starting nodes.",
         farm.frontal_cpu_s);
  to.add("graycube_frontal_longest_turn_seconds",
         "The longest turn of the frontal's loop: whoever asks it something waits that long.",
         farm.longest_turn_s);
  to.add<std::uint64_t>("graycube_refusals_total", "Who or what was refused.", "kind",
                        {{"submission", c.refused_submissions},
                         {"node", c.refused_nodes},
                         {"client", c.refused_clients},
                         {"connection", c.refused_connections}});
}

}  // namespace

std::string metrics_text(const control::FarmMetrics& farm) {
  Families families;
  add_jobs(families, farm);
  add_rays(families, farm.counts);
  add_messages(families, farm.counts);
  add_nodes(families, farm);
  add_frontal(families, farm);
  return families.text();
}

}  // namespace graycube
