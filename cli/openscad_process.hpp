// OpenSCAD as a child process, in a private folder for its files.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "cli/failure.hpp"
#include "cli/openscad/messages.hpp"
#include "formats/openscad/openscad.hpp"

namespace graycube {

/// The most seconds that the process may take for a part of a model, or for evaluating the model;
/// then it is killed.
inline constexpr int kMaxOpenscadSeconds = 300;
/// Most bytes of a file that are taken from it, of all files of one run, and of its messages.
inline constexpr std::uint64_t kMaxOpenscadOutputBytes = std::uint64_t{1} << 28;
inline constexpr std::uint64_t kMaxOpenscadRunBytes = std::uint64_t{1} << 30;
inline constexpr std::uint64_t kMaxOpenscadLogBytes = std::uint64_t{1} << 24;
/// Most parts of one run. The program looks at all of them for each.
inline constexpr std::size_t kMaxOpenscadRunParts = 256;

class OpenscadProcess : public OpenscadProgram {
 public:
  /// The program on PATH; null when there is none. It tells on standard error what it is at unless
  /// `is_quiet`.
  static std::unique_ptr<OpenscadProcess> find(bool is_quiet = true);
  explicit OpenscadProcess(std::filesystem::path program, int most_seconds = kMaxOpenscadSeconds,
                           bool is_quiet = true)
      : program_(std::move(program)), most_seconds_(most_seconds), is_quiet_(is_quiet) {}

  /// An interrupt ends the process and is thrown as a Failure.
  Result evaluate(const std::string& csg, Format format) override;
  /// As frames of an animation, each of which shows one part. The program ends at a part that it
  /// can't make; it is then started again for those that follow.
  std::vector<Result> evaluate_all(std::span<const Part> parts, Format format) override;
  /// Evaluates a .scad file to the text of a .csg file, as for a final picture: $preview is false.
  /// An ERROR is trouble, even where the program goes on.
  Result evaluate_file(const std::filesystem::path& scad);
  /// The same with definitions put behind the model's, without messages; empty when it fails or
  /// takes too long.
  std::string evaluate_with(const std::filesystem::path& scad, std::string_view definitions);
  /// What evaluate_file() had the program say, and the view that the model sets.
  OpenscadMessages& messages() { return messages_; }

 private:
  /// Runs the program with these arguments, its messages going to FOLDER/log, and returns its wait
  /// status; nothing when the time was up. `names` are those of the parts.
  std::optional<int> run(const std::filesystem::path& folder, std::vector<std::string> arguments,
                         std::span<const Part> parts = {});
  /// The result of one part or model: what the program wrote, or why it didn't.
  Result result_of(const std::filesystem::path& written, std::string_view log,
                   const std::optional<int>& status) const;
  /// Evaluates the first parts in one run; returns the results of those that it came to.
  std::vector<Result> evaluate_first(std::span<const Part> parts, Format format);

  std::filesystem::path program_;
  int most_seconds_;
  bool is_quiet_;
  /// Whether the program exports frames; old versions can't.
  bool can_animate_ = true;
  OpenscadMessages messages_;
};

}  // namespace graycube
