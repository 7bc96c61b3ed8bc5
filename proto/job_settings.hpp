// The settings that follow from a job's options: the same in the command, the frontal and nodes.
#pragma once

#include "proto/messages.hpp"
#include "shading/settings.hpp"
#include "trace/tile_plan.hpp"

namespace graycube {

/// Applies the options' overrides; where none is given, the scene's value stays. AOVs that can't be
/// read count as none.
inline void apply_overrides(const control::JobOptions& options, RenderSettings& settings) {
  ImageSize& image = settings.image;
  image.width = options.width.value_or(image.width);
  image.height = options.height.value_or(image.height);
  image.samples = options.samples.value_or(image.samples);
  settings.max_depth = options.max_depth.value_or(settings.max_depth);
  settings.aovs = parse_aovs(options.aov).value_or(AovSet{});
}

/// The shape of a job's tiles: frontal and nodes must number them alike.
inline TileShape tile_shape(Grain grain, std::uint32_t tile_size, const ImageSize& image) {
  switch (grain) {
    case Grain::kPixel: return {1, 1};
    case Grain::kLine: return {image.width, 1};
    case Grain::kTile: break;
  }
  return {tile_size, tile_size};
}

}  // namespace graycube
