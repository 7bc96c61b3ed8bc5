// libFuzzer harness: any bytes as a scene that is compiled, sliced and traced.
#include "fuzz/render_fuzz.hpp"

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
  graycube::fuzz_render({reinterpret_cast<const char*>(data), size});
  return 0;
}
