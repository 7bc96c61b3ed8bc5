// Rules that must hold for any bytes read as a mesh file; the normal suite drives this with
// mutations of small ones.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <utility>
#include <variant>

#include "check.hpp"
#include "formats/graycube/read_scene.hpp"
#include "formats/graycube/write_scene.hpp"
#include "formats/mesh/off.hpp"
#include "formats/mesh/stl.hpp"
#include "formats/view/mesh_scene.hpp"
#include "mesh/close_mesh.hpp"
#include "mesh/edges.hpp"
#include "mesh/mesh.hpp"

namespace graycube::testing {

/// Larger inputs only make the fuzzer slow.
inline constexpr std::size_t kMaxMeshFuzzBytes = std::size_t{1} << 16;

inline void fuzz_polygons(const std::variant<PolygonMesh, MeshFault>& read) {
  if (const auto* fault = std::get_if<MeshFault>(&read)) {
    GRAYCUBE_CHECK(!fault->why.empty(), "a fault without a word");
    return;
  }
  auto closed = closed_mesh(std::get<PolygonMesh>(read));
  if (std::holds_alternative<MeshFault>(closed)) return;
  const TriangleMesh mesh = std::get<TriangleMesh>(std::move(closed));
  GRAYCUBE_CHECK(MeshEdges(mesh.triangles).unbalanced_count() == 0, "an open mesh");
  GRAYCUBE_CHECK(std::get<TriangleMesh>(closed_mesh(mesh)) == mesh, "closed again it is another");
  // A line must end outside, where it began.
  const Mesh solid(mesh);
  for (const Vec3& p : {mesh.points.front(), 0.5 * (mesh.points.front() + mesh.points.back())}) {
    for (const Vec3& d : {Vec3{1, 0, 0}, Vec3{0, -1, 0}, Vec3{0.6, 0, -0.8}}) {
      const Spans spans = solid.spans({p, d});
      for (int i = 0; i < spans.count; ++i) {
        const auto& s = spans.interval[static_cast<std::size_t>(i)];
        GRAYCUBE_CHECK(s.enter < s.leave, "%g … %g", s.enter, s.leave);
      }
    }
  }
  // A farm must accept the scene's text, and read the same from it. No camera sees
  // coordinates near the largest double, and none is away from a mesh that is next to
  // nothing.
  for (const Vec3& p : mesh.points) {
    if (!(max_abs(p) < 1e100)) return;
  }
  const Scene scene = scene_of_mesh({mesh});
  const ReadResult again = read_scene_text(write_scene_text(scene));
  for (const SceneError& e : again.errors) {
    GRAYCUBE_CHECK(e.pointer.starts_with("/camera"), "%s: %s", e.pointer.c_str(),
                   e.message.c_str());
  }
  GRAYCUBE_CHECK(!again.scene || *again.scene == scene, "another scene");
}

inline void fuzz_mesh(std::string_view bytes) {
  if (bytes.size() > kMaxMeshFuzzBytes) return;
  fuzz_polygons(read_stl(bytes));
  fuzz_polygons(read_off(bytes));
}

}  // namespace graycube::testing
