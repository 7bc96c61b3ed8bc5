// The solids of a .csg file in world coordinates. Transforms are moved down to the leaves, unions
// and groups dissolve in the operation around them, empty operands are dropped as in OpenSCAD.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "formats/openscad/faceted_rounds.hpp"
#include "formats/openscad/language/options.hpp"
#include "formats/openscad/language/parser.hpp"
#include "formats/openscad/part.hpp"
#include "formats/openscad/program/delegate.hpp"
#include "formats/openscad/program/program.hpp"
#include "formats/openscad/rounds.hpp"

namespace graycube {

/// The file is the union of the parts. Every leaf has a material.
struct OpenscadParts {
  std::vector<Part> parts;
  std::vector<NamedMaterial> materials;
  /// The map of the matrices that stand around all parts, if there are any. Where it is kept apart
  /// it counts for no tolerance, since its rounded numbers move all parts alike. Reaches are in the
  /// world.
  std::optional<Affine> around_all;
};

/// A file's modules as parts. What takes long is done once, however often parts are asked for.
class OpenscadModules {
 public:
  /// Rotations are recovered from matrices of `digits` digits. Parts that `delegate` hasn't asked
  /// for yet are missing, untold.
  OpenscadModules(const std::vector<ScadModule>& modules, const OpenscadOptions& options,
                  std::uint32_t digits, OpenscadDelegate& delegate);

  /// `keeps_apart`: matrices that stand around all parts are not moved down to the leaves.
  OpenscadParts parts(bool keeps_apart, OpenscadReport& report);
  /// Whether round solids get facets, to be flush with those of others.
  bool has_faceted_rounds() const { return !faceted_.empty(); }

 private:
  const std::vector<ScadModule>& modules_;
  const OpenscadOptions& options_;
  std::uint32_t digits_;
  OpenscadDelegate& delegate_;
  KeptFigures figures_;
  ExactForms forms_;
  FacetedRounds faceted_;
};

}  // namespace graycube
