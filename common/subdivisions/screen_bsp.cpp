#include "subdivisions/screen_bsp.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "crossings/bsp_assembly.hpp"
#include "crossings/split_finder.hpp"

namespace graycube {
namespace {

/// How often the screen, and then the depth of one of its regions, is cut at most.
constexpr int kMostScreenCuts = 32;
constexpr int kMostDepthCuts = 24;
/// Cost of one step of the walk, in tests of a primitive. A cut of the screen costs more than what
/// it shows: every region of the screen is cut in depth, at much the same places as its neighbours,
/// and rays that cross the view pass one after the other.
constexpr double kScreenStepCost = 8;
constexpr double kDepthStepCost = 0.6;
/// How many primitives all leaf regions together hold at most: so many for each of the model's, and
/// more. What is left then isn't cut further.
constexpr std::size_t kMostCopies = 256;
constexpr std::size_t kMoreCopies = std::size_t{1} << 16;
/// Planes keep off the ends of bounds, which are grown already, by this share of the extent.
constexpr double kGap = 1e-12;

class Builder {
 public:
  Builder(const Model& model, const CameraSpace& space)
      : model_(model),
        space_(space),
        assembly_(model),
        most_copies_(kMostCopies * model.primitives.size() + kMoreCopies) {
    bounds_.reserve(model.primitives.size());
    for (const Primitive& p : model.primitives) {
      bounds_.push_back(space.bounds_of(p, model.delta));
    }
  }

  Bsp run() {
    const Aabb all = space_.everything();
    cut_around(0, all, restricted(content_of(model_), all), kScreen);
    return assembly_.finish();
  }

 private:
  /// The axes that a stage cuts: first ≤ axis < end.
  struct Stage {
    int first, end;
  };
  static constexpr Stage kScreen{0, 2};
  static constexpr Stage kDepth{2, 3};

  CellContent restricted(const CellContent& content, const Aabb& cell) const {
    const Aabb world = space_.world_box(cell).grown(model_.delta);
    return content.restricted([&](std::uint32_t primitive) {
      if (!bounds_[primitive].overlaps(cell)) return CellSide::kOutside;
      if (!cell.is_finite()) return CellSide::kCrosses;
      return classify(model_.primitives[primitive], model_.data(), world);
    });
  }

  /// Bounds of all ends of the content's bounds that are finite.
  Aabb finite_ends(const CellContent& content) const {
    Aabb ends = Aabb::nothing();
    content.for_each_literal([&](std::uint32_t primitive) {
      for (int a = 0; a < 3; ++a) {
        for (const double end : {bounds_[primitive].lo[a], bounds_[primitive].hi[a]}) {
          if (!std::isfinite(end)) continue;
          ends.lo[a] = std::min(ends.lo[a], end);
          ends.hi[a] = std::max(ends.hi[a], end);
        }
      }
    });
    return ends;
  }

  /// Cuts what is beyond all ends of bounds off, which leaves the stage a finite cell.
  void cut_around(std::uint32_t node, Aabb cell, CellContent content, Stage stage) {
    const Aabb ends = finite_ends(content);
    for (int axis = stage.first; axis < stage.end; ++axis) {
      if (ends.lo[axis] > ends.hi[axis]) continue;
      const double gap = 4 * kGap * larger(std::fabs(ends.lo[axis]), std::fabs(ends.hi[axis]));
      for (const bool upper : {false, true}) {
        const double at = upper ? ends.hi[axis] + gap : ends.lo[axis] - gap;
        if (!(at > cell.lo[axis] && at < cell.hi[axis])) continue;
        const auto [outer, inner] = halves_of(cell, axis, at, upper);
        const std::uint32_t child = assembly_.cut(node, axis, at);
        go_on(upper ? child + 1 : child, outer, restricted(content, outer), stage);
        content = restricted(content, inner);
        cell = inner;
        node = upper ? child : child + 1;
      }
    }
    cut(node, cell, std::move(content), stage, 0);
  }

