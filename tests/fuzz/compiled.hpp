// A scene's model, for harnesses, whose scenes may have solids that can't be computed.
#pragma once

#include <optional>

#include "check.hpp"
#include "proto/model_slice.hpp"
#include "scene/compile_scene.hpp"
#include "scene/scene_fault.hpp"

namespace graycube {

/// Nothing where the scene is refused, with reasons. A node must accept any model that isn't.
inline std::optional<Model> compiled(const Scene& scene) {
  try {
    Model model = compile_scene(scene);
    if (!fits_model_limits(model)) return model;
    const auto decoded = decode_model(encode_model(model));
    const auto* error = std::get_if<ModelError>(&decoded);
    GRAYCUBE_CHECK(error == nullptr, "%s: %s", error->where.c_str(), error->why.c_str());
    return model;
  } catch (const UnrenderableScene& e) {
    GRAYCUBE_CHECK(!e.faults().empty() && !e.faults().front().message.empty(), "without a reason");
    return std::nullopt;
  }
}

}  // namespace graycube
