#include "formats/openscad/flat/polygon_arguments.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace graycube {
namespace {

bool read_points(const ScadList& list, ScadArguments& arguments, FlatLoop& points) {
  for (const ScadValue& value : list) {
    const auto p = ScadArguments::pair(value);
    if (!p || !(std::max(std::fabs(p->x), std::fabs(p->y)) <= kMaxOpenscadCoordinate)) {
      arguments.leave_out("point", "point " + std::to_string(points.size()) +
                                       " is not two numbers of sensible size");
      return false;
    }
    points.push_back(*p);
  }
  return true;
}

/// Numbers of points that aren't there are passed over, as OpenSCAD does; false if something is no
/// number.
bool read_path(const ScadList& corners, const FlatLoop& points, FlatLoop& loop,
               bool& has_strangers) {
  for (const ScadValue& corner : corners) {
    const double* index = corner.number();
    if (index == nullptr) return false;
    if (*index >= 0 && *index < static_cast<double>(points.size())) {
      loop.push_back(points[static_cast<std::size_t>(*index)]);
    } else {
      has_strangers = true;
    }
  }
  return true;
}

/// Paths that are no lists are passed over, as OpenSCAD does; false, and the polygon is left out,
/// if something in a path is no number.
bool read_paths(const ScadList& paths, const FlatLoop& points, ScadArguments& arguments,
                FlatLoops& loops) {
  for (std::size_t i = 0; i < paths.size(); ++i) {
    const std::string name = "path " + std::to_string(i);
    const ScadList* corners = paths[i].list();
    if (corners == nullptr) {
      arguments.pass_over(name, "must be a list of numbers of points");
      continue;
    }
    bool has_strangers = false;
    if (!read_path(*corners, points, loops.emplace_back(), has_strangers)) {
      arguments.leave_out("path", name + " is not a list of numbers of points");
      return false;
    }
    if (has_strangers) {
      arguments.ignore("strange point", name + " names a point that isn't there, which is ignored");
    }
  }
  return true;
}

}  // namespace

bool read_polygon(const ScadModule& module, ScadArguments& arguments, FlatLoops& loops) {
  const ScadValue* value = module.argument("points", 0);
  if (arguments.empty_unless(value != nullptr, "it has no points")) return false;
  const ScadList* list = arguments.list("points", 0);
  FlatLoop points;
  if (list == nullptr || !read_points(*list, arguments, points)) return false;
  const ScadValue* paths = module.argument("paths", 1);
  if (paths != nullptr && paths->list() == nullptr) {
    arguments.pass_over("paths", "must be a list of paths");
  } else if (paths != nullptr && !paths->list()->empty()) {
    const bool has_paths =
        std::any_of(paths->list()->begin(), paths->list()->end(),
                    [](const ScadValue& path) { return path.list() != nullptr; });
    if (has_paths) return read_paths(*paths->list(), points, arguments, loops);
    // OpenSCAD makes nothing of a single path without a list around it, and doesn't say so.
    arguments.leave_out("paths", "its paths must be lists of numbers of points, as in [[0, 1, 2]]");
    return false;
  }
  loops.push_back(std::move(points));
  return true;
}

}  // namespace graycube
