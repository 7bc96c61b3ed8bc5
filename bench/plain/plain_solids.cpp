#include "bench/plain/plain_solids.hpp"

#include <algorithm>
#include <utility>

#include "bench/plain/plain_shapes.hpp"
#include "check.hpp"

namespace graycube::plain {
namespace {

/// Operations with more children than this get a hierarchy.
constexpr std::uint32_t kFewChildren = 4;
/// Bounds grow by this part of their size and distance, against rounding in the slab test.
constexpr double kMargin = 1e-9;

/// The bounds of a node in the space that `outer` leads to.
Aabb node_bounds(const Scene& scene, const CsgNode& node, const Affine& outer) {
  const Affine map = node.transform ? compose(outer, *node.transform) : outer;
  if (const auto* ref = std::get_if<ReferenceNode>(&node.value)) {
    return node_bounds(scene, scene.shapes[ref->shape].node, map);
  }
  if (const auto* o = std::get_if<OperationNode>(&node.value)) {
    if (o->operation == Operation::kComplement) return Aabb::everything();
    Aabb box = node_bounds(scene, o->children.front(), map);
    if (o->operation == Operation::kDifference) return box;
    for (std::size_t i = 1; i < o->children.size(); ++i) {
      const Aabb child = node_bounds(scene, o->children[i], map);
      const bool both = o->operation == Operation::kIntersection;
      box = both ? intersection_of(box, child) : union_of(box, child);
    }
    return box;
  }
  return std::visit(
      [&](const auto& value) {
        if constexpr (requires { plain_leaf(value); }) {
          const PlainLeaf l = plain_leaf(value);
          return bounds_of(l.shape, l.map ? compose(map, *l.map) : map);
        } else {
          return Aabb{};
        }
      },
      node.value);
}

bool touches(const Aabb& box, const Line& line, Window w) {
  for (int a = 0; a < 3; ++a) {
    if (line.direction[a] == 0) {
      if (line.origin[a] < box.lo[a] || line.origin[a] > box.hi[a]) return false;
      continue;
    }
    const double lo = (box.lo[a] - line.origin[a]) * line.inverse[a];
    const double hi = (box.hi[a] - line.origin[a]) * line.inverse[a];
    w.from = std::max(w.from, std::min(lo, hi));
    w.to = std::min(w.to, std::max(lo, hi));
  }
  return w.from <= w.to;
}

/// Removes the intervals from `start` up to `result`; those appended behind move there.
void keep_from(Spans& s, std::size_t start, std::size_t result) {
  s.erase(s.begin() + static_cast<std::ptrdiff_t>(start),
          s.begin() + static_cast<std::ptrdiff_t>(result));
}

/// Replaces the intervals s[start, …), which may be in any order, by their union.
void merge(Spans& s, std::size_t start) {
  if (s.size() - start < 2) return;
  std::sort(s.begin() + static_cast<std::ptrdiff_t>(start), s.end(),
            [](const Span& a, const Span& b) { return a.enter < b.enter; });
  std::size_t last = start;
  for (std::size_t i = start + 1; i < s.size(); ++i) {
    if (s[i].enter > s[last].leave) {
      s[++last] = s[i];
    } else if (s[i].leave > s[last].leave) {
      s[last].leave = s[i].leave;
      s[last].leave_leaf = s[i].leave_leaf;
    }
  }
  s.resize(last + 1);
}

/// Replaces s[start, …) by s[start, second) minus s[second, …).
void subtract(Spans& s, std::size_t start, std::size_t second) {
  const std::size_t end = s.size();
  if (second == end) return;
  std::size_t j = second;
  for (std::size_t i = start; i < second; ++i) {
    Span rest = s[i];
    while (j < end && s[j].leave <= rest.enter) ++j;
    for (std::size_t k = j; k < end && s[k].enter < rest.leave; ++k) {
      const Span hole = s[k];
      if (hole.enter > rest.enter)
        s.push_back({rest.enter, hole.enter, rest.enter_leaf, hole.enter_leaf});
      rest.enter = hole.leave;
      rest.enter_leaf = hole.leave_leaf;
    }
    if (rest.enter < rest.leave) s.push_back(rest);
  }
  keep_from(s, start, end);
}

/// Replaces s[start, …) by the points that are in both s[start, second) and s[second, …).
void intersect(Spans& s, std::size_t start, std::size_t second) {
  const std::size_t end = s.size();
  for (std::size_t i = start, j = second; i < second && j < end;) {
    const Span a = s[i];
    const Span b = s[j];
    Span both = a;
    if (b.enter > a.enter) {
      both.enter = b.enter;
      both.enter_leaf = b.enter_leaf;
    }
    if (b.leave < a.leave) {
      both.leave = b.leave;
      both.leave_leaf = b.leave_leaf;
    }
    if (both.enter < both.leave) s.push_back(both);
    a.leave < b.leave ? ++i : ++j;
  }
  keep_from(s, start, end);
}

/// Replaces s[start, …) by all points that are not in it.
void invert(Spans& s, std::size_t start) {
  const std::size_t end = s.size();
  Span gap{-kInf, kInf, 0, 0};
  for (std::size_t i = start; i < end; ++i) {
    const Span solid = s[i];
    if (solid.enter > gap.enter)
      s.push_back({gap.enter, solid.enter, gap.enter_leaf, solid.enter_leaf});
    gap.enter = solid.leave;
    gap.enter_leaf = solid.leave_leaf;
  }
  if (gap.enter < gap.leave) s.push_back(gap);
  keep_from(s, start, end);
}

}  // namespace

Solids::Solids(const Scene& scene) : scene_(&scene) {
  for (const NamedMaterial& m : scene.materials) materials_.push_back(m.material);
  for (const SceneObject& o : scene.objects) roots_.push_back(add_node(o.csg, o.material, {}));
  scene_ = nullptr;
}

std::uint32_t Solids::add_node(const CsgNode& node, MaterialIndex material,
                               const Affine& to_world) {
  const auto index = static_cast<std::uint32_t>(nodes_.size());
  nodes_.emplace_back();
  bounds_.push_back(node_bounds(*scene_, node, {}));
  if (node.material != kInheritMaterial) material = node.material;
  Affine inner = to_world;
  Node made;
  const auto enter = [&](const Affine& map) {
    inner = compose(inner, map);
    const auto inverse = map.inverse();
    GRAYCUBE_CHECK(inverse.has_value(), "a map of the scene has no inverse");
    made.map = static_cast<std::int32_t>(inverse_maps_.size());
    inverse_maps_.push_back(*inverse);
  };
  if (const auto* o = std::get_if<OperationNode>(&node.value)) {
    if (node.transform) enter(*node.transform);
    add_operation(*o, material, inner, made);
  } else if (const auto* ref = std::get_if<ReferenceNode>(&node.value)) {
    if (node.transform) enter(*node.transform);
    made.operation = Operation::kUnion;
    const std::uint32_t child = add_node(scene_->shapes[ref->shape].node, material, inner);
    made.first = static_cast<std::uint32_t>(children_.size());
    made.count = 1;
    children_.push_back(child);
  } else {
    std::visit(
        [&](const auto& value) {
          if constexpr (requires { plain_leaf(value); }) {
            PlainLeaf l = plain_leaf(value);
            if (l.map && node.transform) l.map = compose(*node.transform, *l.map);
            if (const auto& map = l.map ? l.map : node.transform) enter(*map);
            add_leaf(std::move(l.shape), material, inner, made);
          }
        },
        node.value);
  }
  nodes_[index] = made;
  return index;
}

void Solids::add_leaf(Shape shape, MaterialIndex material, const Affine& to_world, Node& node) {
  node.first = static_cast<std::uint32_t>(leaves_.size());
  leaves_.push_back(std::move(shape));
  leaf_material_.push_back(material);
  const auto inverse = to_world.inverse();
  GRAYCUBE_CHECK(inverse.has_value(), "a map of the scene has no inverse");
  leaf_to_local_.push_back(*inverse);
}

void Solids::add_operation(const OperationNode& o, MaterialIndex material, const Affine& to_world,
                           Node& node) {
  node.operation = o.operation;
  std::vector<std::uint32_t> children;
  for (const CsgNode& child : o.children) children.push_back(add_node(child, material, to_world));
  node.first = static_cast<std::uint32_t>(children_.size());
  node.count = static_cast<std::uint32_t>(children.size());
  children_.insert(children_.end(), children.begin(), children.end());
  const std::uint32_t skip = o.operation == Operation::kDifference ? 1 : 0;
  const bool adds = skip == 1 || o.operation == Operation::kUnion;
  if (!adds || node.count <= kFewChildren) return;
  node.bundle = static_cast<std::int32_t>(bundles_.size());
  bundles_.push_back({{}, static_cast<std::uint32_t>(sorted_.size()), node.count - skip});
  sorted_.insert(sorted_.end(), children.begin() + skip, children.end());
  split(static_cast<std::uint32_t>(node.bundle));
}

/// Splits a bundle at the median of the centres, along the longest side.
void Solids::split(std::uint32_t bundle) {
  const std::uint32_t first = bundles_[bundle].first;
  const std::uint32_t count = bundles_[bundle].count;
  Aabb box = Aabb::nothing();
  Aabb centers = Aabb::nothing();
  const auto center = [&](std::uint32_t node, int axis) {
    const Aabb& b = bounds_[node];
    return b.is_finite() ? b.center()[axis] : 0.0;
  };
  for (std::uint32_t i = first; i < first + count; ++i) {
    box = union_of(box, bounds_[sorted_[i]]);
    centers.include({center(sorted_[i], 0), center(sorted_[i], 1), center(sorted_[i], 2)});
  }
  bundles_[bundle].bounds = box.grown(kMargin * (max_abs(box.lo) + max_abs(box.hi)));
  if (count <= 2) return;
  const Vec3 e = centers.hi - centers.lo;
  const int axis = e.x >= e.y && e.x >= e.z ? 0 : e.y >= e.z ? 1 : 2;
  const auto begin = sorted_.begin() + first;
  std::nth_element(begin, begin + count / 2, begin + count, [&](std::uint32_t a, std::uint32_t b) {
    return center(a, axis) < center(b, axis);
  });
  const auto pair = static_cast<std::uint32_t>(bundles_.size());
  bundles_.push_back({{}, first, count / 2});
  bundles_.push_back({{}, first + count / 2, count - count / 2});
  bundles_[bundle].first = pair;
  bundles_[bundle].count = 0;
  split(pair);
  split(pair + 1);
}

void Solids::add_spans(std::uint32_t index, const Line& line, Window w, Spans& out) const {
  const Node& node = nodes_[index];
  if (node.map >= 0) {
    const Affine& map = inverse_maps_[static_cast<std::size_t>(node.map)];
    add_inside(node, Line(map.point(line.origin), map.vector(line.direction)), w, out);
  } else {
    add_inside(node, line, w, out);
  }
}

void Solids::add_inside(const Node& node, const Line& line, Window w, Spans& out) const {
  if (!node.operation) {
    const Intervals found =
        std::visit([&](const auto& s) { return intervals(s, line); }, leaves_[node.first]);
    for (int i = 0; i < found.count; ++i) {
      const Interval& x = found.list[static_cast<std::size_t>(i)];
      out.push_back({x.enter, x.leave, node.first, node.first});
    }
    return;
  }
  if (*node.operation == Operation::kUnion) return add_sum(node, 0, line, w, out);
  const std::size_t start = out.size();
  add_spans(children_[node.first], line, w, out);
  if (*node.operation == Operation::kComplement) return invert(out, start);
  for (std::uint32_t i = 1; i < node.count && out.size() > start; ++i) {
    const Window narrow{std::max(w.from, out[start].enter), std::min(w.to, out.back().leave)};
    if (!(narrow.from <= narrow.to)) return;
    const std::size_t second = out.size();
    if (*node.operation == Operation::kDifference) {
      add_sum(node, 1, line, narrow, out);
      return subtract(out, start, second);
    }
    add_spans(children_[node.first + i], line, narrow, out);
    intersect(out, start, second);
  }
}

void Solids::add_sum(const Node& node, std::uint32_t skip, const Line& line, Window w,
                     Spans& out) const {
  const std::size_t start = out.size();
  if (node.bundle >= 0) {
    add_bundle(static_cast<std::uint32_t>(node.bundle), line, w, out);
  } else {
    for (std::uint32_t i = skip; i < node.count; ++i) {
      add_spans(children_[node.first + i], line, w, out);
    }
  }
  merge(out, start);
}

void Solids::add_bundle(std::uint32_t index, const Line& line, Window w, Spans& out) const {
  const Bundle& bundle = bundles_[index];
  if (!touches(bundle.bounds, line, w)) return;
  for (std::uint32_t i = 0; i < bundle.count; ++i) {
    add_spans(sorted_[bundle.first + i], line, w, out);
  }
  if (bundle.count > 0) return;
  add_bundle(bundle.first, line, w, out);
  add_bundle(bundle.first + 1, line, w, out);
}

Vec3 Solids::normal(std::uint32_t leaf, const Vec3& point) const {
  const Affine& to_local = leaf_to_local_[leaf];
  return normalized(to_local.transposed_vector(normal_at(leaves_[leaf], to_local.point(point))));
}

}  // namespace graycube::plain
