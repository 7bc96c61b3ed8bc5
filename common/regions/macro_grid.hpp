// The grid of macro-regions: the screen cut in columns and rows, each cell a pyramid through the
// eye, the outer ones reaching round to the back (Priol & Bouatouch 1987, section 4; design.md
// section 7). Columns and rows each are a fan of planes through the eye; behind the eye the fan is
// taken as a BSP whose root is boundary C/2, which makes the grid a torus. An orthographic camera
// has parallel planes: an open grid.
//
// Pyramids may also be cut in depth, into slabs, by planes across the view: an open line. All
// behind the eye is in the first slab, where all primary rays begin.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "geometry/aabb.hpp"
#include "geometry/ray.hpp"
#include "regions/boundary.hpp"
#include "regions/camera.hpp"

namespace graycube {

/// Most columns, and most rows, of a grid (a scattered one included).
inline constexpr std::uint32_t kMaxGridSide = 4096;
/// Most slabs of a grid.
inline constexpr std::uint32_t kMaxSlabs = 16;
/// How far beyond the picture a boundary may lie, in pixels.
inline constexpr std::int64_t kMaxEdgeDistance = 1 << 20;

/// A macro-region's place in the grid.
struct RegionIndex {
  std::uint16_t column = 0, row = 0, slab = 0;
  friend bool operator==(const RegionIndex&, const RegionIndex&) = default;
};

/// The macro-regions that one node holds: those of every columns-th column, every rows-th row and
/// every slabs-th slab of the grid, counted from the node's own place in the mesh of nodes (design
/// section 7, `--scatter`).
struct RegionShare {
  std::uint32_t columns = 1, rows = 1;
  std::uint32_t column = 0, row = 0;
  std::uint32_t slabs = 1, slab = 0;

  bool owns_column(std::uint32_t c) const { return c % columns == column; }
  bool owns_row(std::uint32_t r) const { return r % rows == row; }
  bool owns_slab(std::uint32_t s) const { return s % slabs == slab; }
  bool owns(RegionIndex region) const {
    return owns_column(region.column) && owns_row(region.row) && owns_slab(region.slab);
  }
  friend bool operator==(const RegionShare&, const RegionShare&) = default;
};

/// The parameter at which a ray leaves a macro-region, and the region that it enters.
struct RegionExit {
  double t;
  RegionIndex next;
};

/// A rectangle of pixels: x0 ≤ x < x1, y0 ≤ y < y1.
struct PixelRect {
  std::uint32_t x0 = 0, y0 = 0, x1 = 0, y1 = 0;
  bool is_empty() const { return x0 >= x1 || y0 >= y1; }
  friend bool operator==(const PixelRect&, const PixelRect&) = default;
};

class MacroGrid {
 public:
  /// Boundaries on pixel edges, spread evenly over the picture and continued beyond it when columns
  /// outnumber pixels. 1 ≤ columns, rows ≤ kMaxGridSide.
  static MacroGrid regular(const CameraFrame& frame, std::uint32_t columns, std::uint32_t rows,
                           std::vector<double> slab_depths = {});
  /// Boundaries at the given pixel edges, strictly increasing; one fewer than columns (rows). Edges
  /// may lie up to kMaxEdgeDistance beyond the picture. `slab_depths`, one fewer than slabs: where
  /// slabs end, in scene units along the view from the eye; above 0 and strictly increasing.
  MacroGrid(const CameraFrame& frame, std::vector<std::int64_t> column_edges,
            std::vector<std::int64_t> row_edges, std::vector<double> slab_depths = {});

  std::uint32_t columns() const { return static_cast<std::uint32_t>(columns_.cells.size()); }
  std::uint32_t rows() const { return static_cast<std::uint32_t>(rows_.cells.size()); }
  std::uint32_t slabs() const { return static_cast<std::uint32_t>(slabs_.cells.size()); }
  const std::vector<std::int64_t>& column_edges() const { return columns_.edges; }
  const std::vector<std::int64_t>& row_edges() const { return rows_.edges; }
  /// Of each slab but the last, where it ends.
  std::vector<double> slab_depths() const;

