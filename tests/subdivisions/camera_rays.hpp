// Rays that are hard for a subdivision in camera space: in planes through the eye and across the
// view, on the plane of the eye itself, from and through the eye, along the view.
#pragma once

#include <cmath>
#include <vector>

#include "crossings/against_whole_trees.hpp"
#include "subdivisions/arnaldi_cells.hpp"

namespace graycube::testing {

class CameraRays {
 public:
  static constexpr std::size_t kCases = 8;

  CameraRays(std::uint64_t seed, const Model& model, const ArnaldiCells& cells)
      : dice_(seed ^ 0x517CC1B727220A95ull),
        frame_(CameraFrame::from(model.settings.camera, model.settings.image)) {
    for (const ArnaldiCells::Half& half : cells.halves()) {
      for (const BspNode& n : half.bsp.nodes()) {
        if (n.axis != BspNode::kLeafAxis) planes_.push_back({n.axis, n.split});
      }
    }
  }

  RayCase make(std::size_t kind) { return with_random_ends(of_kind(kind), dice_); }
  Dice& dice() { return dice_; }

 private:
  RayCase of_kind(std::size_t kind) {
    const Vec3 eye = frame_.eye;
    switch (kind) {
      case 0: return {"in a plane of the subdivision", between(in_a_plane())};
      case 1: return {"from a plane of the subdivision", {in_a_plane()[0], dice_.unit_vector()}};
      case 2: return {"from the eye", {eye, dice_.unit_vector()}};
      case 3: return {"from the eye, in a plane", {eye, in_a_plane()[0] - eye}};
      case 4: {
        const Vec3 p = dice_.point(6);
        return {"through the eye", {p, eye - p}};
      }
      case 5: return {"in the eye's plane", {in_eye_plane(), in_eye_plane() - eye}};
      case 6: return {"along the view", {dice_.point(4), dice_.sign() * frame_.forward}};
      default: return {"from the eye's plane", {in_eye_plane(), dice_.unit_vector()}};
    }
  }

  Vec3 in_eye_plane() {
    return frame_.eye + dice_.between(-4, 4) * frame_.right + dice_.between(-4, 4) * frame_.down;
  }
  Ray between(const std::array<Vec3, 2>& points) {
    const Vec3 way = points[1] - points[0];
    return {points[0], length(way) > 0 ? way : dice_.unit_vector()};
  }
  /// Two points in one plane, in front of the eye or behind it.
  std::array<Vec3, 2> in_a_plane() {
    if (planes_.empty()) return {in_eye_plane(), in_eye_plane()};
    const SplitPlane plane = planes_[dice_.below(planes_.size())];
    return {point_of(plane), point_of(plane)};
  }
  Vec3 point_of(const SplitPlane& plane) {
    Vec3 p = dice_.point(5);
    const bool leans = plane.axis < 2 && frame_.projection == Projection::kPerspective;
    p[plane.axis] = leans ? plane.at * p.z : plane.at;
    return frame_.eye + p.x * frame_.right + p.y * frame_.down + p.z * frame_.forward;
  }

  Dice dice_;
  CameraFrame frame_;
  std::vector<SplitPlane> planes_;
};

}  // namespace graycube::testing
