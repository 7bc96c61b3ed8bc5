// libFuzzer harness: any bytes as meshes from the program that reads foreign files.
#include "fuzz/part_stream_fuzz.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  graycube::testing::fuzz_part_stream({reinterpret_cast<const char*>(data), size});
  return 0;
}
