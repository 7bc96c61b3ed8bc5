// A section of a LeafSpace on the page: how its coordinates become places, and cells outlines.
#pragma once

#include <string>
#include <vector>

#include "figures/leaf_space.hpp"
#include "figures/page/svg.hpp"

namespace graycube::figures {

/// What of a section is shown.
struct Window {
  double right_lo = 0, right_hi = 1, up_lo = 0, up_hi = 1;
};

/// Where axis `right` holds slopes and `up` is depth, cells become what they are in space: parts of
/// a fan through the eye, which is below. Scales along both axes differ, to fill the panel.
class SectionView {
 public:
  SectionView(const LeafSpace& space, const Section& section, const Window& window,
              const Box& panel);

  const Window& window() const { return window_; }
  const Box& panel() const { return panel_; }
  Point at(double right, double up) const;
  /// The place of a point of the space's own coordinates.
  Point at(const Vec3& place) const { return at(place[section_.right], place[section_.up]); }
  /// The corners of a cell, as far as it is in the window; none when it isn't.
  std::vector<Point> outline(const SectionCell& cell) const;
  /// The middle of a cell, as far as it is in the window.
  Point middle(const SectionCell& cell) const;
  /// The middle of a face (0: lower right axis, 1: upper, 2: lower up axis, 3: upper).
  Point face_middle(const SectionCell& cell, int face) const;
  bool shows(const SectionCell& cell) const;

  /// Draws the leaf regions of the section, shaded by what they hold.
  void draw_cells(Svg& svg, const std::vector<SectionCell>& cells) const;

 private:
  SectionCell clipped(const SectionCell& cell) const;

  Section section_;
  Window window_;
  Box panel_;
  bool is_fan_;
  double x_lo_, x_hi_;
};

/// The window around all that a section of the space shows.
Window whole_window(const LeafSpace& space, const Section& section);

/// "seen from above: x/z to the right, depth z up" or the like.
std::string axes_text(const LeafSpace& space, const Section& section);

}  // namespace graycube::figures
