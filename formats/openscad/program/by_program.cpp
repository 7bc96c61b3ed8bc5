#include "formats/openscad/program/by_program.hpp"

#include <algorithm>
#include <filesystem>
#include <string>
#include <system_error>
#include <variant>

#include "formats/mesh/mesh_file.hpp"

namespace graycube {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxToldLines = 3;

/// The file that a module names, as it is written; empty if there is none.
std::string file_of(const ScadModule& module) {
  if (module.name != "import" && module.name != "surface") return {};
  const ScadValue* value = module.argument("file", 0);
  const auto* name = value != nullptr ? std::get_if<std::string>(&value->value) : nullptr;
  return name != nullptr ? *name : "";
}

/// "minkowski()", "import() of part.stl".
std::string named(const ScadModule& module) {
  const std::string file = file_of(module);
  return file.empty() ? module.name + "()" : module.name + "() of " + file;
}

void leave_out(const ScadModule& module, const std::string& why, ScadImport& import) {
  const std::string message = named(module) + " is left out: " + why;
  import.leave_out_once(message, module.line, message);
}

/// Whether the module names a file that isn't there; then it is left out.
bool lacks_file(const ScadModule& module, ScadImport& import) {
  const std::string& folder = import.delegate.folder();
  const std::string file = file_of(module);
  if (folder.empty() || file.empty()) return false;
  std::error_code error;
  const fs::path path = fs::path(folder) / file;
  if (fs::is_regular_file(path, error)) return false;
  leave_out(module, fs::exists(path, error) ? "it is not a file" : "there is no such file", import);
  return true;
}

/// The STL or OFF file of an import(), which is read without the program; nothing for other
/// modules.
std::optional<fs::path> own_mesh_file(const ScadModule& module, const ScadImport& import) {
  const std::string& folder = import.delegate.folder();
  const std::string file = file_of(module);
  const bool is_own = is_mesh_file(file) && !is_foreign_mesh_file(file);
  if (module.name != "import" || folder.empty() || !is_own) return std::nullopt;
  return fs::path(folder) / file;
}

/// Tells what the program said; true if there is a shape.
template <typename Shape>
bool is_made(const Delegated<Shape>& part, const ScadModule& module, ScadImport& import) {
  if (!part.trouble.empty()) {
    leave_out(module, part.trouble, import);
    return false;
  }
  for (std::size_t i = 0; i < std::min(part.said.size(), kMaxToldLines); ++i) {
    const std::string message = named(module) + ": " + part.said[i];
    if (part.is_partial) {
      import.leave_out_once(message, module.line, message);
    } else {
      import.warn_once(module.line, message);
    }
  }
  return true;
}

bool is_empty_text(const ScadModule& module) {
  const ScadValue* value = module.name == "text" ? module.argument("text", 0) : nullptr;
  const auto* text = value != nullptr ? std::get_if<std::string>(&value->value) : nullptr;
  return text != nullptr && text->empty();
}

/// Whether the program can be asked; else there is an error.
bool can_ask(const ScadModule& module, const char* as, ScadImport& import) {
  if (!import.delegate.is_there()) {
    import.report.error(module.line,
                        module.name + "() needs the program openscad, which is not there");
    return false;
  }
  import.warn_once(module.line, module.name + "() is evaluated by OpenSCAD, as a " + as);
  return true;
}

}  // namespace

std::optional<PolygonMesh> solid_by_program(const ScadModule& module, ScadImport& import) {
  if (lacks_file(module, import)) return std::nullopt;
  const auto path = own_mesh_file(module, import);
  if (!path && !can_ask(module, "mesh", import)) return std::nullopt;
  const Delegated<PolygonMesh>* part =
      path ? &import.delegate.mesh_file(*path) : import.delegate.solid(module);
  if (part == nullptr || !is_made(*part, module, import)) return std::nullopt;
  return part->shape;
}

std::optional<FlatLoops> flat_by_program(const ScadModule& module, ScadImport& import) {
  if (is_empty_text(module) || lacks_file(module, import) || !can_ask(module, "polygon", import))
    return std::nullopt;
  const Delegated<FlatLoops>* part = import.delegate.flat(module);
  if (part == nullptr || !is_made(*part, module, import)) return std::nullopt;
  return part->shape;
}

}  // namespace graycube
