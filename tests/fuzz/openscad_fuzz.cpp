// libFuzzer harness: any bytes as OpenSCAD's evaluated tree.
#include "fuzz/openscad_fuzz.hpp"

#include <cstdint>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  graycube::testing::fuzz_openscad({reinterpret_cast<const char*>(data), size});
  return 0;
}
