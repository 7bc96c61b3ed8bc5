#include "formats/openscad/program/delegate.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>
#include <variant>

#include "formats/mesh/mesh_file.hpp"
#include "formats/mesh/off.hpp"
#include "formats/openscad/program/program.hpp"
#include "geometry/aabb.hpp"

namespace graycube {
namespace {

/// Beyond so many times its own size from the origin a part is far.
constexpr double kFar = 10;
/// The digits of a number that was moved by one of more digits.
constexpr std::uint32_t kMostDigits = 15;

using Result = OpenscadProgram::Result;

void shape_of(const std::string& text, Delegated<PolygonMesh>& part) {
  auto mesh = read_off(text);
  if (auto* fault = std::get_if<MeshFault>(&mesh)) {
    part.trouble = "OpenSCAD's mesh: " + fault->why;
    return;
  }
  part.shape = std::get<PolygonMesh>(std::move(mesh));
  // However many digits they have, they were computed from a .csg file's numbers.
  part.shape.digits = kOpenscadDigits;
}

void shape_of(const std::string& text, Delegated<FlatLoops>& part) {
  if (auto loops = loops_of_svg(text)) {
    part.shape = *std::move(loops);
  } else {
    part.trouble = "OpenSCAD's SVG file is not what it writes";
  }
}

template <typename Shape>
Delegated<Shape> delegated(Result&& result) {
  Delegated<Shape> part;
  part.trouble = std::move(result.trouble);
  for (const std::string& line : result.said) part.said.push_back("openscad: " + line);
  if (part.trouble.empty() && !result.text.empty()) shape_of(result.text, part);
  return part;
}

Aabb box_of(const PolygonMesh& mesh) {
  Aabb box = Aabb::nothing();
  for (const Vec3& p : mesh.points) box.include(p);
  return box;
}
Aabb box_of(const FlatLoops& loops) {
  Aabb box = Aabb::nothing();
  for (const FlatLoop& loop : loops) {
    for (const FlatPoint& p : loop) box.include({p.x, p.y, 0});
  }
  return box;
}

void move(PolygonMesh& mesh, const Vec3& by) {
  for (Vec3& p : mesh.points) p = p + by;
  mesh.digits = kMostDigits;
}
void move(FlatLoops& loops, const Vec3& by) {
  for (FlatLoop& loop : loops) {
    for (FlatPoint& p : loop) p = {p.x + by.x, p.y + by.y};
  }
}

/// About the centre of a part that is far from the origin, in few binary digits, so that moving the
/// part there and back costs none of its own; nothing for other parts.
template <typename Shape>
std::optional<Vec3> far_center(const Shape& shape) {
  const Aabb box = box_of(shape);
  if (box.is_empty()) return std::nullopt;
  Vec3 center = box.center();
  const double size = max_abs(box.hi - box.lo), distance = max_abs(center);
  if (!(distance > kFar * size) || !std::isfinite(distance)) return std::nullopt;
  // A part can be smaller than what six digits tell apart.
  const double step = std::exp2(std::ceil(std::log2(std::max(size, 1e-6 * distance))));
  for (int a = 0; a < 3; ++a) center[a] = std::round(center[a] / step) * step;
  return center;
}

/// The part's text, moved by −`by`.
OpenscadProgram::Part near_origin(const OpenscadProgram::Part& part, const Vec3& by) {
  ScadModule moved;
  moved.name = "translate";
  moved.arguments.push_back(
      {"", ScadValue{ScadList{ScadValue{-by.x}, ScadValue{-by.y}, ScadValue{-by.z}}}});
  std::string text = scad_text(moved, {});
  // The part takes the place of the end of the statement, ";\n".
  text.resize(text.rfind(';'));
  return {text + " {\n" + part.csg + "}\n", part.name};
}

/// All solids of a mesh file as one mesh.
PolygonMesh polygons_of(const MeshSolids& file) {
  PolygonMesh mesh;
  for (const MeshSolid& solid : file.solids) {
    const TriangleMesh& own = solid.shape.mesh;
    const auto first = static_cast<std::uint32_t>(mesh.points.size());
    mesh.points.insert(mesh.points.end(), own.points.begin(), own.points.end());
    mesh.digits = std::max(mesh.digits, solid.shape.digits);
    for (const auto& [a, b, c] : own.triangles)
      mesh.add_face(std::array{first + a, first + b, first + c});
  }
  return mesh;
}

}  // namespace

template <typename Shape>
const Delegated<Shape>* OpenscadDelegate::answer(Answers<Shape>& answers,
                                                 const ScadModule& module) {
  std::string text = scad_text(module, folder_);
  const auto known = answers.known.find(text);
  if (known != answers.known.end()) return &known->second;
  if (answers.asked_texts.insert(text).second) {
    answers.asked.push_back(
        {std::move(text), module.name + "() of line " + std::to_string(module.line)});
  }
  return nullptr;
}

const Delegated<PolygonMesh>* OpenscadDelegate::solid(const ScadModule& module) {
  return answer(solids_, module);
}
const Delegated<FlatLoops>* OpenscadDelegate::flat(const ScadModule& module) {
  return answer(flats_, module);
}

const Delegated<PolygonMesh>& OpenscadDelegate::mesh_file(const std::filesystem::path& path) {
  const auto [place, is_new] = files_.try_emplace(path);
  Delegated<PolygonMesh>& part = place->second;
  if (!is_new) return part;
  auto read = read_mesh_file(path, {.open = OpenMeshes::kDropExtraFaces, .foreign = {}});
  if (auto* fault = std::get_if<MeshFault>(&read)) {
    // Whoever tells of it names the file as the model does.
    const std::string prefix = path.string() + ": ";
    part.trouble = fault->why.substr(fault->why.starts_with(prefix) ? prefix.size() : 0);
    return part;
  }
  const MeshSolids& file = std::get<MeshSolids>(read);
  part.shape = polygons_of(file);
  for (const ImportWarning& warning : file.warnings) {
    part.said.push_back(warning.text);
    part.is_partial |= warning.leaves_out;
  }
  return part;
}

template <typename Shape>
bool OpenscadDelegate::evaluate(Answers<Shape>& answers) {
  if (answers.asked.empty()) return false;
  const std::vector<OpenscadProgram::Part> parts = std::exchange(answers.asked, {});
  answers.asked_texts.clear();
  std::vector<OpenscadProgram::Part> far;
  std::vector<std::pair<Delegated<Shape>*, Vec3>> places;
  std::vector<Result> results = program_->evaluate_all(parts, answers.format);
  for (std::size_t i = 0; i < parts.size(); ++i) {
    Delegated<Shape>& part = answers.known[parts[i].csg];
    part = delegated<Shape>(std::move(results[i]));
    if (const auto center = far_center(part.shape)) {
      far.push_back(near_origin(parts[i], *center));
      places.emplace_back(&part, *center);
    }
  }
  if (far.empty()) return true;
  results = program_->evaluate_all(far, answers.format);
  for (std::size_t i = 0; i < far.size(); ++i) {
    Delegated<Shape> near = delegated<Shape>(std::move(results[i]));
    const auto& [part, center] = places[i];
    // If the second run fails, the coarse part is better than none.
    if (box_of(near.shape).is_empty()) continue;
    move(near.shape, center);
    part->shape = std::move(near.shape);
  }
  return true;
}

bool OpenscadDelegate::evaluate_asked() {
  const bool had_solids = evaluate(solids_);
  return evaluate(flats_) || had_solids;
}

}  // namespace graycube
