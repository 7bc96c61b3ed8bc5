// Which spheres and cylinders of a file get OpenSCAD's facets although they could stay round: those
// that a hull() has by facets, since it has no exact form, wherever else they stand. A bore as wide
// as the boss around it thus has the boss's sides, and leaves no crescents.
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "formats/openscad/language/options.hpp"
#include "formats/openscad/language/parser.hpp"
#include "geometry/affine.hpp"

namespace graycube {

class FacetedRounds {
 public:
  FacetedRounds() = default;
  /// Looks for hulls without an exact form, and for such as touch their facets, in a whole file,
  /// whose matrices have so many digits. Reports nothing.
  FacetedRounds(const std::vector<ScadModule>& modules, const OpenscadOptions& options,
                std::uint32_t digits);

  /// Whether the sphere or straight cylinder is one of them, up to its ends; false for all others.
  bool contains(const ScadModule& module, const Affine& to_world) const;
  /// Whether one of them is in a module.
  bool touch(const ScadModule& module, const Affine& to_world) const;

 private:
  /// What facets are told by: a ring of corners, and for cylinders the direction along which it is
  /// seen.
  struct Ring {
    bool is_ball = false;
    Vec3 along;
    Vec3 center;
    std::vector<Vec3> corners;
  };
  struct Hull;

  static bool ring_of(const ScadModule& module, const Affine& to_world, Ring& ring);
  bool is_one(const Ring& a, const Ring& b) const;
  bool has(const Ring& ring) const;
  void add_all(const ScadModule& module, const Affine& to_world);
  template <typename Visit>
  void for_each_round(const ScadModule& module, const Affine& to_world, const Visit& visit) const;
  void find_hulls(const std::vector<ScadModule>& modules, const Affine& to_world,
                  std::vector<Hull>& hulls) const;

  std::uint32_t digits_ = 0;
  /// Matrices of so many digits differ by this share of the coordinates under them.
  double share_ = 0;
  /// By number of corners.
  std::multimap<std::size_t, Ring> rings_;
};

}  // namespace graycube
