// A bounding volume hierarchy over the surfaces of all objects: eight children a node, boxes in floats that
// only cull; doubles decide. Big objects are cut into cells first, each with its pruned program, so that a
// difference of 2000 spheres costs what its few local ones cost. It finds the same crossings, bit for bit,
// as walking a Bsp: which cells and boxes a ray passes never shows in a result.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "csg/model.hpp"
#include "geometry/wide_node.hpp"
#include "space/object_crossings.hpp"
#include "space/ray_packet.hpp"

namespace graycube {

struct SurfaceTreeOptions {
  /// Objects with more literals are cut into cells.
  std::uint32_t whole_object_literals = 8;
};

/// Where the last rays are inside of meshes that are parts of objects cut into cells: a ray asks for them in each cell, and
/// a packet's rays ask in turn.
class MeshMemo {
 public:
  /// From t = 0 on, which is all that walks look at.
  const Spans& spans(const Model& model, std::uint32_t primitive, const Ray& ray) {
    const Mesh& mesh = model.meshes[model.primitives[primitive].mesh];
    Entry& e = entries_[slot_of(primitive, ray)];
    if (!e.mesh.is_same_as(mesh) || !(e.ray == ray)) {
      e.spans = mesh.spans_ahead(ray, cuts_);
      e.mesh = mesh;
      e.ray = ray;
    }
    return e.spans;
  }

 private:
  static constexpr std::size_t kEntries = 64;
  struct Entry {
    /// Held, so that no other takes its place in memory.
    Mesh mesh;
    Ray ray;
    Spans spans;
  };

  static std::size_t slot_of(std::uint32_t primitive, const Ray& ray) {
    std::uint64_t h = primitive;
    for (const double v : {ray.direction.x, ray.direction.y, ray.origin.x}) {
      h = (h ^ std::bit_cast<std::uint64_t>(v)) * 0x9E3779B97F4A7C15u;
      h ^= h >> 32;
    }
    return static_cast<std::size_t>(h % kEntries);
  }

  std::vector<MeshCut> cuts_;
  std::array<Entry, kEntries> entries_;
};

/// Scratch and counts of one evaluator.
struct TreeScratch {
  /// A transparent surface that a shadow ray crosses, and which ray of a packet it is.
  struct Pane {
    std::size_t ray;
    double t;
    std::uint32_t object;
    double transmit;
  };
  std::vector<Pane> panes;

  std::vector<Mailbox::Event> events;
  std::vector<std::uint64_t> flags_before, flags_after;
  std::vector<MeshCut> cuts;
  MeshMemo meshes;
  WalkCounts counts;
  /// The item that ended the last shadow ray in each octant of directions; tried first.
  std::array<std::uint32_t, 8> last_occluder{};
};

/// Immutable once built; shared by all evaluator threads. The model must outlive it.
class SurfaceTree {
 public:
  static SurfaceTree build(const Model& model, const SurfaceTreeOptions& options = {});

  /// The first crossing of any object with t0 ≤ t < t1; at equal t the first object wins. 0 ≤ t0, here and
  /// below: the slack with which boxes are tested is relative.
  std::optional<Crossing> first_crossing(const Ray& ray, double t0, double t1,
                                         TreeScratch& scratch) const;
  /// Lets a shadow ray's light through the surfaces crossed in [t0, t1): multiplies `light` by each
  /// transparent one's transmit, in order of t, then of the objects. False when an opaque one ends it.
  bool pass_light(const Ray& ray, double t0, double t1, TreeScratch& scratch, Rgb& light) const;

  /// As first_crossing for each ray of a packet: bit i of the result tells whether found[i] holds a crossing.
  RayPacket::Mask first_crossings(const RayPacket& packet, TreeScratch& scratch,
                                  std::span<Crossing, RayPacket::kSize> found) const;
  /// As pass_light for each ray of a packet: bit i of the result tells whether light[i] arrives.
  RayPacket::Mask pass_lights(const RayPacket& packet, TreeScratch& scratch,
                              std::span<Rgb, RayPacket::kSize> light) const;

  const Model& model() const { return *model_; }
  std::size_t item_count() const { return items_.size(); }
  std::size_t memory_bytes() const;

  /// Calls visit(Crossing) for the crossings of an item with t0 ≤ t < t1, in order, until it returns false.
  template <typename Visit>
  bool for_each_item_crossing(const SurfaceItem& item, const PreparedRay& ray, double t0, double t1,
                              TreeScratch& scratch, Visit&& visit) const;

