// Finds where a ray crosses the surface of an object, from the object's program in one leaf region.
// Crossings of the object's primitives at equal t are taken together: the object's surface is
// crossed where its membership before and after the group differs.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>

#include "crossings/cell_programs.hpp"
#include "crossings/mailbox.hpp"

namespace graycube {

struct Crossing {
  double t = 0;
  /// Indices into the model's primitives and objects.
  std::uint32_t primitive = 0;
  std::uint32_t object = 0;
  bool entering = false;
};

namespace crossings {

inline bool flag(std::span<const std::uint64_t> flags, std::uint32_t literal) {
  return ((flags[literal / 64] >> (literal % 64)) & 1) != 0;
}

/// Membership of the subtree whose first literal is number `literal`; moves `literal` past the
/// subtree.
inline bool member(std::span<const TreeNode> tree, std::span<const std::uint64_t> flags,
                   std::uint32_t& literal) {
  const TreeNode& root = tree.front();
  if (root.kind == TreeNode::Kind::kLeaf) return flag(flags, literal++);
  if (root.kind == TreeNode::Kind::kInvertedLeaf) return !flag(flags, literal++);
  const bool is_and = root.kind == TreeNode::Kind::kAnd;
  bool result = is_and;
  for (std::size_t i = 1; i < root.size; i += tree[i].size) {
    const bool child = member(tree.subspan(i, tree[i].size), flags, literal);
    result = is_and ? result && child : result || child;
  }
  return result;
}

/// For a subtree whose membership changed, the primitive reached by descending, at each node, into
/// the first child whose own membership changed.
inline std::uint32_t changed_primitive(std::span<const TreeNode> tree,
                                       std::span<const std::uint64_t> before,
                                       std::span<const std::uint64_t> after,
                                       std::uint32_t literal) {
  const TreeNode& root = tree.front();
  if (root.size == 1) return root.primitive;
  for (std::size_t i = 1; i < root.size; i += tree[i].size) {
    const auto child = tree.subspan(i, tree[i].size);
    std::uint32_t a = literal;
    std::uint32_t b = literal;
    if (member(child, before, a) != member(child, after, b)) {
      return changed_primitive(child, before, after, literal);
    }
    literal = a;
  }
  return root.primitive;
}

/// The program seen as a tree of one kind.
class ProgramView {
 public:
  ProgramView(const CellPrograms& store, const CellProgram& program)
      : nodes_(store.nodes().data() + program.first_node, program.node_count),
        shape_(program.shape) {}

  std::span<const TreeNode> nodes() const { return nodes_; }

  bool is_member(std::span<const std::uint64_t> flags) const {
    if (shape_ == CellProgram::Shape::kGeneral) {
      std::uint32_t literal = 0;
      return member(nodes_, flags, literal);
    }
    const bool all = shape_ == CellProgram::Shape::kAllOf;
    for (std::uint32_t i = 0; i < nodes_.size(); ++i) {
      const bool inside = flag(flags, i) == (nodes_[i].kind == TreeNode::Kind::kLeaf);
      if (inside != all) return !all;
    }
    return all;
  }

  std::uint32_t changed(std::span<const std::uint64_t> before,
                        std::span<const std::uint64_t> after) const {
    if (shape_ == CellProgram::Shape::kGeneral) {
      return changed_primitive(nodes_, before, after, 0);
    }
    for (std::uint32_t i = 0; i < nodes_.size(); ++i) {
      if (flag(before, i) != flag(after, i)) return nodes_[i].primitive;
    }
    return nodes_.front().primitive;
  }

