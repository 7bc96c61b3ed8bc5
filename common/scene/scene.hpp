// The scene as plain values, close to the file (docs/scene.md). Nothing
// here is compiled, expanded or checked for meaning beyond what `read_scene` promises.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <variant>
#include <vector>

#include "bezier/net.hpp"
#include "flat/polygon.hpp"
#include "geometry/affine.hpp"
#include "geometry/vec.hpp"
#include "mesh/triangle_mesh.hpp"
#include "outline/pieces.hpp"
#include "scene/sparse_optional.hpp"
#include "shading/material.hpp"
#include "shading/settings.hpp"

namespace graycube {

/// Index into `Scene::materials`.
using MaterialIndex = std::uint32_t;
inline constexpr MaterialIndex kInheritMaterial = 0xFFFFFFFFu;

struct CsgNode;

struct SphereShape {
  Vec3 center;
  double radius = 0;
  friend bool operator==(const SphereShape&, const SphereShape&) = default;
};
struct BoxShape {
  Vec3 min, max;
  friend bool operator==(const BoxShape&, const BoxShape&) = default;
};
struct CylinderShape {
  Vec3 base, top;
  double radius = 0;
  friend bool operator==(const CylinderShape&, const CylinderShape&) = default;
};
/// A capped cone; one of the radii may be zero.
struct ConeShape {
  Vec3 base;
  double base_radius = 0;
  Vec3 top;
  double top_radius = 0;
  friend bool operator==(const ConeShape&, const ConeShape&) = default;
};
/// A torus with 0 < minor < major.
struct TorusShape {
  Vec3 center, axis;
  double major = 0, minor = 0;
  friend bool operator==(const TorusShape&, const TorusShape&) = default;
};
/// The points with normal · p ≤ offset.
struct HalfSpaceShape {
  Vec3 normal;
  double offset = 0;
  friend bool operator==(const HalfSpaceShape&, const HalfSpaceShape&) = default;
};
/// The image of the unit sphere under the three axes, moved to `center`.
struct EllipsoidShape {
  Vec3 center;
  std::array<Vec3, 3> axes;
  friend bool operator==(const EllipsoidShape&, const EllipsoidShape&) = default;
};
/// The points with normal · p ≤ offset for every plane: convex, perhaps unbounded.
struct PolyhedronShape {
  std::vector<HalfSpaceShape> planes;
  friend bool operator==(const PolyhedronShape&, const PolyhedronShape&) = default;
};

/// A solid between ellipses: semi-axes a, b about `base`, and top_a · a, top_b · b about `top`.
struct EllipticConeShape {
  Vec3 base, top, a, b;
  double top_a = 0, top_b = 0;
  friend bool operator==(const EllipticConeShape&, const EllipticConeShape&) = default;
};
/// An ellipse turned about an axis that it doesn't reach: one semi-axis goes `outward` along the
/// radius and `upward` along the axis, the other is `across` long.
struct EllipticTorusShape {
  Vec3 center, axis;
  double radius = 0, outward = 0, upward = 0, across = 0;
  friend bool operator==(const EllipticTorusShape&, const EllipticTorusShape&) = default;
};
/// The points of the box with x² + q₀ y² + q₁ z² + q₂ z + q₃ ≤ 0; q₀ ≥ 0.
struct QuadricShape {
  std::array<double, 4> coefficients{};
  Vec3 min, max;
  friend bool operator==(const QuadricShape&, const QuadricShape&) = default;
};

/// A polygon × [base, base + height] along z. Each path goes round by its corners, numbers of
/// points; without paths all points are one. A point is inside when an odd number of paths goes
/// round it.
struct PrismShape {
  std::vector<FlatPoint> points;
  std::vector<std::vector<std::uint32_t>> paths;
  double height = 0, base = 0;
  friend bool operator==(const PrismShape&, const PrismShape&) = default;
};
/// A closed mesh, as closed_mesh (mesh/close_mesh.hpp) gives it: every edge balanced, normals
/// outward.
struct MeshShape {
  TriangleMesh mesh;
  std::uint32_t digits = 0;  ///< As Scene::digits, of the mesh's own numbers.
  friend bool operator==(const MeshShape&, const MeshShape&) = default;
};
/// The solid that a closed net of bicubic Bézier patches encloses, as a mesh within `tolerance` of
/// it, in the shape's units; 0 means default_tolerance (bezier/division.hpp). The sides meet, as
/// division_of() has found.
struct BezierShape {
  BezierNet net;
  double tolerance = 0;
  friend bool operator==(const BezierShape&, const BezierShape&) = default;
};

/// A closed outline turned about the z axis: x of its points is the distance from the axis, ≥ 0, y
/// the height. A point is inside when an odd number of loops goes round it.
struct LatheShape {
  OutlineLoops outline;
  friend bool operator==(const LatheShape&, const LatheShape&) = default;
};
/// A closed outline × [base, base + height] along z.
struct SweepShape {
  OutlineLoops outline;
  double height = 0, base = 0;
  friend bool operator==(const SweepShape&, const SweepShape&) = default;
};

enum class Operation : std::uint8_t { kUnion, kIntersection, kDifference, kComplement };
/// `kDifference` is the first child minus the rest; `kComplement` has exactly one child.
struct OperationNode {
  Operation operation = Operation::kUnion;
  std::vector<CsgNode> children;
  friend bool operator==(const OperationNode&, const OperationNode&);
};
/// A use of `Scene::shapes[shape]`.
struct ReferenceNode {
  std::uint32_t shape = 0;
  friend bool operator==(const ReferenceNode&, const ReferenceNode&) = default;
};

/// Which copies a repeat has: those under up to `depth` maps, or under exactly that many.
enum class KeptCopies : std::uint8_t { kAll, kLast };
/// The union of one child under all products of maps, each taken from `maps`, in any order and as
/// often as one likes (Mandelbrot 1982); the product of no maps is the child as it is.
struct RepeatNode {
  /// Exactly one; a vector, as the type isn't complete here.
  std::vector<CsgNode> child;
  std::vector<Affine> maps;
  std::uint32_t depth = 0;
  KeptCopies kept = KeptCopies::kAll;
  friend bool operator==(const RepeatNode&, const RepeatNode&);
};

struct CsgNode {
  std::variant<OperationNode, ReferenceNode, RepeatNode, SphereShape, BoxShape, CylinderShape,
               ConeShape, TorusShape, HalfSpaceShape, EllipsoidShape, PolyhedronShape,
               EllipticConeShape, EllipticTorusShape, QuadricShape, PrismShape, MeshShape,
               BezierShape, LatheShape, SweepShape>
      value;
  /// The node's whole `transform` list, composed; applied to everything below.
  SparseOptional<Affine> transform;
  /// The material of all leaves below, unless a node nearer to a leaf has one.
  MaterialIndex material = kInheritMaterial;

