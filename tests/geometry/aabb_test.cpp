#include "geometry/aabb.hpp"

#include "catch.hpp"

using namespace graycube;

TEST_CASE("the box of everything contains any point and the box of nothing none") {
  for (const Vec3& p : {Vec3{}, Vec3{1e300, -1e300, 5}, Vec3{-1, 2, 1e-300}}) {
    CHECK(Aabb::everything().contains(p));
    CHECK_FALSE(Aabb::nothing().contains(p));
  }
  CHECK(Aabb::nothing().is_empty());
  CHECK_FALSE(Aabb::everything().is_empty());
  CHECK_FALSE(Aabb::everything().is_finite());
}

TEST_CASE("boxes that touch in a face, an edge or a corner overlap") {
  const Aabb box{{0, 0, 0}, {1, 1, 1}};
  CHECK(box.overlaps({{1, 0, 0}, {2, 1, 1}}));
  CHECK(box.overlaps({{1, 1, 0}, {2, 2, 1}}));
  CHECK(box.overlaps({{-1, -1, -1}, {0, 0, 0}}));
  CHECK_FALSE(box.overlaps({{1.0000001, 0, 0}, {2, 1, 1}}));
  CHECK_FALSE(box.overlaps({{0, 0, -2}, {1, 1, -0.0000001}}));
}

TEST_CASE("a box grown around its own corners is the box") {
  const Aabb box{{-1, 2, -3}, {4, 5, 6}};
  Aabb grown = Aabb::nothing();
  for (int i = 0; i < 8; ++i) {
    CHECK(box.contains(box.corner(i)));
    for (int j = 0; j < i; ++j) CHECK_FALSE(box.corner(i) == box.corner(j));
    grown.include(box.corner(i));
  }
  CHECK(grown == box);
}

TEST_CASE("the intersection of disjoint boxes is empty and their union holds both") {
  const Aabb a{{0, 0, 0}, {1, 1, 1}}, b{{2, 0, 0}, {3, 2, 1}};
  CHECK(intersection_of(a, b).is_empty());
  CHECK(union_of(a, b) == Aabb{{0, 0, 0}, {3, 2, 1}});
  CHECK(intersection_of(a, Aabb::everything()) == a);
  CHECK(union_of(a, Aabb::nothing()) == a);
}

TEST_CASE("half the surface of a box is the sum of three of its faces") {
  CHECK(Aabb{{0, 0, 0}, {1, 2, 3}}.half_area() == 2 + 6 + 3);
  CHECK(Aabb{{0, 0, 0}, {1, 2, 3}}.center() == Vec3{0.5, 1, 1.5});
  CHECK(Aabb{{0, 0, 0}, {1, 2, 3}}.grown(0.5) == Aabb{{-0.5, -0.5, -0.5}, {1.5, 2.5, 3.5}});
}
