#include "fuzz/json_fuzz.hpp"

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
  graycube::fuzz_json({reinterpret_cast<const char*>(data), size});
  return 0;
}
