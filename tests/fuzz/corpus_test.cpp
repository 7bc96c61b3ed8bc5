// Replays the fuzzers' corpora: seeds, and every input in which a fuzzer has found a fault.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "catch.hpp"
#include "fuzz/brlcad_fuzz.hpp"
#include "fuzz/cbor_fuzz.hpp"
#include "fuzz/json_fuzz.hpp"
#include "fuzz/mesh_fuzz.hpp"
#include "fuzz/openscad_fuzz.hpp"
#include "fuzz/part_stream_fuzz.hpp"
#include "fuzz/proto_fuzz.hpp"
#include "fuzz/render_fuzz.hpp"
#include "fuzz/scene_fuzz.hpp"

using namespace graycube;

namespace {

template <class Check>
void replay(const std::string& corpus, Check check) {
  std::vector<std::filesystem::path> inputs;
  for (const auto& entry : std::filesystem::directory_iterator(GRAYCUBE_CORPORA "/" + corpus)) {
    inputs.push_back(entry.path());
  }
  REQUIRE_FALSE(inputs.empty());
  std::sort(inputs.begin(), inputs.end());
  for (const auto& path : inputs) {
    INFO(path.string());
    std::ifstream file(path, std::ios::binary);
    REQUIRE(file);
    const std::string bytes{std::istreambuf_iterator<char>(file), {}};
    check(std::string_view(bytes));
  }
}

std::span<const std::byte> as_bytes(std::string_view text) {
  return std::as_bytes(std::span(text));
}

}  // namespace

TEST_CASE("no input that was fuzzed harms the reader of BRL-CAD's databases") {
  replay("brlcad", testing::fuzz_brlcad);
}
TEST_CASE("no input that was fuzzed harms the reader of CBOR") { replay("cbor", fuzz_cbor); }
TEST_CASE("no input that was fuzzed harms the readers of mesh files") {
  replay("mesh", testing::fuzz_mesh);
}
TEST_CASE("no input that was fuzzed harms the reader of meshes from another program") {
  replay("part_stream", testing::fuzz_part_stream);
}
TEST_CASE("no input that was fuzzed harms the reader of OpenSCAD's trees") {
  replay("openscad", testing::fuzz_openscad);
}
TEST_CASE(
    "no input that was fuzzed tells the two JSON parsers apart, or harms the reader of scenes") {
  replay("scene_json", [](std::string_view text) {
    fuzz_json(text);
    fuzz_scene(text);
  });
}
TEST_CASE("no input that was fuzzed harms those who compile, slice and trace it") {
  replay("scene_json", fuzz_render);
}
TEST_CASE("no input that was fuzzed harms the decoder of batches") {
  replay("proto_batch", [](std::string_view text) { fuzz_batch(as_bytes(text)); });
}
TEST_CASE("no input that was fuzzed harms the decoder of control messages") {
  replay("proto_control", fuzz_control);
}
TEST_CASE("no input that was fuzzed harms the decoder of models") {
  std::size_t accepted = 0;
  replay("proto_model", [&](std::string_view text) { accepted += fuzz_model(as_bytes(text)); });
  // The seeds are of the version that is read, or a fuzzer would begin with nothing.
  CHECK(accepted >= 6);
}
