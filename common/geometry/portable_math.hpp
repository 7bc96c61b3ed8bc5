// Functions whose every bit is the same on every IEEE-754 machine. glibc picks FMA variants of pow,
// tan, sin and cos at run time, so a farm of mixed machines would disagree in the last bit; these
// use only
// +, −, ×, ÷ and sqrt, which the standard fixes (and the build forbids contraction).
#pragma once

namespace graycube {

/// Sine and cosine of an angle in degrees; multiples of 90° are exact. Error below 4 ulp for
/// |angle| ≤ 1e6.
double sin_degrees(double angle_degrees);
double cos_degrees(double angle_degrees);
/// Tangent of an angle in degrees, by the two above.
double tan_degrees(double angle_degrees);
/// base^exponent for base ≥ 0 and exponent ≥ 0; 0^0 = 1. Relative error below 1e-13 where the
/// result is a normal number; results below the smallest normal number become 0.
double portable_pow(double base, double exponent);
/// e^x. Relative error below 1e-15 where the result is a normal number; results below the smallest
/// normal number become 0.
double portable_exp(double x);
/// The angle in radians, 0 … π, whose cosine is given; what is beyond ±1 counts as ±1. Error below
/// 4 ulp.
double portable_acos(double cosine);

}  // namespace graycube
