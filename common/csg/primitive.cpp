#include "csg/primitive.hpp"

#include "csg/kinds.hpp"

namespace graycube {

Spans spans_along(const Primitive& p, const PrimitiveData& data, const Ray& ray) {
  return csg::traits_of(p.kind).solvers.spans(p, data, ray);
}

bool contains(const Primitive& p, const PrimitiveData& data, const Vec3& point) {
  return csg::traits_of(p.kind).solvers.contains(p, data, point);
}

Vec3 outward_normal(const Primitive& p, const PrimitiveData& data, const Ray& ray, double t) {
  return csg::traits_of(p.kind).solvers.normal(p, data, ray, t);
}

CellSide classify(const Primitive& p, const PrimitiveData& data, const Aabb& cell) {
  return csg::traits_of(p.kind).solvers.classify(p, data, cell);
}

}  // namespace graycube
