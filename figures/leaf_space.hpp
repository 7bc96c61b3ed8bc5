// The leaf regions of a BSP as figures show them: cells, sections, and what they hold.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "crossings/bsp.hpp"
#include "regions/camera.hpp"
#include "subdivisions/camera_space.hpp"
#include "subdivisions/subdivision.hpp"

namespace graycube::figures {

/// A BSP in its own coordinates: those of the world for `linked`; for `arnaldi` those of the half
/// of space in front of the camera (x/z, y/z, z in perspective).
class LeafSpace {
 public:
  /// `way` is kLinked or kArnaldi. The model must outlive this.
  LeafSpace(const Model& model, Subdivision way);

  Subdivision way() const { return way_; }
  const Bsp& bsp() const { return bsp_; }
  const CameraFrame& frame() const { return frame_; }
  const CameraSpace& camera_space() const { return camera_space_; }
  /// Whether axes 0 and 1 are slopes, so that cells are pyramids.
  bool is_fan() const { return way_ == Subdivision::kArnaldi && camera_space_.is_perspective(); }
  /// All of the space.
  Aabb everything() const;
  /// Encloses all finite primitives that are in it, cut at the picture's edges for `arnaldi`. Never
  /// empty and nowhere flat.
  const Aabb& extent() const { return extent_; }
  /// The cell of a node of the BSP, inner or leaf.
  const Aabb& cell(std::uint32_t node) const { return cells_[node]; }
  /// The node of a leaf region of bsp().
  std::uint32_t node_of(const BspLeaf& leaf) const {
    return leaf_nodes_[static_cast<std::size_t>(&leaf - bsp_.leaves().data())];
  }
  /// The primitives that a node's leaf regions hold, each once, in increasing order.
  std::vector<std::uint32_t> primitives_below(std::uint32_t node) const;
  /// The number of leaf regions below a node, itself included if it is one.
  std::uint32_t leaves_below(std::uint32_t node) const;

 private:
  Aabb extent_of_primitives(const Model& model) const;

  Subdivision way_;
  CameraFrame frame_;
  CameraSpace camera_space_;
  Bsp bsp_;
  std::vector<Aabb> cells_;
  /// By the leaf region's index.
  std::vector<std::uint32_t> leaf_nodes_;
  Aabb extent_;
};

/// A plane across one axis of a LeafSpace.
struct Section {
  /// The axis that runs to the right on the page, the one that runs up, and the one across.
  int right = 0, up = 2, across = 1;
  double at = 0;
};

/// A leaf region where a section cuts it.
struct SectionCell {
  /// Index into Bsp::nodes.
  std::uint32_t node = 0;
  /// Extent on the section's axes; perhaps infinite.
  double right_lo = 0, right_hi = 0, up_lo = 0, up_hi = 0;
  std::uint32_t primitives = 0;
};
std::vector<SectionCell> cells_in(const LeafSpace& space, const Section& section);

/// A cell's extent on a section's axes, whether or not the section cuts it.
SectionCell projected(const LeafSpace& space, const Section& section, std::uint32_t node);

/// The section along the axes right and up whose leaf regions hold most, among kSectionsTried
/// across the space's extent.
Section fullest_section(const LeafSpace& space, int right, int up);
inline constexpr int kSectionsTried = 31;

}  // namespace graycube::figures
