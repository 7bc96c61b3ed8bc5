#include "formats/graycube/expansion.hpp"

#include <algorithm>
#include <string>

#include "mesh/triangle_mesh.hpp"
#include "scene/limits.hpp"
#include "spelling.hpp"

namespace graycube {
namespace {

/// Finds cycles by depth-first search and gives the shapes in an order in which each comes after
/// all that it uses. Its own stack: chains of refs may be as long as the file.
class ShapeOrder {
 public:
  ShapeOrder(ErrorReport& errors, const NameTable& names, std::vector<TreeSummary>& shapes)
      : errors_(errors), names_(names), shapes_(shapes), state_(shapes.size(), State::kNew) {}

  std::vector<std::uint32_t> run() {
    for (std::uint32_t s = 0; s < shapes_.size(); ++s)
      if (state_[s] == State::kNew) visit_from(s);
    return std::move(order_);
  }

 private:
  enum class State : std::uint8_t { kNew, kOnPath, kDone };
  struct Step {
    std::uint32_t shape;
    std::size_t next_use = 0;
  };

  void visit_from(std::uint32_t start) {
    path_.assign(1, {start});
    state_[start] = State::kOnPath;
    while (!path_.empty()) {
      Step& step = path_.back();
      auto& uses = shapes_[step.shape].uses;
      if (step.next_use == uses.size()) {
        state_[step.shape] = State::kDone;
        order_.push_back(step.shape);
        path_.pop_back();
        continue;
      }
      const ShapeUse use = uses[step.next_use];
      if (state_[use.shape] == State::kOnPath) {
        report_cycle(use);
        // The use is forgotten, so that the steps that follow see no cycle.
        uses.erase(uses.begin() + static_cast<std::ptrdiff_t>(step.next_use));
        continue;
      }
      ++step.next_use;
      if (state_[use.shape] == State::kNew) {
        state_[use.shape] = State::kOnPath;
        path_.push_back({use.shape});
      }
    }
  }

  void report_cycle(const ShapeUse& use) {
    if (!errors_.has_room()) return errors_.count();
    constexpr std::ptrdiff_t kMaxNamed = 16;
    const auto name = [&](std::uint32_t s) { return quoted(names_.names()[s]); };
    auto first = std::find_if(path_.begin(), path_.end(),
                              [&](const Step& s) { return s.shape == use.shape; });
    std::string text = "shapes refer to one another in a cycle: ";
    const auto named = std::min(kMaxNamed, path_.end() - first);
    for (auto s = first; s != first + named; ++s) text += name(s->shape) + " -> ";
    if (first + named != path_.end()) text += "... -> ";
    errors_.add(use.at, text + name(use.shape));
  }

  ErrorReport& errors_;
  const NameTable& names_;
  std::vector<TreeSummary>& shapes_;
  std::vector<State> state_;
  std::vector<Step> path_;
  std::vector<std::uint32_t> order_;
};

class Expander {
 public:
  Expander(const JsonTree& tree, ErrorReport& errors, const NameTable& names,
           const std::vector<TreeSummary>& shapes)
      : tree_(tree), errors_(errors), names_(names), expanded_(shapes.size()) {}

  void expand_shape(std::uint32_t shape, const TreeSummary& summary) {
    expanded_[shape] = expand(summary, [](const ShapeUse&) {});
  }

  void expand_object(const TreeSummary& summary) {
    const Expanded e = expand(summary, [&](const ShapeUse& use) { report_bare(use); });
    total_.add(e.counts);
    for (const RepeatUse& repeat : summary.repeats) {
      has_repeats_ = true;
      repeated_.add(repeat.added);
      check_repeated(repeat.at, "repeat");
    }
    for (const ShapeUse& use : summary.uses) {
      repeated_.add(expanded_[use.shape].counts.times(use.copies));
      check_repeated(use.at, "ref");
    }
  }

  void check_totals(JsonIndex at) {
    if (repeats_too_much_) return;
    check_total(at, total_.leaves, kMaxLeaves, "leaves");
    check_total(at, total_.nodes, kMaxExpandedNodes, "nodes");
    check_total(at, total_.triangles, kMaxMeshTriangles, "triangles of meshes");
  }

 private:
  struct Expanded {
    TreeCounts counts;
    std::uint32_t depth = 0;
    JsonIndex bare_leaf = 0;
  };