  /// The pixels whose primary rays pass the region's column and row; may be empty.
  PixelRect pixels_of(RegionIndex region) const;
  /// The region in which a pixel's primary rays begin: in the first slab.
  RegionIndex region_of_pixel(std::uint32_t x, std::uint32_t y) const;
  /// The region that holds a point (half-open on every plane: f ≥ 0 is the far side).
  RegionIndex region_of_point(const Vec3& p) const;
  /// Whether a point satisfies each of the region's half-spaces; true of region_of_point(p) only,
  /// but for points within rounding of several planes at once.
  bool contains(RegionIndex region, const Vec3& p) const;
  /// The exit of a ray that has reached `t` in `region`, at the larger of t and its plane's
  /// parameter; nothing when it stays for good. Rays pass one plane at a time, columns before rows,
  /// and rows before slabs, at equal parameters; visits of length zero are normal; each plane is
  /// passed at most once.
  std::optional<RegionExit> exit(RegionIndex region, const Ray& ray, double t) const;
  /// Like exit(), for rays in one region that have reached their t0: bit i of the result tells that
  /// ray i leaves it before t1[i]; then t1[i] is shortened to the exit, and exits[i] is set.
  RayPacket::Mask shorten_to_exits(RegionIndex region, RayPacket& packet,
                                   std::span<RegionExit, RayPacket::kSize> exits) const;
  /// The regions other than `region` itself that a ray may enter next, each once.
  std::vector<RegionIndex> neighbours_of(RegionIndex region) const;
  /// False only when the grown column certainly misses the box (each half-space tested by itself).
  /// A region is a column ∩ a row ∩ a slab, and misses what any of them misses.
  bool column_may_touch(std::uint32_t column, const Aabb& box, double grow) const {
    return cell_may_touch(columns_.cells[column], box, grow);
  }
  bool row_may_touch(std::uint32_t row, const Aabb& box, double grow) const {
    return cell_may_touch(rows_.cells[row], box, grow);
  }
  /// Like column_may_touch() above, for a sphere instead of a box.
  bool column_may_touch(std::uint32_t column, const Vec3& center, double radius,
                        double grow) const {
    return cell_may_touch(columns_.cells[column], center, radius, grow);
  }
  bool row_may_touch(std::uint32_t row, const Vec3& center, double radius, double grow) const {
    return cell_may_touch(rows_.cells[row], center, radius, grow);
  }
  bool slab_may_touch(std::uint32_t slab, const Aabb& box, double grow) const {
    return cell_may_touch(slabs_.cells[slab], box, grow);
  }
  bool slab_may_touch(std::uint32_t slab, const Vec3& center, double radius, double grow) const {
    return cell_may_touch(slabs_.cells[slab], center, radius, grow);
  }
  bool may_touch(RegionIndex region, const Aabb& box, double grow) const {
    return column_may_touch(region.column, box, grow) && row_may_touch(region.row, box, grow) &&
           slab_may_touch(region.slab, box, grow);
  }
  bool may_touch(RegionIndex region, const Vec3& center, double radius, double grow) const {
    return column_may_touch(region.column, center, radius, grow) &&
           row_may_touch(region.row, center, radius, grow) &&
           slab_may_touch(region.slab, center, radius, grow);
  }

 private:
  struct Cell {
    std::array<RegionSide, 2> sides;
    std::size_t count = 0;

    std::span<const RegionSide> list() const { return {sides.data(), count}; }
    void add(const RegionSide& side) { sides[count++] = side; }
  };
  /// All columns, all rows, or all slabs. planes[i] and edges[i] are boundary number i + 1, between
  /// cells i and i + 1; slabs have no edges.
  struct Fan {
    std::vector<std::int64_t> edges;
    std::vector<BoundaryPlane> planes;
    std::vector<Cell> cells;

    std::uint16_t cell_of_edge_position(std::uint32_t pixel) const;
    std::uint16_t cell_of_point(const Vec3& relative) const;
    std::uint16_t next_of(const RegionSide& side, const Ray& relative, double t) const;
  };

  static Fan make_fan(const CameraFrame& frame, const Vec3& axis, double middle,
                      std::vector<std::int64_t> edges);
  static Fan make_slabs(const CameraFrame& frame, const std::vector<double>& depths);
  static void link_cells(Fan& fan, bool wraps);
  static double passage(const RegionSide& side, const Ray& relative);
  bool cell_may_touch(const Cell& cell, const Aabb& box, double grow) const;
  bool cell_may_touch(const Cell& cell, const Vec3& center, double radius, double grow) const;

  ImageSize image_;
  Vec3 eye_;
  Fan columns_, rows_, slabs_;
};

}  // namespace graycube
