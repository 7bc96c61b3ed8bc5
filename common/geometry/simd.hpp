// Chooses which of the processor's vector instructions the walk uses. That can't show in a result;
// choosing fewer is for tests, for comparisons, and for doubts about a machine.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace graycube {

/// Names, narrowest first, of the instruction sets that this processor has and this build knows: of
/// "scalar", "sse4", "avx2", "avx512" and "neon".
std::vector<std::string> simd_names();

/// Uses one of simd_names() from now on; "" and "best" mean the widest. False for any other name.
/// Not to be called while rays are traced.
bool choose_simd(std::string_view name);

/// The index of the function to call in tables made by GRAYCUBE_SIMD_TABLE.
std::size_t simd_index();

/// Obeys the environment variable GRAYCUBE_SIMD. Returns an error message if its value is wrong.
std::optional<std::string> choose_simd_from_environment();

}  // namespace graycube

/// The versions of a function that Highway compiled, and a call of the one chosen. Like HWY_EXPORT
/// and HWY_DYNAMIC_DISPATCH, but without libhwy, which measures a timer for 4 ms whenever a process
/// starts.
#define GRAYCUBE_SIMD_TABLE(function)                                            \
  constexpr decltype(&HWY_STATIC_DISPATCH(function)) k##function##Versions[] = { \
      nullptr, HWY_CHOOSE_TARGET_LIST(function), HWY_CHOOSE_FALLBACK(function)}
#define GRAYCUBE_SIMD_CALL(function) k##function##Versions[graycube::simd_index()]
