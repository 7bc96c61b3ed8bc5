// BRL-CAD's shaders that give colours by place as patterns: camo and marble in space; checker,
// cloud and testmap by u and v on solids.
#pragma once

#include <optional>

#include "formats/brlcad/shader_words.hpp"
#include "shading/pattern.hpp"

namespace graycube::brlcad {

/// Nothing when the shader is none of these. The pattern's map is that from the coordinates of the
/// region, which SceneBuilder makes one from the world's. The defaults and what parameters mean are
/// those of liboptical's sh_camo.c.
std::optional<Pattern> pattern_of(const ShaderWords& words);

/// The pattern of u and v, without a chart; nothing for other shaders. A checker of one colour is
/// that colour, of no kind. Defaults and meanings are those of sh_text.c and sh_cloud.c.
std::optional<Pattern> pattern_on_solids_of(const ShaderWords& words);

}  // namespace graycube::brlcad
