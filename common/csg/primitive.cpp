#include "csg/primitive.hpp"

#include "csg/box.hpp"
#include "csg/cylinder.hpp"
#include "csg/elliptic_cone.hpp"
#include "csg/elliptic_torus.hpp"
#include "csg/half_space.hpp"
#include "csg/quadric.hpp"
#include "csg/sphere.hpp"
#include "csg/torus.hpp"
#include "mesh/mesh.hpp"

namespace graycube {

using namespace csg;

Spans spans_along(const Primitive& p, const PrimitiveData& data, const Ray& ray) {
  switch (p.kind) {
    case PrimitiveKind::kSphere: return sphere_spans(p, ray);
    case PrimitiveKind::kEllipsoid: return ellipsoid_spans(p, ray);
    case PrimitiveKind::kBox: return box_spans(p, ray);
    case PrimitiveKind::kParallelepiped: return parallelepiped_spans(p, ray);
    case PrimitiveKind::kCylinder: return cylinder_spans(p, ray);
    case PrimitiveKind::kCone: return cone_spans(p, ray);
    case PrimitiveKind::kTorus: return torus_spans(p, ray);
    case PrimitiveKind::kHalfSpace: return half_space_spans(p, ray);
    case PrimitiveKind::kPolyhedron: return polyhedron_spans(faces_of(p, data.planes), ray);
    case PrimitiveKind::kEllipticCone: return elliptic_cone_spans(p, ray);
    case PrimitiveKind::kEllipticTorus: return elliptic_torus_spans(p, ray);
    case PrimitiveKind::kQuadric: return quadric_spans(p, faces_of(p, data.planes), ray);
    case PrimitiveKind::kMesh: return data.meshes[p.mesh].spans(ray);
  }
  return {};
}

bool contains(const Primitive& p, const PrimitiveData& data, const Vec3& point) {
  switch (p.kind) {
    case PrimitiveKind::kSphere: return sphere_contains(p, point);
    case PrimitiveKind::kEllipsoid: return ellipsoid_contains(p, point);
    case PrimitiveKind::kBox: return box_contains(p, point);
    case PrimitiveKind::kParallelepiped: return parallelepiped_contains(p, point);
    case PrimitiveKind::kCylinder: return cylinder_contains(p, point);
    case PrimitiveKind::kCone: return cone_contains(p, point);
    case PrimitiveKind::kTorus: return torus_contains(p, point);
    case PrimitiveKind::kHalfSpace: return half_space_contains(p, point);
    case PrimitiveKind::kPolyhedron: return polyhedron_contains(faces_of(p, data.planes), point);
    case PrimitiveKind::kEllipticCone: return elliptic_cone_contains(p, point);
    case PrimitiveKind::kEllipticTorus: return elliptic_torus_contains(p, point);
    case PrimitiveKind::kQuadric: return quadric_contains(p, faces_of(p, data.planes), point);
    case PrimitiveKind::kMesh: return data.meshes[p.mesh].contains(point);
  }
  return false;
}

Vec3 outward_normal(const Primitive& p, const PrimitiveData& data, const Ray& ray, double t) {
  switch (p.kind) {
    case PrimitiveKind::kSphere: return sphere_normal(p, ray.at(t));
    case PrimitiveKind::kEllipsoid: return ellipsoid_normal(p, ray.at(t));
    case PrimitiveKind::kBox: return box_normal(p, ray, t);
    case PrimitiveKind::kParallelepiped: return parallelepiped_normal(p, ray, t);
    case PrimitiveKind::kCylinder: return cylinder_normal(p, ray, t);
    case PrimitiveKind::kCone: return cone_normal(p, ray, t);
    case PrimitiveKind::kTorus: return torus_normal(p, ray.at(t));
    case PrimitiveKind::kHalfSpace: return half_space_plane(p).normal;
    case PrimitiveKind::kPolyhedron: return polyhedron_normal(faces_of(p, data.planes), ray, t);
    case PrimitiveKind::kEllipticCone: return elliptic_cone_normal(p, ray, t);
    case PrimitiveKind::kEllipticTorus: return elliptic_torus_normal(p, ray.at(t));
    case PrimitiveKind::kQuadric: return quadric_normal(p, faces_of(p, data.planes), ray, t);
    case PrimitiveKind::kMesh: return data.meshes[p.mesh].outward_normal(ray, t);
  }
  return {};
}

CellSide classify(const Primitive& p, const PrimitiveData& data, const Aabb& cell) {
  switch (p.kind) {
    case PrimitiveKind::kSphere: return classify_sphere(p, cell);
    case PrimitiveKind::kEllipsoid: return classify_ellipsoid(p, cell);
    case PrimitiveKind::kBox: return classify_box(p, cell);
    case PrimitiveKind::kParallelepiped: return classify_parallelepiped(p, cell);
    case PrimitiveKind::kCylinder: return classify_cylinder(p, cell);
    case PrimitiveKind::kCone: return classify_cone(p, cell);
    case PrimitiveKind::kTorus: return classify_torus(p, cell);
    case PrimitiveKind::kHalfSpace: return classify_plane(half_space_plane(p), cell);
    case PrimitiveKind::kPolyhedron: return classify_polyhedron(p, faces_of(p, data.planes), cell);
    case PrimitiveKind::kEllipticCone: return classify_elliptic_cone(p, cell);
    case PrimitiveKind::kEllipticTorus: return classify_elliptic_torus(p, cell);
    case PrimitiveKind::kQuadric: return classify_quadric(p, faces_of(p, data.planes), cell);
    case PrimitiveKind::kMesh: return data.meshes[p.mesh].classify(cell);
  }
  return CellSide::kCrosses;
}

}  // namespace graycube
