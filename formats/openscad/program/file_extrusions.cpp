#include "formats/openscad/program/file_extrusions.hpp"

#include <string>
#include <utility>

namespace graycube {
namespace {

bool names_file(const ScadModule& module) {
  if (module.name != "linear_extrude" && module.name != "rotate_extrude") return false;
  const ScadValue* file = module.argument("file");
  const auto* name = file != nullptr ? std::get_if<std::string>(&file->value) : nullptr;
  return name != nullptr && !name->empty();
}

/// A number as it is, of a list the first.
ScadValue first_of(ScadValue value) {
  const ScadList* list = value.list();
  if (list == nullptr || list->empty()) return value;
  return ScadValue{list->front()};
}

bool is_of_drawing(const std::string& argument) {
  return argument == "file" || argument == "layer" || argument == "origin";
}

ScadModule import_of(const ScadModule& extrusion) {
  ScadModule import;
  import.name = "import";
  import.line = extrusion.line;
  import.dimension = 2;
  for (const ScadArgument& argument : extrusion.arguments) {
    if (is_of_drawing(argument.name) || argument.name.starts_with('$'))
      import.arguments.push_back(argument);
    if (argument.name == "scale") import.arguments.push_back({"scale", first_of(argument.value)});
  }
  return import;
}

}  // namespace

void import_files_of_extrusions(std::vector<ScadModule>& modules) {
  for (ScadModule& module : modules) {
    if (!names_file(module)) {
      import_files_of_extrusions(module.children);
      continue;
    }
    ScadModule import = import_of(module);
    std::erase_if(module.arguments, [](const ScadArgument& a) { return is_of_drawing(a.name); });
    module.children.clear();
    module.children.push_back(std::move(import));
  }
}

}  // namespace graycube
