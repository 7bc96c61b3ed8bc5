// Reads the tree that OpenSCAD writes with `openscad -o MODEL.csg MODEL.scad`: primitives,
// matrices, Boolean operations and colours, everything else evaluated away. OpenSCAD 2021.01 is the
// reference for what empty operands, degenerate primitives and the modifiers % # ! * mean.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scene/frame.hpp"
#include "scene/scene.hpp"

namespace graycube {

/// Limits of one file. What goes past them is an error naming the line, before memory is taken.
inline constexpr std::size_t kMaxOpenscadBytes = std::size_t{64} << 20;
inline constexpr std::size_t kMaxOpenscadModules = std::size_t{1} << 20;
/// Numbers, strings and lists among the arguments, in the whole file: 40 bytes each.
inline constexpr std::size_t kMaxOpenscadValues = std::size_t{1} << 23;
/// Modules inside modules, and lists inside lists.
inline constexpr int kMaxOpenscadNesting = 512;
inline constexpr int kMaxOpenscadListNesting = 16;
inline constexpr std::size_t kMaxOpenscadPoints = std::size_t{1} << 20;
inline constexpr std::size_t kMaxOpenscadFaces = std::size_t{1} << 20;
/// Errors and warnings that are kept; one more line counts the rest.
inline constexpr std::size_t kMaxOpenscadErrors = 100;
inline constexpr std::size_t kMaxOpenscadWarnings = 100;
/// Significant digits of the numbers in a .csg file: of OpenSCAD's `%g`.
inline constexpr std::uint32_t kOpenscadDigits = 6;
/// Coordinates beyond this are an error; solids thinner than its inverse count as empty.
inline constexpr double kMaxOpenscadCoordinate = 1e30;

/// Sides of anything round that is made of facets, and slices of an extrusion.
inline constexpr int kMaxOpenscadSides = 4096;
/// Facets of one solid that the importer makes of facets.
inline constexpr std::size_t kMaxOpenscadFacets = std::size_t{1} << 20;
/// Corners of a polygon after operations.
inline constexpr std::size_t kMaxOpenscadCorners = std::size_t{1} << 18;

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

/// `line` counts from 1; 0 stands for the whole file.
struct OpenscadError {
  int line = 0;
  std::string message;
};

/// `scene` is there exactly when `errors` is empty. Errors are in the order of their lines.
/// Warnings start with "line N: " unless they are about the whole file; they tell of solids that
/// OpenSCAD leaves out, too.
struct OpenscadResult {
  std::optional<Scene> scene;
  std::vector<OpenscadError> errors;
  std::vector<std::string> warnings;
};

/// The scene of a .csg file: OpenSCAD's axes (z up, right-handed) and its default direction of
/// view, framed, with two lights and a grey background. Never throws for what is in `text`,
/// whatever it is.
///
/// Spheres and cylinders are exact, unless $fn asks for 8 sides or fewer: then they are the
/// polyhedra that OpenSCAD builds. Parts outside any difference and intersection become objects of
/// their own, unless some part is transparent: inner surfaces would show, so then the file is one
/// object, a union.
OpenscadResult read_openscad_csg(std::string_view text, const OpenscadOptions& options = {});

}  // namespace graycube
