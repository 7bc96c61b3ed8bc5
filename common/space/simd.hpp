// Which of the processor's vector instructions the walk uses. It can't show in a result; choosing fewer is
// for tests, for comparisons, and for doubting a machine.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace graycube {

/// Names, narrowest first, of the instruction sets that this processor has and this build knows: of "scalar",
/// "sse4", "avx2", "avx512" and "neon".
std::vector<std::string> simd_names();

/// Uses one of simd_names() from now on; "" and "best" mean the widest. False for any other name. Not to be
/// called while rays are traced.
bool choose_simd(std::string_view name);

/// Obeys the environment variable GRAYCUBE_SIMD. Returns what is wrong with it; empty when all is well.
std::string choose_simd_from_environment();

}  // namespace graycube
