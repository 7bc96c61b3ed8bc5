#include "cli/openscad_process.hpp"

#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <string_view>
#include <system_error>
#include <utility>

#include "cli/display/wait_display.hpp"
#include "cli/interrupts.hpp"
#include "cli/openscad/model_view.hpp"
#include "cli/openscad/run.hpp"
#include "cli/temporary_place.hpp"
#include "process/program_path.hpp"
#include "process/temporary_folder.hpp"

namespace graycube {
namespace {

namespace fs = std::filesystem;

/// The folder must be removed on an interrupt, too, so interrupts are held while there is one.
/// Afterwards an importer that is busy with the results may be interrupted at any time.
class Workplace {
 public:
  Workplace() : folder_(checked("graycube-")) {}
  const std::filesystem::path& path() const { return folder_.path(); }

 private:
  static const char* checked(const char* prefix) {
    check_temporary_place();
    return prefix;
  }
  InterruptsHeld held_;
  TemporaryFolder folder_;
};

/// The bytes of a file, at most `most`; nothing when there is no such file.
std::optional<std::string> bytes_of(const fs::path& path, std::uint64_t most) {
  std::ifstream file(path, std::ios::binary);
  if (!file) return std::nullopt;
  std::error_code error;
  const std::uint64_t size = std::min<std::uint64_t>(fs::file_size(path, error), most);
  if (error) return std::nullopt;
  std::string bytes(size, '\0');
  file.read(bytes.data(), static_cast<std::streamsize>(size));
  bytes.resize(static_cast<std::size_t>(file.gcount()));
  return bytes;
}

std::string log_in(const fs::path& folder) {
  return bytes_of(folder / "log", kMaxOpenscadLogBytes).value_or("");
}

bool has(std::string_view log, std::string_view text) {
  return log.find(text) != std::string_view::npos;
}

/// Whether the program ended since there is nothing to write: an empty solid also counts as no flat
/// figure, and the other way round.
bool is_about_nothing(std::string_view log) {
  return has(log, "Current top level object is empty.") ||
         has(log, "Current top level object is not a ");
}

/// The name in "WARNING: Ignoring unknown module 'fill'"; empty if there is no such line.
std::string unknown_module(std::string_view log) {
  constexpr std::string_view kBefore = "Ignoring unknown module '";
  const std::size_t at = log.find(kBefore);
  if (at == std::string_view::npos) return {};
  const std::string_view rest = log.substr(at + kBefore.size());
  return std::string(rest.substr(0, rest.find('\'')));
}

std::string end_text(int status) {
  return WIFEXITED(status) ? "openscad ended with status " + std::to_string(WEXITSTATUS(status))
                           : "openscad ended by signal " + std::to_string(WTERMSIG(status));
}

/// Why the program has written nothing; empty where there is nothing to write.
std::string trouble_of(std::string_view log, const std::vector<std::string>& said, int status) {
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return {};
  if (const std::string module = unknown_module(log); !module.empty())
    return "the installed openscad doesn't know " + module + "(): " + said.front();
  const auto last_error = std::find_if(said.rbegin(), said.rend(), [](const std::string& line) {
    return line.starts_with("ERROR");
  });
  if (last_error != said.rend()) return "openscad: " + *last_error;
  if (is_about_nothing(log)) return {};
  return end_text(status) + (said.empty() ? "" : ": " + said.back());
}

/// The parts of a log, each from where the program begins to export one.
std::vector<std::string_view> parts_of(std::string_view log) {
  const std::string_view mark = kOpenscadPartMark;
  std::vector<std::size_t> begins;
  for (std::size_t at = 0; (at = log.find(mark, at)) != std::string_view::npos; ++at) {
    if (at == 0 || log[at - 1] == '\n') begins.push_back(at);
  }
  std::vector<std::string_view> parts;
  for (std::size_t i = 0; i < begins.size(); ++i) {
    const std::size_t end = i + 1 < begins.size() ? begins[i + 1] : log.size();
    parts.push_back(log.substr(begins[i], end - begins[i]));
  }
  return parts;
}

/// A model that is one of the parts in each frame of an animation.
std::string frames_text(std::span<const OpenscadProgram::Part> parts) {
  const std::string frame = "round($t * " + std::to_string(parts.size()) + ")";
  std::string text;
  for (std::size_t i = 0; i < parts.size(); ++i)
    text += "if (" + frame + " == " + std::to_string(i) + ") {\n" + parts[i].csg + "}\n";
  return text;
}

const char* format_ending(OpenscadProgram::Format format) {
  return format == OpenscadProgram::Format::kOff ? ".off" : ".svg";
}

/// The name that the program gives a frame's file: "part00012.off".
std::string frame_name(std::size_t frame, OpenscadProgram::Format format) {
  constexpr std::size_t kDigits = 5;
  const std::string number = std::to_string(frame);
  return "part" + std::string(kDigits - std::min(kDigits, number.size()), '0') + number +
         format_ending(format);
}

}  // namespace

std::unique_ptr<OpenscadProcess> OpenscadProcess::find(bool is_quiet) {
  const auto program = program_path("openscad");
  if (!program) return nullptr;
  return std::make_unique<OpenscadProcess>(*program, kMaxOpenscadSeconds, is_quiet);
}

std::optional<int> OpenscadProcess::run(const fs::path& folder, std::vector<std::string> arguments,
                                        std::span<const Part> parts) {
  arguments.insert(arguments.begin(), program_.string());
  WaitDisplay display(stderr, is_quiet_);
  const auto show = [&](std::size_t begun) {
    if (parts.empty()) return display.show("openscad: the model");
    const std::size_t at = std::clamp<std::size_t>(begun, 1, parts.size());
    display.show("openscad: part " + std::to_string(at) + " of " + std::to_string(parts.size()) +
                 ", " + parts[at - 1].name);
  };
  const auto status = run_openscad({std::move(arguments), folder / "log", most_seconds_, show});
  throw_if_interrupted();
  return status;
}

OpenscadProgram::Result OpenscadProcess::result_of(const fs::path& written, std::string_view log,
                                                   const std::optional<int>& status) const {
  Result result;
  if (!status) {
    result.trouble = "openscad took more than " + std::to_string(most_seconds_) + " s";
    return result;
  }
  result.said = openscad_troubles(log, written.parent_path().string());
  result.trouble = trouble_of(log, result.said, *status);
  if (!result.trouble.empty()) return result;
  if (auto bytes = bytes_of(written, kMaxOpenscadOutputBytes + 1)) result.text = std::move(*bytes);
  if (result.text.size() > kMaxOpenscadOutputBytes) {
    result.text.clear();
    result.trouble =
        "openscad wrote more than " + std::to_string(kMaxOpenscadOutputBytes) + " bytes";
  }
  return result;
}

OpenscadProgram::Result OpenscadProcess::evaluate(const std::string& csg, Format format) {
  const Part part{csg, "a part"};
  return evaluate_first({&part, 1}, format).front();
}

std::vector<OpenscadProgram::Result> OpenscadProcess::evaluate_first(std::span<const Part> parts,
                                                                     Format format) {
  const Workplace place;
  const fs::path& folder = place.path();
  const fs::path input = folder / "part.csg";
  const fs::path output = folder / (std::string("part") + format_ending(format));
  const bool is_alone = parts.size() == 1;
  std::ofstream(input, std::ios::binary) << (is_alone ? parts.front().csg : frames_text(parts));
  std::vector<std::string> arguments{"-o", output.string(), input.string()};
  if (!is_alone) arguments.insert(arguments.end(), {"--animate", std::to_string(parts.size())});
  const std::optional<int> status = run(folder, std::move(arguments), parts);
  const std::string log = log_in(folder);
  if (is_alone) return {result_of(output, log, status)};
  std::vector<Result> results;
  std::uint64_t bytes = 0;
  const std::vector<std::string_view> told = parts_of(log);
  for (std::size_t i = 0; i < std::min(told.size(), parts.size()); ++i) {
    // Where another part follows, this one went well.
    const std::optional<int> how = i + 1 < told.size() ? std::optional(0) : status;
    results.push_back(result_of(folder / frame_name(i, format), told[i], how));
    bytes += results.back().text.size();
    if (bytes <= kMaxOpenscadRunBytes) continue;
    results.back() = {
        {}, "openscad wrote more than " + std::to_string(kMaxOpenscadRunBytes) + " bytes of parts"};
  }
  return results;
}

std::vector<OpenscadProgram::Result> OpenscadProcess::evaluate_all(std::span<const Part> parts,
                                                                   Format format) {
  std::vector<Result> results;
  while (results.size() < parts.size()) {
    const auto rest = parts.subspan(results.size());
    const std::size_t count = can_animate_ ? std::min(rest.size(), kMaxOpenscadRunParts) : 1;
    std::vector<Result> next = evaluate_first(rest.first(count), format);
    can_animate_ = can_animate_ && !next.empty();
    std::move(next.begin(), next.end(), std::back_inserter(results));
  }
  return results;
}

OpenscadProgram::Result OpenscadProcess::evaluate_file(const fs::path& scad) {
  const Workplace place;
  const fs::path& folder = place.path();
  const fs::path written = folder / "model.csg";
  const std::optional<int> status =
      run(folder, {"-o", written.string(), fs::absolute(scad).string(), "--render", "-D",
                   std::string(kOpenscadViewDefinitions)});
  const std::string log = log_in(folder);
  messages_.read(log, kOpenscadViewMark);
  Result result = result_of(written, log, status);
  if (!messages_.errors().empty()) result.trouble = messages_.errors().front();
  return result;
}

std::string OpenscadProcess::evaluate_with(const fs::path& scad, std::string_view definitions) {
  const Workplace place;
  const fs::path& folder = place.path();
  const fs::path written = folder / "model.csg";
  const std::optional<int> status =
      run(folder, {"-o", written.string(), fs::absolute(scad).string(), "--render", "-D",
                   std::string(definitions)});
  if (!status || !WIFEXITED(*status) || WEXITSTATUS(*status) != 0) return {};
  return bytes_of(written, kMaxOpenscadOutputBytes).value_or("");
}

}  // namespace graycube
