#include "frontal/preparation/recut.hpp"

#include <algorithm>
#include <exception>
#include <span>
#include <utility>

#include "check.hpp"
#include "proto/model_slice.hpp"
#include "proto/share_of.hpp"
#include "regions/kept_trees.hpp"
#include "regions/restrict.hpp"
#include "stop_point.hpp"

namespace graycube {
namespace {

/// The primitives that are held, by their index.
std::vector<bool> held_primitives(const Model& model, const ModelContents& contents) {
  std::vector<bool> held(model.primitives.size(), false);
  for_each_kept(model, contents, [&](const Object&, std::span<const TreeNode> tree) {
    for (const TreeNode& node : tree) {
      const bool is_leaf =
          node.kind == TreeNode::Kind::kLeaf || node.kind == TreeNode::Kind::kInvertedLeaf;
      if (is_leaf) held[node.primitive] = true;
    }
  });
  return held;
}

/// Whether the edges of the share's column and row differ: if not, it needs what it needed.
bool has_moved(const MacroGrid& from, const MacroGrid& to, const RegionShare& share) {
  // Behind the eye the outermost columns also end at the fan's root, boundary number C/2.
  const auto differs = [](const std::vector<std::int64_t>& a, const std::vector<std::int64_t>& b,
                          std::size_t cell) {
    const bool is_outermost = cell == 0 || cell == a.size();
    const std::size_t root = (a.size() + 1) / 2;
    return (cell > 0 && a[cell - 1] != b[cell - 1]) || (cell < a.size() && a[cell] != b[cell]) ||
           (is_outermost && root > 0 && a[root - 1] != b[root - 1]);
  };
  return differs(from.column_edges(), to.column_edges(), share.column) ||
         differs(from.row_edges(), to.row_edges(), share.row);
}

bool is_same(const ModelContents& a, const ModelContents& b) {
  const auto is_same_part = [](const ModelContents::Part& p, const ModelContents::Part& q) {
    return p.object == q.object && p.tree == q.tree;
  };
  return a.is_whole == b.is_whole && std::ranges::equal(a.parts, b.parts, is_same_part);
}

void recut_into(RecutResult& result, const RecutWork& work) {
  const Model& model = *work.model;
  const SliceEncoder encoder(model);
  result.slices.resize(work.cube.nodes());
  for (std::uint32_t rank = 0; rank < work.cube.nodes(); ++rank) {
    stop_if_asked();
    const RegionShare share = share_of(work.cube, Rank{rank});
    if (!has_moved(work.from, work.to, share)) continue;
    const ModelContents before = contents_of_share(model, work.from, share);
    const ModelContents after = contents_of_share(model, work.to, share);
    if (is_same(before, after)) continue;
    const std::vector<bool> had = held_primitives(model, before);
    const std::vector<bool> has = held_primitives(model, after);
    for (std::size_t i = 0; i < has.size(); ++i) {
      result.primitives += has[i];
      result.new_primitives += has[i] && !had[i];
    }
    result.slices[rank] = encoder.encode(after, {});
    result.bytes += result.slices[rank].size();
  }
}

}  // namespace

RecutResult recut(const RecutWork& work, const std::function<double()>& clock_s) {
  RecutResult result;
  result.job = work.job;
  result.generation = work.generation;
  const double began_s = clock_s();
  try {
    const ChecksThrow checks_throw;
    recut_into(result, work);
  } catch (const std::bad_alloc&) {
    result.error = "there is not enough memory to cut the scene anew";
  } catch (const std::exception& e) {
    result.error = std::string("internal error: ") + e.what();
  }
  result.seconds = clock_s() - began_s;
  return result;
}

}  // namespace graycube
