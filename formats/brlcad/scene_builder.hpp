// Regions of a BRL-CAD database as objects of a scene, with the materials that they inherit.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "formats/brlcad/brlcad.hpp"
#include "formats/brlcad/database/database.hpp"
#include "formats/brlcad/lights.hpp"
#include "formats/brlcad/parts.hpp"
#include "formats/brlcad/shader.hpp"

namespace graycube::brlcad {

/// The state that a name inherits from the combinations above it.
struct State {
  Affine to_world;
  std::optional<std::array<int, 3>> rgb;
  std::string shader;
  /// Whether a combination above has set it so that it holds for all below.
  bool rgb_is_set = false, shader_is_set = false;
};

/// Why a part can't be built; no reason where it can. Regions that share the reason are told of in
/// one line, with the detail of the first.
struct Lack {
  std::string why, detail;
  explicit operator bool() const { return !why.empty(); }
};

/// A solid that every region found further down is cut by: it is subtracted, or intersected.
struct Cut {
  bool is_minus = false;
  CsgNode node;
  std::size_t levels = 0;
  /// Why the solid can't be built; the regions that it cuts are left out then.
  Lack lacks;
};

/// A solid as it was built: where, and by how much its faces lie further out.
struct MarkedSolid {
  const BrlcadSolid* solid = nullptr;
  Affine to_world;
  double grow = 0;
};

class SceneBuilder {
 public:
  SceneBuilder(const BrlcadDatabase& database, BrlcadReport& report);

  void add(const std::string& name);
  Scene take() { return std::move(scene_); }
  /// The regions that shine.
  const std::vector<LampObject>& lamps() const { return lamps_; }

 private:
  /// Goes into a name; false when it can't: unknown, a cycle, too deep, or after an error.
  bool enter(const std::string& name, const BrlcadObject*& object);

  static State within(State state, const BrlcadTree& leaf);

  /// Finds the regions below a name that is above regions.
  void collect(const std::string& name, State state, std::vector<Cut>& cuts);

  void collect_tree(const BrlcadTree& tree, const State& state, std::vector<Cut>& cuts);

  /// The first operand's regions, each cut by the others.
  void collect_cut(const BrlcadTree& tree, const State& state, std::vector<Cut>& cuts);

  static void inherit(const BrlcadComb& comb, State& state);

  void region(const BrlcadObject& object, const BrlcadComb& comb, const State& state,
              const std::vector<Cut>& cuts);

  BrlcadSurface surface_of(const std::string& name, const State& state, const BrlcadComb* region);

  MaterialIndex material_of(const BrlcadSurface& surface);

  /// The first solid of a tree: nothing where the tree's first member is none; and the map from its
  /// coordinates to the world's.
  struct FirstSolid {
    const BrlcadSolid* solid = nullptr;
    Affine to_world;
  };
  FirstSolid first_solid_of(const BrlcadTree& tree, const Affine& to_world) const;
  static FirstSolid first_solid_of(const BrlcadObject& object, const Affine& to_world);

  /// Adds a region, unless something of it can't be built: then it is left out. Its first solid
  /// aims lamps.
  void add_object(const std::string& name, Part part, BrlcadSurface surface,
                  const std::vector<Cut>& cuts, const FirstSolid& first);
  /// Gives each solid of a region a material of its own, whose pattern lies on it, if the region
  /// has such a pattern; takes their marks off. Returns whether all have one.
  bool paint(const std::string& name, const BrlcadSurface& surface, CsgNode& node);
  MaterialIndex painted(const std::string& name, const BrlcadSurface& surface,
                        const MarkedSolid& solid);

  /// Notes that the part under way can't be built.
  void lack(std::string why, std::string detail = {}) {
    if (!lacks_) lacks_ = {std::move(why), std::move(detail)};
  }

  /// The name as UTF-8, which a scene's text must be; names in databases may be any bytes.
  static std::string printable(std::string name);

  bool check_limits(const std::string& name, const Part& part);

  /// Builds a part of a region. `is_cut`: the part gets subtracted, and so is grown.
  Part build(const std::string& name, const Affine& to_world, bool is_cut);

  Part build(const BrlcadTree& tree, const Affine& to_world, bool is_cut);

  Part solid(const BrlcadObject& object, const Affine& to_world, bool is_cut);

  const BrlcadDatabase& database_;
  BrlcadReport& report_;
  Scene scene_;
  std::map<std::vector<double>, MaterialIndex> materials_;
  std::vector<const BrlcadObject*> path_;
  std::size_t visits_ = 0, leaves_ = 0, triangles_ = 0;
  std::vector<LampObject> lamps_;
  /// The solids by which nodes of trees are marked: until a region is painted, a node's material is
  /// an index in here. Used only where a shader of the database gives colours by u and v.
  std::vector<MarkedSolid> marked_;
  bool marks_solids_ = false;
  /// Why the part under way can't be built.
  Lack lacks_;
};

}  // namespace graycube::brlcad
