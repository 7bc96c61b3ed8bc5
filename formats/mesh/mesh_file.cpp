#include "formats/mesh/mesh_file.hpp"

#include <algorithm>
#include <array>
#include <fstream>
#include <optional>
#include <system_error>
#include <utility>

#include "file_ending.hpp"
#include "formats/mesh/off.hpp"
#include "formats/mesh/stl.hpp"

namespace graycube {
namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 2> kOwnEndings{".stl", ".off"};
/// Those that were tried with the library; it reads more.
constexpr std::array<std::string_view, 10> kForeignEndings{".obj", ".ply", ".3mf", ".gltf", ".glb",
                                                           ".dae", ".3ds", ".amf", ".x3d",  ".fbx"};

bool has_ending_of(const fs::path& path, std::span<const std::string_view> endings) {
  return std::ranges::any_of(endings, [&](auto ending) { return has_ending(path, ending); });
}

std::string read_whole(const fs::path& path, std::optional<MeshFault>& fault) {
  std::error_code error;
  const auto size = fs::file_size(path, error);
  if (error) {
    fault = MeshFault{"can't be read: " + error.message()};
  } else if (size > kMaxMeshFileBytes) {
    fault = MeshFault{"larger than " + std::to_string(kMaxMeshFileBytes) + " bytes"};
  }
  if (fault) return {};
  std::string bytes(size, '\0');
  std::ifstream file(path, std::ios::binary);
  file.read(bytes.data(), static_cast<std::streamsize>(size));
  if (!file) fault = MeshFault{"can't be read"};
  return bytes;
}

using Parts = std::variant<std::vector<MeshPart>, MeshFault>;

Parts read_own_file(const fs::path& path) {
  std::optional<MeshFault> fault;
  const std::string bytes = read_whole(path, fault);
  if (fault) return *std::move(fault);
  if (has_ending(path, ".stl")) return read_stl(bytes);
  auto mesh = read_off(bytes);
  if (auto* wrong = std::get_if<MeshFault>(&mesh)) return std::move(*wrong);
  std::vector<MeshPart> parts(1);
  parts[0].polygons = std::get<PolygonMesh>(std::move(mesh));
  return parts;
}

Parts read_foreign_file(const fs::path& path, const MeshReading& how) {
  if (!how.foreign) return MeshFault{"only .stl and .off are read here"};
  return how.foreign(path);
}

std::variant<MeshSolids, MeshFault> read_and_close(const fs::path& path, const MeshReading& how) {
  const bool is_own = has_ending_of(path, kOwnEndings);
  if (!is_own && !is_foreign_mesh_file(path))
    return MeshFault{"expected a name ending in " + mesh_endings_text()};
  Parts parts = is_own ? read_own_file(path) : read_foreign_file(path, how);
  if (auto* wrong = std::get_if<MeshFault>(&parts)) return std::move(*wrong);
  auto& list = std::get<std::vector<MeshPart>>(parts);
  auto solids =
      is_own ? closed_body(std::move(list), how.open) : closed_parts(std::move(list), how.open);
  auto* fault = std::get_if<MeshFault>(&solids);
  if (fault != nullptr && fault->is_open && how.open == OpenMeshes::kLeaveOut)
    fault->why += "; --repair may close it";
  return solids;
}

/// All solids as one mesh: each is closed and turned outwards, so that all together are.
MeshShape one_shape(std::vector<MeshSolid> solids) {
  MeshShape whole = std::move(solids.front().shape);
  for (std::size_t s = 1; s < solids.size(); ++s) {
    const MeshShape& more = solids[s].shape;
    const auto points = static_cast<std::uint32_t>(whole.mesh.points.size());
    whole.mesh.points.insert(whole.mesh.points.end(), more.mesh.points.begin(),
                             more.mesh.points.end());
    for (const auto& [a, b, c] : more.mesh.triangles)
      whole.mesh.triangles.push_back({points + a, points + b, points + c});
    whole.digits = std::max(whole.digits, more.digits);
  }
  return whole;
}

}  // namespace

bool is_foreign_mesh_file(const fs::path& path) { return has_ending_of(path, kForeignEndings); }
bool is_mesh_file(const fs::path& path) {
  return has_ending_of(path, kOwnEndings) || is_foreign_mesh_file(path);
}

std::string mesh_endings_text() {
  std::string text;
  for (const auto ending : kOwnEndings) text.append(text.empty() ? "" : ", ").append(ending);
  for (const auto ending : kForeignEndings) text.append(", ").append(ending);
  return text;
}

std::variant<MeshSolids, MeshFault> read_mesh_file(const fs::path& path, const MeshReading& how) {
  auto read = read_and_close(path, how);
  if (auto* fault = std::get_if<MeshFault>(&read)) fault->why = path.string() + ": " + fault->why;
  return read;
}

MeshLoader mesh_files_beside(const fs::path& scene_file, MeshReading how,
                             std::vector<ImportWarning>* warnings) {
  return [folder = scene_file.parent_path(), how = std::move(how),
          warnings](std::string_view file) -> std::variant<MeshShape, MeshFault> {
    auto read = read_mesh_file(folder / fs::path(file), how);
    if (auto* fault = std::get_if<MeshFault>(&read)) return std::move(*fault);
    auto& solids = std::get<MeshSolids>(read);
    for (ImportWarning& w : solids.warnings) {
      if (warnings == nullptr) break;
      w.where = std::string(file) + (w.where.empty() ? "" : ":" + w.where);
      warnings->push_back(std::move(w));
    }
    return one_shape(std::move(solids.solids));
  };
}

}  // namespace graycube
