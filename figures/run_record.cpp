#include "figures/run_record.hpp"

#include <algorithm>
#include <functional>
#include <variant>

#include "proto/batch.hpp"
#include "proto/control.hpp"
#include "simulation/modelled_machine.hpp"

namespace graycube::figures {
namespace {

using simulation::Place;
using simulation::Unit;

/// CPU seconds of each unit of work: round figures near those that `graycube simulate` finds on a
/// processor of 2020.
simulation::PerUnit fixed_costs() {
  simulation::PerUnit costs;
  costs[Unit::kPiece] = 1.5e-6;
  costs[Unit::kRay] = 2e-7;
  costs[Unit::kVisit] = 5e-8;
  costs[Unit::kTest] = 1e-7;
  costs[Unit::kBuildByte] = 2e-9;
  costs[Unit::kNodeCall] = 2e-6;
  costs[Unit::kRayIn] = 1e-7;
  costs[Unit::kRayOut] = 5e-8;
  costs[Unit::kReturn] = 1e-7;
  costs[Unit::kLightByte] = 1e-9;
  costs[Unit::kFrontalCall] = 5e-6;
  costs[Unit::kFrontalByte] = 1e-9;
  costs[Unit::kMessage] = 5e-6;
  costs[Unit::kMessageByte] = 2e-10;
  costs[Unit::kWakeup] = 2e-6;
  return costs;
}

/// A machine that tells when the message arrives that it was asked about.
class TellingMachine : public simulation::ModelledMachine {
 public:
  using ModelledMachine::ModelledMachine;
  double arrival_s(Place from, Place to, std::size_t bytes, double now_s) override {
    const double at_s = ModelledMachine::arrival_s(from, to, bytes, now_s);
    if (arrives) arrives(at_s);
    arrives = nullptr;
    return at_s;
  }
  /// Called with the moment at which the next message arrives, once.
  std::function<void(double)> arrives;
};

/// Writes down what a farm sends.
class Recorder {
 public:
  Recorder(RunRecord& record, TellingMachine& machine, std::uint32_t nodes)
      : record_(record),
        machine_(machine),
        limits_{
            .pixel_count = kMaxPixels, .max_depth = kMaxDepth, .nodes = nodes, .may_slide = true} {}

  void on_sent(Place from, Place to, double sent_s, const Message& message) {
    if (!looks_like_batch(message.frame)) return on_control(from, sent_s, message);
    if (!from || !to) return;
    const auto header = peek_header(message.frame);
    const auto* h = std::get_if<BatchHeader>(&header);
    if (h == nullptr) return;
    if (h->type == BatchType::kRays || h->type == BatchType::kClassRays) {
      on_rays(*from, *to, sent_s - start_s_, message, *h);
    } else if (h->type == BatchType::kToken) {
      on_token(*from, *to, sent_s - start_s_, message);
    }
  }

 private:
  static constexpr std::size_t kKeptOfBatch = 24;

  void on_control(Place from, double sent_s, const Message& message) {
    const auto decoded = decode(message.text());
    const auto* m = std::get_if<ControlMessage>(&decoded);
    if (m == nullptr) return;
    if (const auto* load = std::get_if<control::Load>(m)) record_.grid = load->grid;
    if (std::holds_alternative<control::Start>(*m) && !has_started_) {
      has_started_ = true;
      start_s_ = sent_s;
    }
    if (from && std::holds_alternative<control::Terminated>(*m)) note_time(sent_s - start_s_);
  }

  void on_rays(Rank from, Rank to, double sent_s, const Message& message, const BatchHeader& h) {
    note_time(sent_s);
    if (record_.rays.size() < RunRecord::kMostRays) keep_rays(from, to, message, h.type);
    if (record_.shipments.size() >= RunRecord::kMostShipments) {
      record_.is_cut_short = true;
      return;
    }
    const std::size_t i = record_.shipments.size();
    record_.shipments.push_back({from, to, sent_s, sent_s, h.count});
    machine_.arrives = [this, i](double at_s) {
      record_.shipments[i].arrived_s = at_s - start_s_;
      note_time(at_s - start_s_);
    };
  }

  void keep_rays(Rank from, Rank to, const Message& message, BatchType type) {
    std::vector<RayTask> rays;
    if (std::holds_alternative<BatchError>(decode_rays(message.frame, limits_, rays, type))) return;
    // Rays of a batch are much alike: those that are kept are spread over it.
    const std::size_t step = rays.size() / kKeptOfBatch + 1;
    for (std::size_t i = 0; i < rays.size(); i += step) {
      if (record_.rays.size() < RunRecord::kMostRays) record_.rays.push_back({to, from, rays[i]});
    }
  }

  void on_token(Rank from, Rank to, double sent_s, const Message& message) {
    Token token;
    if (std::holds_alternative<BatchError>(decode_token(message.frame, limits_, token))) return;
    const std::size_t i = record_.token.size();
    record_.token.push_back({from, to, sent_s, sent_s, token.round, token.black, token.count});
    machine_.arrives = [this, i](double at_s) {
      record_.token[i].arrived_s = at_s - start_s_;
      note_time(at_s - start_s_);
    };
  }

  void note_time(double at_s) { record_.end_s = std::max(record_.end_s, at_s); }

  RunRecord& record_;
  TellingMachine& machine_;
  BatchLimits limits_;
  bool has_started_ = false;
  double start_s_ = 0;
};

}  // namespace

RunRecord record_run(const std::string& scene, const control::JobOptions& options,
                     std::uint32_t nodes) {
  RunRecord record;
  simulation::MachineFigures figures;
  figures.costs = fixed_costs();
  TellingMachine machine(figures);
  simulation::Farm farm({.nodes = nodes, .stalled_s = 1e9}, machine);
  Recorder recorder(record, machine, nodes);
  farm.on_sent = [&](Place from, Place to, double sent_s, const Message& message) {
    recorder.on_sent(from, to, sent_s, message);
  };
  record.outcome = farm.render(scene, options);
  return record;
}

}  // namespace graycube::figures
