#include "cli/outputs.hpp"

#include <array>
#include <string_view>
#include <system_error>
#include <utility>

#include "cli/failure.hpp"
#include "cli/interrupts.hpp"
#include "file_ending.hpp"
#include "film/picture_files.hpp"
#include "film/whole_file.hpp"
#include "version.hpp"

namespace graycube {
namespace {

namespace fs = std::filesystem;

using NamedPath = std::pair<const char*, const fs::path*>;

std::array<NamedPath, 3> named(const Outputs& outputs) {
  return {{{"-o", &outputs.exr}, {"--png", &outputs.png}, {"--stats", &outputs.stats}}};
}

bool is_same_file(const fs::path& a, const fs::path& b) {
  std::error_code error;
  if (fs::equivalent(a, b, error)) return true;
  return fs::absolute(a, error).lexically_normal() == fs::absolute(b, error).lexically_normal();
}

template <typename Write>
void write(const char* option, const fs::path& path, const Write& write_it) {
  if (path.empty()) return;
  try {
    write_it();
  } catch (const PictureError& e) {
    throw Failure(ExitStatus::kFailed, Problem{"output", option, e.what()});
  }
}

}  // namespace

void check_output(const std::string& option, const fs::path& file, const fs::path& input) {
  const std::string where = option + (option.empty() ? "" : " ") + file.string();
  std::error_code error;
  const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
  if (!file.has_filename() || fs::is_directory(file, error)) {
    throw usage_failure(where, "expected a file name, found a folder");
  }
  if (!fs::is_directory(folder, error)) throw usage_failure(where, "the folder does not exist");
  if (fs::exists(file, error) && !fs::is_regular_file(file, error)) {
    throw usage_failure(where, "exists and is not a regular file");
  }
  if (is_same_file(file, input)) throw usage_failure(where, "would replace the input");
  try {
    // Writing is the surest way to find out. The file disappears again, whatever happens.
    const InterruptsHeld held;
    const WholeFile probe(file);
  } catch (const PictureError& e) {
    throw usage_failure(option, e.what());
  }
  throw_if_interrupted();
}

void check_ending(const std::string& option, const fs::path& file, const std::string& ending,
                  const std::string& format) {
  if (file.empty() || has_ending(file, ending)) return;
  throw usage_failure(option + " " + file.string(),
                      "writes " + format + ": expected a name ending in " + ending);
}

void check_outputs(const Outputs& outputs, const fs::path& scene) {
  const auto files = named(outputs);
  for (std::size_t i = 0; i < files.size(); ++i) {
    const auto& [option, path] = files[i];
    if (path->empty()) continue;
    check_output(option, *path, scene);
    for (std::size_t j = 0; j < i; ++j) {
      if (!files[j].second->empty() && is_same_file(*files[j].second, *path)) {
        throw usage_failure(option, path->string() + " is also what " + files[j].first + " names");
      }
    }
  }
  if (has_ending(outputs.exr, ".png")) {
    throw usage_failure("-o " + outputs.exr.string(), "writes OpenEXR; for PNG use --png");
  }
  check_ending("-o", outputs.exr, ".exr", "OpenEXR");
  check_ending("--png", outputs.png, ".png", "PNG");
}

fs::path default_exr(const fs::path& scene) { return scene.stem().string() + ".exr"; }

void write_pictures(const Outputs& outputs, const Picture& picture, const std::string& scene) {
  write("-o", outputs.exr, [&] { write_exr(outputs.exr, picture, {scene, kVersion}); });
  write("--png", outputs.png, [&] { write_png(outputs.png, picture); });
}

void write_stats(const Outputs& outputs, const std::string& stats) {
  if (!outputs.stats.empty() && !stats.empty()) write_text_file(outputs.stats, stats + "\n");
}

void write_text_file(const fs::path& path, const std::string& text) {
  write(path.c_str(), path, [&] {
    WholeFile file(path);
    file.write(text.data(), text.size());
    file.commit();
  });
}

}  // namespace graycube
