#include "frontal/preparation/choice.hpp"

namespace graycube {
namespace {

/// Seconds that the frontal takes for each byte to another host: handing it over (0.6 ns), cipher
/// (0.85 ns) and 10 Gbit/s (0.8 ns), which mostly come one after another.
constexpr double kRemoteByte_s = 2.2e-9;
/// Estimates: CPU seconds that a primary ray takes with all that descend from it, and the part of
/// them that roth may gain over macro, whose nodes don't end together.
constexpr double kPrimaryRay_s = 10e-6, kGainOfRoth = 0.5;

}  // namespace

double copying_s(const ChoiceBasis& basis) {
  if (basis.hosts <= 1) return 0;
  return kRemoteByte_s * static_cast<double>(basis.model_bytes) * basis.nodes;
}

Algorithm chosen_algorithm(MeshMode mesh, const ChoiceBasis& basis) {
  if (mesh != MeshMode::k2d || basis.model_bytes > kReplicatedModelBytes) return Algorithm::kMacro;
  const double render_s = kPrimaryRay_s * static_cast<double>(basis.primary_rays) / basis.nodes;
  return copying_s(basis) <= kGainOfRoth * render_s ? Algorithm::kRoth : Algorithm::kMacro;
}

}  // namespace graycube
