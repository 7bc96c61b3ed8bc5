#include "flat/simple_outlines.hpp"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <set>
#include <utility>

namespace graycube {
namespace {

constexpr std::uint32_t kNone = 0xFFFFFFFFu;

bool is_before(const FlatPoint& a, const FlatPoint& b) {
  return a.x != b.x ? a.x < b.x : a.y < b.y;
}

/// A side from its left to its right end. Corners and sides are numbered through all loops; side i
/// begins at corner i.
struct Side {
  FlatPoint left, right;
  std::uint32_t loop;
  /// Whether the loop passes it from left to right.
  bool is_forward;
};

/// Whether the sides have a point in common, other than one end of theirs.
bool meet(const Side& s, const Side& t) {
  const int a = orientation(s.left, s.right, t.left), b = orientation(s.left, s.right, t.right);
  const bool same_left = s.left == t.left, same_right = s.right == t.right;
  if (same_left || same_right) return a == 0 && b == 0;
  if (s.right == t.left || t.right == s.left) return false;
  if (a == 0 && b == 0) return !is_before(s.right, t.left) && !is_before(t.right, s.left);
  if (a * b > 0) return false;
  return orientation(t.left, t.right, s.left) * orientation(t.left, t.right, s.right) <= 0;
}

class Sweep {
 public:
  explicit Sweep(const FlatLoops& loops) : across_(Below{&sides_}), parent_(loops.size(), kNone) {
    for (std::uint32_t l = 0; l < loops.size(); ++l) {
      const auto first = static_cast<std::uint32_t>(sides_.size());
      const FlatLoop& loop = loops[l];
      for (std::size_t i = 0; i < loop.size(); ++i) {
        const FlatPoint &a = loop[i], &b = loop[(i + 1) % loop.size()];
        const bool is_forward = is_before(a, b);
        sides_.push_back({is_forward ? a : b, is_forward ? b : a, l, is_forward});
        corners_.push_back(a);
        previous_.push_back(i == 0 ? first + static_cast<std::uint32_t>(loop.size()) - 1
                                   : first + static_cast<std::uint32_t>(i) - 1);
      }
      is_hole_.push_back(false);
      is_counter_clockwise_.push_back(false);
      is_placed_.push_back(false);
    }
    place_.resize(sides_.size());
  }

  /// False as soon as sides meet.
  bool run() {
    std::vector<std::uint32_t> order(corners_.size());
    std::iota(order.begin(), order.end(), 0u);
    std::sort(order.begin(), order.end(), [&](std::uint32_t i, std::uint32_t j) {
      return is_before(corners_[i], corners_[j]);
    });
    for (std::size_t i = 1; i < order.size(); ++i) {
      if (corners_[order[i]] == corners_[order[i - 1]]) return false;
    }
    return std::all_of(order.begin(), order.end(), [&](std::uint32_t i) { return pass(i); });
  }

  bool is_counter_clockwise(std::uint32_t loop) const { return is_counter_clockwise_[loop]; }
  bool is_hole(std::uint32_t loop) const { return is_hole_[loop]; }
  /// The outline around a hole.
  std::uint32_t parent(std::uint32_t loop) const { return parent_[loop]; }

 private:
  /// The order of sides along the sweeping line. Sides that meet are compared somehow: they are
  /// neighbours then, and found.
  struct Below {
    const std::vector<Side>* sides;
    bool operator()(std::uint32_t i, std::uint32_t j) const {
      if (i == j) return false;
      const Side &s = (*sides)[i], &t = (*sides)[j];
      int turn = 0;
      if (s.left == t.left) {
        turn = orientation(s.left, s.right, t.right);
      } else if (is_before(s.left, t.left)) {
        turn = orientation(s.left, s.right, t.left);
        if (turn == 0) turn = orientation(s.left, s.right, t.right);
      } else {
        turn = -orientation(t.left, t.right, s.left);
        if (turn == 0) turn = -orientation(t.left, t.right, s.right);
      }
      return turn != 0 ? turn > 0 : i < j;
    }
  };
  using Across = std::set<std::uint32_t, Below>;

  bool pass(std::uint32_t corner) {
    const std::uint32_t two[] = {previous_[corner], corner};
    for (const std::uint32_t side : two) {
      if (sides_[side].right == corners_[corner] && !remove(side)) return false;
    }
    std::uint32_t lower = kNone;
    int begun = 0;
    for (const std::uint32_t side : two) {
      if (!(sides_[side].left == corners_[corner])) continue;
      if (!insert(side)) return false;
      if (lower == kNone || Below{&sides_}(side, lower)) lower = side;
      ++begun;
    }
    if (begun == 2 && !is_placed_[sides_[lower].loop]) find_parent(lower);
    return true;
  }

  bool insert(std::uint32_t side) {
    const auto [at, is_new] = across_.insert(side);
    if (!is_new) return false;
    place_[side] = at;
    if (at != across_.begin() && meet(sides_[*std::prev(at)], sides_[side])) return false;
    const auto next = std::next(at);
    return next == across_.end() || !meet(sides_[side], sides_[*next]);
  }
  bool remove(std::uint32_t side) {
    const auto next = across_.erase(place_[side]);
    if (next == across_.begin() || next == across_.end()) return true;
    return !meet(sides_[*std::prev(next)], sides_[*next]);
  }

  /// The loop begins at its leftmost corner, whose lower side is given: what lies below that side
  /// tells what is around the loop.
  void find_parent(std::uint32_t lower) {
    const std::uint32_t loop = sides_[lower].loop;
    is_placed_[loop] = true;
    is_counter_clockwise_[loop] = sides_[lower].is_forward;
    const auto at = place_[lower];
    if (at == across_.begin()) return;
    const Side& below = sides_[*std::prev(at)];
    const std::uint32_t other = below.loop;
    const bool is_within = below.is_forward == is_counter_clockwise_[other];
    // Within an outline is a hole, and beside a hole another; within a hole is an outline.
    is_hole_[loop] = is_within != is_hole_[other];
    if (is_hole_[loop]) parent_[loop] = is_within ? other : parent_[other];
  }

  std::vector<Side> sides_;
  FlatLoop corners_;
  std::vector<std::uint32_t> previous_;
  Across across_;
  std::vector<Across::iterator> place_;
  std::vector<std::uint32_t> parent_;
  std::vector<bool> is_hole_, is_counter_clockwise_, is_placed_;
};

}  // namespace

std::optional<std::vector<FlatRegion>> simple_regions(const FlatLoops& loops) {
  if (std::any_of(loops.begin(), loops.end(), [](const FlatLoop& l) { return l.size() < 3; }))
    return std::nullopt;
  Sweep sweep(loops);
  if (!sweep.run()) return std::nullopt;
  const auto turned = [&](std::uint32_t l) {
    FlatLoop loop = loops[l];
    if (sweep.is_counter_clockwise(l) == sweep.is_hole(l)) std::reverse(loop.begin(), loop.end());
    return loop;
  };
  std::vector<FlatRegion> regions;
  std::vector<std::size_t> region_of(loops.size());
  for (std::uint32_t l = 0; l < loops.size(); ++l) {
    if (sweep.is_hole(l)) continue;
    region_of[l] = regions.size();
    regions.push_back({turned(l), {}});
  }
  for (std::uint32_t l = 0; l < loops.size(); ++l) {
    if (sweep.is_hole(l)) regions[region_of[sweep.parent(l)]].holes.push_back(turned(l));
  }
  return regions;
}

}  // namespace graycube
