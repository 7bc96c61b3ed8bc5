#include "formats/openscad/language/known_arguments.hpp"

#include <algorithm>
#include <array>
#include <string_view>

namespace graycube {
namespace {

struct KnownArguments {
  std::string_view module;
  /// Words with spaces around them.
  std::string_view names;
};

/// Those of 2021.01, and those that later ones write and that are followed here. Not followed is
/// linear_extrude's `segments`.
constexpr std::array<KnownArguments, 22> kKnown{{
    {"cube", " size center "},
    {"sphere", " r d "},
    {"cylinder", " h r r1 r2 d d1 d2 center "},
    {"polyhedron", " points faces triangles convexity "},
    {"square", " size center "},
    {"circle", " r d "},
    {"polygon", " points paths convexity "},
    {"linear_extrude",
     " height v center twist slices scale convexity file layer origin timestamp "},
    {"rotate_extrude", " angle start convexity file layer origin scale timestamp "},
    {"offset", " r delta chamfer "},
    {"multmatrix", " m "},
    {"color", " c alpha "},
    {"render", " convexity "},
    {"minkowski", " convexity "},
    {"group", " "},
    {"union", " "},
    {"difference", " "},
    {"intersection", " "},
    {"hull", " "},
    {"fill", " "},
    {"roof", " method convexity "},
    {"projection", " cut convexity "},
}};

/// Whether it is one that every module may have.
bool is_common(std::string_view name) {
  return name.empty() || name.front() == '$' || name == "timestamp";
}

bool is_known(const KnownArguments& known, const std::string& name) {
  return known.names.find(" " + name + " ") != std::string_view::npos;
}

void warn(const ScadModule& module, const std::string& argument, OpenscadReport& report) {
  constexpr std::size_t kMaxQuoted = 40;
  const std::string name = argument.substr(0, kMaxQuoted);
  report.warning(module.name + "() argument " + name, module.line,
                 module.name + "(): the argument " + name + " is not known, and ignored");
}

}  // namespace

void warn_of_unknown_arguments(const std::vector<ScadModule>& modules, OpenscadReport& report) {
  for (const ScadModule& module : modules) {
    const auto known = std::find_if(kKnown.begin(), kKnown.end(), [&](const KnownArguments& k) {
      return k.module == module.name;
    });
    for (const ScadArgument& argument : module.arguments) {
      if (known != kKnown.end() && !is_common(argument.name) && !is_known(*known, argument.name))
        warn(module, argument.name, report);
    }
    warn_of_unknown_arguments(module.children, report);
  }
}

}  // namespace graycube
