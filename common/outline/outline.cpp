#include "outline/outline.hpp"

#include <algorithm>
#include <utility>

#include "outline/crossings.hpp"

namespace graycube {
namespace {

OutlineBox union_of(const OutlineBox& a, const OutlineBox& b) {
  return {{std::min(a.lo.x, b.lo.x), std::min(a.lo.y, b.lo.y)},
          {std::max(a.hi.x, b.hi.x), std::max(a.hi.y, b.hi.y)}};
}

bool overlap(const OutlineBox& a, const OutlineBox& b) {
  return a.lo.x <= b.hi.x && b.lo.x <= a.hi.x && a.lo.y <= b.hi.y && b.lo.y <= a.hi.y;
}

/// Whether the piece may have a point in the rectangle; halves of it are looked at, so many times
/// over.
bool may_touch_piece(const OutlinePiece& piece, const OutlineBox& rectangle, int halvings) {
  if (!overlap(piece.box(), rectangle)) return false;
  if (halvings == 0) return true;
  const auto x = piece.x.split(0.5);
  const auto y = piece.y.split(0.5);
  return may_touch_piece({x.first, y.first}, rectangle, halvings - 1) ||
         may_touch_piece({x.second, y.second}, rectangle, halvings - 1);
}

/// A monotonic coordinate less a level, whose sign changes once.
struct LevelArc {
  Cubic rise;
  bool is_negative(double v) const { return value(v) < 0; }
  double value(double v) const { return rise.at(v); }
  double slope(double v) const { return rise.slope(v); }
};

}  // namespace

struct Outline::Data {
  explicit Data(OutlineLoops given) : loops(std::move(given)), pieces(pieces_of(loops)) {
    if (pieces.empty()) return;
    auto& boxes = levels.emplace_back();
    for (const OutlinePiece& piece : pieces) boxes.push_back(piece.box());
    while (levels.back().size() > kWidth) add_level();
  }

  void add_level() {
    std::vector<OutlineBox> above;
    const std::vector<OutlineBox>& below = levels.back();
    for (std::size_t i = 0; i < below.size(); ++i) {
      if (i % kWidth == 0) above.push_back(below[i]);
      above.back() = union_of(above.back(), below[i]);
    }
    levels.push_back(std::move(above));
  }

  OutlineLoops loops;
  std::vector<OutlinePiece> pieces;
  Levels levels;
};

Outline::Outline() {
  static const auto nothing = std::make_shared<const Data>(OutlineLoops{});
  data_ = nothing;
}
Outline::Outline(OutlineLoops loops) : data_(std::make_shared<const Data>(std::move(loops))) {}

const OutlineLoops& Outline::loops() const { return data_->loops; }
std::span<const OutlinePiece> Outline::pieces() const { return data_->pieces; }
const Outline::Levels& Outline::levels() const { return data_->levels; }

std::size_t Outline::memory_bytes() const {
  std::size_t bytes = sizeof(Data) + data_->pieces.capacity() * sizeof(OutlinePiece);
  for (const OutlineLoop& loop : data_->loops) bytes += loop.capacity() * sizeof(OutlinePoint);
  for (const auto& boxes : data_->levels) bytes += boxes.capacity() * sizeof(OutlineBox);
  return bytes;
}

bool Outline::contains(const OutlinePoint& p) const {
  bool is_inside = false;
  const auto meets = [&](const OutlineBox& box) {
    return (box.lo.y < p.y) != (box.hi.y < p.y) && box.hi.x > p.x;
  };
  each_piece(meets, [&](const OutlinePiece& piece) {
    LevelArc arc{piece.y};
    for (double& y : arc.rise.b) y -= p.y;
    const double v = sign_change(arc, arc.rise.b[0] < 0);
    if (piece.box().lo.x > p.x || piece.x.at(v) > p.x) is_inside = !is_inside;
  });
  return is_inside;
}

bool Outline::may_touch(const OutlineBox& rectangle) const {
  constexpr int kHalvings = 6;
  bool touches = false;
  const auto meets = [&](const OutlineBox& box) { return !touches && overlap(box, rectangle); };
  each_piece(meets, [&](const OutlinePiece& piece) {
    touches = touches || may_touch_piece(piece, rectangle, kHalvings);
  });
  return touches;
}

}  // namespace graycube
