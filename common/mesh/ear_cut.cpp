#include "mesh/ear_cut.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>

namespace graycube {
namespace {

/// Of polygons with more corners ears are looked for beside those that were cut.
constexpr std::size_t kMaxScannedCorners = 4096;

/// The corners that are left, in cells of a square grid of about one corner each.
class CornerGrid {
 public:
  explicit CornerGrid(std::span<const FacePoint> corners) : corners_(corners) {
    low_ = high_ = corners.front();
    for (const FacePoint& p : corners) {
      low_ = {std::min(low_.x, p.x), std::min(low_.y, p.y)};
      high_ = {std::max(high_.x, p.x), std::max(high_.y, p.y)};
    }
    side_ = std::max<std::size_t>(
        1, static_cast<std::size_t>(std::sqrt(static_cast<double>(corners.size()))));
    cells_.resize(side_ * side_);
    for (std::uint32_t i = 0; i < corners.size(); ++i)
      cells_[column(corners[i].x) + side_ * row(corners[i].y)].push_back(i);
  }

  void remove(std::uint32_t i) {
    auto& cell = cells_[column(corners_[i].x) + side_ * row(corners_[i].y)];
    const auto at = std::find(cell.begin(), cell.end(), i);
    *at = cell.back();
    cell.pop_back();
  }

  /// Whether some corner fulfils the test, among others all of those in the triangle.
  template <typename Test>
  bool any_in(const FacePoint& a, const FacePoint& b, const FacePoint& c, const Test& test) const {
    const std::size_t first = row(std::min({a.y, b.y, c.y})), last = row(std::max({a.y, b.y, c.y}));
    for (std::size_t r = first; r <= last; ++r) {
      double from = std::numeric_limits<double>::infinity(), to = -from;
      // A row or column more on each side makes up for rounding.
      const double low = row_height(r) - row_step(), high = row_height(r + 1) + row_step();
      widen(a, b, low, high, from, to);
      widen(b, c, low, high, from, to);
      widen(c, a, low, high, from, to);
      if (!(from <= to)) continue;
      const std::size_t end = column(to + column_step());
      for (std::size_t at = column(from - column_step()); at <= end; ++at) {
        const auto& cell = cells_[at + side_ * r];
        if (std::any_of(cell.begin(), cell.end(), test)) return true;
      }
    }
    return false;
  }

 private:
  std::size_t place(double v, double low, double high) const {
    const double share = (v - low) / (high - low) * static_cast<double>(side_);
    if (!(share > 0)) return 0;
    return std::min(side_ - 1, static_cast<std::size_t>(std::min(share, 1e9)));
  }
  std::size_t column(double x) const { return place(x, low_.x, high_.x); }
  std::size_t row(double y) const { return place(y, low_.y, high_.y); }
  double column_step() const { return (high_.x - low_.x) / static_cast<double>(side_); }
  double row_step() const { return (high_.y - low_.y) / static_cast<double>(side_); }
  double row_height(std::size_t r) const { return low_.y + static_cast<double>(r) * row_step(); }

  /// Widens [from, to] to what the side covers between two heights.
  static void widen(const FacePoint& p, const FacePoint& q, double low, double high, double& from,
                    double& to) {
    if (std::max(p.y, q.y) < low || std::min(p.y, q.y) > high) return;
    const auto at = [&](double y) {
      if (p.y == q.y) return p.x;
      return p.x + std::clamp((y - p.y) / (q.y - p.y), 0.0, 1.0) * (q.x - p.x);
    };
    const double both[] = {at(low), at(high)};
    const double flat[] = {p.x, q.x};
    for (const double x : p.y == q.y ? flat : both) {
      from = std::min(from, x);
      to = std::max(to, x);
    }
  }

