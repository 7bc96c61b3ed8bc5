#include "subdivisions/crossing_search.hpp"

#include "check.hpp"
#include "subdivisions/arnaldi_cells.hpp"
#include "subdivisions/kaplan_cells.hpp"
#include "subdivisions/linked_cells.hpp"
#include "subdivisions/octree_cells.hpp"
#include "subdivisions/pieces.hpp"
#include "subdivisions/roth_objects.hpp"

namespace graycube {
namespace {

template <typename Cells, typename... Arguments>
std::unique_ptr<const CrossingSearch> search_of(const Arguments&... arguments) {
  return std::make_unique<WalkingSearch<Cells>>(Cells(arguments...));
}

}  // namespace

std::unique_ptr<const CrossingSearch> make_search(const Model& model,
                                                  const SubdivisionChoice& choice) {
  switch (choice.way) {
    case Subdivision::kRoth: return search_of<RothObjects>(model);
    case Subdivision::kLinked: return search_of<LinkedCells>(model, entry_of(choice));
    case Subdivision::kArnaldi: return search_of<ArnaldiCells>(model, entry_of(choice));
    case Subdivision::kOctree: return search_of<OctreeCells>(model);
    case Subdivision::kKaplan: return search_of<KaplanCells>(model);
    case Subdivision::kSurfaces: break;
  }
  GRAYCUBE_CHECK(false, "subdivision %d has no search", static_cast<int>(choice.way));
  return nullptr;
}

}  // namespace graycube
