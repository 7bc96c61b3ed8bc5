// Scenes in CBOR mean what they mean in JSON, and other values are refused with their place.
#include <nlohmann/json.hpp>
#include <random>

#include "catch.hpp"
#include "formats/graycube/random_scene.hpp"
#include "formats/graycube/write_scene.hpp"
#include "fuzz/cbor_fuzz.hpp"

namespace graycube {
namespace {

using namespace std::string_literals;

std::string cbor_of_text(const std::string& json) {
  return cbor_of(JsonTree(std::string_view(json)));
}

std::string refusal(const std::string& behind_magic) {
  const std::string bytes = std::string(kCborMagic) + behind_magic;
  const JsonTree tree{std::string_view(bytes)};
  return tree.syntax_error() ? tree.syntax_error()->message : "accepted";
}

TEST_CASE("a scene is the same from CBOR as from JSON") {
  const auto seed = GENERATE(range(1, 60));
  INFO("seed " << seed);
  const std::string json =
      write_scene_text(testing::RandomScene(static_cast<std::uint64_t>(seed)).make());
  const std::string cbor = cbor_of_text(json);
  CHECK(cbor.size() < json.size());
  check_same_meaning(JsonTree(std::string_view(json)), JsonTree(std::string_view(cbor)));
  CHECK(JsonTree(std::string_view(cbor)).was_read_fast());
  const ReadResult a = read_scene_text(json), b = read_scene_text(cbor);
  REQUIRE(a.scene.has_value() == b.scene.has_value());
  if (a.scene) CHECK(*a.scene == *b.scene);
  CHECK(b.was_read_in_pieces == b.scene.has_value());
}

TEST_CASE("numbers take their shortest exact form") {
  const auto bytes = [](const std::string& number) {
    return cbor_of_text("[" + number + "]").size() - kCborMagic.size() - 1;
  };
  CHECK(bytes("0") == 1);
  CHECK(bytes("23") == 1);
  CHECK(bytes("24") == 2);
  CHECK(bytes("-1") == 1);
  CHECK(bytes("65536") == 5);
  CHECK(bytes("0.5") == 5);
  CHECK(bytes("0.1") == 9);
  CHECK(bytes("-0.0") == 5);
  CHECK(bytes("1e300") == 9);
}

TEST_CASE("a scene's errors have the same pointers and words in CBOR") {
  const std::string json = R"({"graycube": 1, "image": {"width": 0, "height": 8}, "lights": [],
    "camera": {"type": "perspective", "eye": [0,0,0], "look_at": [0,0,0], "up": [0,1,0], "fov": 400.5},
    "matrials": {}, "objects": [{"csg": {"type": "sphere", "center": [1,2], "radius": -1}}]})";
  const auto a = read_scene_text(json).errors, b = read_scene_text(cbor_of_text(json)).errors;
  REQUIRE(a.size() == b.size());
  REQUIRE(a.size() >= 5);
  for (std::size_t i = 0; i < a.size(); ++i) {
    CHECK(a[i].pointer == b[i].pointer);
    CHECK(a[i].message == b[i].message);
    CHECK(b[i].line == 0);
  }
}

TEST_CASE("objects that come before what they use are read from the whole tree") {
  const std::string json = R"({"graycube": 1, "image": {"width": 8, "height": 8}, "lights": [],
    "camera": {"type": "perspective", "eye": [0,0,0], "look_at": [0,0,1], "up": [0,1,0], "fov": 40},
    "objects": [{"material": "m", "csg": {"type": "sphere", "center": [1,2,3], "radius": 1}}], "materials": {"m": {}}})";
  const ReadResult read = read_scene_text(cbor_of_text(json));
  REQUIRE(read.scene);
  CHECK_FALSE(read.was_read_in_pieces);
  CHECK(*read.scene == *read_scene_text(json).scene);
}

TEST_CASE("a list of objects that claims more than it holds takes no memory for them") {
  std::string cbor = cbor_of_text(R"({"graycube": 1, "objects": []})");
  REQUIRE(cbor.back() == '\x80');
  cbor.back() = '\x9A';
  const auto errors = read_scene_text(cbor + "\x00\xFF\xFF\xFF"s).errors;
  REQUIRE(errors.size() == 1);
  CHECK(errors[0].message.find("byte ") == 0);
}

