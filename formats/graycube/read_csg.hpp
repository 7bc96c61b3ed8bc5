// The CSG trees of a scene file.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "formats/graycube/expansion.hpp"
#include "formats/graycube/read_leaf.hpp"
#include "formats/json/access.hpp"
#include "formats/json/name_table.hpp"
#include "formats/mesh/mesh_file.hpp"
#include "scene/scene.hpp"

namespace graycube {

/// Reads trees; names are looked up in tables that must be complete.
class CsgReader {
 public:
  CsgReader(JsonAccess& json, const NameTable& materials, const NameTable& shapes,
            const MeshLoader& load_mesh)
      : json_(json), materials_(materials), shapes_(shapes), load_mesh_(load_mesh) {}

  /// The tree of a shape: leaves may wait for a material from where the shape is used.
  TreeSummary read_shape(JsonIndex at, CsgNode& out);
  /// The tree of an object: every leaf without a material is reported unless `has_material`.
  TreeSummary read_object(JsonIndex at, CsgNode& out, bool has_material);
  /// A material's name; broken ones are reported and read as 0.
  MaterialIndex read_material_name(JsonIndex at);

 private:
  struct Context {
    TreeSummary& summary;
    bool reports_bare_leaves;
  };

  void read_node(JsonIndex at, CsgNode& out, bool has_material, std::uint32_t depth,
                 Context& context);
  void read_leaf(JsonIndex at, bool has_material, std::string_view owner, Context& context);
  void read_children(JsonIndex at, OperationNode& out, bool has_material, std::uint32_t depth,
                     Context& context);
  void read_repeat(const std::array<JsonIndex, kMaxNodeKeys>& members, JsonIndex at,
                   RepeatNode& out, bool has_material, std::uint32_t depth, Context& context);
  bool read_repeat_maps(JsonIndex at, std::vector<Affine>& out);
  void read_mesh_leaf(JsonIndex at, const std::array<JsonIndex, kMaxNodeKeys>& members,
                      CsgNode& out, Context& context);
  void read_bezier_leaf(JsonIndex at, const std::array<JsonIndex, kMaxNodeKeys>& members,
                        CsgNode& out, Context& context);
  /// Counts what a mesh takes; false, after reporting, if all of them take too much.
  bool count_mesh(JsonIndex at, std::uint64_t points, std::uint64_t triangles, Context& context);
  void read_outlined_leaf(JsonIndex at, NodeType type,
                          const std::array<JsonIndex, kMaxNodeKeys>& members, CsgNode& out);
  ReferenceNode read_reference(JsonIndex name, JsonIndex at, bool has_material, std::uint32_t depth,
                               Context& context);

  JsonAccess& json_;
  const NameTable& materials_;
  const NameTable& shapes_;
  const MeshLoader& load_mesh_;
  /// Nodes written in the file so far, in all trees together; this bounds the memory taken.
  std::uint64_t nodes_read_ = 0;
  /// Maps of repeats in the file so far, for the same reason.
  std::uint64_t maps_read_ = 0;
  /// Points and triangles of meshes in the file so far, for the same reason.
  std::uint64_t mesh_points_read_ = 0, triangles_read_ = 0;
  /// Outlines of the file so far and their segments, for the same reason.
  std::uint64_t outlines_read_ = 0, segments_read_ = 0;
};

}  // namespace graycube
