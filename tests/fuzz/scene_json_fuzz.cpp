// libFuzzer harness: any bytes as JSON, and as a scene.
#include "fuzz/json_fuzz.hpp"
#include "fuzz/scene_fuzz.hpp"

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  graycube::fuzz_json(text);
  graycube::fuzz_scene(text);
  return 0;
}
