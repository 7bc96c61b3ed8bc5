// How the running job takes losses (docs/design/epochs.md).
#include <utility>

#include "frontal/jobs.hpp"

namespace graycube {

void Jobs::nodes_were_lost(const std::vector<NodeLoss>& nodes) {
  if (!running_) {
    for (const NodeLoss& node : nodes)
      log_.node_is_lost(node.rank, node.name, node.how, node.noticed_s);
    return;
  }
  if (auto failure = running_->lose(nodes, post_)) return fail(*std::move(failure));
  if (running_->is_loaded()) finish_when_complete();
}

void Jobs::node_has_host(const NodeLoss& node) {
  if (running_) running_->note_guest(node);
}

void Jobs::look_for_lost_messages() {
  if (!running_) return;
  if (auto failure = running_->look_for_lost_messages(now_.now_s, post_))
    return fail(*std::move(failure));
  if (running_->is_loaded()) finish_when_complete();
}

}  // namespace graycube
