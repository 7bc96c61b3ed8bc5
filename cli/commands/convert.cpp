// graycube convert: one file into another, by the endings of their names.
#include <filesystem>

#include "cli/commands/commands.hpp"
#include "cli/interrupts.hpp"
#include "cli/scene_input.hpp"
#include "file_ending.hpp"
#include "film/picture_files.hpp"
#include "formats/graycube/write_scene.hpp"
#include "formats/json/cbor_writer.hpp"
#include "formats/json/padded_text.hpp"
#include "formats/mesh/mesh_file.hpp"
#include "formats/pov/write_pov.hpp"

namespace graycube {
namespace {

namespace fs = std::filesystem;

void convert_picture(const fs::path& in, const fs::path& out) {
  Picture picture;
  try {
    picture = read_exr(in);
  } catch (const PictureError& e) {
    // The file stands in front of the reason already.
    const std::string prefix = "cannot read picture: " + in.string() + ": ", why = e.what();
    throw Failure(
        ExitStatus::kBadInput,
        Problem{"picture", in.string(), why.substr(why.starts_with(prefix) ? prefix.size() : 0)});
  }
  const InterruptsHeld held;
  write_pictures({{}, out, {}}, picture, "");
}

void convert_scene(const fs::path& in, const fs::path& out, const ModelChoice& choice) {
  const SceneInput input = read_scene_input(in, {}, choice);
  for (const Problem& warning : input.warnings) print(warning);
  std::string text;
  if (has_ending(out, ".pov")) {
    PovScene pov = write_pov(input.scene);
    for (const std::string& warning : pov.warnings) print({"warning", out.string(), warning});
    if (!pov.errors.empty()) {
      std::vector<Problem> problems;
      for (const std::string& error : pov.errors)
        problems.push_back({"convert", out.string(), error});
      throw Failure(ExitStatus::kBadInput, std::move(problems));
    }
    text = std::move(pov.text);
  } else {
    text = write_scene_text(input.scene);
    if (has_ending(out, ".cbor")) text = cbor_of(JsonTree(PaddedText(std::move(text))));
  }
  const InterruptsHeld held;
  write_text_file(out, text);
}

}  // namespace

ExitStatus run(const ConvertCommand& command) {
  catch_interrupts("convert", 0);
  const fs::path in = command.in, out = command.out;
  const std::string from = ending_of(in), to = ending_of(out);
  const bool is_scene =
      from == ".json" || from == ".cbor" || is_openscad(in) || is_brlcad(in) || is_mesh_file(in);
  const bool is_known = (is_scene && (to == ".json" || to == ".cbor" || to == ".pov")) ||
                        (from == ".exr" && to == ".png");
  if (!is_known) {
    throw usage_failure("convert", "expected " + scene_endings_text() +
                                       " to .json, .cbor or .pov, or .exr to .png; found " +
                                       in.string() + " to " + out.string());
  }
  check_output("", out, in);
  is_scene ? convert_scene(in, out, command.choice) : convert_picture(in, out);
  return ExitStatus::kDone;
}

}  // namespace graycube
