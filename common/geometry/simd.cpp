#include "geometry/simd.hpp"

#include <hwy/targets.h>

#include <array>
#include <cstdint>
#include <cstdlib>

#if HWY_ARCH_X86
#include <cpuid.h>
#endif

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

#if HWY_ARCH_X86
// clang 14's __builtin_cpu_supports knows neither F16C nor LZCNT.
bool has_f16c() {
  unsigned a = 0, b = 0, c = 0, d = 0;
  return __get_cpuid(1, &a, &b, &c, &d) != 0 && (c & bit_F16C) != 0;
}
bool has_lzcnt() {
  unsigned a = 0, b = 0, c = 0, d = 0;
  return __get_cpuid(0x80000001, &a, &b, &c, &d) != 0 && (c & bit_LZCNT) != 0;
}
#endif

/// The compiled targets, as Highway's bits, that the processor and its operating system support.
std::int64_t available() {
  std::int64_t found = HWY_EMU128 | HWY_SCALAR;
#if HWY_ARCH_X86
  const auto has_all = [](auto... has) { return (has && ...); };
  const bool sse4 = has_all(__builtin_cpu_supports("sse4.2"), __builtin_cpu_supports("aes"),
                            __builtin_cpu_supports("pclmul"));
  const bool avx2 = sse4 && has_all(__builtin_cpu_supports("avx2"), __builtin_cpu_supports("bmi"),
                                    __builtin_cpu_supports("bmi2"), __builtin_cpu_supports("fma"),
                                    has_f16c(), has_lzcnt());
  const bool avx512 =
      avx2 && has_all(__builtin_cpu_supports("avx512f"), __builtin_cpu_supports("avx512vl"),
                      __builtin_cpu_supports("avx512dq"), __builtin_cpu_supports("avx512bw"));
  if (sse4) found |= HWY_SSE4;
  if (avx2) found |= HWY_AVX2;
  if (avx512) found |= HWY_AVX3;
#elif HWY_ARCH_ARM_A64
  found |= HWY_NEON;
#endif
  return found & HWY_TARGETS;
}

/// The index, in a table of functions, of the best of some targets.
std::size_t index_of(std::int64_t targets) {
  hwy::ChosenTarget target;
  target.Update(targets);
  return target.GetIndex();
}

std::size_t chosen_index = index_of(available());

}  // namespace

std::size_t simd_index() { return chosen_index; }

std::vector<std::string> simd_names() {
  const std::int64_t all = available();
  std::vector<std::string> names;
  for (const Named& n : kNamed) {
    if ((n.target & all) != 0) names.emplace_back(n.name);
  }
  return names;
}

bool choose_simd(std::string_view name) {
  const std::int64_t all = available();
  if (name.empty() || name == "best") {
    chosen_index = index_of(all);
    return true;
  }
  for (const Named& n : kNamed) {
    if (n.name != name || (n.target & all) == 0) continue;
    chosen_index = index_of(n.target);
    return true;
  }
  return false;
}

std::optional<std::string> choose_simd_from_environment() {
  const char* name = std::getenv("GRAYCUBE_SIMD");
  if (name == nullptr || choose_simd(name)) return std::nullopt;
  std::string message = std::string(name) + ": this machine has best";
  for (const std::string& known : simd_names()) message += ", " + known;
  return message;
}

}  // namespace graycube
