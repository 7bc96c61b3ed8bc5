#include "formats/mesh/mesh_file.hpp"

#include <algorithm>
#include <fstream>
#include <optional>
#include <string>
#include <system_error>

#include "formats/mesh/off.hpp"
#include "formats/mesh/stl.hpp"
#include "formats/mesh/words.hpp"

namespace graycube {
namespace {

namespace fs = std::filesystem;

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

std::string lower_ending(const fs::path& path) {
  std::string ending = path.extension().string();
  std::ranges::transform(ending, ending.begin(), lower);
  return ending;
}

}  // namespace

bool is_mesh_file(const fs::path& path) {
  const std::string ending = lower_ending(path);
  return ending == ".stl" || ending == ".off";
}

std::variant<MeshShape, MeshFault> read_mesh_file(const fs::path& path) {
  const auto here = [&](MeshFault fault) { return MeshFault{path.string() + ": " + fault.why}; };
  if (!is_mesh_file(path)) return here({"expected a name ending in .stl or .off"});
  std::optional<MeshFault> fault;
  const std::string bytes = read_whole(path, fault);
  if (fault) return here(*std::move(fault));
  auto polygons = lower_ending(path) == ".stl" ? read_stl(bytes) : read_off(bytes);
  if (auto* wrong = std::get_if<MeshFault>(&polygons)) return here(std::move(*wrong));
  auto closed = closed_mesh(std::get<PolygonMesh>(polygons));
  if (auto* wrong = std::get_if<MeshFault>(&closed)) return here(std::move(*wrong));
  return MeshShape{std::get<TriangleMesh>(std::move(closed)),
                   std::get<PolygonMesh>(polygons).digits};
}

MeshLoader mesh_files_beside(const fs::path& scene_file) {
  return [folder = scene_file.parent_path()](std::string_view file) {
    return read_mesh_file(folder / fs::path(file));
  };
}

}  // namespace graycube
