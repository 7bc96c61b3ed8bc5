#include "figures/leaf_space.hpp"

#include <algorithm>
#include <cmath>

#include "subdivisions/screen_bsp.hpp"

namespace graycube::figures {
namespace {

std::vector<Aabb> cells_of_nodes(const Bsp& bsp, const Aabb& all) {
  std::vector<Aabb> cells(bsp.nodes().size());
  cells[0] = all;
  // Children come behind their parents.
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const BspNode& n = bsp.nodes()[i];
    if (n.axis == BspNode::kLeafAxis) continue;
    cells[n.child] = cells[n.child + 1] = cells[i];
    cells[n.child].hi[n.axis] = n.split;
    cells[n.child + 1].lo[n.axis] = n.split;
  }
  return cells;
}

/// Leaf regions are numbered apart from nodes: the node of each.
std::vector<std::uint32_t> nodes_of_leaves(const Bsp& bsp) {
  std::vector<std::uint32_t> nodes(bsp.leaves().size());
  for (std::uint32_t i = 0; i < bsp.nodes().size(); ++i) {
    if (bsp.nodes()[i].axis == BspNode::kLeafAxis) nodes[bsp.nodes()[i].child] = i;
  }
  return nodes;
}

Bsp bsp_of(const Model& model, Subdivision way, const CameraSpace& space) {
  return way == Subdivision::kArnaldi ? build_screen_bsp(model, space) : Bsp::build(model);
}

/// Calls f(node) for each leaf below a node.
template <typename F>
void for_each_leaf(const Bsp& bsp, std::uint32_t node, F&& f) {
  std::vector<std::uint32_t> open{node};
  while (!open.empty()) {
    const std::uint32_t i = open.back();
    open.pop_back();
    const BspNode& n = bsp.nodes()[i];
    if (n.axis == BspNode::kLeafAxis) {
      f(i);
    } else {
      open.insert(open.end(), {n.child + 1, n.child});
    }
  }
}

}  // namespace

LeafSpace::LeafSpace(const Model& model, Subdivision way)
    : way_(way),
      frame_(CameraFrame::from(model.settings.camera, model.settings.image)),
      camera_space_(frame_, CameraSpace::Direction::kForward),
      bsp_(bsp_of(model, way, camera_space_)),
      cells_(cells_of_nodes(bsp_, everything())),
      leaf_nodes_(nodes_of_leaves(bsp_)),
      extent_(extent_of_primitives(model)) {}

Aabb LeafSpace::everything() const {
  return way_ == Subdivision::kArnaldi ? camera_space_.everything() : Aabb::everything();
}

Aabb LeafSpace::extent_of_primitives(const Model& model) const {
  const bool is_seen = way_ == Subdivision::kArnaldi;
  Aabb extent = Aabb::nothing();
  for (const Primitive& p : model.primitives) {
    if (!p.bounds.is_finite()) continue;
    const Aabb bounds = is_seen ? camera_space_.bounds_of(p, model.delta) : p.bounds;
    if (!bounds.is_empty()) extent = union_of(extent, bounds);
  }
  if (is_seen) {
    const Aabb picture{{frame_.column_position(0), frame_.row_position(0), -kInf},
                       {frame_.column_position(frame_.image.width),
                        frame_.row_position(frame_.image.height), kInf}};
    extent = intersection_of(extent, picture);
  }
  if (extent.is_empty() || !extent.is_finite()) extent = {{-1, -1, 0}, {1, 1, 2}};
  for (int a = 0; a < 3; ++a) {
    if (!(extent.lo[a] < extent.hi[a])) {
      extent.lo[a] -= 0.5;
      extent.hi[a] += 0.5;
    }
  }
  return extent;
}

std::vector<std::uint32_t> LeafSpace::primitives_below(std::uint32_t node) const {
  std::vector<std::uint32_t> found;
  for_each_leaf(bsp_, node, [&](std::uint32_t i) {
    const BspLeaf& leaf = bsp_.leaves()[bsp_.nodes()[i].child];
    for (std::uint32_t p = 0; p < leaf.program_count; ++p) {
      const CellProgram& program = bsp_.programs()[leaf.first_program + p];
      for (std::uint32_t k = 0; k < program.node_count; ++k) {
        const TreeNode& n = bsp_.program_nodes()[program.first_node + k];
        if (n.size == 1) found.push_back(n.primitive);
      }
    }
  });
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

std::uint32_t LeafSpace::leaves_below(std::uint32_t node) const {
  std::uint32_t count = 0;
  for_each_leaf(bsp_, node, [&](std::uint32_t) { ++count; });
  return count;
}

SectionCell projected(const LeafSpace& space, const Section& section, std::uint32_t node) {
  const Aabb& cell = space.cell(node);
  return {node,
          cell.lo[section.right],
          cell.hi[section.right],
          cell.lo[section.up],
          cell.hi[section.up],
          static_cast<std::uint32_t>(space.primitives_below(node).size())};
}

std::vector<SectionCell> cells_in(const LeafSpace& space, const Section& section) {
  std::vector<SectionCell> cells;
  std::vector<std::uint32_t> open{0};
  while (!open.empty()) {
    const std::uint32_t i = open.back();
    open.pop_back();
    const BspNode& n = space.bsp().nodes()[i];
    if (n.axis == BspNode::kLeafAxis) {
      cells.push_back(projected(space, section, i));
    } else if (n.axis == section.across) {
      open.push_back(n.child + (section.at >= n.split ? 1u : 0u));
    } else {
      open.insert(open.end(), {n.child + 1, n.child});
    }
  }
  return cells;
}

Section fullest_section(const LeafSpace& space, int right, int up) {
  Section best{right, up, 3 - right - up, 0};
  std::uint64_t most = 0;
  const double lo = space.extent().lo[best.across], hi = space.extent().hi[best.across];
  best.at = (lo + hi) / 2;
  for (int i = 1; i <= kSectionsTried; ++i) {
    Section tried = best;
    tried.at = lo + (hi - lo) * i / (kSectionsTried + 1);
    std::uint64_t held = 0;
    for (const SectionCell& cell : cells_in(space, tried)) held += cell.primitives;
    if (held > most) {
      most = held;
      best = tried;
    }
  }
  return best;
}

}  // namespace graycube::figures
