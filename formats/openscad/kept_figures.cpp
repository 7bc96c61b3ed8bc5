#include "formats/openscad/kept_figures.hpp"

#include <utility>

namespace graycube {

std::optional<FlatShape> KeptFigures::figure(const ScadModule& module, ScadImport& import) {
  auto kept = kept_.find(&module);
  if (kept == kept_.end()) {
    OpenscadReport report;
    ScadImport alone{import.options, report, import.delegate, import.digits, import.told};
    Kept made{flat_union(module.children, {}, alone, module.line), false};
    made.is_told = report.has_errors() || !report.take_warnings().empty();
    kept = kept_.emplace(&module, std::move(made)).first;
  }
  if (kept->second.is_told && !import.is_silent)
    return flat_union(module.children, {}, import, module.line);
  return kept->second.figure;
}

}  // namespace graycube
