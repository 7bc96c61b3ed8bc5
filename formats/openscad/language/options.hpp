// How a .csg file is read, and what with.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "formats/view/frame.hpp"

namespace graycube {

/// OpenSCAD as a program, for what the importer can't do.
class OpenscadProgram {
 public:
  enum class Format : std::uint8_t { kOff, kSvg };
  struct Result {
    /// The file that it wrote; empty, without trouble, for an empty model.
    std::string text;
    /// Why there is no file.
    std::string trouble;
  };
  virtual ~OpenscadProgram() = default;
  /// Evaluates the text of a .csg file.
  virtual Result evaluate(const std::string& csg, Format format) = 0;
};

/// What a .csg file doesn't say.
struct OpenscadOptions {
  Frame frame{};
  /// Everything round as OpenSCAD would make it of facets.
  bool facets = false;
  /// Evaluates text(), import() and what else needs it; null: they are errors.
  OpenscadProgram* program = nullptr;
  /// Where the names of files in the text start from.
  std::string folder{};
  /// What OpenSCAD evaluates the same model to with openscad_exact_definitions(): it has all digits
  /// of the text's numbers. What doesn't agree with the text is ignored. Empty: there is none.
  std::string_view spelled_out{};
};

}  // namespace graycube
