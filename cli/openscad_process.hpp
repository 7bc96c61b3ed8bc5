// OpenSCAD as a child process, in a private folder for its files.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cli/failure.hpp"
#include "formats/openscad/openscad.hpp"

namespace graycube {

/// The most seconds that the process may run; then it is killed.
inline constexpr int kMaxOpenscadSeconds = 300;
/// Most bytes of a file that are taken from it, and most bytes of its messages that are read.
inline constexpr std::uint64_t kMaxOpenscadOutputBytes = std::uint64_t{1} << 28;
inline constexpr std::uint64_t kMaxOpenscadLogBytes = 65536;

class OpenscadProcess : public OpenscadProgram {
 public:
  /// The program on PATH; null when there is none.
  static std::unique_ptr<OpenscadProcess> find();
  explicit OpenscadProcess(std::filesystem::path program, int most_seconds = kMaxOpenscadSeconds)
      : program_(std::move(program)), most_seconds_(most_seconds) {}

  /// An interrupt ends the process and is thrown as a Failure.
  Result evaluate(const std::string& csg, Format format) override;
  /// Evaluates a .scad file to the text of a .csg file.
  Result evaluate_file(const std::filesystem::path& scad);
  /// The same with definitions put behind the model's, without messages; empty when it fails or
  /// takes too long.
  std::string evaluate_with(const std::filesystem::path& scad, std::string_view definitions);
  /// The program's messages, line by line, since the last call.
  std::vector<std::string> take_messages();

 private:
  /// Runs the program with `-o FOLDER/output input` and returns the file that it wrote.
  Result run(const std::filesystem::path& folder, const std::filesystem::path& input,
             const std::string& output);
  /// Starts `program -o output input OPTIONS`.
  pid_t start(const std::filesystem::path& input, const std::filesystem::path& output,
              const std::filesystem::path& log, const std::vector<std::string>& options = {});
  /// The process's wait status; nothing when the time was up.
  static std::optional<int> wait_for_end(pid_t pid, int most_seconds);
  /// Notes the program's messages, and returns what went wrong.
  std::string trouble_in(const std::string& log, int status);

  std::filesystem::path program_;
  int most_seconds_;
  std::vector<std::string> messages_;
};

}  // namespace graycube
