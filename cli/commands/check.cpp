// graycube check: prints every error of a scene file, or what is in it.
#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

#include "cli/commands/commands.hpp"
#include "cli/display/json_text.hpp"
#include "cli/interrupts.hpp"
#include "cli/scene_input.hpp"
#include "scene/compile_scene.hpp"

namespace graycube {
namespace {

std::string counted(std::uint64_t count, const std::string& singular, const std::string& plural) {
  return std::to_string(count) + " " + (count == 1 ? singular : plural);
}

std::string fine_text(const CheckCommand& command, const Model& model, std::size_t materials) {
  const RenderSettings& s = model.settings;
  std::string image = std::to_string(s.image.width) + " x " + std::to_string(s.image.height);
  if (s.image.samples > 1) {
    image += ", " + std::to_string(s.image.samples * s.image.samples) + " rays per pixel";
  }
  return command.scene + ": fine: " + counted(model.objects.size(), "object", "objects") + ", " +
         counted(model.primitives.size(), "primitive", "primitives") + ", " +
         counted(materials, "material", "materials") + ", " +
         counted(s.lights.size(), "light", "lights") + "; picture " + image + "\n";
}

std::string problems_json(const std::vector<Problem>& problems) {
  std::string text;
  for (const Problem& p : problems) {
    text += (text.empty() ? "{\"where\":" : ",{\"where\":") + json_string(p.where) +
            ",\"why\":" + json_string(p.why) + "}";
  }
  return "[" + text + "]";
}

std::string fine_json(const CheckCommand& command, const Model& model, std::size_t materials,
                      const std::vector<Problem>& warnings) {
  const RenderSettings& s = model.settings;
  std::string text = "{\"scene\":" + json_string(command.scene) + ",\"fine\":true";
  const auto number = [&](const char* name, std::uint64_t value) {
    text += ",\"" + std::string(name) + "\":" + std::to_string(value);
  };
  number("objects", model.objects.size());
  number("primitives", model.primitives.size());
  number("materials", materials);
  number("lights", s.lights.size());
  number("width", s.image.width);
  number("height", s.image.height);
  number("samples", s.image.samples);
  return text + ",\"warnings\":" + problems_json(warnings) + "}\n";
}

}  // namespace

ExitStatus run(const CheckCommand& command) {
  catch_interrupts("check", 0);
  try {
    if (is_brlcad(command.scene) && !command.as_json)
      std::fputs(brlcad_tops_text(command.scene).c_str(), stdout);
    SceneInput input = read_scene_input(command.scene, {}, command.choice);
    check_is_built(command.scene, input.scene);
    const std::size_t materials = input.scene.materials.size();
    const Model model = compile_scene(input.scene);
    for (const Problem& warning : input.warnings) print(warning);
    const std::string text = command.as_json ? fine_json(command, model, materials, input.warnings)
                                             : fine_text(command, model, materials);
    std::fputs(text.c_str(), stdout);
  } catch (const Failure& failure) {
    if (command.as_json) {
      std::printf("{\"scene\":%s,\"fine\":false,\"errors\":%s}\n",
                  json_string(command.scene).c_str(), problems_json(failure.problems()).c_str());
    }
    throw;
  }
  return ExitStatus::kDone;
}

}  // namespace graycube
