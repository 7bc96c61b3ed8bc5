#include "formats/mesh/mesh_parts.hpp"

#include <algorithm>
#include <utility>

namespace graycube {
namespace {

/// The bytes of the character that begins the text, in UTF-8 (RFC 3629, section 4); 0 if it is
/// none.
std::size_t character_bytes(std::string_view text) {
  const auto byte = [&](std::size_t i) {
    return i < text.size() ? static_cast<unsigned char>(text[i]) : 0u;
  };
  const unsigned lead = byte(0);
  if (lead < 0x80) return 1;
  const std::size_t size = lead < 0xC2   ? 0
                           : lead < 0xE0 ? 2
                           : lead < 0xF0 ? 3
                           : lead < 0xF5 ? 4
                                         : 0;
  const unsigned least = lead == 0xE0 ? 0xA0 : lead == 0xF0 ? 0x90 : 0x80;
  const unsigned most = lead == 0xED ? 0x9F : lead == 0xF4 ? 0x8F : 0xBF;
  for (std::size_t i = 1; i < size; ++i) {
    if (byte(i) < (i == 1 ? least : 0x80) || byte(i) > (i == 1 ? most : 0xBF)) return 0;
  }
  return size;
}

}  // namespace

std::string mesh_name(std::string_view bytes) {
  std::string name;
  while (!bytes.empty()) {
    const std::size_t size = character_bytes(bytes);
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
