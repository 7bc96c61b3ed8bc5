// Rules that must hold for any bytes read as a mesh file; the normal suite drives this with
// mutations of small ones.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "check.hpp"
#include "formats/graycube/read_scene.hpp"
#include "formats/graycube/write_scene.hpp"
#include "formats/mesh/close_parts.hpp"
#include "formats/mesh/mesh_parts.hpp"
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

/// Whatever is left out or repaired, the solids of a file's parts are closed.
inline void fuzz_parts(const std::variant<std::vector<MeshPart>, MeshFault>& read) {
  if (const auto* fault = std::get_if<MeshFault>(&read)) {
    GRAYCUBE_CHECK(!fault->why.empty(), "a fault without a word");
    return;
  }
  const auto& parts = std::get<std::vector<MeshPart>>(read);
  fuzz_polygons(united(parts));
  for (const OpenMeshes open : {OpenMeshes::kLeaveOut, OpenMeshes::kRepair}) {
    for (const auto& result : {closed_body(parts, open), closed_parts(parts, open)}) {
      if (const auto* fault = std::get_if<MeshFault>(&result)) {
        GRAYCUBE_CHECK(!fault->why.empty(), "a fault without a word");
        continue;
      }
      const auto& solids = std::get<MeshSolids>(result).solids;
      GRAYCUBE_CHECK(!solids.empty(), "neither a solid nor a fault");
      for (const MeshSolid& s : solids) {
        const auto& triangles = s.shape.mesh.triangles;
        GRAYCUBE_CHECK(!triangles.empty(), "a solid of nothing");
        GRAYCUBE_CHECK(MeshEdges(triangles).unbalanced_count() == 0, "an open solid");
        const auto again = closed_mesh(s.shape.mesh);
        const auto* mesh = std::get_if<TriangleMesh>(&again);
        GRAYCUBE_CHECK(mesh != nullptr && *mesh == s.shape.mesh, "closed again it is another");
      }
    }
  }
}

inline void fuzz_mesh(std::string_view bytes) {
  if (bytes.size() > kMaxMeshFuzzBytes) return;
  fuzz_parts(read_stl(bytes));
  auto off = read_off(bytes);
  fuzz_polygons(off);
  if (auto* mesh = std::get_if<PolygonMesh>(&off)) {
    std::vector<MeshPart> parts(1);
    parts[0].polygons = std::move(*mesh);
    fuzz_parts(std::move(parts));
  }
}

}  // namespace graycube::testing
