// The work that the importer leaves to OpenSCAD itself: a part of a .csg file goes out as text, a
// mesh or a polygon comes back.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>

#include "flat/polygon.hpp"
#include "formats/openscad/language/options.hpp"
#include "formats/openscad/language/parser.hpp"
#include "mesh/close_mesh.hpp"

namespace graycube {

/// Whether the program evaluates whatever such a module holds.
bool is_for_program(const std::string& name);

/// The text of a module as OpenSCAD reads it; the names of files in `file = …` are made absolute by
/// `folder`, when it isn't empty.
std::string scad_text(const ScadModule& module, const std::string& folder);

/// The polygon of an SVG file that OpenSCAD wrote: its path's closed loops, y upwards. Nothing when
/// the text is no such file.
std::optional<FlatLoops> loops_of_svg(std::string_view text);

/// Asks a program once for each different text.
class OpenscadDelegate {
 public:
  /// `program` may be null: then there is no program to ask.
  OpenscadDelegate(OpenscadProgram* program, std::string folder)
      : program_(program), folder_(std::move(folder)) {}

  bool is_there() const { return program_ != nullptr; }
  /// The mesh that the program makes of a module, or why there is none; it may be empty.
  std::variant<PolygonMesh, std::string> solid(const ScadModule& module);
  std::variant<FlatLoops, std::string> flat(const ScadModule& module);

 private:
  const OpenscadProgram::Result& result(const ScadModule& module, OpenscadProgram::Format format);

  OpenscadProgram* program_;
  std::string folder_;
  std::map<std::pair<std::string, OpenscadProgram::Format>, OpenscadProgram::Result> known_;
};

}  // namespace graycube
