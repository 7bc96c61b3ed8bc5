// Binary databases of version 4, in the byte orders of the machines that wrote them.
#include <bit>
#include <limits>
#include <string>
#include <vector>

#include "model.hpp"
#include "reading.hpp"

using namespace graycube;
using namespace graycube::testing;

namespace {

/// Writes records of 128 bytes.
class V4Binary {
 public:
  explicit V4Binary(bool is_big) : is_big_(is_big) {
    begin('I', 1);
    text(2, "v4");
    text(8, "A model");
  }

  V4Binary& solid(int type, const std::string& name, const std::vector<float>& numbers) {
    begin('S', static_cast<char>(type));
    text(2, name);
    singles(20, numbers);
    return *this;
  }
  V4Binary& region(const std::string& name, int air = 0) {
    begin('C', 'R');
    text(2, name);
    small(18, 1000);
    small(20, air);
    const std::string rgb("\x01\xff\x80\x00", 4);
    text(30, rgb);
    text(34, "plastic");
    text(66, "di 0.5");
    return *this;
  }
  V4Binary& member(char relation, const std::string& name, float x = 0) {
    begin('M', relation);
    text(18, name);
    singles(36, {1, 0, 0, x, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1});
    return *this;
  }
  V4Binary& particle(const std::string& name, const std::vector<double>& numbers) {
    begin('p', 0);
    text(2, name);
    text(18, V5Binary::doubles(numbers));
    return *this;
  }
  /// A record whose data are in `more` records behind it; `counts` follow the name.
  V4Binary& with_data(char id, const std::string& name, const std::string& counts,
                      std::size_t data_at, const std::string& data) {
    begin(id, 0);
    text(2, name);
    text(18, counts);
    const std::size_t record = bytes_.size() - 128;
    bytes_.resize(record + (data_at + data.size() + 127) / 128 * 128);
    bytes_.replace(record + data_at, data.size(), data);
    return *this;
  }
  V4Binary& curve(int number, int part, const std::vector<float>& points) {
    begin('B', 0);
    small(2, number);
    small(4, part);
    singles(8, points);
    return *this;
  }
  V4Binary& ars(const std::string& name, int curves, int points) {
    begin('A', 0);
    text(2, name);
    small(18, curves);
    small(20, points);
    return *this;
  }
  V4Binary& color(int low, int high, const std::string& rgb) {
    begin('m', 0);
    small(2, low);
    small(4, high);
    text(6, rgb);
    return *this;
  }
  const std::string& bytes() const { return bytes_; }

 private:
  void begin(char id, char second) {
    bytes_ += id;
    bytes_ += second;
    bytes_.append(126, '\0');
  }
  void text(std::size_t at, const std::string& words) {
    bytes_.replace(bytes_.size() - 128 + at, words.size(), words);
  }
  void number(std::size_t at, std::uint64_t bits, unsigned width) {
    std::string digits = V5Binary::big(bits, width);
    if (!is_big_) digits.assign(digits.rbegin(), digits.rend());
    text(at, digits);
  }
  void small(std::size_t at, int v) { number(at, static_cast<std::uint16_t>(v), 2); }
  void singles(std::size_t at, const std::vector<float>& numbers) {
    for (std::size_t i = 0; i < numbers.size(); ++i)
      number(at + 4 * i, std::bit_cast<std::uint32_t>(numbers[i]), 4);
  }

  bool is_big_;
  std::string bytes_;
};

}  // namespace

TEST_CASE("a binary database of version 4 is the scene that its text is, in either byte order") {
  std::string text = kV4Head + v4_sphere("s", 0, 0, 0, 2) + v4_box("b", 0, 0, 0, 9, 9, 9) +
                     "C Y r 1000 0 0 0 0 0 1 255 128 0 1 1 0\nplastic\ndi 0.5\n" +
                     v4_member('u', "b") + v4_member('-', "s") +
                     v4_member('u', "s", {1, 0, 0, 5, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}) +
                     v4_region("air", 3) + v4_member('u', "s") + "m 0 5 6 1 2 3\n";
  for (const bool is_big : {false, true}) {
    V4Binary g(is_big);
    g.solid(19, "s", {0, 0, 0, 2, 0, 0, 0, 2, 0, 0, 0, 2});
    g.solid(20, "b", {0, 0, 0, 9, 0, 0, 9, 9, 0, 0, 9, 0, 0, 0, 9, 9, 0, 9, 9, 9, 9, 0, 9, 9});
    g.region("r").member('u', "b").member('-', "s").member('u', "s", 5);
    g.region("air", 3).member('u', "s").color(5, 6, "\x01\x02\x03");
    CHECK(scene_of(g.bytes()) == scene_of(text));
  }
}

