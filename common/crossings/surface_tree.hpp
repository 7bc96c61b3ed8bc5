// A bounding volume hierarchy over the surfaces of all objects: eight children a node, boxes in
// floats that only cull; doubles decide. Big objects are cut into cells first, each with its pruned
// program, so that a difference of 2000 spheres costs what its few local ones cost. It finds the
// same crossings, bit for bit, as walking a Bsp: which cells and boxes a ray passes never shows in
// a result.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "crossings/object_crossings.hpp"
#include "crossings/ray_packet.hpp"
#include "crossings/tree_scratch.hpp"
#include "csg/model.hpp"
#include "geometry/wide_node.hpp"

namespace graycube {

struct SurfaceTreeOptions {
  /// Objects with more literals are cut into cells.
  std::uint32_t whole_object_literals = 8;
};

/// Immutable once built; shared by all evaluator threads. The model must outlive it.
class SurfaceTree {
 public:
  static SurfaceTree build(const Model& model, const SurfaceTreeOptions& options = {});

  /// The first crossing of any object with t0 ≤ t < t1; at equal t the first object wins. 0 ≤ t0,
  /// here and below: the slack with which boxes are tested is relative.
  std::optional<Crossing> first_crossing(const Ray& ray, double t0, double t1,
                                         TreeScratch& scratch) const;
  /// Lets a shadow ray's light through the surfaces crossed in [t0, t1): multiplies `light` by each
  /// transparent one's transmit, in order of t, then of the objects. False when an opaque one ends
  /// it.
  bool pass_light(const Ray& ray, double t0, double t1, TreeScratch& scratch, Rgb& light) const;

  /// Like first_crossing(), for each ray of a packet: bit i of the result tells whether found[i]
  /// holds a crossing.
  RayPacket::Mask first_crossings(const RayPacket& packet, TreeScratch& scratch,
                                  std::span<Crossing, RayPacket::kSize> found) const;
  /// Like pass_light(), for each ray of a packet: bit i of the result tells if light[i] arrives.
  RayPacket::Mask pass_lights(const RayPacket& packet, TreeScratch& scratch,
                              std::span<Rgb, RayPacket::kSize> light) const;

  const Model& model() const { return *model_; }
  std::size_t item_count() const { return items_.size(); }
  std::size_t memory_bytes() const;

  /// Calls visit(Crossing) for the crossings of an item with t0 ≤ t < t1, in order, until it
  /// returns false.
  template <typename Visit>
  bool for_each_item_crossing(const SurfaceItem& item, const PreparedRay& ray, double t0, double t1,
                              TreeScratch& scratch, Visit&& visit) const;

  /// Entries of a walk's stack; a node leaves at most seven behind on each level.
  static constexpr std::size_t kMaxStack = 512;
  static constexpr std::size_t kMaxDepth = (kMaxStack - WideNode::kWidth) / (WideNode::kWidth - 1);

  const std::vector<WideNode>& nodes() const { return nodes_; }
  const std::vector<SurfaceItem>& items() const { return items_; }
  const std::vector<std::uint32_t>& unbounded_items() const { return unbounded_; }
  /// The mesh of an item that is one mesh.
  const Mesh& mesh_of(const SurfaceItem& item) const {
    return model_->meshes[model_->primitives[literals_of(item).front().primitive].mesh];
  }
  std::span<const Literal> literals_of(const SurfaceItem& item) const {
    return {literals_.data() + item.first_literal, item.literal_count};
  }
  /// Visits the crossings of a small item whose literals' intervals are given.
  template <typename Visit>
  bool event_crossings(const SurfaceItem& item, const crossings::FewEvents& events,
                       Visit&& visit) const;
  /// Only for items with a cell.
  const Aabb& cell_of(const SurfaceItem& item) const { return cells_[item.cell]; }
  /// Cuts [t0, t1) to the piece of the ray in the item's cell; false when there is none.
  bool clip_to_cell(const SurfaceItem& item, const PreparedRay& ray, double& t0, double& t1) const;
  /// Transmit of each primitive's material.
  double transmit_of(std::uint32_t primitive) const {
    return model_->materials[model_->primitives[primitive].material].transmit;
  }

 private:
  friend class SurfaceTreeBuilder;
  /// The crossings of an item that is one mesh.
  template <typename Visit>
  bool mesh_crossings(const SurfaceItem& item, const PreparedRay& ray, double t0, double t1,
                      TreeScratch& scratch, Visit&& visit) const;
  /// The crossings of an item that is small but not a simple conjunction.
  template <typename Visit>
  bool small_crossings(const SurfaceItem& item, const PreparedRay& ray, double t0, double t1,
                       TreeScratch& scratch, Visit&& visit) const;
  template <typename Visit>
  bool general_crossings(const SurfaceItem& item, const PreparedRay& ray, double t0, double t1,
                         TreeScratch& scratch, Visit&& visit) const;