  /// The two parts of a cell, that on the given side of the plane first.
  static std::pair<Aabb, Aabb> halves_of(const Aabb& cell, int axis, double at, bool upper_first) {
    Aabb lower = cell;
    lower.hi[axis] = at;
    Aabb upper = cell;
    upper.lo[axis] = at;
    return upper_first ? std::pair{upper, lower} : std::pair{lower, upper};
  }

  /// A stage is done with a cell: the screen's cells are cut in depth next.
  void go_on(std::uint32_t node, const Aabb& cell, CellContent content, Stage stage) {
    if (stage.end == kScreen.end && !content.items().empty()) {
      cut_around(node, cell, std::move(content), kDepth);
    } else {
      close(node, cell, content);
    }
  }

  void close(std::uint32_t node, const Aabb& cell, const CellContent& content) {
    copies_ += content.literal_count();
    assembly_.close(node, cell, content);
  }

  void cut(std::uint32_t node, const Aabb& cell, CellContent content, Stage stage, int depth) {
    const int most = stage.end == kScreen.end ? kMostScreenCuts : kMostDepthCuts;
    const Split split = content.items().empty() || depth >= most || copies_ > most_copies_
                            ? Split{}
                            : plane_for(cell, content, stage);
    if (split.axis < 0) {
      go_on(node, cell, std::move(content), stage);
      return;
    }
    const auto [lower, upper] = halves_of(cell, split.axis, split.at, false);
    CellContent below = restricted(content, lower);
    CellContent above = restricted(content, upper);
    content = {};
    const std::uint32_t child = assembly_.cut(node, split.axis, split.at);
    cut(child, lower, std::move(below), stage, depth + 1);
    cut(child + 1, upper, std::move(above), stage, depth + 1);
  }

  /// The stage's plane that costs least; none where any would cost more than the cell as it is.
  /// Costs are those of the surface-area heuristic: a screen region's area for the screen, in depth
  /// that of a box as wide as the cell in its middle.
  Split plane_for(const Aabb& cell, const CellContent& content, Stage stage) const {
    const bool is_screen = stage.end == kScreen.end;
    for (int a = stage.first; a < stage.end; ++a) {
      if (!std::isfinite(cell.lo[a]) || !std::isfinite(cell.hi[a])) return {};
    }
    const double width = is_screen ? 0 : width_of(cell);
    const auto flattened = [&](Aabb box) {
      for (int a = 0; a < 3; ++a) {
        if (a >= stage.first && a < stage.end) continue;
        box.lo[a] = 0;
        box.hi[a] = width;
      }
      return box;
    };
    double extent = 0;
    for (int a = stage.first; a < stage.end; ++a) {
      extent = larger(extent, larger(std::fabs(cell.lo[a]), std::fabs(cell.hi[a])));
    }
    SplitFinder finder(flattened(cell), kGap * extent,
                       is_screen ? kScreenStepCost : kDepthStepCost);
    content.for_each_literal(
        [&](std::uint32_t primitive) { finder.add(flattened(bounds_[primitive])); });
    const Split split = finder.best();
    return split.cost < static_cast<double>(finder.count()) ? split : Split{};
  }

  double width_of(const Aabb& cell) const {
    constexpr double kWide = 1e3;
    const double scale = space_.is_perspective() ? 0.5 * std::fabs(cell.lo.z + cell.hi.z) : 1;
    const double extent = cell.hi.z - cell.lo.z;
    const double x = scale * (cell.hi.x - cell.lo.x), y = scale * (cell.hi.y - cell.lo.y);
    return std::min(std::sqrt(x * y), kWide * extent);
  }

  const Model& model_;
  const CameraSpace& space_;
  BspAssembly assembly_;
  std::vector<Aabb> bounds_;
  std::size_t copies_ = 0;
  std::size_t most_copies_;
};

}  // namespace

Bsp build_screen_bsp(const Model& model, const CameraSpace& space) {
  return Builder(model, space).run();
}

}  // namespace graycube
