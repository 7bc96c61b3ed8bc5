// Turns the solids of a .csg file into a scene: objects, materials, camera and lights.
#include <algorithm>
#include <string>
#include <utility>
#include <variant>

#include "check.hpp"
#include "formats/openscad/camera.hpp"
#include "formats/openscad/language/exact.hpp"
#include "formats/openscad/language/parser.hpp"
#include "formats/openscad/openscad.hpp"
#include "formats/openscad/parts.hpp"
#include "formats/openscad/program/delegate.hpp"
#include "formats/openscad/program/file_extrusions.hpp"
#include "formats/view/framing.hpp"

namespace graycube {
namespace {

void collect_materials(const CsgNode& node, std::vector<MaterialIndex>& used) {
  if (node.material != kInheritMaterial) used.push_back(node.material);
  if (const auto* inner = std::get_if<OperationNode>(&node.value)) {
    for (const CsgNode& child : inner->children) collect_materials(child, used);
  }
}

void forget_materials(CsgNode& node) {
  node.material = kInheritMaterial;
  if (auto* inner = std::get_if<OperationNode>(&node.value)) {
    for (CsgNode& child : inner->children) forget_materials(child);
  }
}

/// The part as an object; its material is named once if all leaves share it.
SceneObject object_of(Part part, std::string name) {
  SceneObject object{std::move(name), kInheritMaterial, std::move(part.node)};
  std::vector<MaterialIndex> used;
  collect_materials(object.csg, used);
  if (std::equal(used.begin() + 1, used.end(), used.begin())) {
    object.material = used.front();
    forget_materials(object.csg);
  }
  return object;
}

bool any_transparent(const std::vector<Part>& parts, const std::vector<NamedMaterial>& materials) {
  std::vector<MaterialIndex> used;
  for (const Part& part : parts) collect_materials(part.node, used);
  return std::any_of(used.begin(), used.end(),
                     [&](MaterialIndex i) { return materials[i].material.transmit > 0; });
}

/// The solid under a map of its root's own.
CsgNode under(const Affine& map, CsgNode solid) {
  if (!solid.transform) {
    solid.transform = map;
    return solid;
  }
  OperationNode alone{Operation::kUnion, {}};
  alone.children.push_back(std::move(solid));
  return {std::move(alone), map, kInheritMaterial};
}

/// Significant digits to which facets' planes are known by their corners, whose last place is some
/// 1e-16 of how far out they are: facets may be some 1e-4 of that wide.
constexpr std::uint32_t kFacetDigits = 12;

/// Whether it lies so far from the origin that the rounding of how far exceeds that of its own
/// numbers.
bool is_far(const Reach& reach) {
  constexpr double kFar = 4;
  const Aabb box = reach.box();
  return !box.is_empty() && max_abs(box.center()) > kFar * max_abs(box.hi - box.lo);
}

std::vector<SceneObject> objects_of(std::vector<Part> parts,
                                    const std::vector<NamedMaterial>& materials) {
  std::vector<SceneObject> objects;
  if (parts.size() > 1 && any_transparent(parts, materials)) {
    objects.push_back(object_of(united(std::move(parts)), "model"));
    return objects;
  }
  for (Part& part : parts) {
    std::string name = "part " + std::to_string(objects.size() + 1) + ": " + part.module +
                       ", line " + std::to_string(part.line);
    objects.push_back(object_of(std::move(part), std::move(name)));
  }
  return objects;
}

/// The first module with `!` in front, outer ones before inner ones and in the order of the file;
/// null if there is none.
const ScadModule* root_of(const std::vector<ScadModule>& modules) {
  for (const ScadModule& module : modules) {
    if (module.root) return &module;
    if (const ScadModule* inner = root_of(module.children)) return inner;
  }
  return nullptr;
}

/// Gives the modules' numbers all digits, if these can be had; false if they keep six.
bool improve_numbers(std::vector<ScadModule>& modules, std::string_view spelled_out) {
  if (spelled_out.empty() || spelled_out.size() > kMaxOpenscadBytes) return false;
  OpenscadReport unread;
  const std::vector<ScadModule> marked = parse_openscad(spelled_out, unread);
  return !unread.has_errors() && spell_out(modules, marked);
}

/// The parts, with all that the delegate has to ask for. What there is to tell of them is told
/// once.
OpenscadParts parts_of(const std::vector<ScadModule>& modules, const OpenscadOptions& options,
                       std::uint32_t digits, OpenscadDelegate& delegate,
                       std::optional<OpenscadModules>& file, OpenscadReport& report) {
  for (;;) {
    OpenscadReport told = report;
    // Anew, since forms that were found while parts were missing are wrong.
    file.emplace(modules, options, digits, delegate);
    OpenscadParts found = file->parts(false, told);
    if (delegate.evaluate_asked()) continue;
    report = std::move(told);
    return found;
  }
}

/// Gives the settings the model's own camera, if it has one.
void set_view(const OpenscadOptions& options, OpenscadReport& report, RenderSettings& settings) {
  if (!options.view) return;
  const std::optional<Camera> camera = camera_of(*options.view, options.frame.image);
  if (camera) settings.camera = *camera;
  if (!camera)
    report.warning(0, "no camera is as $vpt, $vpr, $vpd and $vpf say; the model is framed");
}

Scene import_modules(std::vector<ScadModule> modules, const OpenscadOptions& options,
                     OpenscadReport& report) {
  const bool is_exact = improve_numbers(modules, options.spelled_out);
  import_files_of_extrusions(modules);
  const std::uint32_t digits = is_exact ? kSpelledOutDigits : kOpenscadDigits;
  if (const ScadModule* root = root_of(modules)) {
    std::vector<ScadModule> only{*root};
    modules = std::move(only);
  }
  OpenscadDelegate delegate(options.program, options.folder);
  std::optional<OpenscadModules> file;
  OpenscadParts found = parts_of(modules, options, digits, delegate, file, report);
  Scene scene;
  scene.digits = is_exact && !has_flat_parts_of_six_digits(modules) ? 0 : kOpenscadDigits;
  if (report.has_errors()) return scene;
  const bool keeps_apart = scene.digits > 0 && found.around_all && is_far(reach_of(found.parts));
  if (keeps_apart) {
    OpenscadReport told_already;
    found = file->parts(true, told_already);
  }
  if (scene.digits == 0 && file->has_faceted_rounds()) scene.digits = kFacetDigits;
  auto& [parts, materials, around_all] = found;
  scene.settings = framed_settings(reach_of(parts), options.frame);
  set_view(options, report, scene.settings);
  scene.materials = std::move(materials);
  if (parts.empty() && report.leaves_out()) {
    report.error(0, "nothing is left of the model");
  } else if (parts.empty()) {
    report.warning(0, "the model is empty");
  }
  scene.objects = objects_of(std::move(parts), scene.materials);
  if (keeps_apart) {
    for (SceneObject& object : scene.objects)
      object.csg = under(*around_all, std::move(object.csg));
  }
  return scene;
}

}  // namespace

OpenscadResult read_openscad_csg(std::string_view text, const OpenscadOptions& options) {
  GRAYCUBE_CHECK(options.frame.image.width > 0 && options.frame.image.height > 0, "picture %u x %u",
                 options.frame.image.width, options.frame.image.height);
  GRAYCUBE_CHECK(options.frame.fov_degrees > 0 && options.frame.fov_degrees < 180, "fov %g",
                 options.frame.fov_degrees);
  GRAYCUBE_CHECK(options.frame.margin >= 0 && options.frame.margin < 0.5, "margin %g",
                 options.frame.margin);
  OpenscadReport report;
  Scene scene;
  if (text.size() > kMaxOpenscadBytes) {
    report.error(0, "the file has more than " + std::to_string(kMaxOpenscadBytes) + " bytes");
  } else {
    scene = import_modules(parse_openscad(text, report), options, report);
  }
  OpenscadResult result;
  if (!report.has_errors()) result.scene = std::move(scene);
  result.errors = report.take_errors();
  result.warnings = report.take_warnings();
  return result;
}

}  // namespace graycube
