// Makes a closed mesh from the polygons of a file: points are welded, faces cut into triangles, and
// the orientation made outward.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "mesh/cut_face.hpp"
#include "mesh/triangle_mesh.hpp"

namespace graycube {

/// Faces are cycles of indices into the points.
struct PolygonMesh {
  std::vector<Vec3> points;
  /// The corners of all faces, one face after the other, and the index at which each face's end.
  std::vector<std::uint32_t> corners;
  std::vector<std::uint32_t> face_ends;
  /// Significant decimal digits that the points were written with; 0: all that a double has.
  std::uint32_t digits = 0;
  /// Where the faces are bent, the surface may depend on it (mesh/cut_face.hpp).
  FaceSide side = FaceSide::kOuter;

  void add_face(std::span<const std::uint32_t> face) {
    corners.insert(corners.end(), face.begin(), face.end());
    face_ends.push_back(static_cast<std::uint32_t>(corners.size()));
  }
};

/// Why polygons don't enclose a solid; begins in lower case, for "mesh: …".
struct MeshFault {
  std::string why;
  /// Edges are open, which mesh/repair_mesh.hpp may mend.
  bool is_open = false;
};

/// The closed mesh: points with bitwise equal coordinates become one (−0 is 0), points that no face
/// uses and triangles with two equal corners are dropped. Every edge must be used by as many faces
/// one way as the other. If that fails but every edge has two faces, faces are turned to agree with
/// their neighbours. A mesh whose volume is negative is turned inside out as a whole. A result
/// given to this function again comes back unchanged.
///
/// A mesh that has no inside as it is written is tried again with points joined that are within
/// kRoundingShare (mesh/join_points.hpp) of the largest coordinate, then within one unit of the
/// last of its `digits`, and then within `join_within`: programs compute a corner in two ways. The
/// fault is that of the mesh as written.
///
/// Faults: points that aren't finite, indices out of range, faces of fewer than 3 or more than
/// kMostFaceCorners corners, more than kMaxMeshPoints or kMaxMeshTriangles, nothing left, open or
/// contradicting edges.
std::variant<TriangleMesh, MeshFault> closed_mesh(const PolygonMesh& polygons,
                                                  double join_within = 0);
/// Like closed_mesh() above, for triangles.
std::variant<TriangleMesh, MeshFault> closed_mesh(TriangleMesh triangles);

/// The first steps of closed_mesh() only: points with equal coordinates are one, faces are cut into
/// triangles. Faults: those of points, faces and their numbers.
std::variant<TriangleMesh, MeshFault> welded_mesh(const PolygonMesh& polygons);

/// The volume that a closed mesh of one triangle or more encloses, negative where its triangles
/// turn inwards. It is reckoned about a corner of the mesh, so that far meshes keep their digits.
double enclosed_volume(const TriangleMesh& mesh);

/// "(1, 2, 3)", with all digits.
std::string text_of_point(const Vec3& p);

/// Turns all triangles over.
void turn_inside_out(TriangleMesh& mesh);

}  // namespace graycube
