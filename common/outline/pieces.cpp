#include "outline/pieces.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace graycube {
namespace {

/// Parameters in (0, 1), in order.
class Turns {
 public:
  /// Adds those at which the coordinate turns back: the roots of its derivative's
  /// p (1 − v)² + 2 q v (1 − v) + r v² (a third of it).
  void add(const Cubic& c) {
    const double p = c.b[1] - c.b[0], q = c.b[2] - c.b[1], r = c.b[3] - c.b[2];
    const double square = p - 2 * q + r, half = q - p;  // square v² + 2 half v + p
    const double discriminant = half * half - square * p;
    if (!(discriminant > 0)) return;
    // Without cancellation.
    const double root = std::sqrt(discriminant);
    const double w = half >= 0 ? -(half + root) : root - half;
    add(w / square);
    add(p / w);
  }
  const double* begin() const { return at_.data(); }
  const double* end() const { return at_.data() + count_; }

 private:
  void add(double v) {
    if (!(v > 0 && v < 1)) return;
    std::size_t place = count_++;
    for (; place > 0 && at_[place - 1] > v; --place) at_[place] = at_[place - 1];
    at_[place] = v;
  }

  std::array<double, 4> at_{};
  std::size_t count_ = 0;
};

void add_pieces(OutlinePiece rest, std::vector<OutlinePiece>& out) {
  Turns turns;
  turns.add(rest.x);
  turns.add(rest.y);
  double cut = 0;
  for (const double v : turns) {
    const double of_rest = (v - cut) / (1 - cut);
    if (!(of_rest > 0 && of_rest < 1)) continue;
    const auto x = rest.x.split(of_rest);
    const auto y = rest.y.split(of_rest);
    out.push_back({x.first, y.first});
    rest = {x.second, y.second};
    cut = v;
  }
  out.push_back(rest);
}

}  // namespace

OutlinePoint OutlinePiece::tangent(double v) const {
  const auto has_direction = [](const OutlinePoint& d) { return d.x != 0 || d.y != 0; };
  OutlinePoint d{x.slope(v), y.slope(v)};
  if (has_direction(d)) return d;
  // Where control points coincide the curve has the direction of its points nearby.
  constexpr double kAside = 0x1p-20;
  const double aside = v + (0.5 - v) * kAside;
  d = {x.slope(aside), y.slope(aside)};
  return has_direction(d) ? d : OutlinePoint{x.b[3] - x.b[0], y.b[3] - y.b[0]};
}

OutlineBox OutlinePiece::box() const {
  return {{std::min(x.b[0], x.b[3]), std::min(y.b[0], y.b[3])},
          {std::max(x.b[0], x.b[3]), std::max(y.b[0], y.b[3])}};
}

std::vector<OutlinePiece> pieces_of(const OutlineLoops& loops) {
  std::vector<OutlinePiece> pieces;
  for (const OutlineLoop& loop : loops) {
    for (std::size_t i = 0; i + 2 < loop.size(); i += 3) {
      const OutlinePoint &a = loop[i], &b = loop[i + 1], &c = loop[i + 2];
      const OutlinePoint& d = loop[i + 3 < loop.size() ? i + 3 : 0];
      add_pieces({{{a.x, b.x, c.x, d.x}}, {{a.y, b.y, c.y, d.y}}}, pieces);
    }
  }
  return pieces;
}

}  // namespace graycube
