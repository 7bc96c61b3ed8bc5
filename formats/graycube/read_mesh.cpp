// Reads the mesh leaf: points and faces, or a file.
#include "formats/graycube/read_leaf.hpp"
#include "mesh/close_mesh.hpp"
#include "mesh/face_limits.hpp"
#include "stop_point.hpp"
#include "written_digits.hpp"

namespace graycube {
namespace {

enum MeshKey : std::size_t { kPoints = kCommonKeys, kFaces, kFile, kDigits };

bool read_face(JsonAccess& json, JsonIndex at, std::uint32_t points,
               std::vector<std::uint32_t>& face) {
  if (!json.is_array(at)) return false;
  const std::uint32_t corners = json.tree.size(at);
  if (corners < 3 || corners > kMostFaceCorners) {
    return json.wrong(at, "a face of 3 to " + std::to_string(kMostFaceCorners) + " corners");
  }
  face.resize(corners);
  bool good = true;
  JsonIndex child = json.tree.first_child(at);
  for (std::uint32_t& corner : face) {
    good = json.read(child, corner, 0u, points - 1) && good;
    child = json.tree.next(child);
  }
  return good;
}

bool read_faces(JsonAccess& json, JsonIndex at, PolygonMesh& out) {
  if (!json.is_array(at)) return false;
  const std::uint32_t count = json.tree.size(at);
  if (count > kMaxMeshTriangles)
    return json.wrong(at, "at most " + std::to_string(kMaxMeshTriangles) + " faces");
  if (out.points.empty()) return json.wrong(at, "points for the faces");
  out.face_ends.reserve(count);
  out.corners.reserve(std::size_t{3} * count);
  std::vector<std::uint32_t> face;
  bool good = true;
  for (JsonIndex f = json.tree.first_child(at); f != json.tree.end(at); f = json.tree.next(f)) {
    if (out.face_ends.size() % kValuesBetweenStops == 0) stop_if_asked();
    good = read_face(json, f, static_cast<std::uint32_t>(out.points.size()), face) && good;
    if (good) out.add_face(face);
  }
  return good;
}

/// Takes the mesh, or reports why there is none.
template <typename Mesh>
void take(JsonAccess& json, JsonIndex at, std::variant<Mesh, MeshFault> read, Mesh& out) {
  if (auto* mesh = std::get_if<Mesh>(&read)) {
    out = std::move(*mesh);
  } else {
    json.errors.add(at, std::get<MeshFault>(read).why);
  }
}

void read_polygons(JsonAccess& json, JsonIndex points, JsonIndex faces, TriangleMesh& out) {
  PolygonMesh polygons;
  if (read_points(json, points, polygons.points) && read_faces(json, faces, polygons)) {
    take(json, faces, closed_mesh(polygons), out);
  }
}

void read_named_file(JsonAccess& json, JsonIndex file, const MeshLoader& load, MeshShape& out) {
  std::string_view name;
  if (!json.read(file, name)) return;
  if (load) return take(json, file, load(name), out);
  json.errors.add(
      file, "no file is opened here: the mesh must be in the scene itself, as graycube sends it");
}

}  // namespace

bool read_points(JsonAccess& json, JsonIndex at, std::vector<Vec3>& out) {
  if (!json.is_array(at)) return false;
  const std::uint32_t count = json.tree.size(at);
  if (count > kMaxMeshPoints)
    return json.wrong(at, "at most " + std::to_string(kMaxMeshPoints) + " points");
  out.resize(count);
  bool good = true;
  JsonIndex child = json.tree.first_child(at);
  for (Vec3& p : out) {
    if ((&p - out.data()) % kValuesBetweenStops == 0) stop_if_asked();
    good = json.read(child, p) && good;
    child = json.tree.next(child);
  }
  return good;
}

void read_mesh(JsonAccess& json, JsonIndex at, const std::array<JsonIndex, kMaxNodeKeys>& members,
               const MeshLoader& load, MeshShape& out) {
  const JsonIndex points = members[kPoints], faces = members[kFaces], file = members[kFile];
  if (file != 0 ? points != 0 || faces != 0 : points == 0 || faces == 0) {
    json.errors.add(at,
                    "a mesh needs either the keys \"points\" and \"faces\" or the key \"file\"");
    return;
  }
  if (file != 0) {
    read_named_file(json, file, load, out);
  } else {
    read_polygons(json, points, faces, out.mesh);
  }
  // Digits given in the scene count more than those that the file's numbers have.
  json.read_optional(members[kDigits], out.digits, 1u, kMaxDigits);
}

}  // namespace graycube