TEST_CASE("what JSON doesn't have is refused") {
  CHECK(refusal("\xA0") == "accepted");
  CHECK_THAT(refusal("\x81\x42xy"), Catch::Contains("byte strings"));
  CHECK_THAT(refusal("\x81\xC1\x01"), Catch::Contains("0xC1"));
  CHECK_THAT(refusal("\x81\xD9\xD9\xF7\x01"), Catch::Contains("0xD9"));
  CHECK_THAT(refusal("\x81\xF9\x7C\x00"s), Catch::Contains("finite"));
  CHECK_THAT(refusal("\x81\xF7"), Catch::Contains("0xF7"));
  CHECK_THAT(refusal("\xA1\x01\x01"), Catch::Contains("string"));
  CHECK_THAT(refusal(""), Catch::Contains("end"));
  CHECK_THAT(refusal("\x82\x01"), Catch::Contains("end"));
  CHECK_THAT(refusal("\x80\x80"), Catch::Contains("expected end of input"));
  CHECK_THAT(refusal("\x9B\x7F\xFF\xFF\xFF\xFF\xFF\xFF\xFF\x01"), Catch::Contains("end"));
  CHECK_THAT(refusal("\x7B\x7F\xFF\xFF\xFF\xFF\xFF\xFF\xFFxx"), Catch::Contains("end"));
  CHECK_THAT(refusal(std::string(2000, '\x81')), Catch::Contains("nest deeper than"));
  CHECK_THAT(refusal("\x7A\x00\x01\x00\x00"s + std::string(65536, 'a')),
             Catch::Contains("longer than"));
}

TEST_CASE("a key twice is an error of the reader's, as in JSON") {
  const std::string twice = "\xD9\xD9\xF7\xA2\x68graycube\x01\x68graycube\x01";
  const auto errors = read_scene_text(twice).errors;
  REQUIRE_FALSE(errors.empty());
  CHECK(std::any_of(errors.begin(), errors.end(), [](const SceneError& e) {
    return e.message.find("uplicate") != std::string::npos;
  }));
}

TEST_CASE("strings in chunks and containers without a length are read") {
  const std::string bytes = "\xD9\xD9\xF7\xBF\x7F\x61g\x61h\xFF\x9F\x01\xF5\xF6\xFF\xFF";
  const JsonTree tree{std::string_view(bytes)};
  REQUIRE_FALSE(tree.syntax_error());
  CHECK_FALSE(tree.was_read_fast());
  CHECK(tree.key(1) == "gh");
  CHECK(tree.size(1) == 3);
  CHECK(tree.describe(1) == "an array of 3");
}

TEST_CASE("whatever happens to a scene in CBOR, it is read or refused") {
  int accepted = 0;
  for (unsigned seed = 1; seed <= 3000; ++seed) {
    std::mt19937 random(seed);
    std::string bytes = cbor_of_text(write_scene_text(testing::RandomScene(seed % 40).make()))
                            .substr(kCborMagic.size());
    for (unsigned n = static_cast<unsigned>(random() % 4); n > 0 && !bytes.empty(); --n) {
      const auto at = static_cast<std::size_t>(random()) % bytes.size();
      switch (random() % 4) {
        case 0: bytes[at] = static_cast<char>(random()); break;
        case 1: bytes.erase(at, random() % 9); break;
        case 2:
          bytes.insert(
              at, bytes.substr(static_cast<std::size_t>(random()) % bytes.size(), random() % 60));
          break;
        default: bytes[at] = static_cast<char>((random() % 8) << 5 | 24 | (random() % 8)); break;
      }
    }
    INFO("seed " << seed);
    const bool taken = fuzz_cbor(bytes);
    accepted += taken ? 1 : 0;
    // Whichever reader read it, nlohmann's own documents are the judge.
    if (taken) CHECK_FALSE(nlohmann::json::from_cbor(bytes, true, false).is_discarded());
  }
  CHECK((accepted > 600 && accepted < 2900));
}

}  // namespace
}  // namespace graycube