  const Model* model_ = nullptr;
  std::vector<WideNode> nodes_;
  std::vector<SurfaceItem> items_;
  std::vector<Literal> literals_;
  std::vector<TreeNode> program_nodes_;
  std::vector<crossings::MaskOperation> operations_;
  std::vector<Aabb> cells_;
  std::vector<std::uint32_t> unbounded_;
};

/// Clips to the half-open piece of a ray in a cell by the same expressions as the walk's, so that
/// each t of a line lies in exactly one cell of a subdivision. False when no piece is in [t0, t1).
inline bool SurfaceTree::clip_to_cell(const SurfaceItem& item, const PreparedRay& ray, double& t0,
                                      double& t1) const {
  if (item.cell == SurfaceItem::kAllSpace) return true;
  const Aabb& cell = cells_[item.cell];
  for (int a = 0; a < 3; ++a) {
    const double inverse = ray.inverse[a];
    const double o = ray.ray.origin[a];
    if (!std::isfinite(inverse)) {
      if (o < cell.lo[a] || o >= cell.hi[a]) return false;
      continue;
    }
    const double lo = (cell.lo[a] - o) * inverse;
    const double hi = (cell.hi[a] - o) * inverse;
    const double from = inverse > 0 ? lo : hi;
    const double to = inverse > 0 ? hi : lo;
    if (from > t0) t0 = from;
    if (to < t1) t1 = to;
  }
  return t0 < t1;
}

template <typename Visit>
bool SurfaceTree::for_each_item_crossing(const SurfaceItem& item, const PreparedRay& ray, double t0,
                                         double t1, TreeScratch& scratch, Visit&& visit) const {
  if (!clip_to_cell(item, ray, t0, t1)) return true;
  const auto literals = literals_of(item);
  if (!item.is_small) {
    if (item.is_mesh) return mesh_crossings(item, ray, t0, t1, scratch, visit);
    return general_crossings(item, ray, t0, t1, scratch, visit);
  }
  if (!item.is_flat() || !item.is_simple) return small_crossings(item, ray, t0, t1, scratch, visit);
  std::array<crossings::Ends, crossings::kMaxFlatLiterals> intervals;
  std::array<crossings::Ends, crossings::kMaxFlatLiterals> removed;
  std::size_t removed_count = 0;
  double from = -kInf;
  double to = kInf;
  for (std::size_t i = 0; i < literals.size(); ++i) {
    if (literals.size() > 1 && crossings::has_bounds(literals[i].kind) &&
        !crossings::may_meet(literals[i], ray, std::fmax(from, t0), std::fmin(to, t1))) {
      if (!literals[i].is_inverted) return true;
      intervals[i] = {kInf, -kInf};
      continue;
    }
    scratch.counts.count_test(literals[i].kind);
    crossings::interval_of(literals[i], *model_, ray, intervals[i]);
    const crossings::Ends& at = intervals[i];
    if (literals[i].is_inverted) {
      if (at.enter < at.leave) removed[removed_count++] = at;
      continue;
    }
    if (at.enter > from) from = at.enter;
    if (at.leave < to) to = at.leave;
    // All crossings lie in [from, to].
    if (!(from < to) || to < t0 || from >= t1) return true;
  }
  const auto at_end = [&](double t, bool entering) {
    const auto interval = [&](std::size_t i) { return intervals[i]; };
    return visit(Crossing{t, crossings::changed_literal(literals, interval, t), item.object,
                          entering != item.is_complement});
  };
  return crossings::conjunction_ends({removed.data(), removed_count}, from, to, t0, t1, at_end);
}

template <typename Visit>
bool SurfaceTree::mesh_crossings(const SurfaceItem& item, const PreparedRay& ray, double t0,
                                 double t1, TreeScratch& scratch, Visit&& visit) const {
  ++scratch.counts.primitives_tested;
  const Literal& literal = literals_of(item).front();
  const bool swaps = literal.is_inverted != item.is_complement;
  return mesh_of(item).crossings(ray.ray, t0, t1, scratch.cuts, [&](double t, bool entering) {
    return visit(Crossing{t, literal.primitive, item.object, entering != swaps});
  });
}

template <typename Visit>
bool SurfaceTree::small_crossings(const SurfaceItem& item, const PreparedRay& ray, double t0,
                                  double t1, TreeScratch& scratch, Visit&& visit) const {
  const auto literals = literals_of(item);
  crossings::FewEvents events(t0, t1);
  // All crossings of a conjunction lie in the common extent of its upright literals (as in
  // for_each_item_crossing).
  double from = t0;
  double to = t1;
  for (std::uint32_t i = 0; i < literals.size(); ++i) {
    const Literal& literal = literals[i];
    const bool confines = item.is_flat() && !literal.is_inverted;
    if (literals.size() > 1 && crossings::has_bounds(literal.kind) &&
        !crossings::may_meet(literal, ray, from, to)) {
      if (confines) return true;
      continue;
    }
    scratch.counts.count_test(literal.kind);
    double first = kInf;
    double last = -kInf;
    crossings::each_interval(literal, *model_, ray, [&](double enter, double leave) {
      events.add(i, enter, leave);
      if (enter < first) first = enter;
      if (leave > last) last = leave;
    });
    if (!confines) continue;
    if (first > from) from = first;
    if (last < to) to = last;
    if (from > to) return true;
  }
  return event_crossings(item, events, visit);
}

template <typename Visit>
bool SurfaceTree::event_crossings(const SurfaceItem& item, const crossings::FewEvents& events,
                                  Visit&& visit) const {
  if (events.is_empty()) return true;
  const auto literals = literals_of(item);
  std::uint64_t inverted = 0;
  for (std::size_t i = 0; i < literals.size(); ++i)
    inverted |= std::uint64_t{literals[i].is_inverted} << i;
  const crossings::MaskOperation all{(std::uint64_t{1} << literals.size()) - 1, true, 0};
  const std::span<const crossings::MaskOperation> operations =
      item.is_flat() ? std::span(&all, 1)
                     : std::span(operations_.data() + item.first_operation,
                                 item.node_count - item.literal_count);
  const crossings::MaskedProgram program(operations, inverted, literals.size());
  return events.visit_changes(
      [&](std::uint64_t flags) { return program.is_member(flags) != item.is_complement; },
      [&](double t, bool entering, std::uint64_t before, std::uint64_t after) {
        return visit(Crossing{t, literals[program.changed_literal(before, after)].primitive,
                              item.object, entering});
      });
}

template <typename Visit>
bool SurfaceTree::general_crossings(const SurfaceItem& item, const PreparedRay& ray, double t0,
                                    double t1, TreeScratch& scratch, Visit&& visit) const {
  const auto literals = literals_of(item);
  auto& events = scratch.events;
  auto& before = scratch.flags_before;
  auto& after = scratch.flags_after;
  events.clear();
  before.assign(literals.size() / 64 + 1, 0);
  const bool is_flat = item.first_node == SurfaceItem::kFlat;
  double from = -kInf;
  double to = kInf;
  for (std::uint32_t i = 0; i < literals.size(); ++i) {
    scratch.counts.count_test(literals[i].kind);
    const std::uint32_t primitive = literals[i].primitive;
    if (literals[i].kind == PrimitiveKind::kMesh) {
      crossings::gather(scratch.meshes.spans(*model_, primitive, ray.ray), i, t0, t1, events,
                        before);
      continue;
    }
    const Spans spans = spans_along(model_->primitives[primitive], model_->data(), ray.ray);
    crossings::gather(spans, i, t0, t1, events, before);
    if (!is_flat || literals[i].is_inverted) continue;
    // All crossings of a conjunction lie in the common extent of its upright literals (as in
    // for_each_item_crossing).
    if (spans.count == 0) return true;
    from = std::fmax(from, spans.interval[0].enter);
    to = std::fmin(to, spans.interval[static_cast<std::size_t>(spans.count - 1)].leave);
    if (!(from < to) || to < t0 || from >= t1) return true;
  }
  if (events.empty()) return true;
  const std::span<const TreeNode> tree{is_flat ? nullptr : program_nodes_.data() + item.first_node,
                                       item.node_count};
  const auto is_member = [&](std::span<const std::uint64_t> flags) {
    if (!is_flat) {
      std::uint32_t literal = 0;
      return crossings::member(tree, flags, literal);
    }
    for (std::uint32_t i = 0; i < literals.size(); ++i) {
      if (crossings::flag(flags, i) == literals[i].is_inverted) return item.is_complement;
    }
    return !item.is_complement;
  };
  const auto changed = [&] {
    if (!is_flat) return crossings::changed_primitive(tree, before, after, 0);
    std::uint32_t i = 0;
    while (i + 1 < literals.size() && crossings::flag(before, i) == crossings::flag(after, i)) ++i;
    return literals[i].primitive;
  };
  return crossings::grouped(events, before, after, is_member, [&](double t, bool entering) {
    return visit(Crossing{t, changed(), item.object, entering});
  });
}

}  // namespace graycube
