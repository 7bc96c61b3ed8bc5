// The state that all parts of an import share.
#pragma once

#include <cstdint>
#include <set>
#include <string>

#include "formats/openscad/language/options.hpp"
#include "formats/openscad/language/report.hpp"
#include "formats/openscad/program/delegate.hpp"

namespace graycube {

class KeptFigures;

struct ScadImport {
  const OpenscadOptions& options;
  OpenscadReport& report;
  /// What it has been asked already it isn't asked again, so parts of an import share it.
  OpenscadDelegate& delegate;
  /// Significant digits of the matrices' numbers.
  std::uint32_t digits = kOpenscadDigits;
  /// The warnings that are given only once, and have been.
  std::set<std::string> told;
  /// Figures that are evaluated already; may be null.
  KeptFigures* figures = nullptr;
  /// Whether nobody reads the report.
  bool is_silent = false;

  void warn_once(int line, const std::string& message) {
    if (told.insert(message).second) report.warning(line, message);
  }
  /// Tells once for each line that a part is missing because of this. Parts can be asked for more
  /// than once.
  void leave_out_once(const std::string& kind, int line, const std::string& message) {
    if (told.insert(std::to_string(line) + message).second) report.leave_out(kind, line, message);
  }
  /// Warns that a module gives facets to the round solids in it.
  void warn_of_sides(const std::string& name, int line) {
    const char* around =
        options.facets ? "" : "; what is round around it is exact, unless it is flush with it";
    warn_once(line, name + "() takes what is round by OpenSCAD's sides" + around);
  }
};

}  // namespace graycube
