#include "scene/openscad_primitives.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "scene/openscad_mesh.hpp"

namespace graycube {
namespace {

/// From this many sides on a cylinder or sphere stands for a round one.
constexpr double kLeastRoundSides = 9;

/// Reads one module's arguments. What is wrong is reported at once; `ok` tells in the end.
class Arguments {
 public:
  Arguments(const ScadModule& module, OpenscadReport& report) : module_(module), report_(report) {}

  bool ok() const { return ok_; }
  bool has(const char* name) const { return module_.argument(name) != nullptr; }

  double number(const char* name, int position, double otherwise) {
    const ScadValue* value = module_.argument(name, position);
    if (value == nullptr) return otherwise;
    if (const double* n = value->number()) return *n;
    fail(std::string(name) + " must be a number");
    return otherwise;
  }
  bool boolean(const char* name, int position) {
    const ScadValue* value = module_.argument(name, position);
    if (value == nullptr) return false;
    if (const bool* b = value->boolean()) return *b;
    fail(std::string(name) + " must be true or false");
    return false;
  }
  /// Three numbers; nothing, unreported, for anything else.
  static std::optional<Vec3> vector(const ScadValue& value) {
    const ScadList* list = value.list();
    if (list == nullptr || list->size() != 3) return std::nullopt;
    Vec3 v;
    for (int a = 0; a < 3; ++a) {
      const double* n = (*list)[static_cast<std::size_t>(a)].number();
      if (n == nullptr) return std::nullopt;
      v[a] = *n;
    }
    return v;
  }
  const ScadList* list(const char* name, int position) {
    const ScadValue* value = module_.argument(name, position);
    if (value != nullptr && value->list() != nullptr) return value->list();
    fail(std::string(name) + " must be a list");
    return nullptr;
  }

  void fail(const std::string& why) {
    report_.error(module_.line, module_.name + "(): " + why);
    ok_ = false;
  }
  /// True, with a warning, when this is nothing in OpenSCAD; also when an error was reported.
  bool empty_unless(bool solid, const char* why) {
    if (ok_ && !solid) report_.warning(module_.line, module_.name + "() is left out: " + why);
    return !ok_ || !solid;
  }

