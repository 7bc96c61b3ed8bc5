// hull() and minkowski() of solids with round parts exact.
#pragma once

#include <cstdint>
#include <map>
#include <variant>

#include "formats/openscad/flat/shape.hpp"
#include "formats/openscad/hulls/round_solid.hpp"
#include "formats/openscad/kept_figures.hpp"

namespace graycube {

/// The result for a module: that there is no exact form, that it has no volume, or a solid.
struct NoExactForm {};
struct EmptySolid {};
using ExactSolid = std::variant<NoExactForm, EmptySolid, RoundSolid>;

/// The hull of everything in a module that holds something round. There is no exact form with
/// nothing round in it, with balls and discs together that have no common axis, under maps that
/// make them unlike, and beyond the limits of round_hull.hpp; then nothing is reported.
ExactSolid exact_hull(const ScadModule& module, ScadImport& import);

/// The Minkowski sum, when each operand is a union of convex solids, or all are upright prisms of
/// flat shapes whose sum is exact, perhaps with a ball. Without an exact form nothing is reported.
ExactSolid exact_minkowski(const ScadModule& module, ScadImport& import);

/// The exact forms of hull()s and minkowski()s, which are asked for twice: when round solids that
/// are flush with others' facets are looked for, and when a module is imported. Modules are told by
/// their addresses.
class ExactForms {
 public:
  ExactForms(const OpenscadOptions& options, OpenscadDelegate& delegate, std::uint32_t digits,
             KeptFigures& figures)
      : options_(options), delegate_(delegate), digits_(digits), figures_(figures) {}

  /// Whether the module has an exact form, or no volume. Reports nothing.
  bool has_form(const ScadModule& module);
  /// The module's form. What there is to say of it is reported.
  ExactSolid form(const ScadModule& module, ScadImport& import) const;

 private:
  const OpenscadOptions& options_;
  OpenscadDelegate& delegate_;
  std::uint32_t digits_;
  KeptFigures& figures_;
  /// The forms of which there is nothing to report.
  std::map<const ScadModule*, ExactSolid> known_;
};

}  // namespace graycube
