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

std::optional<JobFailure> RunningJob::lose(const NodeLoss& node, Post& post) {
  if (!is_on_nodes()) farm_log_.node_is_lost(node.rank, node.name, node.how, node.noticed_s);
  if (stage_ == JobStage::kReporting) {
    render_->reports().will_not_come(node.rank);
    return std::nullopt;
  }
  if (!is_on_nodes()) return std::nullopt;
  return go_on_without({node.rank.value, node.how, node.noticed_s, 0}, node.name, true, post);
}

std::optional<JobFailure> RunningJob::on_error(Rank rank, const control::NodeError& m, Post& post) {
  const std::string name = "node " + std::to_string(rank.value);
  if (m.job != id() || !is_on_nodes()) return std::nullopt;
  if (m.is_final) return JobFailure{JobState::kFailed, FailureCode::kFailed, {{name, m.message}}};
  if (m.epoch != render_->epoch()) return std::nullopt;
  return go_on_without({rank.value, m.message, 0, 0}, name, false, post);
}

std::optional<JobFailure> RunningJob::look_for_lost_messages(double now_s, Post& post) {
  // Where boundaries slide, nodes may wait for what is being cut.
  if (!is_rendering() || render_->sliding() != nullptr) return std::nullopt;
  // The deadlocks of blocking flow are found sooner.
  if (!standstill_watch_.all_wait(now_s, 2 * farm_.silence_s)) return std::nullopt;
  return go_on_without({std::nullopt, "all nodes wait for messages that were lost", 0, 0},
                       "the farm", false, post);
}

/// Begins the next epoch. Once all tiles are whole none is needed: the picture is complete.
std::optional<JobFailure> RunningJob::go_on_without(Loss loss, const std::string& name,
                                                    bool is_gone, Post& post) {
  std::optional<Rank> rank;
  if (loss.rank) rank = Rank{*loss.rank};
  RenderJob::Damage damage = render_->note_loss(rank, is_gone);
  loss.tiles = damage.tiles;
  losses_.push_back(loss);
  if (render_->film_is_complete()) {
    farm_log_.job_loses(id(), losses_.back(), name, is_gone, epochs());
    is_cut_short_ = true;
    if (is_gone) render_->reports().will_not_come(*rank);
    return std::nullopt;
  }
  if (!damage.culprit.empty()) {
    farm_log_.job_loses(id(), losses_.back(), name, is_gone, epochs());
    return JobFailure{JobState::kFailed,
                      FailureCode::kFailed,
                      {{name, loss.why + "; that was loss " + std::to_string(losses_.size()) +
                                  " of the job, and each time " + damage.culprit}}};
  }
  render_->begin_next_epoch();
  farm_log_.job_loses(id(), losses_.back(), name, is_gone, epochs());
  stage_ = JobStage::kBuilding;
  late_.clear();
  are_told_dealt_ = false;
  if (deadlock_watch_) deadlock_watch_.emplace(farm_.cube);
  if (!render_->loads_all_again()) post.to_nodes(control::Prepare{id(), render_->epoch()});
  return std::nullopt;
}

}  // namespace graycube
