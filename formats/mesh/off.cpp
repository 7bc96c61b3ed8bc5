#include "formats/mesh/off.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "formats/mesh/words.hpp"

namespace graycube {
namespace {

std::optional<MeshFault> read_off_face(Words& words, PolygonMesh& mesh,
                                       std::vector<std::uint32_t>& face) {
  std::uint32_t corners = 0;
  if (!words.read(corners)) return words.fault("expected a face's number of corners");
  if (corners < 3 || corners > kMaxFaceCorners) {
    return words.fault("expected a face of 3 to " + std::to_string(kMaxFaceCorners) + " corners");
  }
  face.resize(corners);
  for (std::uint32_t& i : face) {
    if (!words.read(i)) return words.fault("expected the numbers of a face's points");
    if (i >= mesh.points.size()) {
      return words.fault("no point " + std::to_string(i) + ", there are " +
                         std::to_string(mesh.points.size()));
    }
  }
  mesh.add_face(face);
  words.skip_line();  // perhaps a colour
  return std::nullopt;
}

}  // namespace

std::variant<PolygonMesh, MeshFault> read_off(std::string_view text) {
  Words words(text, '#');
  if (!equal_words(words.next(), "OFF")) return words.fault("expected \"OFF\"");
  std::uint32_t points = 0, faces = 0, edges = 0;
  if (!words.read(points) || !words.read(faces))
    return words.fault("expected the numbers of points, faces and edges");
  if (!words.at_line_end() && !words.read(edges))
    return words.fault("expected the number of edges");
  // Each point and each face takes six characters at least.
  if (points > kMaxMeshPoints || faces > kMaxMeshTriangles ||
      (std::uint64_t{points} + faces) * 6 > words.left() + 6) {
    return words.fault("more points or faces than are accepted or can follow: " +
                       std::to_string(points) + " and " + std::to_string(faces));
  }
  PolygonMesh mesh;
  mesh.points.resize(points);
  for (Vec3& p : mesh.points) {
    for (int a = 0; a < 3; ++a) {
      if (!words.read(p[a])) return words.fault("expected a point's three numbers");
    }
  }
  mesh.digits = words.digits();
  std::vector<std::uint32_t> face;
  for (std::uint32_t f = 0; f < faces; ++f) {
    if (auto fault = read_off_face(words, mesh, face)) return *std::move(fault);
  }
  return mesh;
}

}  // namespace graycube
