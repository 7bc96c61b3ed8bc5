// The words of the scene format that stand for enumerators, shared by reader and writer.
#pragma once

#include <array>
#include <string_view>

#include "formats/json/access.hpp"
#include "scene/scene.hpp"
#include "shading/material.hpp"
#include "shading/settings.hpp"

namespace graycube {

inline constexpr std::array<Word<ShadingModel>, 5> kShadingModelWords{
    {{"phong", ShadingModel::kPhong},
     {"torrance_sparrow", ShadingModel::kTorranceSparrow},
     {"hall_greenberg", ShadingModel::kHallGreenberg},
     {"rt", ShadingModel::kRt},
     {"rt_lamp", ShadingModel::kRtLamp}}};
inline constexpr std::array<Word<PatternKind>, kPatternKinds - 1> kPatternWords{
    {{"camouflage", PatternKind::kCamouflage},
     {"marble", PatternKind::kMarble},
     {"checker", PatternKind::kChecker},
     {"clouds", PatternKind::kClouds},
     {"gradient", PatternKind::kGradient}}};
inline constexpr std::array<Word<ChartKind>, kChartKinds - 1> kChartWords{
    {{"sphere", ChartKind::kSphere},
     {"torus", ChartKind::kTorus},
     {"round", ChartKind::kRound},
     {"trough", ChartKind::kTrough},
     {"plane", ChartKind::kPlane},
     {"faces", ChartKind::kFaces}}};
inline constexpr std::array<Word<EndChart>, kEndCharts> kEndChartWords{
    {{"none", EndChart::kNone},
     {"zero_at_rim", EndChart::kZeroAtRim},
     {"one_at_rim", EndChart::kOneAtRim}}};
inline constexpr std::array<Word<Projection>, 2> kProjectionWords{
    {{"perspective", Projection::kPerspective}, {"orthographic", Projection::kOrthographic}}};
inline constexpr std::array<Word<Handedness>, 2> kHandednessWords{
    {{"right", Handedness::kRight}, {"left", Handedness::kLeft}}};
inline constexpr std::array<Word<InsideView>, 2> kInsideViewWords{
    {{"exit", InsideView::kExit}, {"entry", InsideView::kEntry}}};
inline constexpr std::array<Word<Falloff>, 2> kFalloffWords{
    {{"none", Falloff::kNone}, {"inverse_square", Falloff::kInverseSquare}}};
inline constexpr std::array<Word<KeptCopies>, 2> kKeptCopiesWords{
    {{"all", KeptCopies::kAll}, {"last", KeptCopies::kLast}}};

/// The word that stands for a value.
template <typename T, std::size_t N>
constexpr std::string_view word_of(const std::array<Word<T>, N>& words, T value) {
  for (const auto& w : words)
    if (w.value == value) return w.name;
  return {};
}

}  // namespace graycube