  friend bool operator==(const CsgNode&, const CsgNode&) = default;
};
inline bool operator==(const OperationNode& a, const OperationNode& b) {
  return a.operation == b.operation && a.children == b.children;
}
inline bool operator==(const RepeatNode& a, const RepeatNode& b) {
  return a.child == b.child && a.maps == b.maps && a.depth == b.depth && a.kept == b.kept;
}

struct NamedMaterial {
  std::string name;
  Material material;
  friend bool operator==(const NamedMaterial&, const NamedMaterial&) = default;
};
struct NamedShape {
  std::string name;
  CsgNode node;
  friend bool operator==(const NamedShape&, const NamedShape&) = default;
};
/// An independent solid. `material` may be kInheritMaterial when every leaf has one of its own.
struct SceneObject {
  std::string name;
  MaterialIndex material = kInheritMaterial;
  CsgNode csg;
  friend bool operator==(const SceneObject&, const SceneObject&) = default;
};

struct Scene {
  RenderSettings settings;
  std::vector<NamedMaterial> materials;
  std::vector<NamedShape> shapes;
  std::vector<SceneObject> objects;
  /// Significant decimal digits of the numbers that the scene was made from; 0 means all that a
  /// double has. Surfaces that coincide within them become one (docs/design/coincidence.md).
  std::uint32_t digits = 0;
  friend bool operator==(const Scene&, const Scene&) = default;
};

}  // namespace graycube
