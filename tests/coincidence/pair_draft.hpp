// Tools that make the parts of a pair: one chain of maps, lengths, columns, and two ways to tell a
// part.
#pragma once

#include <cmath>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

#include "coincidence/columns.hpp"
#include "coincidence/flush_pair.hpp"
#include "coincidence/retold.hpp"

namespace graycube::testing {

struct PairOptions {
  ChainOptions::Turns turns = ChainOptions::Turns::kAny;
  /// Sizes may be other than 1, and places far from the origin.
  bool is_any_size = true;
  /// The longer scene's parts have their own ways and numbers, too.
  bool tells_longer_anew = false;
  /// Round solids may be told as shapes of other kinds (Retelling).
  bool tells_across_kinds = false;
  /// The most moves of the chain that leads to the pair's place.
  std::size_t most_moves = 5;
  /// How parts are told; by default in other numbers, by a way of their own.
  std::function<CsgNode(const CsgNode&, const Chain&)> telling{};

  bool is_exact() const { return turns == ChainOptions::Turns::kQuarters; }
};

/// A pair under construction; the makers of its parts draw from it.
class PairDraft {
 public:
  PairDraft(std::uint64_t seed, PairKind kind, PairOptions options)
      : dice(seed * 2 + 1), telling_dice(seed * 2), options_(std::move(options)) {
    pair.seed = seed;
    pair.kind = kind;
    ChainOptions how{options_.turns, options_.most_moves, 0};
    if (options_.is_any_size && !is_exact()) {
      constexpr std::array<double, 7> kUnits{1, 25.4, 1000, 1e-3, 100, 1e-6, 1e-9};
      if (dice.one_in(2)) unit = kUnits[dice.below(kUnits.size())];
      constexpr std::array<double, 4> kFar{1e3, 1e4, 1e5, 1e6};
      if (dice.one_in(5)) how.far = kFar[dice.below(kFar.size())];
    }
    chain = some_chain(dice, unit, how);
  }

  bool is_exact() const { return options_.is_exact(); }

  double length(double lo, double hi) {
    const double at = dice.between(lo, hi);
    return unit * (is_exact() ? std::ceil(at * 256) / 256 : at);
  }
  Move some_turn() {
    if (is_exact()) return Move::rotate(dice.axis(), 90);
    return Move::rotate(dice.unit_vector(), chains::round_angle(dice));
  }
  /// The part at its place, by the chain as it is.
  CsgNode plain(const CsgNode& node) {
    return options_.tells_longer_anew ? told(node) : transformed(node, map_of(chain));
  }
  /// The part at its place, by another way and in other numbers.
  CsgNode told(const CsgNode& node) {
    if (options_.telling) return options_.telling(node, chain);
    if (is_exact()) return placed(node, chain, telling_dice);
    const Chain way = rewritten(chain, telling_dice, unit, 1 + telling_dice.below(6));
    note_difference(map_of(way));
    return told_anew(node, way, telling_dice, options_.tells_across_kinds);
  }
  Column some_column(double x, double y, double r, const Stretch& stretch) {
    return {some_kind(r, stretch), x, y, r, stretch, dice, is_exact()};
  }
  /// A column that is no ring, so that there is room in it.
  Column body(const Stretch& stretch) {
    for (;;) {
      const Column c = some_column(0, 0, unit, stretch);
      if (c.kind() != ColumnKind::kTorus) return c;
    }
  }
  Stretch some_stretch() {
    const double h = dice.one_in(2) ? length(0.04, 0.1) : length(0.2, 0.6);
    return {0, h, 0.25 * h};
  }
  /// One to four columns within the inner disc of a body of radius 1, apart from each other.
  std::vector<Column> cutters(const Stretch& stretch) {
    std::vector<Column> found;
    if (dice.one_in(2)) {
      found.push_back(
          some_column(length(-0.1, 0.1), length(-0.1, 0.1), length(0.15, 0.25), stretch));
      return found;
    }
    const std::size_t count = 2 + dice.below(3);
    for (std::size_t i = 0; i < count; ++i) {
      const double x = (i % 2 == 0 ? 1 : -1) * length(0.3, 0.33), y = length(-0.02, 0.02);
      const double r = length(0.07, 0.11);
      found.push_back(i < 2 ? some_column(x, y, r, stretch) : some_column(y, x, r, stretch));
    }
    return found;
  }
  Site& note_site(const Stretch& stretch, std::vector<double> heights) {
    pair.sites.push_back({map_of(chain), 1.55 * unit, stretch.hi, {}, std::move(heights)});
    return pair.sites.back();
  }
  void note_columns(const std::vector<Column>& columns) {
    for (const Column& c : columns) pair.sites.back().discs.push_back({c.x(), c.y(), c.outer()});
  }

  /// Dice that decide what is made, and dice that decide how it is told.
  Dice dice, telling_dice;
  FlushPair pair;
  double unit = 1;
  Chain chain;

 private:
  void note_difference(const Affine& other) {
    const Affine map = map_of(chain);
    double difference = 0, reach = 0;
    for (int i = 0; i < 8; ++i) {
      const Vec3 corner = unit * Aabb{{-1, -1, 0}, {1, 1, 1}}.corner(i);
      difference = std::fmax(difference, max_abs(map.point(corner) - other.point(corner)));
      reach = std::fmax(reach, max_abs(map.point(corner)));
    }
    const double ulps = difference / (std::numeric_limits<double>::epsilon() * reach);
    pair.ways_differ_ulps = std::fmax(pair.ways_differ_ulps, ulps);
  }

  ColumnKind some_kind(double r, const Stretch& stretch) {
    if (is_exact()) return dice.one_in(2) ? ColumnKind::kBox : ColumnKind::kCylinder;
    const auto kind = static_cast<ColumnKind>(dice.below(kColumnKinds));
    return Column::fits(kind, r, stretch) ? kind : ColumnKind::kCylinder;
  }

  PairOptions options_;
};

}  // namespace graycube::testing
