// The way from a scene to a node of one of its trees, kept on the stack while trees are walked.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "json_pointer.hpp"
#include "scene/scene.hpp"

namespace graycube {

/// A node, and the place of the node above it.
struct ScenePlace {
  enum class Step : std::uint8_t { kObject, kShape, kChild, kOnlyChild, kCopy };

  /// Null for an object's root.
  const ScenePlace* above = nullptr;
  Step step = Step::kObject;
  /// Number of the object, the shape or the child; of a copy of a repeat's child, how many of the
  /// repeat's maps it is under.
  std::size_t index = 0;

  /// The node's JSON pointer. Within a shape it begins at the shape, not at the ref.
  std::string pointer(const Scene& scene) const {
    switch (step) {
      case Step::kObject: return "/objects/" + std::to_string(index) + "/csg";
      case Step::kShape: {
        std::string shape = "/shapes";
        append_token(shape, scene.shapes[index].name);
        return shape;
      }
      case Step::kChild: return above->pointer(scene) + "/children/" + std::to_string(index);
      case Step::kOnlyChild:
      case Step::kCopy: break;
    }
    return above->pointer(scene) + "/child";
  }
  /// Whether a ref lies on the way.
  bool is_in_shape() const {
    return step == Step::kShape || (above != nullptr && above->is_in_shape());
  }
  /// The nearest copy of a repeat's child that the node is or is in; null if there is none.
  const ScenePlace* copy() const {
    if (step == Step::kCopy) return this;
    return above == nullptr ? nullptr : above->copy();
  }
  /// The object's number.
  std::size_t object() const { return above == nullptr ? index : above->object(); }
};

}  // namespace graycube
