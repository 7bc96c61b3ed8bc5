#include "proto/bounds_bytes.hpp"

#include <algorithm>

#include "geometry/infinity.hpp"
#include "proto/bytes.hpp"

namespace graycube {
namespace {

constexpr std::size_t kSides = 6;
constexpr std::size_t kBranchBytes = kSides * sizeof(float) + sizeof(std::uint32_t);

/// The number of branches that are used, which come first.
std::size_t branches_of(const WideNode& node) {
  std::size_t count = 0;
  while (count < WideNode::kWidth && node.planes[0][0][count] <= node.planes[1][0][count]) ++count;
  return count;
}

float& side_of(WideNode& node, std::size_t side, std::size_t place) {
  return node.planes[side / 3][side % 3][place];
}

/// Reads a branch. False if it is no box, or leads back or too deep. `levels`: the depth of each
/// node, 0 until its parent came.
bool take_branch(ByteReader& r, std::size_t number, std::size_t place, WideNode& node,
                 std::vector<std::uint8_t>& levels) {
  for (std::size_t side = 0; side < kSides; ++side) side_of(node, side, place) = r.get<float>();
  for (std::size_t a = 0; a < 3; ++a) {
    // This is false for NaN, too.
    if (!(node.planes[0][a][place] <= node.planes[1][a][place])) return false;
  }
  const auto child = r.get<std::uint32_t>();
  node.child[place] = child == 0 ? WideNode::kItemFlag : child;
  if (!r.ok() || child == 0) return r.ok();
  if (child <= number || child >= levels.size() || levels[child] != 0) return false;
  levels[child] = static_cast<std::uint8_t>(levels[number] + 1);
  return levels[child] <= SurfaceTree::kMaxDepth;
}

}  // namespace

std::vector<std::byte> encode_bounds(const ForeignBounds& bounds) {
  const auto& nodes = bounds.nodes();
  std::size_t size = 2 * sizeof(std::uint32_t);
  for (const WideNode& node : nodes) size += 1 + branches_of(node) * kBranchBytes;
  ByteWriter w(size);
  w.put(kBoundsMagic);
  w.put(static_cast<std::uint32_t>(nodes.size()));
  for (WideNode node : nodes) {
    const std::size_t branches = branches_of(node);
    w.put(static_cast<std::uint8_t>(branches));
    for (std::size_t place = 0; place < branches; ++place) {
      for (std::size_t side = 0; side < kSides; ++side) w.put(side_of(node, side, place));
      const std::uint32_t child = node.child[place];
      w.put((child & WideNode::kItemFlag) != 0 ? std::uint32_t{0} : child);
    }
  }
  return std::move(w).take();
}

bool begins_with_bounds(std::span<const std::byte> bytes) {
  return bytes.size() >= sizeof kBoundsMagic &&
         load_little<std::uint32_t>(bytes.data()) == kBoundsMagic;
}

std::optional<ForeignBounds> take_bounds(std::span<const std::byte>& bytes) {
  ByteReader r(bytes);
  const auto magic = r.get<std::uint32_t>(), count = r.get<std::uint32_t>();
  // Each node takes at least a byte.
  if (!r.ok() || magic != kBoundsMagic || count > kMaxBoundsNodes || count > r.remaining())
    return std::nullopt;
  std::vector<WideNode> nodes(count);
  std::vector<std::uint8_t> levels(count);
  for (std::size_t number = 0; number < count; ++number) {
    WideNode& node = nodes[number];
    for (std::size_t side = 0; side < kSides; ++side) {
      for (std::size_t place = 0; place < WideNode::kWidth; ++place)
        side_of(node, side, place) = side < 3 ? kFloatInf : -kFloatInf;
    }
    node.child.fill(WideNode::kItemFlag);
    const auto branches = r.get<std::uint8_t>();
    if (branches == 0 || branches > WideNode::kWidth) return std::nullopt;
    for (std::size_t place = 0; place < branches; ++place) {
      if (!take_branch(r, number, place, node, levels)) return std::nullopt;
    }
  }
  bytes = bytes.last(r.remaining());
  return ForeignBounds(std::move(nodes));
}

}  // namespace graycube
