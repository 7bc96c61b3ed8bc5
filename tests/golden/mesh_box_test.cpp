// A box as a mesh against the box itself: the same depths, normals and shades, pixel by pixel.

#include "catch.hpp"
#include "csg/random_model.hpp"
#include "mesh/samples.hpp"
#include "trace/render_serial.hpp"

using namespace graycube;
using namespace graycube::testing;

namespace {

Picture picture_of(CsgNode solid) {
  Scene scene = scene_of(
      {operation(Operation::kDifference, {std::move(solid), node_of(SphereShape{{1, 1, -1}, 0.7})}),
       node_of(HalfSpaceShape{{0, 1, 0}, -1.5})});
  RenderSettings& s = scene.settings;
  s.image = {96, 64, 1};
  s.camera.projection = Projection::kPerspective;
  s.camera.eye = {1.5, 2, -6};
  s.camera.fov_degrees = 35;
  s.lights = {{{4, 6, -5}, {0.8, 0.8, 0.8}, Falloff::kNone}};
  s.aovs = *parse_aovs("depth,normal,object");
  scene.materials[0].material.reflect = 0.2;
  const Domain domain(compile_scene(scene));
  Film film(s.image.width, s.image.height, 1, s.aovs);
  render_serial(domain, {}, film);
  return film.develop();
}

}  // namespace

TEST_CASE("a mesh of a box looks like the box, to the depth of each pixel") {
  const Vec3 lo{-1.1, -1, -0.9}, hi{1.2, 1, 1.3};
  const Picture box = picture_of(node_of(BoxShape{lo, hi}));
  const Picture mesh = picture_of(node_of(MeshShape{closed(box_polygons(lo, hi))}));
  CHECK(mesh == box);
}
