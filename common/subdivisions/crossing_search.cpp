#include "subdivisions/crossing_search.hpp"

#include "check.hpp"
#include "subdivisions/linked_cells.hpp"

namespace graycube {

std::unique_ptr<const CrossingSearch> make_search(const Model& model,
                                                  const SubdivisionChoice& choice) {
  GRAYCUBE_CHECK(choice.way == Subdivision::kLinked, "subdivision %d has no search",
                 static_cast<int>(choice.way));
  return std::make_unique<LinkedCells>(model);
}

}  // namespace graycube
