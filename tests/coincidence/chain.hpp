// Ways to a place: maps one after the other, as a file's nested `transform` lists give them, and
// other ways that lead to the same place by other arithmetic.
#pragma once

#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "csg/random_model.hpp"

namespace graycube::testing {

/// One entry of a transform list.
struct Move {
  enum class Kind { kTranslate, kRotate, kScale, kMatrix };
  Kind kind = Kind::kTranslate;
  /// The offset, the axis or the factors.
  Vec3 v;
  double angle_degrees = 0;
  Affine matrix;

  static Move translate(const Vec3& by) { return {Kind::kTranslate, by, 0, {}}; }
  static Move rotate(const Vec3& axis, double degrees) {
    return {Kind::kRotate, axis, degrees, {}};
  }
  static Move scale(const Vec3& by) { return {Kind::kScale, by, 0, {}}; }
  static Move with_matrix(const Affine& m) { return {Kind::kMatrix, {}, 0, m}; }

  Affine map() const {
    switch (kind) {
      case Kind::kTranslate: return translation(v);
      case Kind::kRotate: return rotation(v, angle_degrees);
      case Kind::kScale: return scaling(v);
      default: return matrix;
    }
  }
  bool is_rigid() const { return kind == Kind::kTranslate || kind == Kind::kRotate; }
};

/// Steps in the order in which they apply.
using Chain = std::vector<Move>;

inline Affine map_of(const Chain& chain) {
  Affine map;
  for (const Move& s : chain) map = compose(s.map(), map);
  return map;
}

/// The limits within which a chain is drawn.
struct ChainOptions {
  enum class Turns {
    kQuarters,  ///< quarter turns, mirrors, powers of two: all arithmetic is exact
    kRigid,     ///< rotations and translations only
    kAny,
  };
  Turns turns = Turns::kAny;
  std::size_t most_moves = 5;
  /// How many times the size a last move may move things away.
  double far = 0;
};

namespace chains {

inline Affine shear_of(Dice& dice) {
  Affine a;
  const std::size_t row = dice.below(3);
  a.m[row][(row + 1 + dice.below(2)) % 3] = dice.between(-0.5, 0.5);
  return a;
}

inline double round_angle(Dice& dice) {
  return dice.one_in(2) ? 5 * (1 + static_cast<double>(dice.below(71))) : dice.between(1, 359);
}

inline Vec3 offset(Dice& dice, double size, ChainOptions::Turns turns) {
  return turns == ChainOptions::Turns::kQuarters ? size * dice.grid_point(2) : size * dice.point(2);
}

inline Move any_move(Dice& dice, double size, ChainOptions::Turns turns) {
  using Turns = ChainOptions::Turns;
  const std::size_t kinds = turns == Turns::kRigid ? 3 : 6;
  switch (dice.below(kinds)) {
    case 0: return Move::translate(offset(dice, size, turns));
    case 1:
    case 2:
      if (turns == Turns::kQuarters)
        return Move::rotate(dice.axis(), 90.0 * static_cast<double>(1 + dice.below(3)));
      return Move::rotate(dice.one_in(2) ? dice.axis() : dice.unit_vector(), round_angle(dice));
    case 3: {
      Vec3 mirror{1, 1, 1};
      mirror[static_cast<int>(dice.below(3))] = -1;
      return Move::scale(mirror);
    }
    case 4: {
      if (turns == Turns::kQuarters)
        return Move::scale(dice.one_in(2) ? Vec3{2, 2, 2} : Vec3{1, 0.5, 2});
      const double s = dice.between(0.4, 2);
      return Move::scale(dice.one_in(2) ? Vec3{s, s, s}
                                        : Vec3{s, dice.between(0.5, 2), dice.between(0.5, 2)});
    }
    default:
      if (turns == Turns::kQuarters) return Move::rotate(dice.axis(), 180);
      return Move::with_matrix(shear_of(dice));
  }
}

}  // namespace chains

/// A random way to a place, for solids of about the given size.
inline Chain some_chain(Dice& dice, double size, const ChainOptions& options) {
  Chain chain;
  const std::size_t count = 1 + dice.below(options.most_moves);
  for (std::size_t i = 0; i < count; ++i)
    chain.push_back(chains::any_move(dice, size, options.turns));
  if (options.turns != ChainOptions::Turns::kQuarters) {
    chain.insert(chain.begin() + static_cast<std::ptrdiff_t>(dice.below(chain.size() + 1)),
                 Move::rotate(dice.unit_vector(), chains::round_angle(dice)));
  }
  if (options.far > 0) chain.push_back(Move::translate(options.far * size * dice.unit_vector()));
  return chain;
}

namespace chains {

/// A move and its inverse, so that nothing happens in all.
inline std::pair<Move, Move> there_and_back(Dice& dice, double size) {
  switch (dice.below(5)) {
    case 0: {
      Vec3 mirror{1, 1, 1};
      mirror[static_cast<int>(dice.below(3))] = -1;
      return {Move::scale(mirror), Move::scale(mirror)};
    }
    case 4: {
      const Vec3 s{3, 0.7, dice.between(0.5, 2)};
      return {Move::scale(s), Move::scale({1 / s.x, 1 / s.y, 1 / s.z})};
    }
    case 1: {
      const double s = dice.one_in(2) ? 3 : dice.between(0.5, 2);
      const double back = 1 / s;
      return {Move::scale({s, s, s}), Move::scale({back, back, back})};
    }
    case 2: {
      const Vec3 axis = dice.one_in(2) ? dice.axis() : dice.unit_vector();
      const double a = round_angle(dice);
      return {Move::rotate(axis, a), Move::rotate(axis, -a)};
    }
    default: {
      const Vec3 by = size * dice.point(1);
      return {Move::translate(by), Move::translate(-by)};
    }
  }
}

/// The move as two moves.
inline std::pair<Move, Move> halves(Dice& dice, const Move& s) {
  const double share = dice.between(0.1, 0.9);
  switch (s.kind) {
    case Move::Kind::kTranslate:
      return {Move::translate(share * s.v), Move::translate(s.v - share * s.v)};
    case Move::Kind::kRotate: {
      const double first =
          dice.one_in(2) ? std::floor(share * s.angle_degrees) : share * s.angle_degrees;
      return {Move::rotate(s.v, first), Move::rotate(s.v, s.angle_degrees - first)};
    }
    case Move::Kind::kScale: {
      const Vec3 first{3, 0.7, 1 / s.v.z};
      return {Move::scale(first), Move::scale({s.v.x / first.x, s.v.y / first.y, s.v.z / first.z})};
    }
    default: return {s, Move::rotate({0, 0, 1}, 360)};
  }
}

inline void swap_with_translation(Chain& chain, std::size_t i) {
  Move& first = chain[i];
  Move& then = chain[i + 1];
  if (first.kind == Move::Kind::kTranslate && then.kind != Move::Kind::kTranslate) {
    const Affine map = then.map();
    const Move moved = Move::translate(map.point(first.v) - map.translation());
    first = then;
    then = moved;
  } else if (then.kind == Move::Kind::kTranslate && first.kind != Move::Kind::kTranslate) {
    const std::optional<Affine> back = first.map().inverse();
    if (!back) return;
    const Move moved = Move::translate(back->vector(then.v));
    then = first;
    first = moved;
  }
}

inline void rewrite_once(Chain& chain, Dice& dice, double size) {
  const std::size_t i = dice.below(chain.size());
  const auto at = chain.begin() + static_cast<std::ptrdiff_t>(i);
  const auto replace = [&](const std::pair<Move, Move>& by) {
    *at = by.second;
    chain.insert(at, by.first);
  };
  switch (dice.below(5)) {
    case 0: {
      const auto nothing = there_and_back(dice, size);
      chain.insert(at, {nothing.first, nothing.second});
      return;
    }
    case 1: return replace(halves(dice, *at));
    case 2:
      if (at->kind == Move::Kind::kRotate)
        *at = Move::rotate(-at->v, -at->angle_degrees);
      else
        replace(halves(dice, *at));
      return;
    case 3:
      if (i + 1 < chain.size()) swap_with_translation(chain, i);
      return;
    default:
      if (i + 1 == chain.size()) return;
      *at = Move::with_matrix(compose(chain[i + 1].map(), at->map()));
      chain.erase(at + 1);
  }
}

}  // namespace chains

/// Another way to the same place.
inline Chain rewritten(Chain chain, Dice& dice, double size, std::size_t times) {
  for (std::size_t i = 0; i < times; ++i) chains::rewrite_once(chain, dice, size);
  return chain;
}

/// The node brought to its place, on up to five levels of the tree with some moves each.
inline CsgNode placed(CsgNode node, const Chain& chain, Dice& dice) {
  constexpr std::size_t kMostLevels = 5;
  const std::size_t levels = 1 + dice.below(kMostLevels);
  std::size_t done = 0;
  for (std::size_t level = 0; level < levels; ++level) {
    const std::size_t end =
        level + 1 == levels ? chain.size() : done + dice.below(chain.size() - done + 1);
    if (end == done) continue;
    if (node.transform) node = operation(Operation::kUnion, {std::move(node)});
    node.transform = map_of({chain.begin() + static_cast<std::ptrdiff_t>(done),
                             chain.begin() + static_cast<std::ptrdiff_t>(end)});
    done = end;
  }
  return node;
}

}  // namespace graycube::testing
