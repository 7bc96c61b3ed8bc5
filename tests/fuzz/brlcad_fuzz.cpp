// libFuzzer harness: any bytes as a BRL-CAD database, and as a view of a model.
#include "fuzz/brlcad_fuzz.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  graycube::testing::fuzz_brlcad({reinterpret_cast<const char*>(data), size});
  return 0;
}
