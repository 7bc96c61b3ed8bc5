// Faces that are one too many, as those that a generator writes twice or three times over.
#pragma once

#include <optional>

#include "mesh/close_mesh.hpp"

namespace graycube {

/// The mesh without some of its faces, where closed_mesh(…, join_within) makes a solid only without
/// them, or a larger one: where both sides of a surface are faces it encloses nothing. Corners
/// within `join_within` of each other in every coordinate are one, and those that differ by
/// rounding (mesh/join_points.hpp).
///
/// Dropped are the faces that OpenSCAD 2021.01 passes over when it builds a solid face by face, in
/// their order: those with an edge that a face before goes along in the same direction, or with a
/// corner that faces before surround completely, or that it would surround together with some of
/// them while others only touch it there (CGAL's Polyhedron_incremental_builder_3, test_facet()).
/// If neither the rest nor the mesh as it is encloses anything, those are dropped instead that have
/// the same corners as one before, wherever they begin and whichever way they turn.
///
/// Nothing if no two faces go along an edge in the same direction, the mesh is a solid as it is, or
/// no rest is one.
std::optional<PolygonMesh> without_extra_faces(const PolygonMesh& mesh, double join_within);

}  // namespace graycube
