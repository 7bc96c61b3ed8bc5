#include "bezier/net_mesh.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "bezier/division.hpp"

namespace graycube {
namespace {

/// Points of the mesh by their numbers.
using MeshPoints = std::vector<std::uint32_t>;

class Tessellator {
 public:
  Tessellator(const BezierNet& net, const BezierDivision& division)
      : net_(net), division_(division), corners_(net.points.size(), kNone) {}

  TriangleMesh run() {
    mesh_.triangles.reserve(division_.triangles);
    for (std::size_t c = 0; c < division_.curves.size(); ++c) add_curve(c);
    for (std::size_t p = 0; p < net_.patches.size(); ++p) add_patch(p);
    return std::move(mesh_);
  }

 private:
  static constexpr std::uint32_t kNone = 0xFFFFFFFFu;

  std::uint32_t add_point(const Vec3& p) {
    mesh_.points.push_back(p);
    return static_cast<std::uint32_t>(mesh_.points.size() - 1);
  }
  /// A curve ends in the control point itself, which all curves share that end there.
  std::uint32_t corner(std::uint32_t control_point) {
    std::uint32_t& index = corners_[control_point];
    if (index == kNone) index = add_point(net_.points[control_point]);
    return index;
  }

  void add_curve(std::size_t index) {
    const BezierCurve& curve = division_.sides.curves[index];
    const std::size_t parts = std::size_t{1} << division_.curves[index];
    MeshPoints& along = curves_.emplace_back(parts + 1);
    along.front() = corner(curve.points[0]);
    along.back() = corner(curve.points[3]);
    std::array<Vec3, 4> control;
    for (std::size_t i = 0; i < 4; ++i) control[i] = net_.points[curve.points[i]];
    for (std::size_t k = 1; k < parts; ++k) {
      if (curve.is_point()) {
        along[k] = along.front();
      } else if (curve.is_fold() && k > parts - k) {
        along[k] = along[parts - k];
      } else {
        along[k] =
            add_point(point_at(control, static_cast<double>(k) / static_cast<double>(parts)));
      }
    }
  }

  void add_patch(std::size_t p) {
    patch_ = &net_.patches[p];
    columns_ = std::size_t{1} << division_.patches[p].u;
    rows_ = std::size_t{1} << division_.patches[p].v;
    for (std::size_t s = 0; s < 4; ++s) {
      const BezierSides::Use& use = division_.side(p, s);
      const MeshPoints& along = curves_[use.curve];
      if (use.is_backward) {
        sides_[s].assign(along.rbegin(), along.rend());
      } else {
        sides_[s] = along;
      }
    }
    inner_.clear();
    for (std::size_t j = 1; j < rows_; ++j)
      for (std::size_t i = 1; i < columns_; ++i) inner_.push_back(add_point(surface(i, j, 0)));
    for (std::size_t j = 0; j < rows_; ++j)
      for (std::size_t i = 0; i < columns_; ++i) add_cell(i, j);
  }

  /// The patch's point at a point of the grid, or so much of a cell further both ways.
  Vec3 surface(std::size_t i, std::size_t j, double further) const {
    return point_at(net_, *patch_,
                    (static_cast<double>(i) + further) / static_cast<double>(columns_),
                    (static_cast<double>(j) + further) / static_cast<double>(rows_));
  }

  /// The mesh's point at a point of the grid.
  std::uint32_t at(std::size_t i, std::size_t j) const {
    if (j == 0) return sides_[0][i * parts_of_cell(0)];
    if (i == columns_) return sides_[1][j * parts_of_cell(1)];
    if (j == rows_) return sides_[2][(columns_ - i) * parts_of_cell(2)];
    if (i == 0) return sides_[3][(rows_ - j) * parts_of_cell(3)];
    return inner_[(j - 1) * (columns_ - 1) + i - 1];
  }
  /// Into how many parts a side cuts each cell that lies at it.
  std::size_t parts_of_cell(std::size_t side) const {
    return (sides_[side].size() - 1) / (side % 2 == 0 ? columns_ : rows_);
  }
  /// Appends the points along a cell's edge on a side of the patch, without its end; `cell` counts
  /// going round.
  void append_edge(std::size_t side, std::size_t cell, MeshPoints& outline) const {
    const std::size_t parts = parts_of_cell(side);
    for (std::size_t k = cell * parts; k < (cell + 1) * parts; ++k)
      outline.push_back(sides_[side][k]);
  }

  void add_cell(std::size_t i, std::size_t j) {
    MeshPoints& outline = outline_;
    outline.clear();
    const auto edge = [&](bool is_outer, std::size_t side, std::size_t cell, std::size_t column,
                          std::size_t row) {
      if (is_outer) return append_edge(side, cell, outline);
      outline.push_back(at(column, row));
    };
    edge(j == 0, 0, i, i, j);
    edge(i + 1 == columns_, 1, j, i + 1, j);
    edge(j + 1 == rows_, 2, columns_ - 1 - i, i + 1, j + 1);
    edge(i == 0, 3, rows_ - 1 - j, i, j + 1);
    if (outline.size() == 4) {
      add_square(outline[0], outline[1], outline[2], outline[3]);
      return;
    }
    const std::uint32_t centre = add_point(surface(i, j, 0.5));
    for (std::size_t k = 0; k < outline.size(); ++k)
      mesh_.triangles.push_back({outline[k], outline[(k + 1) % outline.size()], centre});
  }

  /// Cut along the shorter diagonal.
  void add_square(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    const auto& points = mesh_.points;
    const Vec3 ac = points[c] - points[a], bd = points[d] - points[b];
    if (dot(ac, ac) <= dot(bd, bd)) {
      mesh_.triangles.push_back({a, b, c});
      mesh_.triangles.push_back({a, c, d});
    } else {
      mesh_.triangles.push_back({b, c, d});
      mesh_.triangles.push_back({b, d, a});
    }
  }

  const BezierNet& net_;
  const BezierDivision& division_;
  TriangleMesh mesh_;
  /// The mesh's point at each control point that is an end of curves.
  MeshPoints corners_;
  std::vector<MeshPoints> curves_;
  /// Of the patch at hand: its cells, its sides going round, the points within, row by row.
  const BezierPatch* patch_ = nullptr;
  std::size_t columns_ = 0, rows_ = 0;
  std::array<MeshPoints, 4> sides_;
  MeshPoints inner_;
  /// The corners of the cell at hand.
  MeshPoints outline_;
};

}  // namespace

std::variant<TriangleMesh, MeshFault> mesh_of(const BezierNet& net, double tolerance) {
  auto division = division_of(net, tolerance);
  if (auto* fault = std::get_if<MeshFault>(&division)) return std::move(*fault);
  return closed_mesh(Tessellator(net, std::get<BezierDivision>(division)).run());
}

}  // namespace graycube
