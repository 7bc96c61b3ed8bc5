// How a .csg file is read, and with which help.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "formats/view/frame.hpp"

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
  };
  virtual ~OpenscadProgram() = default;
  /// Evaluates the text of a .csg file.
  virtual Result evaluate(const std::string& csg, Format format) = 0;
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
};

}  // namespace graycube
