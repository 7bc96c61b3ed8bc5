#include "fuzz/proto_fuzz.hpp"

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
  graycube::fuzz_model(std::as_bytes(std::span(data, size)));
  return 0;
}