  /// Entries of a walk's stack; a node leaves at most seven behind on each level.
  static constexpr std::size_t kMaxStack = 512;
  static constexpr std::size_t kMaxDepth = (kMaxStack - WideNode::kWidth) / (WideNode::kWidth - 1);

  const std::vector<WideNode>& nodes() const { return nodes_; }
  const std::vector<SurfaceItem>& items() const { return items_; }
  const std::vector<std::uint32_t>& unbounded_items() const { return unbounded_; }
  std::span<const Literal> literals_of(const SurfaceItem& item) const {
    return {literals_.data() + item.first_literal, item.literal_count};
  }
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
  /// Of an item that is one mesh.
  template <typename Visit>
  bool mesh_crossings(const SurfaceItem& item, const PreparedRay& ray, double t0, double t1,
                      TreeScratch& scratch, Visit&& visit) const;
  template <typename Visit>
  bool general_crossings(const SurfaceItem& item, const PreparedRay& ray, double t0, double t1,
                         TreeScratch& scratch, Visit&& visit) const;

  const Model* model_ = nullptr;
  std::vector<WideNode> nodes_;
  std::vector<SurfaceItem> items_;
  std::vector<Literal> literals_;
  std::vector<TreeNode> program_nodes_;
  std::vector<Aabb> cells_;
  std::vector<std::uint32_t> unbounded_;
};

/// The half-open piece of a ray in a cell, by the same expressions as the walk's: each t of a line lies in
/// exactly one cell of a subdivision. False when there is none in [t0, t1).
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
  if (item.first_node != SurfaceItem::kFlat || item.literal_count > crossings::kMaxFlatLiterals) {
    return general_crossings(item, ray, t0, t1, scratch, visit);
  }
  if (literals.front().kind == PrimitiveKind::kMesh && literals.size() == 1 && item.cell == SurfaceItem::kAllSpace) {
    return mesh_crossings(item, ray, t0, t1, scratch, visit);
  }
  std::array<crossings::Ends, crossings::kMaxFlatLiterals> intervals;
  std::array<crossings::Ends, crossings::kMaxFlatLiterals> removed;
  std::size_t removed_count = 0;
  double from = -csg::kInf;
  double to = csg::kInf;
  for (std::size_t i = 0; i < literals.size(); ++i) {
    ++scratch.counts.primitives_tested;
    if (!crossings::interval_of(literals[i], *model_, ray, intervals[i])) {
      return general_crossings(item, ray, t0, t1, scratch, visit);
    }
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
bool SurfaceTree::mesh_crossings(const SurfaceItem& item, const PreparedRay& ray, double t0, double t1,
                                 TreeScratch& scratch, Visit&& visit) const {
  ++scratch.counts.primitives_tested;
  const Literal& literal = literals_of(item).front();
  const bool swaps = literal.is_inverted != item.is_complement;
  const Mesh& mesh = model_->meshes[model_->primitives[literal.primitive].mesh];
  return mesh.crossings(ray.ray, t0, t1, scratch.cuts, [&](double t, bool entering) {
    return visit(Crossing{t, literal.primitive, item.object, entering != swaps});
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
  double from = -csg::kInf;
  double to = csg::kInf;
  for (std::uint32_t i = 0; i < literals.size(); ++i) {
    ++scratch.counts.primitives_tested;
    const std::uint32_t primitive = literals[i].primitive;
    if (literals[i].kind == PrimitiveKind::kMesh) {
      crossings::gather(scratch.meshes.spans(*model_, primitive, ray.ray), i, t0, t1, events, before);
      continue;
    }
    const Spans spans = spans_along(model_->primitives[primitive], model_->data(), ray.ray);
    crossings::gather(spans, i, t0, t1, events, before);
    if (!is_flat || literals[i].is_inverted) continue;
    // As in for_each_item_crossing: all crossings of a conjunction lie where all that is not taken away reaches.
    if (spans.count == 0) return true;
    from = std::fmax(from, spans.interval[0].enter);
    to = std::fmin(to, spans.interval[static_cast<std::size_t>(spans.count - 1)].leave);
    if (!(from < to) || to < t0 || from >= t1) return true;
  }
  if (events.empty()) return true;
  const std::span<const TreeNode> tree{
      is_flat ? nullptr : program_nodes_.data() + item.first_node, item.node_count};
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
