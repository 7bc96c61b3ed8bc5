// BRL-CAD's shaders that give colours by place, camo and marble, as patterns.
#pragma once

#include <optional>

#include "formats/brlcad/shader_words.hpp"
#include "shading/pattern.hpp"

namespace graycube::brlcad {

/// Nothing when the shader is none of these. The pattern's map is that from the coordinates of the
/// region, which SceneBuilder makes one from the world's. The defaults and what parameters mean are
/// those of liboptical's sh_camo.c.
std::optional<Pattern> pattern_of(const ShaderWords& words);

}  // namespace graycube::brlcad
