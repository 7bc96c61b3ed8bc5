// graycube check: prints every error of a scene file, or what is in it.
#include <cstdio>

#include "cli/commands/commands.hpp"
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

}  // namespace

ExitStatus run(const CheckCommand& command) {
  catch_interrupts("check", 0);
  if (is_brlcad(command.scene)) std::fputs(brlcad_tops_text(command.scene).c_str(), stdout);
  SceneInput input = read_scene_input(command.scene, {}, command.choice);
  check_is_built(command.scene, input.scene);
  for (const Problem& warning : input.warnings) print(warning);
  const std::size_t materials = input.scene.materials.size();
  const Model model = compile_input(input);
  if (is_brlcad(command.scene)) print_regions(input.scene, model);
  const RenderSettings& s = model.settings;
  // What is fine is fine for every algorithm.
  check_farm_limits(input, s);
  if (!fits_model_limits(model)) {
    throw Failure(ExitStatus::kBadInput, Problem{"scene", command.scene,
                                                 "larger than a farm takes; only --algorithm "
                                                 "serial renders it"});
  }
  std::string image = std::to_string(s.image.width) + " x " + std::to_string(s.image.height);
  if (s.image.samples > 1) {
    image += ", " + std::to_string(s.image.samples * s.image.samples) + " rays per pixel";
  }
  std::printf("%s: fine: %s, %s, %s, %s; picture %s\n", command.scene.c_str(),
              counted(model.objects.size(), "object", "objects").c_str(),
              counted(model.primitives.size(), "primitive", "primitives").c_str(),
              counted(materials, "material", "materials").c_str(),
              counted(s.lights.size(), "light", "lights").c_str(), image.c_str());
  return ExitStatus::kDone;
}

}  // namespace graycube
