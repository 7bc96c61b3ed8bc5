// Reads the bezier leaf: control points, and patches of them that close up.
#include <string>

#include "formats/graycube/read_leaf.hpp"
#include "scene/bezier_solid.hpp"

namespace graycube {
namespace {

enum BezierKey : std::size_t { kPoints = kCommonKeys, kPatches, kTolerance };

bool read_patch(JsonAccess& json, JsonIndex at, std::uint32_t points, BezierPatch& patch) {
  if (json.tree.kind(at) != JsonKind::kArray || json.tree.size(at) != patch.size())
    return json.wrong(at, "a patch of 16 numbers of points");
  bool good = true;
  JsonIndex child = json.tree.first_child(at);
  for (std::uint32_t& number : patch) {
    good = json.read(child, number, 0u, points - 1) && good;
    child = json.tree.next(child);
  }
  return good;
}

bool read_patches(JsonAccess& json, JsonIndex at, BezierNet& net) {
  if (!json.is_array(at)) return false;
  const std::uint32_t count = json.tree.size(at);
  if (count == 0 || count > kMaxBezierPatches)
    return json.wrong(at, "1 to " + std::to_string(kMaxBezierPatches) + " patches");
  if (net.points.empty()) return json.wrong(at, "points for the patches");
  net.patches.resize(count);
  bool good = true;
  JsonIndex child = json.tree.first_child(at);
  for (BezierPatch& patch : net.patches) {
    good = read_patch(json, child, static_cast<std::uint32_t>(net.points.size()), patch) && good;
    child = json.tree.next(child);
  }
  return good;
}

}  // namespace

std::uint64_t read_bezier(JsonAccess& json, const std::array<JsonIndex, kMaxNodeKeys>& members,
                          BezierShape& out) {
  const JsonIndex points = members[kPoints], patches = members[kPatches];
  const bool tolerance_good = json.read_optional(members[kTolerance], out.tolerance, kPositive);
  const bool points_good = points != 0 && read_points(json, points, out.net.points);
  if (!points_good || patches == 0 || !read_patches(json, patches, out.net) || !tolerance_good)
    return 0;
  const auto division = division_of(out.net, tolerance_of(out));
  if (const auto* good = std::get_if<BezierDivision>(&division)) return good->triangles;
  json.errors.add(patches, std::get<MeshFault>(division).why);
  return 0;
}

}  // namespace graycube