TEST_CASE("records of version 4 that go on in others are read whole") {
  V4Binary g(true);
  g.particle("p", {0, 0, 0, 0, 0, 9, 2, 1});
  // Eight planes of an octahedron at distance 1 from the origin.
  std::vector<double> planes;
  for (int i = 0; i < 8; ++i) {
    for (int axis = 0; axis < 3; ++axis) planes.push_back((i >> axis & 1) != 0 ? 1 : -1);
    planes.push_back(2);
  }
  g.with_data('n', "n", V5Binary::big(8, 4) + V5Binary::big(2, 4), 128, V5Binary::doubles(planes));
  // Position, bend, inner and outer diameter.
  g.with_data('w', "w", V5Binary::big(2, 4) + V5Binary::big(0, 4), 26,
              V5Binary::doubles({20, 0, 0, 0, 0, 2, 30, 0, 0, 0, 0, 2}));
  std::string faces;
  for (const unsigned i : {0u, 2u, 1u, 0u, 1u, 3u, 0u, 3u, 2u, 1u, 2u, 3u})
    faces += V5Binary::big(i, 4);
  const std::string mesh = V5Binary::doubles({40, 0, 0, 44, 0, 0, 40, 4, 0, 40, 0, 4}) + faces;
  g.with_data('t', "t",
              V5Binary::big(1, 4) + std::string("\x02\x02\x00", 3) + V5Binary::big(4, 4) +
                  V5Binary::big(4, 4),
              33, mesh);
  g.ars("a", 3, 3);
  g.curve(1, 1, {60, 0, 0, 0, 0, 0, 0, 0, 0});
  g.curve(2, 1, {4, 0, 2, 0, 4, 2, -4, -4, 2});
  g.curve(3, 1, {0, 0, 4, 0, 0, 4, 0, 0, 4});
  const Scene scene = scene_of(g.bytes());
  CHECK(scene.objects.size() == 5);
  CHECK(holds(scene, 0, 0, 9.9));
  CHECK(holds(scene, 0.5, 0.5, -0.9));
  CHECK(holds(scene, 25, 0.9, 0));
  CHECK_FALSE(holds(scene, 25, 1.1, 0));
  CHECK(holds(scene, 41, 1, 1));
  CHECK(holds(scene, 60, 0, 1));
}

TEST_CASE("a database of version 4 that is cut short says so, and takes no memory on its word") {
  CHECK(error_of(std::string("I\x01v4\0\0\0\0", 8)).find("version 4") != std::string::npos);
  V4Binary g(true);
  g.with_data('n', "n", V5Binary::big(0xFFFFFFFF, 4) + V5Binary::big(2, 4), 128,
              std::string(256, '\1'));
  CHECK(error_of(g.bytes()).find("n: an arbn wants") != std::string::npos);
  V4Binary w(true);
  w.with_data('w', "w", V5Binary::big(2, 4) + V5Binary::big(0xFFFFFFFF, 4), 26, "");
  CHECK(error_of(w.bytes()).find("w: it has no END_PIPE") != std::string::npos);
}

TEST_CASE("a solid that can't be read leaves out its region only, in a binary of version 4") {
  V4Binary g(true);
  const float none = std::numeric_limits<float>::quiet_NaN();
  g.solid(19, "b", {0, 0, 0, 2, 0, 0, 0, 2, 0, 0, 0, 2});
  g.solid(19, "s", {0, 0, 0, 2, 0, 0, 0, none, 0, 0, 0, 2});
  g.with_data('t', "t",
              V5Binary::big(0, 4) + std::string("\x02\x02\x00", 3) + V5Binary::big(9, 4) +
                  V5Binary::big(4, 4),
              33, "");
  g.region("bad1").member('u', "b").member('u', "s");
  g.region("bad2").member('u', "b").member('u', "t");
  g.region("good").member('u', "b");
  const BrlcadResult result = read_brlcad(g.bytes());
  REQUIRE(result.scene);
  REQUIRE(result.scene->objects.size() == 1);
  CHECK(result.scene->objects[0].name == "good");
  REQUIRE(result.warnings.size() == 1);
  CHECK(result.warnings[0].text.find("2 regions are left out (an object can't be read; bad1:") ==
        0);
  CHECK(result.warnings[0].leaves_out);
}
