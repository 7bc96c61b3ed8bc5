// Finds the spheres and cylinders of a file that get OpenSCAD's facets although they could stay
// round: those that a hull() without an exact form has in facets, wherever else they stand. So a
// bore as wide as the boss around it has the boss's sides, and leaves no crescents.
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "formats/openscad/language/options.hpp"
#include "formats/openscad/language/parser.hpp"
#include "formats/openscad/rounds.hpp"
#include "geometry/affine.hpp"

namespace graycube {

class FacetedRounds {
 public:
  /// Looks for hulls without an exact form, and for solids that touch their facets, in a whole file
  /// whose matrices have `digits` digits. Reports nothing.
  FacetedRounds(const std::vector<ScadModule>& modules, const OpenscadOptions& options,
                std::uint32_t digits, ExactForms& forms);

  /// Whether the sphere or straight cylinder is one of them, wherever it ends; else false.
  bool contains(const ScadModule& module, const Affine& to_world) const;
  /// Whether a module contains one of them.
  bool touch(const ScadModule& module, const Affine& to_world) const;

 private:
  /// The corners by which facets are told: a ring of them, and for cylinders the direction along
  /// which it is seen.
  struct Ring {
    bool is_ball = false;
    Vec3 along;
    Vec3 center;
    std::vector<Vec3> corners;
  };

  static bool ring_of(const ScadModule& module, const Affine& to_world, Ring& ring);
  bool is_one(const Ring& a, const Ring& b) const;
  bool has(const Ring& ring) const;
  void add_all(const ScadModule& module, const Affine& to_world);
  template <typename Visit>
  void for_each_round(const ScadModule& module, const Affine& to_world, const Visit& visit) const;

  std::uint32_t digits_ = 0;
  /// The share of coordinates by which two matrices of so many digits may place points differently.
  double share_ = 0;
  /// The rings of all faceted rounds, by their number of corners.
  std::multimap<std::size_t, Ring> rings_;
};

}  // namespace graycube
