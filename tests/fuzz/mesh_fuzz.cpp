// libFuzzer harness: any bytes as a mesh file, STL and OFF.
#include "fuzz/mesh_fuzz.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  graycube::testing::fuzz_mesh({reinterpret_cast<const char*>(data), size});
  return 0;
}
