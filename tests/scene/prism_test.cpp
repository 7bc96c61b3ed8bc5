// Prisms and turned polygons against the plane's own even-odd rule, and the rays that might slip
// through a seam.
#include <cmath>

#include "catch.hpp"
#include "csg/dice.hpp"
#include "csg/whole_tree.hpp"
#include "flat/pieces.hpp"
#include "formats/graycube/read_scene.hpp"
#include "formats/graycube/write_scene.hpp"
#include "formats/openscad/membership.hpp"
#include "scene/compile_scene.hpp"
#include "scene/flat_solids.hpp"

namespace graycube {
namespace {

using testing::Dice;

constexpr double kPi = 3.14159265358979323846;

/// A star-shaped outline about (x, y), which never crosses itself.
FlatLoop star(Dice& dice, double x, double y, double least, double most, int corners) {
  FlatLoop loop;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2 * kPi * i / corners, r = dice.between(least, most);
    loop.push_back({x + r * std::cos(angle), y + r * std::sin(angle)});
  }
  return loop;
}

/// A band that winds `turns` times about the origin.
FlatLoop spiral(int turns, int per_turn) {
  FlatLoop out, in;
  for (int i = 0; i <= turns * per_turn; ++i) {
    const double angle = 2 * kPi * i / per_turn, r = 1 + static_cast<double>(i) / per_turn;
    out.push_back({(r + 0.5) * std::cos(angle), (r + 0.5) * std::sin(angle)});
    in.push_back({r * std::cos(angle), r * std::sin(angle)});
  }
  out.insert(out.end(), in.rbegin(), in.rend());
  return out;
}

Scene scene_of(CsgNode node) {
  Scene scene;
  scene.settings.camera.eye = {0, 0, -30};
  scene.materials = {{"m", {}}};
  scene.objects = {{"o", 0, std::move(node)}};
  return scene;
}

void check_prism(const FlatLoops& loops, double reach, Dice& dice, int points = 4000) {
  const auto solid = prism_of(loops, -1, 2);
  REQUIRE(solid);
  for (int i = 0; i < points; ++i) {
    const FlatPoint p{dice.between(-reach, reach), dice.between(-reach, reach)};
    const double z = dice.between(-1.5, 2.5);
    INFO(p.x << ", " << p.y << ", " << z);
    REQUIRE(testing::holds(*solid, {p.x, p.y, z}) == (z >= -1 && z <= 2 && is_within(loops, p)));
  }
}

TEST_CASE("a prism holds the points above its polygon") {
  const auto seed = GENERATE(range(1, 40));
  INFO("seed " << seed);
  Dice dice(static_cast<std::uint64_t>(seed));
  const int corners = 3 + static_cast<int>(dice.below(60));
  check_prism({star(dice, 0.3, 0.1, 0.6, 3, corners)}, 4, dice);
}

TEST_CASE("a prism has holes, islands in them, and several parts") {
  Dice dice(7);
  check_prism({star(dice, 0, 0, 4, 5, 31), star(dice, 0, 0, 2.2, 3.6, 17),
               star(dice, 0, 0, 0.5, 2, 12), star(dice, 8, 0, 1, 2, 9)},
              10, dice, 20000);
}

TEST_CASE("an outline may cross itself: the rule is even-odd") {
  FlatLoop pentagram;
  for (int i = 0; i < 5; ++i)
    pentagram.push_back({std::cos(0.8 * kPi * i), std::sin(0.8 * kPi * i)});
  Dice dice(3);
  check_prism({pentagram}, 1.2, dice);
}

TEST_CASE("a spiral's pockets lie within pockets") {
  Dice dice(5);
  check_prism({spiral(4, 24)}, 7, dice);
  SECTION("too many of them are cut in two") { check_prism({spiral(60, 12)}, 64, dice, 20000); }
}

/// Crossings of each ray enter and leave in turn, as with any closed solid, and lie where the
/// polygon's sides do.
TEST_CASE("rays through a prism's corners and sides cross it in pairs") {
  const auto seed = GENERATE(range(1, 25));
  INFO("seed " << seed);
  Dice dice(static_cast<std::uint64_t>(seed));
  FlatLoop loop = star(dice, 0, 0, 1, 3, 24);
  for (FlatPoint& p : loop) p = {std::round(4 * p.x) / 4, std::round(4 * p.y) / 4};
  const auto solid = prism_of(FlatLoops{loop}, 0, 1);
  REQUIRE(solid);
  Scene scene = scene_of(*solid);
  scene.objects[0].csg.transform = rotation({1, 2, 3}, 10.0 * seed);
  const Model model = compile_scene(scene);
  const testing::WholeTrees whole(model);
  for (int i = 0; i < 300; ++i) {
    const FlatPoint &a = loop[dice.below(loop.size())], &b = loop[dice.below(loop.size())];
    const Vec3 from{a.x, a.y, dice.on_grid(1)}, to{b.x, b.y, dice.on_grid(1)};
    if (from == to) continue;
    const Affine& map = *scene.objects[0].csg.transform;
    const Vec3 direction = normalized(map.vector(to - from));
    const Ray ray{map.point(from) - 20 * direction, direction};
    const auto crossings = whole.crossings(0, ray);
    REQUIRE(crossings.size() % 2 == 0);
    for (std::size_t k = 0; k < crossings.size(); ++k) CHECK(crossings[k].entering == (k % 2 == 0));
  }
}

TEST_CASE("a turned polygon holds the points at its distances from the axis") {
  const auto seed = GENERATE(range(1, 40));
  INFO("seed " << seed);
  Dice dice(static_cast<std::uint64_t>(seed));
  FlatLoops loops{star(dice, 4, 0.5, 0.7, 3, 3 + static_cast<int>(dice.below(40)))};
  if (dice.one_in(2)) loops.push_back(star(dice, 4, 0.5, 0.2, 0.6, 9));
  SECTION("which may touch the axis, or reach beyond it") {
    for (FlatLoop& loop : loops) {
      for (FlatPoint& p : loop) p.x -= dice.one_in(2) ? 4 : 3.9;
    }
    loops = resolved(loops);
  }
  const auto solid = turned(loops);
  REQUIRE(solid);
  for (int i = 0; i < 3000; ++i) {
    const Vec3 p{dice.between(-7, 7), dice.between(-7, 7), dice.between(-3, 4)};
    const FlatPoint flat{std::sqrt(p.x * p.x + p.y * p.y), p.z};
    INFO(flat.x << ", " << flat.y);
    REQUIRE(testing::holds(*solid, p) == is_within(loops, flat));
  }
}

constexpr const char* kHead = R"({"graycube": 1, "image": {"width": 8, "height": 8},
  "camera": {"type": "perspective", "eye": [0,0,-9], "look_at": [0,0,0], "up": [0,1,0], "fov": 40},
  "lights": [], "materials": {"m": {}}, "objects": [{"material": "m", "csg": )";

ReadResult read_prism(const std::string& members) {
  return read_scene_text(kHead + ("{\"type\": \"prism\", " + members + "}}]}"));
}

TEST_CASE("a prism is read as written, and written as read") {
  const ReadResult read = read_prism(
      R"("points": [[0,0],[4,0],[4,4],[0,4],[1,1],[2,1],[2,2]], "paths": [[0,1,2,3],[4,5,6]], "height": 2, "base": -1)");
  REQUIRE(read.scene);
  const auto& prism = std::get<PrismShape>(read.scene->objects[0].csg.value);
  CHECK(prism.points.size() == 7);
  CHECK((prism.height == 2 && prism.base == -1));
  const ReadResult again = read_scene_text(write_scene_text(*read.scene));
  REQUIRE(again.scene);
  CHECK(*again.scene == *read.scene);
}

TEST_CASE("a prism's errors have their places") {
  const auto error = [](const std::string& members) {
    const ReadResult read = read_prism(members);
    REQUIRE_FALSE(read.errors.empty());
    return read.errors[0].pointer + ": " + read.errors[0].message;
  };
  const std::string at = "/objects/0/csg/";
  CHECK_THAT(error(R"("points": [[0,0],[1,0]], "height": 1)"),
             Catch::StartsWith(at + "points: expected 3 to"));
  CHECK_THAT(error(R"("points": [[0,0],[1,0],[2,0]], "height": 1)"),
             Catch::Contains("go round an area"));
  CHECK_THAT(error(R"("points": [[0,0],[1,0],[0,1,2]], "height": 1)"),
             Catch::StartsWith(at + "points/2: "));
  CHECK_THAT(error(R"("points": [[0,0],[1,0],[0,1]], "height": 0)"),
             Catch::StartsWith(at + "height: "));
  CHECK_THAT(error(R"("points": [[0,0],[1,0],[0,1]], "height": 1, "paths": [[0,1,3]])"),
             Catch::StartsWith(at + "paths/0/2: "));
  CHECK_THAT(error(R"("points": [[0,0],[1,0],[0,1]])"), Catch::Contains("height"));
}

}  // namespace
}  // namespace graycube
