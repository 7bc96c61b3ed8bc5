#include "mesh/edges.hpp"

#include <algorithm>
#include <utility>

#include "stop_point.hpp"
#include "stoppable_sort.hpp"

namespace graycube {
namespace {

std::uint64_t key_of(std::uint32_t from, std::uint32_t to) {
  const std::uint64_t lower = std::min(from, to), higher = std::max(from, to);
  return lower << 33 | higher << 1;
}

MeshEdge edge_of(const Triangle& t, std::size_t i) { return {t[i], t[(i + 1) % 3]}; }

/// A triangle's side: the edge's key, and 3 · triangle + side.
struct Side {
  std::uint64_t key;
  std::uint32_t place;
  friend bool operator<(const Side& a, const Side& b) {
    return a.key != b.key ? a.key < b.key : a.place < b.place;
  }
};

}  // namespace

std::vector<std::uint32_t> sides_across(std::span<const Triangle> triangles, std::uint32_t none) {
  std::vector<Side> sides;
  sides.reserve(3 * triangles.size());
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    for (std::uint32_t i = 0; i < 3; ++i) {
      const MeshEdge e = edge_of(triangles[t], i);
      sides.push_back({key_of(e.from, e.to), 3 * t + i});
    }
  }
  stoppable_sort(std::span(sides));
  std::vector<std::uint32_t> across(sides.size(), none);
  for (std::size_t i = 0; i < sides.size();) {
    std::size_t end = i;
    while (end < sides.size() && sides[end].key == sides[i].key) ++end;
    if (end - i == 2) {
      across[sides[i].place] = sides[i + 1].place;
      across[sides[i + 1].place] = sides[i].place;
    }
    i = end;
  }
  return across;
}

MeshEdges::MeshEdges(std::span<const Triangle> triangles) {
  records_.reserve(3 * triangles.size());
  for (const Triangle& t : triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const MeshEdge e = edge_of(t, i);
      records_.push_back(key_of(e.from, e.to) | (e.from > e.to ? 1u : 0u));
    }
  }
  stoppable_sort(std::span(records_));
  for (std::size_t i = 0; i < records_.size();) {
    const std::uint64_t key = records_[i] & ~std::uint64_t{1};
    std::ptrdiff_t balance = 0;
    for (; i < records_.size() && (records_[i] & ~std::uint64_t{1}) == key; ++i) {
      balance += (records_[i] & 1) != 0 ? -1 : 1;
    }
    ++count_;
    if (balance != 0) ++unbalanced_count_;
  }
}

MeshEdges::Uses MeshEdges::uses(const MeshEdge& e) const {
  const std::uint64_t key = key_of(e.from, e.to);
  const auto times = [&](std::uint64_t record) {
    const auto [first, last] = std::equal_range(records_.begin(), records_.end(), record);
    return static_cast<std::uint32_t>(last - first);
  };
  const Uses u{times(key), times(key | 1)};
  return e.from < e.to ? u : Uses{u.backward, u.forward};
}

std::optional<MeshEdge> MeshEdges::first_unbalanced(std::span<const Triangle> triangles) const {
  for (const Triangle& t : triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const MeshEdge e = edge_of(t, i);
      const Uses u = uses(e);
      if (u.forward != u.backward) return e;
    }
  }
  return std::nullopt;
}

std::optional<MeshEdge> agree_on_orientation(std::span<Triangle> triangles) {
  constexpr std::uint32_t kNone = 0xFFFFFFFFu;
  enum class State : std::uint8_t { kNew, kKept, kTurned };
  const std::vector<std::uint32_t> across = sides_across(triangles, kNone);
  std::vector<State> state(triangles.size(), State::kNew);
  std::vector<std::uint32_t> part;
  for (std::uint32_t seed = 0; seed < triangles.size(); ++seed) {
    if (state[seed] != State::kNew) continue;
    part.assign(1, seed);
    state[seed] = State::kKept;
    std::size_t turned = 0;
    for (std::size_t next = 0; next < part.size(); ++next) {
      stop_if_asked();
      const std::uint32_t t = part[next];
      for (std::uint32_t i = 0; i < 3; ++i) {
        const std::uint32_t other = across[3 * t + i];
        if (other == kNone) continue;
        const MeshEdge mine = edge_of(triangles[t], i),
                       theirs = edge_of(triangles[other / 3], other % 3);
        const bool agrees = mine.from == theirs.to;
        const State wanted = agrees == (state[t] == State::kKept) ? State::kKept : State::kTurned;
        State& found = state[other / 3];
        if (found != State::kNew) {
          if (found != wanted) return mine;
          continue;
        }
        found = wanted;
        if (wanted == State::kTurned) ++turned;
        part.push_back(other / 3);
      }
    }
    const State minority = 2 * turned > part.size() ? State::kKept : State::kTurned;
    for (const std::uint32_t t : part) {
      if (state[t] == minority) std::swap(triangles[t][1], triangles[t][2]);
    }
  }
  return std::nullopt;
}

}  // namespace graycube
