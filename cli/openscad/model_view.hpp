// The view that an OpenSCAD model sets by $vpt, $vpr, $vpd and $vpf.
#pragma once

#include <optional>
#include <string_view>

#include "formats/openscad/language/options.hpp"

namespace graycube {

/// Definitions that have openscad tell the view: the line of its log that begins with the mark.
inline constexpr std::string_view kOpenscadViewDefinitions =
    "echo(graycube_view = [$vpt, $vpr, $vpd, $vpf])";
inline constexpr std::string_view kOpenscadViewMark = "ECHO: graycube_view = ";

/// The view, `told` being what stands behind the mark; nothing if the model sets none. Variables
/// that aren't set count as OpenSCAD's camera has them. That one is set shows by its value, or by
/// an assignment in the text of the model.
std::optional<OpenscadView> openscad_view(std::string_view told, std::string_view model);

}  // namespace graycube
