#include "space/simd.hpp"

#include <hwy/targets.h>

#include <array>
#include <cstdint>
#include <cstdlib>

namespace graycube {
namespace {

struct Named {
  const char* name;
  std::int64_t target;
};

constexpr std::array<Named, 6> kNamed{{{"scalar", HWY_EMU128},
                                       {"scalar", HWY_SCALAR},
                                       {"sse4", HWY_SSE4},
                                       {"neon", HWY_NEON},
                                       {"avx2", HWY_AVX2},
                                       {"avx512", HWY_AVX3}}};

/// What the processor has, whatever was chosen before.
std::int64_t available() {
  hwy::SetSupportedTargetsForTest(0);
  return hwy::SupportedTargets() & HWY_TARGETS;
}

void use(std::int64_t targets) {
  hwy::SetSupportedTargetsForTest(targets);
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

}  // namespace

std::vector<std::string> simd_names() {
  const std::int64_t chosen = hwy::SupportedTargets();
  const std::int64_t all = available();
  hwy::SetSupportedTargetsForTest(chosen);
  std::vector<std::string> names;
  for (const Named& n : kNamed) {
    if ((n.target & all) != 0) names.emplace_back(n.name);
  }
  return names;
}

bool choose_simd(std::string_view name) {
  const std::int64_t all = available();
  if (name.empty() || name == "best") {
    use(all);
    return true;
  }
  for (const Named& n : kNamed) {
    if (n.name != name || (n.target & all) == 0) continue;
    use(n.target);
    return true;
  }
  return false;
}

std::string choose_simd_from_environment() {
  const char* name = std::getenv("GRAYCUBE_SIMD");
  if (name == nullptr || choose_simd(name)) return {};
  std::string message = std::string(name) + ": this machine has best";
  for (const std::string& known : simd_names()) message += ", " + known;
  return message;
}

}  // namespace graycube
