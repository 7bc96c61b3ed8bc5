#include "formats/openscad/language/program.hpp"

#include <charconv>
#include <cmath>
#include <system_error>

#include "formats/mesh/off.hpp"

namespace graycube {
namespace {

std::string written(double v) {
  if (std::isnan(v)) return "0/0";
  if (std::isinf(v)) return v > 0 ? "1/0" : "-1/0";
  char digits[32];
  return {digits, std::to_chars(digits, digits + sizeof digits, v).ptr};
}

std::string written(std::string_view text) {
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') quoted += '\\';
    c == '\n' ? quoted += "\\n" : quoted += c;
  }
  return quoted + '"';
}

std::string written(const ScadValue& value) {
  if (const bool* b = value.boolean()) return *b ? "true" : "false";
  if (const double* n = value.number()) return written(*n);
  if (const auto* s = std::get_if<std::string>(&value.value)) return written(std::string_view(*s));
  const ScadList* list = value.list();
  if (list == nullptr) return "undef";
  std::string text = "[";
  for (const ScadValue& item : *list) {
    if (text.size() > 1) text += ", ";
    text += written(item);
  }
  return text + ']';
}

void write(const ScadModule& module, const std::string& folder, std::string& text) {
  if (module.left_out) return;
  text += module.name + '(';
  bool first = true;
  for (const ScadArgument& argument : module.arguments) {
    // The timestamp was written for OpenSCAD's cache; OpenSCAD takes no such argument.
    if (argument.name == "timestamp") continue;
    if (!std::exchange(first, false)) text += ", ";
    if (!argument.name.empty()) text += argument.name + " = ";
    const auto* file = std::get_if<std::string>(&argument.value.value);
    if (argument.name == "file" && file != nullptr && !file->empty() && file->front() != '/' &&
        !folder.empty()) {
      text += written(std::string_view(folder + '/' + *file));
    } else {
      text += written(argument.value);
    }
  }
  if (module.children.empty()) {
    text += ");\n";
    return;
  }
  text += ") {\n";
  for (const ScadModule& child : module.children) write(child, folder, text);
  text += "}\n";
}

/// Numbers and letters of a path's data.
class PathData {
 public:
  explicit PathData(std::string_view text) : text_(text) {}

  /// The next letter; 0 at the end.
  char letter() {
    skip();
    return at_ < text_.size() ? text_[at_++] : '\0';
  }
  bool number(double& out) {
    skip();
    const auto [end, error] = std::from_chars(text_.data() + at_, text_.data() + text_.size(), out);
    if (error != std::errc{}) return false;
    at_ = static_cast<std::size_t>(end - text_.data());
    return true;
  }

 private:
  void skip() {
    while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == ',' || text_[at_] == '\n'))
      ++at_;
  }
  std::string_view text_;
  std::size_t at_ = 0;
};

}  // namespace

std::string scad_text(const ScadModule& module, const std::string& folder) {
  std::string text;
  write(module, folder, text);
  return text;
}

std::optional<FlatLoops> loops_of_svg(std::string_view text) {
  constexpr std::string_view kData = " d=\"";
  FlatLoops loops;
  for (std::size_t at = text.find("<path"); at != std::string_view::npos;
       at = text.find("<path", at + 1)) {
    const std::size_t begin = text.find(kData, at);
    const std::size_t end =
        begin == std::string_view::npos ? begin : text.find('"', begin + kData.size());
    if (end == std::string_view::npos) return std::nullopt;
    PathData data(text.substr(begin + kData.size(), end - begin - kData.size()));
    FlatLoop loop;
    for (char letter = data.letter(); letter != '\0'; letter = data.letter()) {
      if (letter == 'M' || letter == 'L') {
        FlatPoint p;
        if (!data.number(p.x) || !data.number(p.y)) return std::nullopt;
        loop.push_back({p.x, -p.y + 0.0});
      } else if (letter == 'z') {
        if (loop.size() >= 3) loops.push_back(std::move(loop));
        loop.clear();
      } else {
        return std::nullopt;
      }
    }
  }
  return loops;
}

const OpenscadProgram::Result& OpenscadDelegate::result(const ScadModule& module,
                                                        OpenscadProgram::Format format) {
  std::string text = scad_text(module, folder_);
  const auto known = known_.find({text, format});
  if (known != known_.end()) return known->second;
  OpenscadProgram::Result result = program_->evaluate(text, format);
  return known_.emplace(std::pair{std::move(text), format}, std::move(result)).first->second;
}

std::variant<PolygonMesh, std::string> OpenscadDelegate::solid(const ScadModule& module) {
  const auto& r = result(module, OpenscadProgram::Format::kOff);
  if (!r.trouble.empty()) return r.trouble;
  if (r.text.empty()) return PolygonMesh{};
  auto mesh = read_off(r.text);
  if (auto* fault = std::get_if<MeshFault>(&mesh)) return "OpenSCAD's mesh: " + fault->why;
  // However many digits they have, they were computed from a .csg file's numbers.
  std::get<PolygonMesh>(mesh).digits = kOpenscadDigits;
  return std::get<PolygonMesh>(std::move(mesh));
}

std::variant<FlatLoops, std::string> OpenscadDelegate::flat(const ScadModule& module) {
  const auto& r = result(module, OpenscadProgram::Format::kSvg);
  if (!r.trouble.empty()) return r.trouble;
  if (r.text.empty()) return FlatLoops{};
  auto loops = loops_of_svg(r.text);
  if (!loops) return std::string("OpenSCAD's SVG file is not what it writes");
  return *std::move(loops);
}

}  // namespace graycube
