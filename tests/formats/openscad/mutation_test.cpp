// Hostile input: whatever happens to a file, reading it ends with a scene or with errors.
#include <random>

#include "catch.hpp"
#include "formats/graycube/read_scene.hpp"
#include "formats/graycube/write_scene.hpp"
#include "formats/openscad/fixture.hpp"
#include "formats/openscad/openscad.hpp"
#include "formats/openscad/reading.hpp"
#include "fuzz/openscad_fuzz.hpp"

namespace graycube {
namespace {

using Random = std::mt19937;

std::size_t below(Random& random, std::size_t count) {
  return static_cast<std::size_t>(random() % count);
}

/// Changes a digit or any byte, drops a piece, copies a piece elsewhere, or inserts a token.
void mutate(std::string& text, Random& random) {
  static const std::vector<std::string> tokens{"(",
                                               ")",
                                               "{",
                                               "}",
                                               "[",
                                               "]",
                                               ",",
                                               ";",
                                               "=",
                                               "-",
                                               "%",
                                               "!",
                                               "*",
                                               "\"",
                                               "/*",
                                               "//",
                                               "inf",
                                               "nan",
                                               "undef",
                                               "0",
                                               "1e300",
                                               "1e-300",
                                               "-1",
                                               "1e30",
                                               "difference() {",
                                               "intersection() {",
                                               "polyhedron(",
                                               "multmatrix(",
                                               "color(",
                                               "$fn = 3, ",
                                               "linear_extrude(height = 2, twist = 30) ",
                                               "rotate_extrude(angle = 90) ",
                                               "hull() ",
                                               "offset(r = -1) ",
                                               "circle(r = 2);",
                                               "multmatrix([[1, 0, 0, 9]]) ",
                                               "\n"};
  const std::size_t at = below(random, text.size() + 1);
  const std::size_t piece = below(random, 60);
  switch (random() % 5) {
    case 0:
      if (at < text.size()) text[at] = static_cast<char>(random() % 256);
      break;
    case 1: text.erase(at, piece); break;
    case 2: text.insert(below(random, text.size() + 1), text.substr(at, piece)); break;
    case 3: {
      const std::size_t digit = text.find_first_of("0123456789", at);
      if (digit != std::string::npos) text[digit] = static_cast<char>('0' + random() % 10);
      break;
    }
    default: text.insert(at, tokens[below(random, tokens.size())]); break;
  }
}

/// Whether the result keeps the promise of OpenscadResult; the scene file's reader checks the rules
/// on which the renderer relies.
bool is_sound(const OpenscadResult& result) {
  if (result.scene.has_value() != result.errors.empty()) return false;
  if (result.errors.size() > kMaxOpenscadErrors + 1) return false;
  if (result.warnings.size() > kMaxOpenscadWarnings + 1) return false;
  if (!result.scene) return true;
  return read_scene_text(write_scene_text(*result.scene)).errors.empty();
}

/// Every kind of syntax in little text, so that mutations meet each often.
constexpr const char* kShortFile = R"(color([0.1, 0.2, 0.3, 0.4]) {
	difference() {
		polyhedron(points = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]],
			faces = [[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2]], convexity = 1);
%		sphere($fn = 5, $fa = 12, $fs = 2, r = 2);
#		multmatrix([[1, 0, 0, 1], [0, 1, 0, 2], [0, 0, 1, 3], [0, 0, 0, 1]]) {
			cylinder($fn = 7, $fa = 12, $fs = 2, h = 3, r1 = 2, r2 = 0, center = true);
		}
	}
}
intersection() {
	cube(size = [1, 2, 3], center = false);
	sphere(r = -inf);
}
*text(text = "a "b" c", size = 10);
)";

TEST_CASE("thousands of damaged files are read without harm, and both ends occur") {
  const std::string long_file = testing::fixture("every_module.csg");
  int accepted = 0, refused = 0;
  for (std::uint32_t seed = 1; seed <= 4000; ++seed) {
    Random random(seed);
    std::string text = seed % 20 == 0 ? long_file : kShortFile;
    const std::size_t mutations = 1 + below(random, 4);
    for (std::size_t i = 0; i < mutations; ++i) mutate(text, random);
    const OpenscadResult result = read_openscad_csg(text);
    if (!is_sound(result)) FAIL("seed " << seed << ":\n" << text);
    ++(result.scene ? accepted : refused);
  }
  CHECK(accepted > 200);
  CHECK(refused > 400);
}

/// Flat shapes and operations on them.
constexpr const char* kFlatFile =
    R"(linear_extrude(height = 3, center = true, twist = 0, scale = [1, 1]) {
	difference() {
		square(size = [4, 3], center = true);
		multmatrix([[1, 0, 0, 1], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]) { circle($fn = 0, r = 1); }
		polygon(points = [[0, 0], [2, 0], [0, 2], [1, 1]], paths = [[0, 1, 2], [3, 1, 0]]);
	}
}
rotate_extrude(angle = 270, $fn = 0) {
	intersection() {
		multmatrix([[1, 0, 0, 5], [0, 2, 0, 0]]) circle(r = 2, $fn = 0);
		offset(delta = 1, chamfer = true) { square(size = 6); }
	}
}
hull() { sphere(r = 1, $fn = 6); cube(size = [1, 2, 3]); }
linear_extrude(height = 2, twist = 45, slices = 3, scale = [0.5, 2]) offset(r = 0.5) { text(text = "a"); square(2); }
projection() { cube(1); }
)";

TEST_CASE("thousands of damaged files of flat shapes are read without harm, and both ends occur") {
  int accepted = 0, refused = 0;
  for (std::uint32_t seed = 1; seed <= 2000; ++seed) {
    Random random(seed);
    std::string text = kFlatFile;
    const std::size_t mutations = below(random, 5);
    for (std::size_t i = 0; i < mutations; ++i) mutate(text, random);
    INFO("seed " << seed << ":\n" << text);
    ++(testing::fuzz_openscad(text) ? accepted : refused);
  }
  CHECK(accepted > 200);
  CHECK(refused > 200);
}

TEST_CASE("every beginning of a file is read without harm") {
  const std::string_view text = kShortFile;
  for (std::size_t size = 0; size <= text.size(); ++size) {
    INFO("size " << size);
    REQUIRE(is_sound(read_openscad_csg(text.substr(0, size))));
  }
}

TEST_CASE("noise is read without harm") {
  for (std::uint32_t seed = 1; seed <= 300; ++seed) {
    INFO("seed " << seed);
    Random random(seed);
    std::string text(below(random, 2000), ' ');
    for (char& c : text) c = static_cast<char>(random() % 256);
    REQUIRE(is_sound(read_openscad_csg(text)));
  }
}

}  // namespace
}  // namespace graycube
