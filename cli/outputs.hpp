// The files that a render writes.
#pragma once

#include <filesystem>
#include <string>

#include "film/film.hpp"

namespace graycube {

/// The files' paths; an empty path means that the file is not wanted.
struct Outputs {
  std::filesystem::path exr, png, stats;
  bool none() const { return exr.empty() && png.empty() && stats.empty(); }
};

/// Throws a usage failure when a file can't be written where it should go, or is the input itself.
/// `option` names it, and may be empty.
void check_output(const std::string& option, const std::filesystem::path& file,
                  const std::filesystem::path& input);

/// Throws a usage failure when a file is named and its name doesn't end so, in whatever case.
void check_ending(const std::string& option, const std::filesystem::path& file,
                  const std::string& ending, const std::string& format);

/// As check_output() and check_ending() for all files of a render, before it starts; also that no
/// two are the same.
void check_outputs(const Outputs& outputs, const std::filesystem::path& scene);

/// SCENE's name without its ending, with ".exr", in the current folder.
std::filesystem::path default_exr(const std::filesystem::path& scene);

/// Writes the pictures, each whole or not at all. `scene` is the scene's name for the EXR's header.
/// Throws a Failure of status 1.
void write_pictures(const Outputs& outputs, const Picture& picture, const std::string& scene);

/// Writes the statistics, if wanted and there are any. A render that ended in a deadlock has them
/// too (Failure::statistics): its nodes' times and queues are worth as much as a picture's.
void write_stats(const Outputs& outputs, const std::string& stats);

/// Writes a text file, whole or not at all. Throws a Failure of status 1.
void write_text_file(const std::filesystem::path& path, const std::string& text);

}  // namespace graycube
