#include "crossings/cell_programs.hpp"

#include <algorithm>

namespace graycube {
namespace {

bool is_leaf(const TreeNode& n) { return n.size == 1; }

}  // namespace

CellContent content_of(const Model& model, std::uint32_t first, std::uint32_t end) {
  const auto side = [&](std::uint32_t primitive) {
    return classify(model.primitives[primitive], model.data(), Aabb::everything());
  };
  CellContent content;
  for (std::uint32_t i = first; i < end; ++i) content.add(model.tree(model.objects[i]), i, side);
  return content;
}

CellContent content_of(const Model& model) {
  return content_of(model, 0, static_cast<std::uint32_t>(model.objects.size()));
}

CellContent restricted_to(const CellContent& content, const Model& model, const Aabb& box) {
  const Aabb grown = box.grown(model.delta);
  return content.restricted([&](std::uint32_t primitive) {
    return classify(model.primitives[primitive], model.data(), grown);
  });
}

Aabb finite_extent(const CellContent& content, const Model& model) {
  Aabb extent = Aabb::nothing();
  content.for_each_literal([&](std::uint32_t primitive) {
    const Aabb& bounds = model.primitives[primitive].bounds;
    if (bounds.is_finite()) extent = union_of(extent, bounds);
  });
  return extent;
}

ProgramRange CellPrograms::add(const CellContent& content) {
  const ProgramRange range{static_cast<std::uint32_t>(programs_.size()),
                           static_cast<std::uint32_t>(content.items().size())};
  for (const auto& item : content.items()) add_program(item.object, content.tree(item));
  return range;
}

void CellPrograms::add_program(std::uint32_t object, std::span<const TreeNode> tree) {
  CellProgram program;
  program.object = object;
  const bool flat = std::all_of(tree.begin() + 1, tree.end(), is_leaf);
  if (flat && tree.size() > 1) {
    program.shape = tree.front().kind == TreeNode::Kind::kAnd ? CellProgram::Shape::kAllOf
                                                              : CellProgram::Shape::kAnyOf;
    tree = tree.subspan(1);
  } else if (tree.size() > 1) {
    program.shape = CellProgram::Shape::kGeneral;
  }
  program.first_node = static_cast<std::uint32_t>(nodes_.size());
  program.node_count = static_cast<std::uint32_t>(tree.size());
  for (const TreeNode& n : tree) program.literals += is_leaf(n);
  nodes_.insert(nodes_.end(), tree.begin(), tree.end());
  programs_.push_back(program);
}

}  // namespace graycube