  static std::string written(std::uint64_t count) {
    return count == kCountless ? "more than 2^64" : std::to_string(count);
  }

  /// Reports, once for all refs and repeats, that they add too much.
  void check_repeated(JsonIndex at, const std::string& what_adds) {
    if (repeats_too_much_) return;
    const auto check = [&](std::uint64_t count, std::uint64_t limit, const char* what) {
      if (count <= limit) return;
      repeats_too_much_ = true;
      errors_.add(at, "with this " + what_adds +
                          (has_repeats_ ? ", refs and repeats make " : ", refs make ") +
                          written(count) + " " + what + ", at most " + std::to_string(limit) +
                          " are accepted");
    };
    check(repeated_.leaves, kMaxRepeatedLeaves, "leaves");
    check(repeated_.nodes, kMaxRepeatedNodes, "nodes");
    check(repeated_.planes, kMaxRepeatedPlanes, "planes of polyhedra");
    check(repeated_.triangles, kMaxRepeatedTriangles, "triangles of meshes");
  }

  /// The tree's counts with its refs expanded; `on_bare` is told of uses that leave a leaf without
  /// a material.
  template <typename OnBare>
  Expanded expand(const TreeSummary& summary, const OnBare& on_bare) {
    Expanded e{summary.counts, summary.depth, summary.bare_leaf};
    for (const ShapeUse& use : summary.uses) {
      const Expanded& shape = expanded_[use.shape];
      e.counts.add(shape.counts.times(use.copies));
      if (use.depth + shape.depth > kMaxTreeDepth)
        errors_.add(use.at, "the tree is deeper than " + std::to_string(kMaxTreeDepth) +
                                " levels when its refs are expanded");
      else
        e.depth = std::max(e.depth, use.depth + shape.depth);
      if (use.has_material || shape.bare_leaf == 0) continue;
      on_bare(use);
      if (e.bare_leaf == 0) e.bare_leaf = shape.bare_leaf;
    }
    return e;
  }

  void report_bare(const ShapeUse& use) {
    if (!errors_.has_room()) return errors_.count();
    errors_.add(use.at, "the shape " + quoted(names_.names()[use.shape]) +
                            " has a leaf without a material (" +
                            tree_.pointer(expanded_[use.shape].bare_leaf) +
                            "), and neither this ref nor anything above it names one");
  }

  void check_total(JsonIndex at, std::uint64_t total, std::uint64_t limit, const char* what) {
    if (total <= limit) return;
    errors_.add(at, "the objects have " + written(total) + " " + what +
                        " when refs are expanded, at most " + std::to_string(limit) +
                        " are accepted");
  }

  const JsonTree& tree_;
  ErrorReport& errors_;
  const NameTable& names_;
  std::vector<Expanded> expanded_;
  TreeCounts total_, repeated_;
  bool has_repeats_ = false;
  bool repeats_too_much_ = false;
};

}  // namespace

void TreeSummary::add_repeat(JsonIndex at, const RepeatCounts& times, TreeSummary child) {
  // There is one copy at least, as a repeat has a map.
  const bool countless = times.copies == kCountless;
  TreeCounts added = child.counts.times(countless ? kCountless : times.copies - 1);
  added.nodes = saturating_sum(added.nodes, times.products);
  counts.add(child.counts);
  counts.add(added);
  depth = std::max(depth, child.depth);
  if (bare_leaf == 0) bare_leaf = child.bare_leaf;
  for (ShapeUse& use : child.uses) {
    use.copies = saturating_product(use.copies, times.copies);
    uses.push_back(use);
  }
  repeats.insert(repeats.end(), child.repeats.begin(), child.repeats.end());
  repeats.push_back({at, added});
}

void check_expansion(const JsonTree& tree, ErrorReport& errors, const NameTable& shape_names,
                     std::vector<TreeSummary>& shapes, const std::vector<TreeSummary>& objects,
                     JsonIndex objects_at) {
  const auto order = ShapeOrder(errors, shape_names, shapes).run();
  Expander expander(tree, errors, shape_names, shapes);
  for (const std::uint32_t s : order) expander.expand_shape(s, shapes[s]);
  for (const auto& object : objects) expander.expand_object(object);
  expander.check_totals(objects_at);
}

}  // namespace graycube
