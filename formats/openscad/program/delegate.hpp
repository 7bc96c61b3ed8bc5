// The parts of a model that OpenSCAD itself evaluates. All that one reading of the model asks for
// goes into one run of the program; then the model is read again, with the answers.
#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "flat/polygon.hpp"
#include "formats/openscad/language/options.hpp"
#include "formats/openscad/language/parser.hpp"
#include "geometry/vec.hpp"
#include "mesh/close_mesh.hpp"

namespace graycube {

/// What the program made of a part.
template <typename Shape>
struct Delegated {
  /// Empty if the part is nothing, or if there is trouble.
  Shape shape;
  /// Why the part can't be had; empty if it can.
  std::string trouble;
  /// What the program, or the reader of a mesh file, warned of.
  std::vector<std::string> said;
  /// Some of it is left out, as `said` tells.
  bool is_partial = false;
};

/// Asks a program once for each different text.
class OpenscadDelegate {
 public:
  /// `program` may be null: then there is no program to ask.
  explicit OpenscadDelegate(OpenscadProgram* program, std::string folder)
      : program_(program), folder_(std::move(folder)) {}

  bool is_there() const { return program_ != nullptr; }
  /// The folder to which the names of files are relative; empty if it isn't known.
  const std::string& folder() const { return folder_; }

  /// What the program makes of a module; null until evaluate_asked() has asked for it.
  const Delegated<PolygonMesh>* solid(const ScadModule& module);
  const Delegated<FlatLoops>* flat(const ScadModule& module);
  /// The mesh in an STL or OFF file, which needs no program. Each file is read once.
  const Delegated<PolygonMesh>& mesh_file(const std::filesystem::path& path);
  /// Has the program evaluate all that was asked for and isn't known. False if that is nothing:
  /// then all answers were there. Parts far from the origin, of which six digits don't tell much,
  /// are evaluated a second time near it.
  bool evaluate_asked();

 private:
  template <typename Shape>
  struct Answers {
    OpenscadProgram::Format format;
    std::map<std::string, Delegated<Shape>> known{};
    /// What to ask for, in the order of the file, and its texts.
    std::vector<OpenscadProgram::Part> asked{};
    std::set<std::string> asked_texts{};
  };
  template <typename Shape>
  const Delegated<Shape>* answer(Answers<Shape>& answers, const ScadModule& module);
  template <typename Shape>
  bool evaluate(Answers<Shape>& answers);

  OpenscadProgram* program_;
  std::string folder_;
  std::map<std::filesystem::path, Delegated<PolygonMesh>> files_;
  Answers<PolygonMesh> solids_{OpenscadProgram::Format::kOff};
  Answers<FlatLoops> flats_{OpenscadProgram::Format::kSvg};
};

}  // namespace graycube
