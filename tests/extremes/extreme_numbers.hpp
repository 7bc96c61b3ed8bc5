// Numbers of every size that a double has, from dice.
#pragma once

#include <array>
#include <charconv>
#include <cmath>
#include <string>

#include "csg/dice.hpp"

namespace graycube::testing {

/// Most exponents lie where pictures are still possible.
inline double extreme_power(Dice& dice) {
  constexpr std::array kReaches{20.0, 20.0, 62.0, 300.0};
  const double reach = kReaches[dice.below(kReaches.size())];
  return std::pow(10.0, dice.between(-reach, reach));
}

/// A number in the place of `was`: of another size, nearly the same, or one at an end of a range.
inline double extreme_number(Dice& dice, double was) {
  constexpr std::array kSpecial{0.0,     5e-324,
                                1e-310,  2.2250738585072014e-308,
                                1e-160,  1e-10,
                                1e15,    1e16,
                                1e30,    9007199254740993.0,
                                1e154,   1e300,
                                1.7e308, 1e-15,
                                1e20,    3.4e38};
  switch (dice.below(5)) {
    case 0: return dice.sign() * kSpecial[dice.below(kSpecial.size())];
    case 1: return was * (1 + dice.sign() * std::pow(10.0, dice.between(-17, -8)));
    case 2: return was * extreme_power(dice);
    default: return dice.sign() * extreme_power(dice);
  }
}

inline std::string written(double v) {
  std::array<char, 32> digits;
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), v).ptr;
  return {digits.data(), end};
}

}  // namespace graycube::testing
