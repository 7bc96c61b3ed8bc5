#include "formats/view/mesh_scene.hpp"

#include <algorithm>
#include <utility>

#include "formats/view/framing.hpp"
#include "formats/view/palette.hpp"

namespace graycube {

Scene scene_of_meshes(std::vector<SceneMesh> meshes, const Frame& frame) {
  Scene scene;
  // A mesh reaches as far as its points do.
  CsgNode hull;
  hull.value = PolyhedronShape{};
  Reach reach = Reach::nothing();
  Palette palette;
  bool has_all_digits = false;
  for (SceneMesh& mesh : meshes) {
    has_all_digits = has_all_digits || mesh.shape.digits == 0;
    scene.digits = has_all_digits ? 0 : std::max(scene.digits, mesh.shape.digits);
    reach =
        union_of(reach, reach_of(hull, mesh.shape.mesh.points, Affine{}, reach_directions(frame)));
    const auto color = mesh.color ? ScadColor{*mesh.color} : ScadColor{};
    SceneObject object{
        mesh.name.empty() ? "mesh" : std::move(mesh.name), palette.index_of(color), {}};
    object.csg.value = std::move(mesh.shape);
    scene.objects.push_back(std::move(object));
  }
  scene.settings = framed_settings(reach, frame);
  scene.materials = std::move(palette).take();
  return scene;
}

Scene scene_of_mesh(MeshShape mesh, const Frame& frame) {
  std::vector<SceneMesh> meshes(1);
  meshes[0].shape = std::move(mesh);
  return scene_of_meshes(std::move(meshes), frame);
}

}  // namespace graycube
