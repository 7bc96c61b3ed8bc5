// The leaves of CSG trees: which keys each kind has, and what its values must satisfy.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "formats/json/access.hpp"
#include "formats/mesh/mesh_file.hpp"
#include "scene/scene.hpp"

namespace graycube {

enum class NodeType : std::uint8_t {
  kUnion,
  kIntersection,
  kDifference,
  kComplement,
  kRef,
  kRepeat,
  kSphere,
  kBox,
  kCylinder,
  kCone,
  kTorus,
  kHalfSpace,
  kEllipsoid,
  kPolyhedron,
  kEllipticCone,
  kEllipticTorus,
  kQuadric,
  kPrism,
  kMesh,
  kBezier,
  kLathe,
  kSweep,
};

/// The first keys of every node; those of its type follow.
enum CommonKey : std::size_t { kTypeKey, kTransformKey, kMaterialKey, kCommonKeys };
inline constexpr std::size_t kMaxNodeKeys = 9;

struct NodeRules {
  std::string_view name;
  std::string_view owner;  // with its article, for messages
  NodeType type;
  std::size_t key_count;
  std::array<KeyRule, kMaxNodeKeys> keys;

  std::span<const KeyRule> rules() const { return {keys.data(), key_count}; }
};

/// The rules of all node types.
std::span<const NodeRules> node_rules();

/// Reads a leaf's own members (0 where absent, reported already) into `out`.
void read_leaf_value(JsonAccess& json, NodeType type,
                     const std::array<JsonIndex, kMaxNodeKeys>& members, CsgNode& out);

/// Reads the points of a mesh or net; false, after reporting, if there is anything wrong.
bool read_points(JsonAccess& json, JsonIndex at, std::vector<Vec3>& out);

/// Reads a net of Bézier patches into `out`. Returns the most triangles that its mesh has, 0 after
/// reporting that something is wrong.
std::uint64_t read_bezier(JsonAccess& json, const std::array<JsonIndex, kMaxNodeKeys>& members,
                          BezierShape& out);

/// Reads the outline of a lathe or a sweep, and how far that is swept, into `out`. Returns the
/// number of its segments, 0 after reporting that something is wrong.
std::uint32_t read_outlined(JsonAccess& json, NodeType type,
                            const std::array<JsonIndex, kMaxNodeKeys>& members, CsgNode& out);

/// Reads a mesh (`at`) into `out`. `load` opens mesh files; null refuses them.
void read_mesh(JsonAccess& json, JsonIndex at, const std::array<JsonIndex, kMaxNodeKeys>& members,
               const MeshLoader& load, MeshShape& out);

}  // namespace graycube
