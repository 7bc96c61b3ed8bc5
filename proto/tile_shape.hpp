#pragma once

#include "proto/messages.hpp"
#include "trace/tile_plan.hpp"

namespace graycube {

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
