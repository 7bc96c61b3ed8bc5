// Reads the repeat node: a child, and the maps under whose products it is placed.
#include <string>
#include <utility>

#include "formats/graycube/read_csg.hpp"
#include "formats/graycube/read_transform.hpp"
#include "formats/graycube/scene_words.hpp"
#include "scene/limits.hpp"
#include "scene/repeat.hpp"

namespace graycube {
namespace {

enum RepeatKey : std::size_t { kChild = kCommonKeys, kMaps, kDepth, kKeep };

}  // namespace

void CsgReader::read_repeat(const std::array<JsonIndex, kMaxNodeKeys>& members, JsonIndex at,
                            RepeatNode& out, bool has_material, std::uint32_t depth,
                            Context& context) {
  const bool maps_good = members[kMaps] != 0 && read_repeat_maps(members[kMaps], out.maps);
  const bool depth_good =
      members[kDepth] != 0 && json_.read(members[kDepth], out.depth, 0u, kMaxRepeatDepth);
  const bool kept_good = json_.read_word(members[kKeep], out.kept, kKeptCopiesWords);
  out.child.resize(1);
  ++nodes_read_;
  if (members[kChild] == 0) return;
  TreeSummary child;
  Context inner{child, context.reports_bare_leaves};
  read_node(members[kChild], out.child.front(), has_material, depth + 1, inner);
  // How often the child is placed isn't known where there is an error: once, then.
  const bool good = maps_good && depth_good && kept_good;
  context.summary.add_repeat(at, good ? counts_of(out) : RepeatCounts{1, 1}, std::move(child));
}

bool CsgReader::read_repeat_maps(JsonIndex at, std::vector<Affine>& out) {
  if (!json_.is_array(at)) return false;
  const std::uint32_t count = json_.tree.size(at);
  if (count == 0) return json_.wrong(at, "one map or more");
  maps_read_ += count;
  if (maps_read_ > kMaxRepeatMaps) {
    json_.errors.add(
        at, "the repeats have more than " + std::to_string(kMaxRepeatMaps) + " maps together");
    return false;
  }
  const std::uint64_t errors = json_.errors.total();
  out.reserve(count);
  for (JsonIndex m = json_.tree.first_child(at); m != json_.tree.end(at); m = json_.tree.next(m))
    out.push_back(read_transform(json_, m).value_or(Affine{}));
  return json_.errors.total() == errors;
}

}  // namespace graycube
