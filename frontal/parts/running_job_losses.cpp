// The part of RunningJob that goes on after losses (docs/design/epochs.md).
#include <algorithm>
#include <string>
#include <utility>

#include "frontal/parts/running_job.hpp"

namespace graycube {

void RunningJob::goes_on_after(std::uint32_t frontals) {
  earlier_frontals_ = frontals;
  losses_.assign(std::min<std::size_t>(frontals, kMaxLossesListed),
                 {std::nullopt, "the frontal ended, and another one goes on", 0, 0});
}

std::optional<JobFailure> RunningJob::lose(const std::vector<NodeLoss>& nodes, Post& post) {
  if (!is_on_nodes()) {
    for (const NodeLoss& node : nodes) {
      farm_log_.node_is_lost(node.rank, node.name, node.how, node.noticed_s);
      if (stage_ == JobStage::kReporting) render_->reports().will_not_come(node.rank);
    }
    return std::nullopt;
  }
  std::vector<NamedLoss> losses;
  for (const NodeLoss& node : nodes)
    losses.push_back({node.name, {node.rank.value, node.how, node.noticed_s, 0}});
  return go_on_without(std::move(losses), true, post);
}

/// That needs no epoch: the one that began with the loss has waited for somebody in its place.
void RunningJob::note_guest(const NodeLoss& node) {
  if (is_on_nodes()) losses_.push_back({node.rank.value, node.how, node.noticed_s, 0});
}

std::optional<JobFailure> RunningJob::on_error(Rank rank, const control::NodeError& m, Post& post) {
  const std::string name = "node " + std::to_string(rank.value);
  if (m.job != id() || !is_on_nodes()) return std::nullopt;
  if (m.is_final) return JobFailure{JobState::kFailed, FailureCode::kFailed, {{name, m.message}}};
  if (m.epoch != render_->epoch()) return std::nullopt;
  return go_on_without({{name, {rank.value, m.message, 0, 0}}}, false, post);
}

std::optional<JobFailure> RunningJob::look_for_lost_messages(double now_s, Post& post) {
  // Where boundaries slide, nodes may wait for what is being cut.
  if (!is_rendering() || render_->sliding() != nullptr) return std::nullopt;
  // The deadlocks of blocking flow are found sooner.
  if (!standstill_watch_.all_wait(now_s, 2 * farm_.silence_s)) return std::nullopt;
  const Loss loss{std::nullopt, "all nodes wait for messages that were lost", 0, 0};
  return go_on_without({{"the farm", loss}}, false, post);
}

/// Begins the next epoch. Once all tiles are whole none is needed: the picture is complete. Of
/// losses at one moment the first has all tiles that were under way.
std::optional<JobFailure> RunningJob::go_on_without(std::vector<NamedLoss> losses, bool are_gone,
                                                    Post& post) {
  std::vector<Rank> nodes;
  for (const NamedLoss& of : losses) {
    if (of.loss.rank) nodes.push_back(Rank{*of.loss.rank});
  }
  const RenderJob::Damage damage = render_->note_loss(nodes, are_gone);
  losses.front().loss.tiles = damage.tiles;
  const bool goes_on = !render_->film_is_complete() && damage.culprit.empty();
  if (goes_on) {
    render_->begin_next_epoch();
    farm_log_.epoch_begins();
  }
  for (const NamedLoss& of : losses) {
    losses_.push_back(of.loss);
    farm_log_.job_loses(id(), of.loss, of.name, are_gone, epochs());
  }
  if (render_->film_is_complete()) {
    is_cut_short_ = true;
    for (const Rank rank : nodes) {
      if (are_gone) render_->reports().will_not_come(rank);
    }
    return std::nullopt;
  }
  if (!goes_on) {
    return JobFailure{
        JobState::kFailed,
        FailureCode::kFailed,
        {{losses.front().name, losses.front().loss.why + "; that was loss " +
                                   std::to_string(earlier_frontals_ + render_->epoch() + 1) +
                                   " of the job, and each time " + damage.culprit}}};
  }
  stage_ = JobStage::kBuilding;
  late_.clear();
  are_told_dealt_ = false;
  if (deadlock_watch_) deadlock_watch_.emplace(farm_.cube);
  if (!render_->loads_all_again()) post.to_nodes(control::Prepare{id(), render_->epoch()});
  return std::nullopt;
}

}  // namespace graycube