 private:
  std::span<const TreeNode> nodes_;
  CellProgram::Shape shape_;
};

/// Takes the events of a program in groups of equal t, and calls visit(t, entering) where the
/// membership before and after a group differs, until visit returns false; then returns false.
/// `before` holds the flags before the first event; during a visit `before` and `after` are the
/// flags around its group.
template <typename IsMember, typename Visit>
bool grouped(std::vector<Mailbox::Event>& events, std::vector<std::uint64_t>& before,
             std::vector<std::uint64_t>& after, IsMember&& is_member, Visit&& visit) {
  std::sort(events.begin(), events.end(), [](const auto& a, const auto& b) { return a.t < b.t; });
  after = before;
  bool inside = is_member(before);
  for (std::size_t i = 0; i < events.size();) {
    const double t = events[i].t;
    for (; i < events.size() && events[i].t == t; ++i) {
      after[events[i].literal / 64] ^= std::uint64_t{1} << (events[i].literal % 64);
    }
    const bool now = is_member(after);
    if (now != inside) {
      inside = now;
      if (!visit(t, now)) return false;
    }
    before = after;
  }
  return true;
}

/// Appends the ends of one literal's spans that lie in [t0, t1) to `events`, and sets its bit of
/// `flags` if the line is inside its primitive just before t0.
inline void gather(const Spans& spans, std::uint32_t literal, double t0, double t1,
                   std::vector<Mailbox::Event>& events, std::vector<std::uint64_t>& flags) {
  for (int i = 0; i < spans.count; ++i) {
    const auto [enter, leave] = spans.interval[static_cast<std::size_t>(i)];
    if (enter < t0 && !(leave < t0)) flags[literal / 64] |= std::uint64_t{1} << (literal % 64);
    if (enter >= t0 && enter < t1) events.push_back({enter, literal});
    if (leave >= t0 && leave < t1) events.push_back({leave, literal});
  }
}

/// Visits the crossings of an object that is one primitive here: the ends of its intervals.
template <typename Visit>
bool single(const TreeNode& node, std::uint32_t object, const Spans& spans, double t0, double t1,
            Visit&& visit) {
  const auto end = [&](int i) {
    const auto& interval = spans.interval[static_cast<std::size_t>(i / 2)];
    return i % 2 == 0 ? interval.enter : interval.leave;
  };
  const int n = 2 * spans.count;
  const bool upright = node.kind == TreeNode::Kind::kLeaf;
  for (int i = 0; i < n;) {
    const double t = end(i);
    int group = i;
    while (group < n && end(group) == t) ++group;
    const bool changes = (group - i) % 2 == 1;
    const bool enters = i % 2 == 0;
    i = group;
    if (t >= t1) break;
    if (t < t0 || !changes) continue;
    if (!visit(Crossing{t, node.primitive, object, enters == upright})) return false;
  }
  return true;
}

}  // namespace crossings

/// Calls `visit(Crossing)` for every crossing of the program's object with t0 ≤ t < t1, in order of
/// t, until it returns false; returns false then. Intersections come from the mailbox.
template <typename Visit>
bool for_each_crossing(const CellPrograms& store, const CellProgram& program, const Ray& ray,
                       double t0, double t1, Mailbox& mailbox, Visit&& visit) {
  const Model& model = store.model();
  if (program.shape == CellProgram::Shape::kSingle) {
    const TreeNode& node = store.nodes()[program.first_node];
    return crossings::single(node, program.object, mailbox.spans(model, node.primitive, ray), t0,
                             t1, visit);
  }
  const crossings::ProgramView view(store, program);
  auto& events = mailbox.events;
  auto& before = mailbox.flags_before;
  events.clear();
  before.assign(program.literals / 64 + 1, 0);
  std::uint32_t literal = 0;
  for (const TreeNode& node : view.nodes()) {
    if (node.size != 1) continue;
    crossings::gather(mailbox.spans(model, node.primitive, ray), literal++, t0, t1, events, before);
  }
  if (events.empty()) return true;
  return crossings::grouped(
      events, before, mailbox.flags_after, [&](const auto& flags) { return view.is_member(flags); },
      [&](double t, bool entering) {
        return visit(
            Crossing{t, view.changed(before, mailbox.flags_after), program.object, entering});
      });
}

}  // namespace graycube