  std::span<const FacePoint> corners_;
  FacePoint low_, high_;
  std::size_t side_ = 1;
  std::vector<std::vector<std::uint32_t>> cells_;
};

class EarCutter {
 public:
  explicit EarCutter(std::span<const FacePoint> corners)
      : corners_(corners),
        left_(corners.size()),
        next_(corners.size()),
        previous_(corners.size()),
        is_cut_(corners.size()),
        grid_(corners) {
    const auto n = static_cast<std::uint32_t>(corners.size());
    for (std::uint32_t i = 0; i < n; ++i) {
      next_[i] = (i + 1) % n;
      previous_[i] = (i + n - 1) % n;
    }
  }

  void run(std::vector<Triangle>& triangles) {
    if (left_ > kMaxScannedCorners) cut_candidates(triangles);
    scan(triangles);
    std::uint32_t at = first_left();
    // The triangle that is left begins with its lowest corner.
    while (previous_[at] < at) at = next_[at];
    triangles.push_back({at, next_[at], previous_[at]});
  }

 private:
  void cut(std::uint32_t at, std::vector<Triangle>& triangles) {
    triangles.push_back({previous_[at], at, next_[at]});
    next_[previous_[at]] = next_[at];
    previous_[next_[at]] = previous_[at];
    is_cut_[at] = true;
    grid_.remove(at);
    --left_;
  }
  std::uint32_t first_left() const {
    const auto at = std::find(is_cut_.begin(), is_cut_.end(), false);
    return static_cast<std::uint32_t>(at - is_cut_.begin());
  }

  /// Goes round, looking for the next ear.
  void scan(std::vector<Triangle>& triangles) {
    std::uint32_t at = first_left();
    while (left_ > 3) {
      std::size_t tried = 0;
      while (tried < left_ && tests_ < kMaxEarTests && !is_ear(at)) at = next_[at], ++tried;
      cut(at, triangles);
      at = next_[next_[at]];
    }
  }

  /// Cuts ears as long as there are any, without going round for each: only the neighbours of one
  /// that is cut are looked at again, and all corners when none is left to look at.
  void cut_candidates(std::vector<Triangle>& triangles) {
    for (std::size_t before = 0; left_ > 3 && left_ != before && tests_ < kMaxEarTests;) {
      before = left_;
      std::deque<std::uint32_t> open;
      for (std::uint32_t i = 0; i < is_cut_.size(); ++i) {
        if (!is_cut_[i]) open.push_back(i);
      }
      while (!open.empty() && left_ > 3 && tests_ < kMaxEarTests) {
        const std::uint32_t at = open.front();
        open.pop_front();
        if (is_cut_[at] || !is_ear(at)) continue;
        cut(at, triangles);
        open.push_back(previous_[at]);
        open.push_back(next_[at]);
      }
    }
  }

  bool is_ear(std::uint32_t ib) {
    ++tests_;
    const std::uint32_t ia = previous_[ib], ic = next_[ib];
    const FacePoint &a = corners_[ia], &b = corners_[ib], &c = corners_[ic];
    if (!(turn(a, b, c) > 0)) return false;
    return !grid_.any_in(a, b, c, [&](std::uint32_t j) {
      ++tests_;
      if (j == ia || j == ib || j == ic) return false;
      const FacePoint& p = corners_[j];
      const bool is_corner =
          (p.x == a.x && p.y == a.y) || (p.x == b.x && p.y == b.y) || (p.x == c.x && p.y == c.y);
      return !is_corner && turn(a, b, p) >= 0 && turn(b, c, p) >= 0 && turn(c, a, p) >= 0;
    });
  }

  std::span<const FacePoint> corners_;
  std::size_t left_;
  std::vector<std::uint32_t> next_, previous_;
  std::vector<bool> is_cut_;
  CornerGrid grid_;
  std::uint64_t tests_ = 0;
};

}  // namespace

void cut_ears(std::span<const FacePoint> corners, std::vector<Triangle>& triangles) {
  EarCutter(corners).run(triangles);
}

}  // namespace graycube
