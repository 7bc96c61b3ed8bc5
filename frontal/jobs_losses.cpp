// How the running job takes losses (docs/design/epochs.md).
#include <utility>

#include "frontal/jobs.hpp"

namespace graycube {

void Jobs::node_was_lost(const NodeLoss& node) {
  if (!running_) return log_.node_is_lost(node.rank, node.name, node.how, node.noticed_s);
  if (auto failure = running_->lose(node, post_)) return fail(*std::move(failure));
  if (running_->is_loaded()) finish_when_complete();
}

void Jobs::look_for_lost_messages() {
  if (!running_) return;
  if (auto failure = running_->look_for_lost_messages(now_.now_s, post_))
    return fail(*std::move(failure));
  if (running_->is_loaded()) finish_when_complete();
}

}  // namespace graycube
