// The figures of extrusions, each evaluated once although it is asked for often: by the search for
// rounds that are flush with facets, by hulls, and by the import.
#pragma once

#include <map>
#include <optional>

#include "formats/openscad/flat/shape.hpp"

namespace graycube {

class KeptFigures {
 public:
  /// The union of the flat shapes in a module, which is told by its address. What there is to say
  /// of it is reported each time, unless the import is silent.
  std::optional<FlatShape> figure(const ScadModule& module, ScadImport& import);

 private:
  struct Kept {
    std::optional<FlatShape> figure;
    /// Whether there is anything to report.
    bool is_told = false;
  };
  std::map<const ScadModule*, Kept> kept_;
};

}  // namespace graycube
