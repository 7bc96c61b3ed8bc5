// The syntax tree of a .csg file: modules with arguments and children. Their meaning is decided
// elsewhere.
#pragma once

#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "formats/openscad/language/report.hpp"

namespace graycube {

struct ScadValue;
using ScadList = std::vector<ScadValue>;

/// undef, a truth value, a number (±infinity and NaN included), a string or a list.
struct ScadValue {
  std::variant<std::monostate, bool, double, std::string, ScadList> value;

  bool is_undef() const { return std::holds_alternative<std::monostate>(value); }
  const bool* boolean() const { return std::get_if<bool>(&value); }
  const double* number() const { return std::get_if<double>(&value); }
  const ScadList* list() const { return std::get_if<ScadList>(&value); }
};

/// `name` is empty for a positional argument.
struct ScadArgument {
  std::string name;
  ScadValue value;
};

struct ScadModule {
  std::string name;
  int line = 0;
  /// `%` or `*` in front: drawn as a ghost in OpenSCAD's preview, or not at all; never part of the
  /// solid.
  bool left_out = false;
  /// `!` in front: the rest of the file doesn't count.
  bool root = false;
  /// The dimension of the solid or shape, 2 or 3; 0 if nothing in the module tells.
  int dimension = 0;
  std::vector<ScadArgument> arguments;
  std::vector<ScadModule> children;

  /// The last argument of this name, else the unnamed one number `position` (from 0; negative:
  /// none); null when it isn't given or is undef.
  const ScadValue* argument(std::string_view argument_name, int position = -1) const;
};

struct ScadLimits {
  std::size_t modules = kMaxOpenscadModules;
  std::size_t values = kMaxOpenscadValues;
};

/// The file's top level. After a syntax error the parser goes on at the next `;` or brace, to find
/// the others; past a limit it stops.
std::vector<ScadModule> parse_openscad(std::string_view text, OpenscadReport& report,
                                       const ScadLimits& limits = {});

}  // namespace graycube
