#include "formats/mesh/close_parts.hpp"

#include <algorithm>
#include <cstdint>
#include <map>
#include <utility>

#include "formats/mesh/extra_faces.hpp"
#include "formats/mesh/part_groups.hpp"
#include "formats/mesh/repair_text.hpp"

namespace graycube {
namespace {

/// Kinds of repairs, and meshes that are left out.
constexpr std::size_t kMostKinds = 8;

MeshSolid solid_of(const MeshPart& part, TriangleMesh mesh, std::uint32_t digits) {
  return {part.name, MeshShape{std::move(mesh), digits}, part.color};
}

/// closed_mesh(), with a fault where the mesh encloses nothing, as a surface does of which each
/// face is there both ways.
std::variant<TriangleMesh, MeshFault> solid_mesh(const PolygonMesh& polygons) {
  auto closed = closed_mesh(polygons);
  const auto* mesh = std::get_if<TriangleMesh>(&closed);
  if (mesh != nullptr && !encloses_volume(*mesh)) closed = MeshFault{"it encloses no volume", true};
  return closed;
}

/// Closes parts one by one, then groups of those that are open.
class PartCloser {
 public:
  PartCloser(std::vector<MeshPart> parts, OpenMeshes open)
      : parts_(std::move(parts)), open_(open) {}

  std::variant<MeshSolids, MeshFault> run() {
    std::vector<std::uint32_t> open;
    for (std::uint32_t p = 0; p < parts_.size(); ++p) {
      // A part without faces, as of lines and points only, is no mesh.
      if (parts_[p].polygons.face_ends.empty()) continue;
      ++meshes_;
      auto closed = solid_mesh(parts_[p].polygons);
      if (auto* mesh = std::get_if<TriangleMesh>(&closed)) {
        solids_.emplace(p, solid_of(parts_[p], std::move(*mesh), parts_[p].polygons.digits));
      } else {
        open.push_back(p);
      }
    }
    close_groups(open);
    return result();
  }

 private:
  void close_groups(const std::vector<std::uint32_t>& open) {
    std::vector<MeshPart> candidates;
    for (const std::uint32_t p : open) candidates.push_back(std::move(parts_[p]));
    for (const auto& group : groups_at_open_edges(candidates)) {
      std::vector<MeshPart> members;
      for (const std::uint32_t i : group) members.push_back(std::move(candidates[i]));
      close_group(open[group.front()], std::move(members));
    }
  }

  void close_group(std::uint32_t place, std::vector<MeshPart> members) {
    const std::size_t count = members.size();
    MeshPart whole{members.front().name, {}, members.front().color};
    whole.polygons = united(std::move(members));
    auto closed = solid_mesh(whole.polygons);
    if (std::holds_alternative<MeshFault>(closed)) mend(whole.polygons, closed);
    if (auto* mesh = std::get_if<TriangleMesh>(&closed)) {
      solids_.emplace(place, solid_of(whole, std::move(*mesh), whole.polygons.digits));
      return;
    }
    leave_out(place, whole.name, count, std::get<MeshFault>(std::move(closed)));
  }

  /// Closes polygons that aren't, if it may and can; else `closed` says why they aren't.
  void mend(const PolygonMesh& polygons, std::variant<TriangleMesh, MeshFault>& closed) {
    if (open_ == OpenMeshes::kLeaveOut) return;
    if (open_ == OpenMeshes::kRepair) {
      auto repaired = repaired_mesh(polygons);
      if (auto* done = std::get_if<RepairedMesh>(&repaired)) {
        add_repairs(repairs_, done->repairs);
        closed = std::move(done->mesh);
        return;
      }
      closed = std::get<MeshFault>(std::move(repaired));
    }
    const auto rest = without_extra_faces(polygons, 0);
    if (!rest) return;
    auto thinned = solid_mesh(*rest);
    if (std::holds_alternative<MeshFault>(thinned)) return;
    MeshRepairs repairs;
    repairs.dropped_faces = polygons.face_ends.size() - rest->face_ends.size();
    add_repairs(repairs_, repairs);
    closed = std::move(thinned);
  }

  void leave_out(std::uint32_t place, const std::string& name, std::size_t count, MeshFault fault) {
    const std::string where = name.empty() ? "mesh " + std::to_string(place + 1) : name;
    for (std::size_t n = 0; n < count; ++n)
      warnings_.leave_out("mesh", where, "left out: " + fault.why);
    if (left_out_ == 0) first_fault_ = {where + ": " + fault.why, fault.is_open};
    left_out_ += count;
    if (meshes_ == 1) first_fault_ = std::move(fault);
  }

  std::variant<MeshSolids, MeshFault> result() {
    if (meshes_ == 0) return MeshFault{"no face encloses anything"};
    if (solids_.empty()) {
      if (meshes_ > 1) {
        first_fault_.why =
            "none of its " + std::to_string(meshes_) + " meshes is closed; " + first_fault_.why;
      }
      return std::move(first_fault_);
    }
    MeshSolids result;
    for (auto& [place, solid] : solids_) result.solids.push_back(std::move(solid));
    for (std::string& text : texts_of(repairs_)) warnings_.add(text, "", text);
    result.warnings = warnings_.take();
    return result;
  }

  std::vector<MeshPart> parts_;
  OpenMeshes open_;
  /// By the place of their part, or of the first of several.
  std::map<std::uint32_t, MeshSolid> solids_;
  MeshRepairs repairs_;
  std::size_t meshes_ = 0, left_out_ = 0;
  MeshFault first_fault_;
  ImportWarnings warnings_{kMostKinds};
};

}  // namespace

std::variant<MeshSolids, MeshFault> closed_parts(std::vector<MeshPart> parts, OpenMeshes open) {
  return PartCloser(std::move(parts), open).run();
}

std::variant<MeshSolids, MeshFault> closed_body(std::vector<MeshPart> parts, OpenMeshes open) {
  if (parts.size() == 1) {
    parts[0].name.clear();
    return closed_parts(std::move(parts), open);
  }
  MeshPart whole;
  whole.polygons = united(parts);
  auto closed = solid_mesh(whole.polygons);
  if (auto* mesh = std::get_if<TriangleMesh>(&closed)) {
    MeshSolids body;
    body.solids.push_back(solid_of(whole, std::move(*mesh), whole.polygons.digits));
    return body;
  }
  return closed_parts(std::move(parts), open);
}

}  // namespace graycube
