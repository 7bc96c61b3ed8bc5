#include "formats/view/mesh_scene.hpp"

#include <utility>

#include "formats/view/framing.hpp"
#include "formats/view/palette.hpp"

namespace graycube {

Scene scene_of_mesh(MeshShape mesh, const Frame& frame) {
  Scene scene;
  scene.digits = mesh.digits;
  // A mesh reaches as far as its points do.
  CsgNode hull;
  hull.value = PolyhedronShape{};
  scene.settings =
      framed_settings(reach_of(hull, mesh.mesh.points, Affine{}, reach_directions(frame)), frame);
  Palette palette;
  SceneObject object{"mesh", palette.index_of(ScadColor{}), {}};
  object.csg.value = std::move(mesh);
  scene.materials = std::move(palette).take();
  scene.objects.push_back(std::move(object));
  return scene;
}

}  // namespace graycube
