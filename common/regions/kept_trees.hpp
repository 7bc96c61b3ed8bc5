// Visits the parts of a model that are held, object by object.
#pragma once

#include <cstdint>
#include <span>

#include "csg/model.hpp"
#include "regions/restrict.hpp"

namespace graycube {

/// Calls f(object, tree) for each object of the whole model of which something is held, in order;
/// the tree is the object's whole tree or the part of it that is held.
template <typename F>
void for_each_kept(const Model& model, const ModelContents& contents, F&& f) {
  auto part = contents.parts.begin();
  for (std::uint32_t i = 0; i < model.objects.size(); ++i) {
    const Object& object = model.objects[i];
    if (contents.is_whole[i]) {
      f(object, model.tree(object));
    } else if (part != contents.parts.end() && part->object == i) {
      f(object, std::span<const TreeNode>(part->tree));
      ++part;
    }
  }
}

}  // namespace graycube
