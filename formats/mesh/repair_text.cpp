#include "formats/mesh/repair_text.hpp"

#include <algorithm>
#include <cstdio>

namespace graycube {
namespace {

std::string counted(std::size_t count, const char* singular, const char* plural) {
  return std::to_string(count) + " " + (count == 1 ? singular : plural);
}

std::string short_number(double v) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2g", v);
  return text;
}

}  // namespace

void add_repairs(MeshRepairs& sum, const MeshRepairs& more) {
  sum.joined_corners += more.joined_corners;
  sum.farthest_joined = std::max(sum.farthest_joined, more.farthest_joined);
  sum.dropped_faces += more.dropped_faces;
  sum.filled_holes += more.filled_holes;
  sum.most_filled_edges = std::max(sum.most_filled_edges, more.most_filled_edges);
}

std::vector<std::string> texts_of(const MeshRepairs& repairs) {
  std::vector<std::string> texts;
  if (repairs.joined_corners > 0) {
    texts.push_back("repaired: joined " + counted(repairs.joined_corners, "corner", "corners") +
                    " with others up to " + short_number(repairs.farthest_joined) + " away");
  }
  if (repairs.dropped_faces > 0) {
    texts.push_back("repaired: dropped " + counted(repairs.dropped_faces, "face", "faces") +
                    " that the mesh has twice");
  }
  if (repairs.filled_holes > 0) {
    texts.push_back("repaired: filled " + counted(repairs.filled_holes, "flat hole", "flat holes") +
                    " of up to " + std::to_string(repairs.most_filled_edges) + " edges");
  }
  return texts;
}

}  // namespace graycube
