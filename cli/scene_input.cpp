#include "cli/scene_input.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <memory>
#include <optional>
#include <string_view>
#include <system_error>

#include "cli/failure.hpp"
#include "cli/foreign_meshes.hpp"
#include "cli/openscad/model_view.hpp"
#include "cli/openscad_process.hpp"
#include "file_ending.hpp"
#include "formats/brlcad/brlcad.hpp"
#include "formats/brlcad/database/database.hpp"
#include "formats/graycube/read_scene.hpp"
#include "formats/graycube/write_scene.hpp"
#include "formats/mesh/mesh_file.hpp"
#include "formats/openscad/language/exact.hpp"
#include "formats/openscad/openscad.hpp"
#include "formats/view/mesh_scene.hpp"
#include "proto/job_settings.hpp"
#include "scene/scene_fault.hpp"
#include "shading/credit_limits.hpp"

namespace graycube {
namespace {

namespace fs = std::filesystem;

Failure bad_scene(const fs::path& path, std::string why) {
  return {ExitStatus::kBadInput, Problem{"scene", path.string(), std::move(why)}};
}

struct FileCloser {
  void operator()(std::FILE* file) const { std::fclose(file); }
};

std::string read_file(const fs::path& path, std::size_t most) {
  std::error_code error;
  if (fs::is_directory(path, error)) throw bad_scene(path, "is a folder");
  const std::unique_ptr<std::FILE, FileCloser> file(std::fopen(path.c_str(), "rb"));
  const auto system_error = [&] { return bad_scene(path, std::generic_category().message(errno)); };
  if (!file) throw system_error();
  const auto too_large = [&] {
    return bad_scene(path, "the file is larger than " + std::to_string(most) + " bytes");
  };
  const auto size = fs::file_size(path, error);  // a pipe has none
  if (!error && size > most) throw too_large();
  std::string text;
  if (!error) text.reserve(size + kTextPadding);
  std::array<char, 65536> chunk;
  while (const std::size_t count = std::fread(chunk.data(), 1, chunk.size(), file.get())) {
    if (text.size() + count > most) throw too_large();
    text.append(chunk.data(), count);
  }
  if (std::ferror(file.get()) != 0) throw system_error();
  return text;
}

/// The file's text with lines that end with "\n" or "\r\n", and without the byte order mark that
/// some programs begin UTF-8 with.
std::string read_text_file(const fs::path& path, std::size_t most) {
  std::string text = read_file(path, most);
  if (text.starts_with("\xEF\xBB\xBF")) text.erase(0, 3);
  if (text.find('\n') == std::string::npos) std::ranges::replace(text, '\r', '\n');
  return text;
}

/// The place FILE:7 for "line 7", FILE:WHERE for other places.
std::string place(const fs::path& path, std::string_view where) {
  constexpr std::string_view prefix = "line ";
  if (where.starts_with(prefix)) where.remove_prefix(prefix.size());
  return where.empty() ? path.string() : path.string() + ":" + std::string(where);
}

/// Notes an importer's warnings. Throws a Failure when a part is left out that must not be.
void note(std::vector<ImportWarning> warnings, const fs::path& path, const ModelChoice& choice,
          SceneInput& input) {
  std::vector<Problem> refused;
  for (ImportWarning& w : warnings) {
    if (choice.is_strict && w.leaves_out) {
      refused.push_back({"scene", place(path, w.where), w.text});
    } else {
      input.warnings.push_back({"warning", place(path, w.where), std::move(w.text)});
    }
  }
  if (!refused.empty()) throw Failure(ExitStatus::kBadInput, std::move(refused));
}

std::vector<Problem> problems_of(const fs::path& path, const std::vector<SceneError>& errors) {
  std::vector<Problem> problems;
  for (const SceneError& e : errors) {
    std::string why = e.message;
    // A pointer says what it is; an editor goes by lines.
    if (e.line > 0 && !e.pointer.empty()) {
      why += " (line " + std::to_string(e.line) + ", column " + std::to_string(e.column) + ")";
    }
    problems.push_back(
        {"scene", path.string() + (e.pointer.empty() ? "" : ":" + e.pointer), std::move(why)});
  }
  return problems;
}

bool is_own_format(const fs::path& path) {
  return has_ending(path, ".json") || has_ending(path, ".cbor");
}

MeshReading mesh_reading(const ModelChoice& choice) {
  return {.open = choice.repairs ? OpenMeshes::kRepair : OpenMeshes::kLeaveOut,
          .foreign = [](const fs::path& file) {
            return read_foreign_meshes(file, mesh_reader_program());
          }};
}

void read_json(const fs::path& path, const ModelChoice& choice, SceneInput& input) {
  PaddedText text(read_file(path, kMaxSubmitBytes));
  std::vector<ImportWarning> warnings;
  ReadResult read = read_scene_text(text, mesh_files_beside(path, mesh_reading(choice), &warnings));
  if (!read.scene) {
    throw Failure(ExitStatus::kBadInput, problems_of(path, read.errors));
  }
  note(std::move(warnings), path, choice, input);
  input.scene = std::move(*read.scene);
  if (input.scene.settings.lights.empty()) {
    input.warnings.push_back({"warning", path.string() + ":/lights",
                              "there are no lights: surfaces show their ambient light only"});
  }
  // A farm opens no files: then the meshes are sent in a text made for it.
  if (!read.used_files) input.text = std::move(text).take();
}

/// The .csg text of an OpenSCAD file; for a .scad file, the text that the program makes of it, and
/// the view that the file sets.
std::string openscad_text(const fs::path& path, OpenscadProcess* program,
                          std::optional<OpenscadView>& view) {
  std::string model = read_text_file(path, kMaxOpenscadBytes);
  if (has_ending(path, ".csg")) return model;
  if (program == nullptr) {
    throw bad_scene(path,
                    "the program openscad must evaluate it, and is not there; or give a .csg file");
  }
  auto result = program->evaluate_file(path);
  const OpenscadMessages& messages = program->messages();
  if (!result.trouble.empty()) {
    std::vector<Problem> problems;
    for (const std::string& line : messages.errors())
      problems.push_back({"openscad", path.string(), line});
    if (problems.empty()) problems.push_back({"openscad", path.string(), result.trouble});
    throw Failure(ExitStatus::kBadInput, std::move(problems));
  }
  view = openscad_view(messages.marked(), model);
  return std::move(result.text);
}

/// Sets the picture's size and depth for which a model is imported, in any importer's options.
template <typename How>
void set_overrides(const control::JobOptions& options, How& how) {
  how.image.width = options.width.value_or(how.image.width);
  how.image.height = options.height.value_or(how.image.height);
  how.max_depth = options.max_depth.value_or(how.max_depth);
}

void import_openscad(const fs::path& path, const control::JobOptions& options,
                     const ModelChoice& choice, SceneInput& input) {
  const auto program = OpenscadProcess::find(choice.is_quiet);
  OpenscadOptions how;
  set_overrides(options, how.frame);
  how.facets = choice.facets;
  how.program = program.get();
  how.folder = fs::absolute(path).parent_path().string();
  const bool is_tree = has_ending(path, ".csg");
  // Line numbers are those of the evaluated tree.
  const fs::path where = is_tree ? path : fs::path(path.string() + " (as .csg)");
  const std::string text = openscad_text(path, program.get(), how.view);
  std::string spelled_out;
  if (!is_tree && text.size() <= kMaxSpelledOutBytes) {
    spelled_out = program->evaluate_with(path, openscad_exact_definitions());
  }
  how.spelled_out = spelled_out;
  OpenscadResult read = read_openscad_csg(text, how);
  if (program) {
    for (const std::string& line : program->messages().take_warnings()) {
      input.warnings.push_back({"openscad", path.string(), line});
    }
  }
  if (!read.scene) {
    std::vector<Problem> problems;
    for (ImportWarning& w : read.warnings) {
      if (w.leaves_out) problems.push_back({"scene", place(where, w.where), std::move(w.text)});
    }
    for (const OpenscadError& e : read.errors) {
      const std::string line = e.line > 0 ? ":" + std::to_string(e.line) : "";
      problems.push_back({"scene", where.string() + line, e.message});
    }
    throw Failure(ExitStatus::kBadInput, std::move(problems));
  }
  note(std::move(read.warnings), where, choice, input);
  input.scene = std::move(*read.scene);
}

void import_mesh(const fs::path& path, const control::JobOptions& options,
                 const ModelChoice& choice, SceneInput& input) {
  auto read = read_mesh_file(path, mesh_reading(choice));
  if (const auto* fault = std::get_if<MeshFault>(&read)) {
    // The problem has the file's name in front already.
    const std::string name = path.string() + ": ";
    throw bad_scene(path,
                    fault->why.starts_with(name) ? fault->why.substr(name.size()) : fault->why);
  }
  auto& solids = std::get<MeshSolids>(read);
  note(std::move(solids.warnings), path, choice, input);
  std::vector<SceneMesh> meshes;
  for (MeshSolid& s : solids.solids)
    meshes.push_back({std::move(s.name), std::move(s.shape), s.color});
  Frame how;
  set_overrides(options, how);
  input.scene = scene_of_meshes(std::move(meshes), how);
}

/// A database's bytes: a text, or the numbers of a .g file.
std::string brlcad_bytes(const fs::path& path) {
  return path.extension() == ".asc" ? read_text_file(path, kMaxBrlcadBytes)
                                    : read_file(path, kMaxBrlcadBytes);
}

Failure failure_of(const fs::path& path, const std::vector<BrlcadMessage>& errors) {
  std::vector<Problem> problems;
  for (const BrlcadMessage& e : errors) {
    problems.push_back({"scene", path.string() + (e.where.empty() ? "" : ":" + e.where), e.text});
  }
  return {ExitStatus::kBadInput, std::move(problems)};
}

Failure failure_of(const fs::path& path, const UnrenderableScene& scene) {
  std::vector<Problem> problems;
  for (const SceneFault& f : scene.faults()) {
    const bool is_placed = is_own_format(path) && !f.pointer.empty();
    problems.push_back({"scene", path.string() + (is_placed ? ":" + f.pointer : ""), f.message});
  }
  return {ExitStatus::kBadInput, std::move(problems)};
}

void import_brlcad(const fs::path& path, const control::JobOptions& options,
                   const ModelChoice& choice, SceneInput& input) {
  BrlcadOptions how;
  set_overrides(options, how);
  how.objects = choice.objects;
  if (!choice.view.empty()) how.view = read_text_file(choice.view, kMaxBrlcadViewBytes);
  how.azimuth_degrees = choice.azimuth_degrees;
  how.elevation_degrees = choice.elevation_degrees;
  BrlcadResult read = read_brlcad(brlcad_bytes(path), how);
  if (!read.scene) throw failure_of(path, read.errors);
  note(std::move(read.warnings), path, choice, input);
  input.scene = std::move(*read.scene);
}

}  // namespace

std::string scene_endings_text() {
  std::string text;
  for (std::size_t i = 0; i < kSceneEndings.size(); ++i) {
    text += i == 0 ? "" : i + 1 == kSceneEndings.size() ? " or " : ", ";
    text += kSceneEndings[i];
  }
  return text;
}

bool is_openscad(const fs::path& path) {
  return has_ending(path, ".csg") || has_ending(path, ".scad");
}
bool is_brlcad(const fs::path& path) { return has_ending(path, ".g") || has_ending(path, ".asc"); }

std::string brlcad_tops_text(const fs::path& path) {
  const BrlcadTops read = list_brlcad_tops(brlcad_bytes(path));
  if (!read.errors.empty()) throw failure_of(path, read.errors);
  std::string text;
  for (const BrlcadTop& top : read.tops) {
    text += top.name + ": " + std::to_string(top.primitives) +
            (top.primitives == 1 ? " solid\n" : " solids\n");
  }
  return text;
}

SceneInput read_scene_input(const fs::path& path, const control::JobOptions& options,
                            const ModelChoice& choice) {
  if (choice.is_given && !is_brlcad(path)) {
    throw usage_failure("--object, --view, --azimuth, --elevation",
                        "are for BRL-CAD databases (.g, .asc), not for " + path.string());
  }
  if (choice.facets && !is_openscad(path)) {
    throw usage_failure("--facets",
                        "is for OpenSCAD's files (.scad, .csg), not for " + path.string());
  }
  if (choice.repairs && !is_mesh_file(path) && !is_own_format(path)) {
    throw usage_failure("--repair", "is for meshes (" + mesh_endings_text() +
                                        ", and those that a .json names), not for " +
                                        path.string());
  }
  SceneInput input;
  input.path = path;
  input.name = path.filename().string();
  if (is_openscad(path)) {
    import_openscad(path, options, choice, input);
  } else if (is_brlcad(path)) {
    import_brlcad(path, options, choice, input);
  } else if (is_own_format(path)) {
    read_json(path, choice, input);
  } else if (is_mesh_file(path)) {
    import_mesh(path, options, choice, input);
  } else {
    throw bad_scene(path, "expected a name ending in " + scene_endings_text());
  }
  return input;
}

Model compile_input(const SceneInput& input) {
  try {
    return compile_scene(input.scene);
  } catch (const UnrenderableScene& e) {
    throw failure_of(input.path, e);
  }
}

void check_farm_limits(const SceneInput& input, const RenderSettings& settings) {
  std::vector<Problem> problems;
  for (const ExceededLimit& limit : exceeded_credit_limits(settings)) {
    problems.push_back({"scene", input.name + ":" + std::string(limit.where),
                        "only --algorithm serial takes more than " + std::to_string(limit.most) +
                            ", found " + std::to_string(limit.found)});
  }
  if (!problems.empty()) throw Failure(ExitStatus::kBadInput, std::move(problems));
}

void prepare_for_farm(SceneInput& input, const control::JobOptions& options) {
  RenderSettings settings = input.scene.settings;
  apply_overrides(options, settings);
  check_farm_limits(input, settings);
  try {
    if (input.text.empty()) input.text = write_scene_text(input.scene);
  } catch (const UnrenderableScene& e) {
    throw failure_of(input.path, e);
  }
  if (input.text.size() > kMaxSubmitBytes) {
    throw Failure(ExitStatus::kBadInput,
                  Problem{"scene", input.name, "larger than a farm takes; use --algorithm serial"});
  }
}

}  // namespace graycube
