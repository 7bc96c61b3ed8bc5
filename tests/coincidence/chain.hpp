// A way to a place: maps one after the other, as a file's nested `transform` lists give them, and other ways that
// lead to the same place by other arithmetic.
#pragma once

#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "csg/random_model.hpp"

namespace graycube::testing {

/// One entry of a transform list.
struct Step {
  enum class Kind { kTranslate, kRotate, kScale, kMatrix };
  Kind kind = Kind::kTranslate;
  /// Offset, axis or factors.
  Vec3 v;
  double angle_degrees = 0;
  Affine matrix;

  static Step translate(const Vec3& by) { return {Kind::kTranslate, by, 0, {}}; }
  static Step rotate(const Vec3& axis, double degrees) { return {Kind::kRotate, axis, degrees, {}}; }
  static Step scale(const Vec3& by) { return {Kind::kScale, by, 0, {}}; }
  static Step with_matrix(const Affine& m) { return {Kind::kMatrix, {}, 0, m}; }

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
using Chain = std::vector<Step>;

inline Affine map_of(const Chain& chain) {
  Affine map;
  for (const Step& s : chain) map = compose(s.map(), map);
  return map;
}

/// What of a chain may be drawn.
struct ChainOptions {
  enum class Turns {
    kQuarters,  ///< quarter turns, mirrors, powers of two: all arithmetic is exact
    kRigid,     ///< rotations and translations only
    kAny,
  };
  Turns turns = Turns::kAny;
  std::size_t most_steps = 5;
  /// How many times the size a last step may move things away.
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

inline Step any_step(Dice& dice, double size, ChainOptions::Turns turns) {
  using Turns = ChainOptions::Turns;
  const std::size_t kinds = turns == Turns::kRigid ? 3 : 6;
  switch (dice.below(kinds)) {
    case 0: return Step::translate(offset(dice, size, turns));
    case 1:
    case 2:
      if (turns == Turns::kQuarters) return Step::rotate(dice.axis(), 90.0 * static_cast<double>(1 + dice.below(3)));
      return Step::rotate(dice.one_in(2) ? dice.axis() : dice.unit_vector(), round_angle(dice));
    case 3: {
      Vec3 mirror{1, 1, 1};
      mirror[static_cast<int>(dice.below(3))] = -1;
      return Step::scale(mirror);
    }
    case 4: {
      if (turns == Turns::kQuarters) return Step::scale(dice.one_in(2) ? Vec3{2, 2, 2} : Vec3{1, 0.5, 2});
      const double s = dice.between(0.4, 2);
      return Step::scale(dice.one_in(2) ? Vec3{s, s, s} : Vec3{s, dice.between(0.5, 2), dice.between(0.5, 2)});
    }
    default:
      if (turns == Turns::kQuarters) return Step::rotate(dice.axis(), 180);
      return Step::with_matrix(shear_of(dice));
  }
}

}  // namespace chains

/// A place for things of about the given size.
inline Chain some_chain(Dice& dice, double size, const ChainOptions& options) {
  Chain chain;
  const std::size_t count = 1 + dice.below(options.most_steps);
  for (std::size_t i = 0; i < count; ++i) chain.push_back(chains::any_step(dice, size, options.turns));
  if (options.turns != ChainOptions::Turns::kQuarters) {
    chain.insert(chain.begin() + static_cast<std::ptrdiff_t>(dice.below(chain.size() + 1)),
                 Step::rotate(dice.unit_vector(), chains::round_angle(dice)));
  }
  if (options.far > 0) chain.push_back(Step::translate(options.far * size * dice.unit_vector()));
  return chain;
}

namespace chains {

/// A step and what takes it back, so that nothing happens.
inline std::pair<Step, Step> there_and_back(Dice& dice, double size) {
  switch (dice.below(4)) {
    case 0: {
      Vec3 mirror{1, 1, 1};
      mirror[static_cast<int>(dice.below(3))] = -1;
      return {Step::scale(mirror), Step::scale(mirror)};
    }
    case 1: {
      const double s = dice.one_in(2) ? 3 : dice.between(0.5, 2);
      const double back = 1 / s;
      return {Step::scale({s, s, s}), Step::scale({back, back, back})};
    }
    case 2: {
      const Vec3 axis = dice.one_in(2) ? dice.axis() : dice.unit_vector();
      const double a = round_angle(dice);
      return {Step::rotate(axis, a), Step::rotate(axis, -a)};
    }
    default: {
      const Vec3 by = size * dice.point(1);
      return {Step::translate(by), Step::translate(-by)};
    }
  }
}

/// The step in two.
inline std::pair<Step, Step> halves(Dice& dice, const Step& s) {
  const double share = dice.between(0.1, 0.9);
  switch (s.kind) {
    case Step::Kind::kTranslate: return {Step::translate(share * s.v), Step::translate(s.v - share * s.v)};
    case Step::Kind::kRotate: {
      const double first = dice.one_in(2) ? std::floor(share * s.angle_degrees) : share * s.angle_degrees;
      return {Step::rotate(s.v, first), Step::rotate(s.v, s.angle_degrees - first)};
    }
    case Step::Kind::kScale: {
      const Vec3 first{3, 0.7, 1 / s.v.z};
      return {Step::scale(first), Step::scale({s.v.x / first.x, s.v.y / first.y, s.v.z / first.z})};
    }
    default: return {s, Step::rotate({0, 0, 1}, 360)};
  }
}

inline void swap_with_translation(Chain& chain, std::size_t i) {
  Step& first = chain[i];
  Step& then = chain[i + 1];
  if (first.kind == Step::Kind::kTranslate && then.kind != Step::Kind::kTranslate) {
    const Affine map = then.map();
    const Step moved = Step::translate(map.point(first.v) - map.translation());
    first = then;
    then = moved;
  } else if (then.kind == Step::Kind::kTranslate && first.kind != Step::Kind::kTranslate) {
    const std::optional<Affine> back = first.map().inverse();
    if (!back) return;
    const Step moved = Step::translate(back->vector(then.v));
    then = first;
    first = moved;
  }
}

inline void rewrite_once(Chain& chain, Dice& dice, double size) {
  const std::size_t i = dice.below(chain.size());
  const auto at = chain.begin() + static_cast<std::ptrdiff_t>(i);
  const auto replace = [&](const std::pair<Step, Step>& by) {
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
      if (at->kind == Step::Kind::kRotate) *at = Step::rotate(-at->v, -at->angle_degrees);
      else replace(halves(dice, *at));
      return;
    case 3:
      if (i + 1 < chain.size()) swap_with_translation(chain, i);
      return;
    default:
      if (i + 1 == chain.size()) return;
      *at = Step::with_matrix(compose(chain[i + 1].map(), at->map()));
      chain.erase(at + 1);
  }
}

}  // namespace chains

/// Another way to the same place.
inline Chain rewritten(Chain chain, Dice& dice, double size, std::size_t times) {
  for (std::size_t i = 0; i < times; ++i) chains::rewrite_once(chain, dice, size);
  return chain;
}

/// The node brought there, on up to five levels of the tree with some steps each.
inline CsgNode placed(CsgNode node, const Chain& chain, Dice& dice) {
  constexpr std::size_t kMostLevels = 5;
  const std::size_t levels = 1 + dice.below(kMostLevels);
  std::size_t done = 0;
  for (std::size_t level = 0; level < levels; ++level) {
    const std::size_t end = level + 1 == levels ? chain.size() : done + dice.below(chain.size() - done + 1);
    if (end == done) continue;
    if (node.transform) node = operation(Operation::kUnion, {std::move(node)});
    node.transform = map_of({chain.begin() + static_cast<std::ptrdiff_t>(done), chain.begin() + static_cast<std::ptrdiff_t>(end)});
    done = end;
  }
  return node;
}

}  // namespace graycube::testing
