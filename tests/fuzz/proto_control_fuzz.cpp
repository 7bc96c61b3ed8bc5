#include "fuzz/proto_fuzz.hpp"

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
  graycube::fuzz_control({reinterpret_cast<const char*>(data), size});
  return 0;
}
