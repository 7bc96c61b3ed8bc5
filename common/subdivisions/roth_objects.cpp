#include "subdivisions/roth_objects.hpp"

namespace graycube {

SpanList RothObjects::list_of(std::size_t index, const Question& q) const {
  const TreeNode& node = model_->nodes[index];
  const BoundingVolumes& volumes = volumes_[index];
  if (volumes.are_missed(q.ray, q.t0, q.t1, q.counts)) {
    return {volumes.is_inside_beyond, q.stack.size(), q.stack.size()};
  }
  if (node.size == 1) {
    const Primitive& p = model_->primitives[node.primitive];
    q.counts.count_test(p.kind);
    return push_spans(q.stack, spans_along(p, model_->data(), q.ray.ray), node.primitive,
                      node.kind == TreeNode::Kind::kInvertedLeaf, q.t0, q.t1);
  }
  const bool is_and = node.kind == TreeNode::Kind::kAnd;
  std::size_t i = index + 1;
  SpanList list = list_of(i, q);
  for (i += model_->nodes[i].size; i < index + node.size; i += model_->nodes[i].size) {
    if (list.is_always(!is_and)) break;
    list = combine(q.stack, list, list_of(i, q), is_and);
  }
  return list;
}

}  // namespace graycube
