#include "formats/openscad/polyhedron.hpp"

#include <charconv>
#include <cmath>
#include <string>
#include <utility>

#include "formats/openscad/hulls/mesh.hpp"
#include "written_digits.hpp"

namespace graycube {
namespace {

/// Meshes of more faces are not tested for being convex.
constexpr std::size_t kMaxTestedFaces = 4 * kMaxPolyhedronFaces;

bool read_points(const ScadList& list, ScadMesh& mesh, ScadArguments& arguments) {
  if (list.size() > kMaxOpenscadPoints) {
    arguments.fail("more than " + std::to_string(kMaxOpenscadPoints) + " points");
    return false;
  }
  for (const ScadValue& value : list) {
    std::optional<Vec3> point = ScadArguments::vector(value);
    // Points of two numbers lie at z = 0.
    if (const auto pair = ScadArguments::pair(value)) point = Vec3{pair->x, pair->y, 0};
    if (!point || !(max_abs(*point) <= kMaxOpenscadCoordinate) || !is_finite(*point)) {
      arguments.leave_out("point", "point " + std::to_string(mesh.points.size()) +
                                       " is not three numbers of sensible size");
      return false;
    }
    mesh.points.push_back(*point);
  }
  return true;
}

/// The numbers in a face that are those of points; false if something in it is no number.
bool read_face(const ScadList& corners, std::size_t points, std::vector<std::uint32_t>& face,
               bool& has_strangers) {
  for (const ScadValue& corner : corners) {
    const double* index = corner.number();
    if (index == nullptr) return false;
    if (*index >= 0 && *index < static_cast<double>(points)) {
      face.push_back(static_cast<std::uint32_t>(*index));
    } else {
      has_strangers = true;
    }
  }
  return true;
}

/// Faces of fewer than three corners are passed over, and so are numbers of points that aren't
/// there, as OpenSCAD does.
bool read_faces(const ScadList& list, ScadMesh& mesh, ScadArguments& arguments) {
  if (list.size() > kMaxOpenscadFaces) {
    arguments.fail("more than " + std::to_string(kMaxOpenscadFaces) + " faces");
    return false;
  }
  for (std::size_t i = 0; i < list.size(); ++i) {
    const ScadList* corners = list[i].list();
    std::vector<std::uint32_t> face;
    bool has_strangers = false;
    if (corners == nullptr || !read_face(*corners, mesh.points.size(), face, has_strangers)) {
      arguments.leave_out("face",
                          "face " + std::to_string(i) + " is not a list of numbers of points");
      return false;
    }
    if (has_strangers) {
      arguments.ignore("strange point", "face " + std::to_string(i) +
                                            " names a point that isn't there, which is ignored");
    }
    if (face.size() >= 3) mesh.faces.push_back(std::move(face));
  }
  return true;
}

std::optional<ScadMesh> read_polyhedron(ScadArguments& arguments) {
  const ScadList* points = arguments.list("points", 0);
  const ScadList* faces = arguments.list("faces", 1);
  ScadMesh mesh;
  if (points == nullptr || faces == nullptr || !read_points(*points, mesh, arguments) ||
      !read_faces(*faces, mesh, arguments)) {
    return std::nullopt;
  }
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

}  // namespace

double precision_of(std::uint32_t digits) {
  return digits <= kOpenscadDigits ? kSixDigitPrecision : kComputedPrecision;
}

std::optional<ScadSolid> polyhedral_solid(ScadMesh mesh, ScadArguments& arguments,
                                          double precision) {
  if (mesh.faces.size() <= kMaxTestedFaces) {
    ConvexPlanes convex = convex_planes(mesh, precision);
    // What is thin for rounded numbers may have been written so.
    if (convex.flat && precision > kComputedPrecision)
      convex = convex_planes(mesh, kComputedPrecision);
    if (arguments.empty_unless(!convex.flat, "it encloses no volume")) return std::nullopt;
    if (convex.problem.empty() && convex.planes.size() <= kMaxPolyhedronFaces)
      return solid_of(std::move(convex), mesh);
  }
  PolygonMesh polygons = polygons_of(mesh);
  // Its faces turn clockwise as seen from outside.
  polygons.side = FaceSide::kInner;
  auto closed = closed_mesh(polygons, kOpenscadGrid);
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
