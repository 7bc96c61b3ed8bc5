// Every way of finding crossings against the whole trees: bit for bit.
#include <algorithm>
#include <memory>
#include <vector>

#include "catch.hpp"
#include "crossings/against_whole_trees.hpp"
#include "subdivisions/kaplan_cells.hpp"
#include "subdivisions/octree_cells.hpp"
#include "subdivisions/searches.hpp"

using namespace graycube;
using namespace graycube::testing;

namespace {

/// Planes of space tracing's halves, and of the first parts of the octree.
std::vector<SplitPlane> planes_of_halves(const Model& model) {
  std::vector<SplitPlane> planes;
  const KaplanCells halves(model);
  for (const BspNode& n : halves.nodes()) {
    if (n.axis != BspNode::kLeafAxis) planes.push_back({n.axis, n.split});
  }
  const Aabb cube = OctreeCells(model).cube();
  if (cube.is_empty()) return planes;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double share : {0.0, 0.25, 0.5, 0.75, 1.0}) {
      planes.push_back({axis, (1 - share) * cube.lo[axis] + share * cube.hi[axis]});
    }
  }
  return planes;
}

}  // namespace

TEST_CASE("every subdivision gives bit for bit the crossings of the whole trees") {
  std::vector<std::unique_ptr<const CrossingSearch>> searches;
  Mailbox mailbox;
  const auto prepare = [&](const Model& model) {
    searches.clear();
    for (const NamedChoice& way : kAllSearches) searches.push_back(make_search(model, way.choice));
    return planes_of_halves(model);
  };
  compare_families(1000, prepare, [&](const Model& model, const RayCase& c, const auto& expected) {
    for (std::size_t i = 0; i < searches.size(); ++i) {
      const CrossingSearch& search = *searches[i];
      const bool same = agrees(
          model, c, expected,
          [&](double t0, double t1) { return search.first_crossing(c.ray, t0, t1, mailbox); },
          [&](double t0, double t1, Rgb& light) {
            return search.pass_light(c.ray, t0, t1, mailbox, light);
          });
      if (same) continue;
      UNSCOPED_INFO("found by " << kAllSearches[i].name);
      return false;
    }
    return true;
  });
}
