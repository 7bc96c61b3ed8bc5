#include "formats/mesh/mesh_parts.hpp"

#include <algorithm>
#include <utility>

#include "utf8.hpp"

namespace graycube {
std::string mesh_name(std::string_view bytes) {
  std::string name;
  while (!bytes.empty()) {
    const std::size_t size = utf8_bytes(bytes);
    const std::size_t taken = std::max<std::size_t>(size, 1);
    if (name.size() + taken > kMaxMeshNameBytes) break;
    const bool is_control = size == 1 && (bytes[0] < ' ' || bytes[0] == '\x7F');
    name += size == 0 ? "?" : is_control ? " " : bytes.substr(0, taken);
    bytes.remove_prefix(taken);
  }
  return name;
}

PolygonMesh united(std::vector<MeshPart> parts) {
  if (parts.empty()) return {};
  PolygonMesh whole = std::move(parts.front().polygons);
  for (std::size_t p = 1; p < parts.size(); ++p) {
    const PolygonMesh& more = parts[p].polygons;
    const auto points = static_cast<std::uint32_t>(whole.points.size());
    const auto corners = static_cast<std::uint32_t>(whole.corners.size());
    whole.points.insert(whole.points.end(), more.points.begin(), more.points.end());
    for (const std::uint32_t c : more.corners) whole.corners.push_back(points + c);
    for (const std::uint32_t end : more.face_ends) whole.face_ends.push_back(corners + end);
    whole.digits = std::max(whole.digits, more.digits);
  }
  return whole;
}

}  // namespace graycube
