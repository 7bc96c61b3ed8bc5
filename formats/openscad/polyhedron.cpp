#include "formats/openscad/polyhedron.hpp"

#include <charconv>
#include <cmath>
#include <string>
#include <utility>

#include "formats/mesh/extra_faces.hpp"
#include "formats/openscad/hulls/mesh.hpp"
#include "written_digits.hpp"

namespace graycube {
namespace {

/// Meshes of more faces are not tested for being convex.
constexpr std::size_t kMaxTestedFaces = 4 * kMaxPolyhedronFaces;

/// The points of a polyhedron(), and which of them are no points: only faces that use them suffer.
struct ReadPoints {
  std::vector<Vec3> points;
  std::vector<bool> is_bad;
};

std::optional<Vec3> point_of(const ScadValue& value) {
  std::optional<Vec3> point = ScadArguments::vector(value);
  // Points of two numbers lie at z = 0.
  if (const auto pair = ScadArguments::pair(value)) point = Vec3{pair->x, pair->y, 0};
  if (!point || !is_finite(*point) || max_abs(*point) > kMaxOpenscadCoordinate) return std::nullopt;
  return point;
}

std::optional<ReadPoints> read_points(const ScadList& list, ScadArguments& arguments) {
  if (list.size() > kMaxOpenscadPoints) {
    arguments.leave_out("points", "more than " + std::to_string(kMaxOpenscadPoints) + " points");
    return std::nullopt;
  }
  ReadPoints read;
  for (const ScadValue& value : list) {
    const auto point = point_of(value);
    read.points.push_back(point.value_or(Vec3{}));
    read.is_bad.push_back(!point);
  }
  return read;
}

/// The numbers in a face that are those of points. False, and the polyhedron is left out, if
/// something in it is no number or no point; numbers of points that aren't there are passed over.
bool read_face(const ScadList& corners, std::size_t number, const ReadPoints& points,
               ScadArguments& arguments, std::vector<std::uint32_t>& face) {
  const std::string name = "face " + std::to_string(number);
  bool has_strangers = false;
  for (const ScadValue& corner : corners) {
    const double* index = corner.number();
    if (index == nullptr) {
      arguments.leave_out("face", name + " is not a list of numbers of points");
      return false;
    }
    if (!(*index >= 0 && *index < static_cast<double>(points.points.size()))) {
      has_strangers = true;
      continue;
    }
    face.push_back(static_cast<std::uint32_t>(*index));
    if (points.is_bad[face.back()]) {
      arguments.leave_out("point", "point " + std::to_string(face.back()) +
                                       " is not three numbers of sensible size");
      return false;
    }
  }
  if (has_strangers) {
    arguments.ignore("strange point", name + " names a point that isn't there, which is ignored");
  }
  return true;
}

/// Faces of fewer than three corners, and what is no list, are passed over, as OpenSCAD does.
bool read_faces(const ScadList& list, const ReadPoints& points, ScadArguments& arguments,
                ScadMesh& mesh) {
  if (list.size() > kMaxOpenscadFaces) {
    arguments.leave_out("faces", "more than " + std::to_string(kMaxOpenscadFaces) + " faces");
    return false;
  }
  for (std::size_t i = 0; i < list.size(); ++i) {
    const ScadList* corners = list[i].list();
    if (corners == nullptr) {
      arguments.pass_over("face " + std::to_string(i), "must be a list of numbers of points");
      continue;
    }
    std::vector<std::uint32_t> face;
    if (!read_face(*corners, i, points, arguments, face)) return false;
    if (face.size() >= 3) mesh.faces.push_back(std::move(face));
  }
  return true;
}

std::optional<ScadMesh> read_polyhedron(ScadArguments& arguments) {
  const ScadList* points = arguments.list("points", 0);
  const ScadList* faces = arguments.list("faces", 1);
  if (points == nullptr || faces == nullptr) return std::nullopt;
  auto read = read_points(*points, arguments);
  ScadMesh mesh;
  if (!read || !read_faces(*faces, *read, arguments, mesh)) return std::nullopt;
  mesh.points = std::move(read->points);
  return mesh;
}

/// Whether some coordinate has as many digits as rounded numbers have: shorter ones are exact.
bool may_be_rounded(const ScadMesh& mesh) {
  for (const Vec3& p : mesh.points) {
    for (int a = 0; a < 3; ++a) {
      char text[32];
      const char* end = std::to_chars(text, text + sizeof text, p[a]).ptr;
      if (significant_digits({text, static_cast<std::size_t>(end - text)}) >= kLeastWrittenDigits)
        return true;
    }
  }
  return false;
}

std::optional<ScadSolid> solid_of(ConvexPlanes convex, ScadMesh& mesh) {
  CsgNode leaf{PolyhedronShape{std::move(convex.planes)}, std::nullopt, kInheritMaterial};
  return ScadSolid{std::move(leaf), used_points(mesh)};
}

/// Whether a mesh has no volume but for the rounding of its corners.
bool is_flat(const TriangleMesh& mesh) {
  const Vec3 origin = mesh.points.front();
  double volume = 0, area = 0, size = 0;
  for (const Vec3& p : mesh.points) size = std::max(size, max_abs(p));
  for (const auto& [a, b, c] : mesh.triangles) {
    const Vec3 twice = cross(mesh.points[b] - mesh.points[a], mesh.points[c] - mesh.points[a]);
    volume += dot(mesh.points[a] - origin, twice) / 6;
    area += 0.5 * length(twice);
  }
  return std::fabs(volume) <= kComputedPrecision * size * area;
}

std::variant<TriangleMesh, MeshFault> surface_of(const ScadMesh& mesh) {
  PolygonMesh polygons = polygons_of(mesh);
  // Its faces turn clockwise as seen from outside.
  polygons.side = FaceSide::kInner;
  return closed_mesh(polygons, kOpenscadGrid);
}

/// Drops faces that are one too many, where the others are closed, and tells so.
void drop_extra_faces(ScadMesh& mesh, ScadArguments& arguments) {
  const auto rest = without_extra_faces(polygons_of(mesh), kOpenscadGrid);
  if (!rest) return;
  const std::size_t count = mesh.faces.size();
  mesh.faces.clear();
  std::uint32_t begin = 0;
  for (const std::uint32_t end : rest->face_ends) {
    mesh.faces.emplace_back(rest->corners.begin() + begin, rest->corners.begin() + end);
    begin = end;
  }
  arguments.ignore("extra faces", std::to_string(count - mesh.faces.size()) + " of its " +
                                      std::to_string(count) +
                                      " faces are ignored: their edges have two others");
}

}  // namespace

double precision_of(std::uint32_t digits) {
  return digits <= kOpenscadDigits ? kSixDigitPrecision : kComputedPrecision;
}

std::optional<ScadSolid> polyhedral_solid(ScadMesh mesh, ScadArguments& arguments,
                                          double precision) {
  drop_extra_faces(mesh, arguments);
  if (mesh.faces.size() <= kMaxTestedFaces) {
    ConvexPlanes convex = convex_planes(mesh, precision);
    // What is thin for rounded numbers may have been written so.
    if (convex.flat && precision > kComputedPrecision)
      convex = convex_planes(mesh, kComputedPrecision);
    if (arguments.empty_unless(!convex.flat, "it encloses no volume")) return std::nullopt;
    if (convex.problem.empty() && convex.planes.size() <= kMaxPolyhedronFaces)
      return solid_of(std::move(convex), mesh);
  }
  auto closed = surface_of(mesh);
  if (const auto* fault = std::get_if<MeshFault>(&closed)) {
    arguments.leave_out("not closed", "its faces enclose no solid: " + fault->why);
    return std::nullopt;
  }
  TriangleMesh& surface = std::get<TriangleMesh>(closed);
  if (arguments.empty_unless(!is_flat(surface), "it encloses no volume")) return std::nullopt;
  CsgNode leaf{MeshShape{std::move(surface)}, std::nullopt, kInheritMaterial};
  return ScadSolid{std::move(leaf), used_points(mesh)};
}

std::optional<ScadSolid> polyhedron(ScadArguments& arguments, std::uint32_t digits) {
  auto mesh = read_polyhedron(arguments);
  if (!mesh) return std::nullopt;
  const double precision = may_be_rounded(*mesh) ? precision_of(digits) : kComputedPrecision;
  return polyhedral_solid(*std::move(mesh), arguments, precision);
}

std::vector<Vec3> polyhedron_corners(const ScadModule& module, OpenscadReport& report) {
  ScadArguments arguments(module, report);
  const auto mesh = read_polyhedron(arguments);
  return mesh ? used_points(*mesh) : std::vector<Vec3>{};
}

}  // namespace graycube
