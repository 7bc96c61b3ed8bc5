// Finds what is round in a file but gets OpenSCAD's facets, because it is flush with facets that
// stand there already: with those of a hull() or offset() without an exact form, or of a mesh of
// OpenSCAD's. So a bore as wide as the boss around it has the boss's sides, and leaves no
// crescents.
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <vector>

#include "formats/openscad/flat/shape.hpp"
#include "formats/openscad/hulls/facet_edges.hpp"
#include "formats/openscad/language/parser.hpp"
#include "formats/openscad/program/import.hpp"
#include "formats/openscad/round_groups.hpp"
#include "formats/openscad/rounds.hpp"

namespace graycube {

class FacetedRounds {
 public:
  /// Looks for facets, and for round solids that are flush with them, in a whole file. Reports
  /// nothing. The import's report is not used; its program is asked for meshes.
  FacetedRounds(const std::vector<ScadModule>& modules, const OpenscadOptions& options,
                std::uint32_t digits, OpenscadDelegate& delegate, KeptFigures& figures,
                ExactForms& forms);

  bool empty() const { return rings_.empty(); }
  /// Whether a solid that for_each_solid() visits has a round surface that gets facets.
  bool touch(const ScadModule& module, const Affine& to_world) const;
  /// Whether with_facets() may change the figure of an upright linear_extrude().
  bool change_figure(const ScadModule& module, const Affine& to_world) const;
  /// A figure that is extruded upright, with facets for its circles that get them. Errors name
  /// `line`.
  FlatShape with_facets(FlatShape figure, const Affine& to_world, ScadImport& import,
                        int line) const;
  /// Moves corners of OpenSCAD's meshes, which are rounded, to those of the rounds that get facets.
  /// Points that are `flat` stay in the plane z = 0.
  void move_corners(std::vector<Vec3>& points, const Affine& to_world, bool flat = false) const;
  /// The same for upright prisms, whose corners Clipper rounds.
  void move_prisms(CsgNode& solid, const Affine& to_world) const;

 private:
  struct Solid;

  void look_at(const ScadModule& solid, const Affine& to_world, std::vector<Solid>& solids);
  void add_mesh(const ScadModule& solid, const Affine& to_world);
  void add_outlines(const FlatShape& figure, const Affine& to_world);
  void add_turned_outlines(const ScadModule& solid, const Affine& to_world);
  void add_taper(const ScadModule& solid, const Affine& to_world);
  bool is_room_for(std::size_t size) const;
  bool is_facet_there(const RoundRing& ring);
  void add_flush(const ScadModule& solid, const Affine& to_world);
  void spread(std::vector<Solid>& solids);

  std::vector<RoundGroup> groups_of(const ScadModule& solid, const Affine& to_world) const;
  using Rings = std::multimap<std::size_t, RoundRing>;
  bool has(const Rings& rings, const RoundRing& ring) const;
  bool has_any(const RoundGroup& group) const;
  void add(const RoundGroup& group);
  FlatShape replaced(FlatShape figure, const Affine& to_world, ScadImport& import, int line) const;

  const OpenscadOptions& options_;
  std::uint32_t digits_;
  OpenscadDelegate& delegate_;
  KeptFigures& figures_;
  ExactForms& forms_;
  /// How far coordinates may be off, relative to their size.
  double share_;
  /// The facets that stand there already, until all that is flush with them is found.
  std::vector<FacetEdges> facets_;
  /// The cones of extrusions that are meshes, until then as well, and these extrusions.
  Rings tapers_;
  std::set<const ScadModule*> tapered_;
  /// How many more corners and edges are compared with rounds.
  std::size_t compared_left_;
  /// The corners of all `rings_`.
  std::size_t corners_ = 0;
  /// The rings of everything that gets facets, by their number of corners.
  Rings rings_;
};

}  // namespace graycube
