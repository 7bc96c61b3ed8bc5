// How a .csg file is read, and with which help.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "formats/view/frame.hpp"
#include "geometry/vec.hpp"

namespace graycube {

/// OpenSCAD as a program, for modules that the importer can't evaluate.
class OpenscadProgram {
 public:
  enum class Format : std::uint8_t { kOff, kSvg };
  struct Result {
    /// The text of the file that it wrote; empty, without trouble, for an empty model.
    std::string text;
    /// Why there is no file.
    std::string trouble;
    /// What the program warned of meanwhile, line by line.
    std::vector<std::string> said{};
  };
  /// A part of a model.
  struct Part {
    /// The text of a .csg file.
    std::string csg;
    /// What it is, for people who wait: "minkowski() of line 7".
    std::string name;
  };
  virtual ~OpenscadProgram() = default;
  /// Evaluates the text of a .csg file.
  virtual Result evaluate(const std::string& csg, Format format) = 0;
  /// A result for each part, as evaluate() gives it; in one run where the program can do that.
  virtual std::vector<Result> evaluate_all(std::span<const Part> parts, Format format) {
    std::vector<Result> results;
    for (const Part& part : parts) results.push_back(evaluate(part.csg, format));
    return results;
  }
};

/// Where a model has its viewer stand, by OpenSCAD's $vpt, $vpr, $vpd and $vpf; these are its
/// camera's own values.
struct OpenscadView {
  /// The point that the camera turns about, and looks at.
  Vec3 target{0, 0, 0};
  /// Degrees about x, y and z; without any the camera looks down.
  Vec3 rotation{55, 0, 25};
  double distance = 140;
  /// The full vertical angle.
  double fov_degrees = 22.5;
};

/// Settings for things that a .csg file doesn't tell.
struct OpenscadOptions {
  Frame frame{};
  /// Whether round solids are made of facets, as OpenSCAD makes them.
  bool facets = false;
  /// Evaluates text(), import() and other modules that need it; if null, these are errors.
  OpenscadProgram* program = nullptr;
  /// The folder to which the names of files in the text are relative.
  std::string folder{};
  /// The same model's tree from OpenSCAD with openscad_exact_definitions(), with all digits of the
  /// numbers. Those that don't agree with the text are ignored. Empty: there is none.
  std::string_view spelled_out{};
  /// The model's own view, if it sets one; else it is framed.
  std::optional<OpenscadView> view{};
};

}  // namespace graycube
