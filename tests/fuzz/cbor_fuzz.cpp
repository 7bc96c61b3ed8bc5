// libFuzzer harness: any bytes as a scene in CBOR.
#include "fuzz/cbor_fuzz.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  graycube::fuzz_cbor({reinterpret_cast<const char*>(data), size});
  return 0;
}
