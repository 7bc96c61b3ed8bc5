#include "formats/brlcad/overlaps.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <unordered_map>

#include "csg/tree.hpp"

namespace graycube {
namespace {

/// Lines along each side of the grid.
constexpr int kLines = 12;

/// Finds where lines run inside objects.
class Lines {
 public:
  explicit Lines(const Model& model) : model_(model) {}

  void set(const Ray& ray) {
    ray_ = ray;
    spans_.clear();
  }
  /// Replaces `inside` by the intervals of t0 … t1 in which the line is in the object.
  void look(const Object& object, double t0, double t1, std::vector<Spans::Interval>& inside) {
    ends_.assign({t0, t1});
    const auto tree = model_.tree(object);
    for (const TreeNode& node : tree) {
      if (node.kind != TreeNode::Kind::kLeaf && node.kind != TreeNode::Kind::kInvertedLeaf)
        continue;
      const Spans& spans = spans_of(node.primitive);
      for (int i = 0; i < spans.count; ++i) {
        const auto& s = spans.interval[static_cast<std::size_t>(i)];
        for (const double end : {s.enter, s.leave}) {
          if (end > t0 && end < t1) ends_.push_back(end);
        }
      }
    }
    std::sort(ends_.begin(), ends_.end());
    inside.clear();
    for (std::size_t i = 0; i + 1 < ends_.size(); ++i) {
      const double a = ends_[i], b = ends_[i + 1], middle = 0.5 * (a + b);
      if (!(a < b) || !evaluate(tree, [&](std::uint32_t p) { return holds(p, middle); })) continue;
      if (!inside.empty() && inside.back().leave == a) {
        inside.back().leave = b;
      } else {
        inside.push_back({a, b});
      }
    }
  }
  std::uint64_t work() const { return work_; }

 private:
  const Spans& spans_of(std::uint32_t primitive) {
    const auto found = spans_.find(primitive);
    if (found != spans_.end()) return found->second;
    ++work_;
    return spans_.emplace(primitive, spans_along(model_.primitives[primitive], model_.data(), ray_))
        .first->second;
  }
  bool holds(std::uint32_t primitive, double t) {
    const Spans& spans = spans_of(primitive);
    for (int i = 0; i < spans.count; ++i) {
      const auto& s = spans.interval[static_cast<std::size_t>(i)];
      if (s.enter <= t && t <= s.leave) return true;
    }
    return false;
  }

  const Model& model_;
  Ray ray_;
  std::unordered_map<std::uint32_t, Spans> spans_;
  std::vector<double> ends_;
  std::uint64_t work_ = 0;
};

class Search {
 public:
  explicit Search(const Model& model) : model_(model), lines_(model) {}

  BrlcadOverlaps run() {
    // By their least x, so that only those whose ranges of x meet are compared.
    std::vector<std::uint32_t> order;
    for (std::uint32_t i = 0; i < model_.objects.size(); ++i) {
      if (model_.objects[i].bounds.is_finite() && !model_.objects[i].bounds.is_empty())
        order.push_back(i);
    }
    const auto bounds = [&](std::uint32_t i) -> const Aabb& { return model_.objects[i].bounds; };
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
      return bounds(a).lo.x != bounds(b).lo.x ? bounds(a).lo.x < bounds(b).lo.x : a < b;
    });
    for (std::size_t i = 0; i < order.size(); ++i) {
      for (std::size_t j = i + 1; j < order.size(); ++j) {
        if (bounds(order[j]).lo.x >= bounds(order[i]).hi.x) break;
        if (!look_at(std::min(order[i], order[j]), std::max(order[i], order[j]))) return finished();
      }
    }
    return finished();
  }

 private:
  BrlcadOverlaps finished() {
    std::sort(found_.pairs.begin(), found_.pairs.end(),
              [](const BrlcadOverlap& a, const BrlcadOverlap& b) {
                return a.first != b.first ? a.first < b.first : a.second < b.second;
              });
    return std::move(found_);
  }

  /// False when the search ends.
  bool look_at(std::uint32_t a, std::uint32_t b) {
    const Aabb both = intersection_of(model_.objects[a].bounds, model_.objects[b].bounds);
    const Vec3 size = both.hi - both.lo;
    int along = 0;
    for (int axis = 0; axis < 3; ++axis) {
      if (!(size[axis] > kLeastBrlcadOverlap)) return true;
      if (size[axis] < size[along]) along = axis;
    }
    if (lines_.work() + ++pairs_ > kMaxOverlapWork || found_.pairs.size() == kMaxBrlcadOverlaps) {
      found_.is_whole = false;
      return false;
    }
    std::optional<BrlcadOverlap> deepest;
    for (int i = 0; i < kLines; ++i) {
      for (int k = 0; k < kLines; ++k) look_along(a, b, both, along, i, k, deepest);
    }
    if (deepest) found_.pairs.push_back(*deepest);
    return true;
  }

  /// Looks along line number (i, k) through the box, parallel to an axis.
  void look_along(std::uint32_t a, std::uint32_t b, const Aabb& box, int along, int i, int k,
                  std::optional<BrlcadOverlap>& deepest) {
    const int u = (along + 1) % 3, v = (along + 2) % 3;
    const auto at = [&](int axis, int number) {
      return box.lo[axis] + (number + 0.5) / kLines * (box.hi[axis] - box.lo[axis]);
    };
    Ray ray;
    ray.origin[along] = box.lo[along];
    ray.origin[u] = at(u, i);
    ray.origin[v] = at(v, k);
    ray.direction = {};
    ray.direction[along] = 1;
    lines_.set(ray);
    const double length = box.hi[along] - box.lo[along];
    lines_.look(model_.objects[a], 0, length, in_a_);
    if (in_a_.empty()) return;
    lines_.look(model_.objects[b], 0, length, in_b_);
    for (const Spans::Interval& x : in_a_) {
      for (const Spans::Interval& y : in_b_) {
        const double enter = std::fmax(x.enter, y.enter), leave = std::fmin(x.leave, y.leave);
        const double depth = leave - enter;
        if (!(depth > kLeastBrlcadOverlap) || (deepest && depth <= deepest->depth)) continue;
        deepest = BrlcadOverlap{a, b, ray.at(0.5 * (enter + leave)), depth};
      }
    }
  }

  const Model& model_;
  Lines lines_;
  BrlcadOverlaps found_;
  std::uint64_t pairs_ = 0;
  std::vector<Spans::Interval> in_a_, in_b_;
};

}  // namespace

BrlcadOverlaps find_brlcad_overlaps(const Model& model) { return Search(model).run(); }

}  // namespace graycube
