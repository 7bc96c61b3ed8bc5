// graycube check: prints every error of a scene file, or what is in it.
#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

#include "cli/commands/commands.hpp"
#include "cli/display/json_text.hpp"
#include "cli/interrupts.hpp"
#include "cli/scene_input.hpp"
#include "formats/brlcad/overlaps.hpp"
#include "proto/model_slice.hpp"

namespace graycube {
namespace {

std::string counted(std::uint64_t count, const std::string& singular, const std::string& plural) {
  return std::to_string(count) + " " + (count == 1 ? singular : plural);
}

/// Names the regions of a database, and those that fill the same space.
void print_regions(const Scene& scene, const Model& model) {
  for (const SceneObject& object : scene.objects) std::printf("region %s\n", object.name.c_str());
  const BrlcadOverlaps overlaps = find_brlcad_overlaps(model);
  for (const BrlcadOverlap& o : overlaps.pairs) {
    std::printf("overlap: %s and %s at %g %g %g, %g mm deep\n", scene.objects[o.first].name.c_str(),
                scene.objects[o.second].name.c_str(), o.point.x, o.point.y, o.point.z, o.depth);
  }
  if (!overlaps.is_whole) std::puts("overlap: there may be more; the search was ended");
}

/// The scene compiled. What is fine is fine for every algorithm; else throws a Failure.
Model compiled(const CheckCommand& command, const SceneInput& input) {
  Model model = compile_input(input);
  check_farm_limits(input, model.settings);
  if (!fits_model_limits(model)) {
    throw Failure(ExitStatus::kBadInput,
                  Problem{"scene", command.scene,
                          "larger than a farm takes; only --algorithm serial renders it"});
  }
  return model;
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
    const SceneInput input = read_scene_input(command.scene, {}, command.choice);
    const std::size_t materials = input.scene.materials.size();
    for (const Problem& warning : input.warnings) print(warning);
    const Model model = compiled(command, input);
    if (is_brlcad(command.scene) && !command.as_json) print_regions(input.scene, model);
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