 private:
  const ScadModule& module_;
  OpenscadReport& report_;
  bool ok_ = true;
};

bool positive(double v) { return std::isfinite(v) && v > 0; }

ScadSolid round_solid(decltype(CsgNode::value) shape) {
  return {CsgNode{std::move(shape), std::nullopt, kInheritMaterial}, {}};
}

std::optional<ScadSolid> solid_of(ScadMesh mesh, Arguments& arguments) {
  ConvexPlanes convex = convex_planes(mesh);
  if (!convex.problem.empty()) {
    arguments.fail(convex.problem);
    return std::nullopt;
  }
  if (arguments.empty_unless(!convex.flat, "it encloses no volume")) return std::nullopt;
  return ScadSolid{
      CsgNode{PolyhedronShape{std::move(convex.planes)}, std::nullopt, kInheritMaterial},
      std::move(mesh.points)};
}

/// The sides that $fn asks for when they are few: then the corners are meant. 0 for a round one.
int asked_sides(Arguments& arguments) {
  const double fn = arguments.number("$fn", -1, 0);
  if (!(fn > 0) || fn >= kLeastRoundSides) return 0;
  return static_cast<int>(std::max(fn, 3.0));
}

std::optional<ScadSolid> cube(const ScadModule& module, Arguments& arguments) {
  Vec3 size{1, 1, 1};
  if (const ScadValue* value = module.argument("size", 0)) {
    const double* edge = value->number();
    const std::optional<Vec3> vector = Arguments::vector(*value);
    if (edge != nullptr) size = {*edge, *edge, *edge};
    if (vector) size = *vector;
    if (edge == nullptr && !vector) arguments.fail("size must be a number or three numbers");
  }
  const bool center = arguments.boolean("center", 1);
  if (arguments.empty_unless(positive(size.x) && positive(size.y) && positive(size.z),
                             "its size is not positive")) {
    return std::nullopt;
  }
  return round_solid(center ? BoxShape{-0.5 * size, 0.5 * size} : BoxShape{{}, size});
}

std::optional<ScadSolid> sphere(Arguments& arguments) {
  const double r =
      arguments.has("d") ? 0.5 * arguments.number("d", -1, 2) : arguments.number("r", 0, 1);
  const int sides = asked_sides(arguments);
  if (arguments.empty_unless(positive(r), "its radius is not positive")) return std::nullopt;
  if (sides > 0) return solid_of(faceted_sphere(r, sides), arguments);
  return round_solid(SphereShape{{}, r});
}

std::optional<ScadSolid> cylinder(Arguments& arguments) {
  const double h = arguments.number("h", 0, 1);
  double r1 = arguments.number("r", -1, 0.5 * arguments.number("d", -1, 2));
  double r2 = r1;
  r1 = arguments.number("r1", 1, arguments.has("d1") ? 0.5 * arguments.number("d1", -1, 2) : r1);
  r2 = arguments.number("r2", 2, arguments.has("d2") ? 0.5 * arguments.number("d2", -1, 2) : r2);
  const bool center = arguments.boolean("center", 3);
  const int sides = asked_sides(arguments);
  if (arguments.empty_unless(positive(h), "its height is not positive")) return std::nullopt;
  const bool radii = (r1 == 0 || positive(r1)) && (r2 == 0 || positive(r2)) && r1 + r2 > 0;
  if (arguments.empty_unless(radii, "its radii are not positive")) return std::nullopt;
  const double low = center ? -0.5 * h : 0, high = center ? 0.5 * h : h;
  if (sides > 0) return solid_of(faceted_cylinder(low, high, r1, r2, sides), arguments);
  if (r1 == r2) return round_solid(CylinderShape{{0, 0, low}, {0, 0, high}, r1});
  return round_solid(ConeShape{{0, 0, low}, r1, {0, 0, high}, r2});
}

bool read_points(const ScadList& list, ScadMesh& mesh, Arguments& arguments) {
  if (list.size() > kMaxOpenscadPoints) {
    arguments.fail("more than " + std::to_string(kMaxOpenscadPoints) + " points");
    return false;
  }
  for (const ScadValue& value : list) {
    const std::optional<Vec3> point = Arguments::vector(value);
    if (!point || !(max_abs(*point) <= kMaxOpenscadCoordinate) || !is_finite(*point)) {
      arguments.fail("point " + std::to_string(mesh.points.size()) +
                     " is not three numbers of sensible size");
      return false;
    }
    mesh.points.push_back(*point);
  }
  return true;
}

bool read_faces(const ScadList& list, ScadMesh& mesh, Arguments& arguments) {
  if (list.size() > kMaxOpenscadFaces) {
    arguments.fail("more than " + std::to_string(kMaxOpenscadFaces) + " faces");
    return false;
  }
  for (const ScadValue& value : list) {
    const ScadList* corners = value.list();
    std::vector<std::uint32_t> face;
    bool ok = corners != nullptr && corners->size() <= kMaxOpenscadPoints;
    for (std::size_t i = 0; ok && i < corners->size(); ++i) {
      const double* index = (*corners)[i].number();
      ok = index != nullptr && *index >= 0 && *index < static_cast<double>(mesh.points.size()) &&
           *index == std::floor(*index);
      if (ok) face.push_back(static_cast<std::uint32_t>(*index));
    }
    if (!ok) {
      arguments.fail("face " + std::to_string(mesh.faces.size()) +
                     " is not a list of numbers of points");
      return false;
    }
    mesh.faces.push_back(std::move(face));
  }
  return true;
}

std::optional<ScadSolid> polyhedron(Arguments& arguments) {
  const ScadList* points = arguments.list("points", 0);
  const ScadList* faces = arguments.list("faces", 1);
  ScadMesh mesh;
  if (points == nullptr || faces == nullptr || !read_points(*points, mesh, arguments) ||
      !read_faces(*faces, mesh, arguments)) {
    return std::nullopt;
  }
  return solid_of(std::move(mesh), arguments);
}

}  // namespace

bool is_openscad_primitive(const ScadModule& module) {
  return module.name == "cube" || module.name == "sphere" || module.name == "cylinder" ||
         module.name == "polyhedron";
}

std::optional<ScadSolid> openscad_primitive(const ScadModule& module, OpenscadReport& report) {
  Arguments arguments(module, report);
  if (module.name == "cube") return cube(module, arguments);
  if (module.name == "sphere") return sphere(arguments);
  if (module.name == "cylinder") return cylinder(arguments);
  return polyhedron(arguments);
}

std::optional<Affine> openscad_matrix(const ScadModule& module, OpenscadReport& report) {
  Arguments arguments(module, report);
  std::array<std::array<double, 4>, 4> m{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}}};
  if (const ScadValue* value = module.argument("m", 0)) {
    const ScadList* rows = value->list();
    if (rows == nullptr) arguments.fail("m must be a list of rows");
    for (std::size_t i = 0; rows != nullptr && i < std::min<std::size_t>(rows->size(), 4); ++i) {
      const ScadList* row = (*rows)[i].list();
      if (row == nullptr) arguments.fail("m must be a list of rows");
      for (std::size_t j = 0; row != nullptr && j < std::min<std::size_t>(row->size(), 4); ++j) {
        if (const double* entry = (*row)[j].number()) {
          m[i][j] = *entry;
        } else if (!(*row)[j].is_undef()) {
          arguments.fail("the entries of m must be numbers");
        }
      }
    }
  }
  if (arguments.ok() && (m[3][0] != 0 || m[3][1] != 0 || m[3][2] != 0)) {
    arguments.fail("a fourth row other than [0, 0, 0, w] is not supported");
  }
  Affine map;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 4; ++j) map.m[i][j] = m[i][j] / m[3][3];
  }
  if (arguments.empty_unless(map.is_finite(), "its matrix is not finite")) return std::nullopt;
  if (arguments.empty_unless(map.inverse().has_value(), "its matrix flattens everything in it"))
    return std::nullopt;
  return map;
}

std::optional<ScadColor> openscad_color(const ScadModule& module, OpenscadReport& report) {
  Arguments arguments(module, report);
  ScadColor color;
  if (const ScadValue* value = module.argument("c", 0)) {
    const ScadList* list = value->list();
    if (list == nullptr || list->size() < 3 || list->size() > 4) {
      arguments.fail("the colour must be three or four numbers");
      return std::nullopt;
    }
    color.rgba[3] = 1;
    for (std::size_t i = 0; i < list->size(); ++i) {
      const double* component = (*list)[i].number();
      if (component == nullptr) arguments.fail("the colour must be three or four numbers");
      // Negated so that a NaN leaves the component open.
      if (component != nullptr) color.rgba[i] = !(*component >= 0) ? -1 : std::min(*component, 1.0);
    }
  }
  color.rgba[3] = std::min(arguments.number("alpha", 1, color.rgba[3]), 1.0);
  if (!arguments.ok()) return std::nullopt;
  return color;
}

}  // namespace graycube
