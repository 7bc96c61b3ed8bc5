#include "bezier/sides.hpp"

#include <algorithm>
#include <map>
#include <span>
#include <string>
#include <tuple>

namespace graycube {
namespace {

using SidePoints = std::array<std::uint32_t, 4>;

/// Gives points with equal coordinates the number of the first of them.
std::vector<std::uint32_t> welded_numbers(std::span<const Vec3> points) {
  std::map<std::tuple<double, double, double>, std::uint32_t> first;
  std::vector<std::uint32_t> numbers;
  numbers.reserve(points.size());
  for (const Vec3& p : points) {
    // −0 compares equal to 0.
    const auto next = static_cast<std::uint32_t>(numbers.size());
    numbers.push_back(first.try_emplace({p.x, p.y, p.z}, next).first->second);
  }
  return numbers;
}

/// How often a curve is used, and where first.
struct CurveUses {
  int forward = 0, backward = 0;
  std::size_t patch = 0, side = 0;

  int count() const { return forward + backward; }
};

std::vector<CurveUses> uses_of(const BezierSides& sides) {
  std::vector<CurveUses> uses(sides.curves.size());
  for (std::size_t p = 0; p < sides.patches.size(); ++p) {
    for (std::size_t s = 0; s < 4; ++s) {
      const BezierSides::Use& use = sides.patches[p][s];
      CurveUses& all = uses[use.curve];
      if (all.count() == 0) all.patch = p, all.side = s;
      ++(use.is_backward ? all.backward : all.forward);
    }
  }
  return uses;
}

}  // namespace

SidePoints side_of(const BezierPatch& patch, std::size_t side) {
  static constexpr std::size_t kRound[4][4] = {
      {0, 1, 2, 3}, {3, 7, 11, 15}, {15, 14, 13, 12}, {12, 8, 4, 0}};
  const auto& at = kRound[side];
  return {patch[at[0]], patch[at[1]], patch[at[2]], patch[at[3]]};
}

BezierSides sides_of(const BezierNet& net) {
  const std::vector<std::uint32_t> number = welded_numbers(net.points);
  std::map<SidePoints, std::uint32_t> known;
  BezierSides sides;
  sides.patches.resize(net.patches.size());
  for (std::size_t p = 0; p < net.patches.size(); ++p) {
    for (std::size_t s = 0; s < 4; ++s) {
      SidePoints ahead = side_of(net.patches[p], s);
      for (std::uint32_t& point : ahead) point = number[point];
      const SidePoints back{ahead[3], ahead[2], ahead[1], ahead[0]};
      const auto next = static_cast<std::uint32_t>(sides.curves.size());
      const auto [found, is_new] = known.try_emplace(std::min(ahead, back), next);
      if (is_new) sides.curves.push_back({found->first});
      sides.patches[p][s] = {found->second, back < ahead};
    }
  }
  return sides;
}

std::optional<MeshFault> open_side(const BezierNet& net, const BezierSides& sides) {
  const std::vector<CurveUses> uses = uses_of(sides);
  const CurveUses* first = nullptr;
  std::size_t open = 0;
  for (std::size_t c = 0; c < uses.size(); ++c) {
    const bool closes = uses[c].forward == uses[c].backward || uses[c].count() == 2;
    if (closes || sides.curves[c].is_point() || sides.curves[c].is_fold()) continue;
    if (first == nullptr) first = &uses[c];
    ++open;
  }
  if (first == nullptr) return std::nullopt;
  const SidePoints side = side_of(net.patches[first->patch], first->side);
  const int others = first->count() - 1;
  std::string why = "the patches are not closed: the side of patch " +
                    std::to_string(first->patch) + " from point " + std::to_string(side[0]) +
                    " to point " + std::to_string(side[3]) + " meets " +
                    (others == 0 ? std::string("no other side of the same four points")
                                 : std::to_string(others) + " others, which can't be paired");
  if (open > 1)
    why += "; " + std::to_string(open - 1) + (open == 2 ? " more is open" : " more are open");
  return MeshFault{std::move(why), true};
}

}  // namespace graycube
