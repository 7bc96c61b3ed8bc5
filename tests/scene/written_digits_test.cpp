#include "written_digits.hpp"

#include <charconv>
#include <cmath>
#include <random>
#include <string>

#include "catch.hpp"
#include "formats/mesh/off.hpp"
#include "formats/openscad/reading.hpp"
#include "mesh/samples.hpp"

namespace graycube {
namespace {

using namespace graycube::testing;

std::uint32_t digits_of(const std::string& number) {
  WrittenDigits digits;
  digits.see(number, std::strtod(number.c_str(), nullptr));
  return digits.most();
}

std::string written(double value, std::chars_format format, int precision) {
  char text[64];
  return {text, std::to_chars(text, text + sizeof text, value, format, precision).ptr};
}

/// A tetrahedron with one corner at (x, 0, 0).
std::string off_of(const std::string& x) {
  return "OFF 4 4 0\n0 0 0\n" + x + " 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";
}
std::uint32_t off_digits(const std::string& x) {
  const auto read = read_off(off_of(x));
  REQUIRE(std::holds_alternative<PolygonMesh>(read));
  return std::get<PolygonMesh>(read).digits;
}

TEST_CASE("significant digits go from the first that isn't 0 to the last") {
  CHECK(significant_digits("3.33333") == 6);
  CHECK(significant_digits("-0.00333333") == 6);
  CHECK(significant_digits("3.3333333333333335") == 17);
  CHECK(significant_digits("1.500000e+01") == 7);
  CHECK(significant_digits("123456e-7") == 6);
  CHECK(significant_digits("100.000000") == 9);
  CHECK(significant_digits("1200000") == 2);
  CHECK(significant_digits("1020") == 3);
  CHECK(significant_digits("0.000") == 0);
  CHECK(significant_digits("nan") == 0);
  CHECK(significant_digits("") == 0);
  CHECK(significant_digits("0.1234567890123456789012345") == 17);
}

TEST_CASE("numbers of few digits are taken for exact, up to six") {
  CHECK(digits_of("10") == 6);
  CHECK(digits_of("0.5") == 6);
  CHECK(digits_of("9.1234567") == 8);
}

TEST_CASE("a number of 24 bits has seven digits, however many are written") {
  std::mt19937_64 random(19);
  for (int i = 0; i < 1000; ++i) {
    const auto single = static_cast<float>(std::ldexp(static_cast<double>(random() >> 11), -40));
    INFO("i " << i << ", " << single);
    for (const int precision : {7, 8, 9, 12}) {
      CHECK(digits_of(written(single, std::chars_format::scientific, precision)) == 7);
    }
  }
  CHECK(digits_of("3.3333333333333335") == 17);
  CHECK(digits_of("33.3333333333") == 12);
}

TEST_CASE("a mesh file has the digits of its longest number, a binary one seven") {
  CHECK(off_digits("1") == 6);
  CHECK(off_digits("3.33333") == 6);
  CHECK(off_digits("3.33333333333") == 12);
  CHECK(off_digits("3.3333333333333335") == 17);
  CHECK(off_digits(written(static_cast<double>(1.0f / 3), std::chars_format::general, 9)) == 7);
}

TEST_CASE("a scene from OpenSCAD has six digits, and so have its meshes from OpenSCAD") {
  struct Program : OpenscadProgram {
    Result evaluate(const std::string&, Format) override {
      return {off_of("3.3333333333333335"), {}};
    }
  } program;
  OpenscadOptions options;
  options.program = &program;
  const Scene scene = scene_of(
      "resize(newsize = [3, 0, 0], auto = [0, 0, 0]) { cube(size = [1, 1, 1]); }", options);
  CHECK(scene.digits == 6);
  CHECK(std::get<MeshShape>(scene.objects.at(0).csg.value).digits == 6);
}

}  // namespace
}  // namespace graycube
