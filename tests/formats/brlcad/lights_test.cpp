// Lights, lamps and shaders as rt takes them.
#include <cmath>
#include <string>

#include "formats/brlcad/shader.hpp"
#include "formats/brlcad/view.hpp"
#include "reading.hpp"

using namespace graycube;
using namespace graycube::testing;

namespace {

const std::string kBall =
    "title t\nput s ell V {0 0 0} A {2 0 0} B {0 2 0} C {0 0 2}\n"
    "put s.r comb region yes tree {l s}\n";

/// A region that is a lamp of radius 1 at x.
std::string lamp(const std::string& name, double x, const std::string& parameters) {
  return "put " + name + ".s ell V {" + std::to_string(x) +
         " 0 30} A {1 0 0} B {0 1 0} C {0 0 1}\nput " + name + " comb region yes tree {l " + name +
         ".s}\nattr set " + name + " rgb 255/255/0 oshader {light {" + parameters + "}}\n";
}
BrlcadSurface surface(const std::string& shader) {
  BrlcadReport report;
  return brlcad_surface(shader, {255, 0, 0}, "r", report);
}

}  // namespace

TEST_CASE("without lamps a white light without shadows stands to the left of the eye") {
  BrlcadOptions options;
  options.view = "viewsize 10; eye_pt 100 0 0; viewrot 0 1 0 0 0 0 1 0 1 0 0 0 0 0 0 1;";
  const BrlcadResult result = read_brlcad(kBall, options);
  REQUIRE(result.scene);
  const auto& lights = result.scene->settings.lights;
  REQUIRE(lights.size() == 1);
  // Right is y, up is z, towards the eye is x; a unit is half of the view.
  CHECK(length(lights[0].position - Vec3{105, -5, 0}) < 1e-9);
  CHECK_FALSE(lights[0].shadows);
  CHECK(lights[0].color.r == Approx(1 / 1.2));
  CHECK(lights[0].color == Rgb{lights[0].color.r, lights[0].color.r, lights[0].color.r});
}

TEST_CASE("lamps count relative to the brightest, unless they say their part of full light") {
  const Scene scene = scene_of(kBall + lamp("a", -20, "b 1000") + lamp("b", 20, "bright 100") +
                               lamp("c", 40, "f 0.25"));
  const auto& lights = scene.settings.lights;
  REQUIRE(lights.size() == 3);
  CHECK(lights[0].color.r == Approx(1 / 1.2));
  CHECK(lights[1].color.r == Approx(0.1 / 1.2));
  CHECK(lights[2].color.r == Approx(0.25));
  CHECK(lights[0].color.b == 0);
  CHECK(length(lights[1].position - Vec3{20, 0, 30}) < 1e-12);
  CHECK(lights[0].shadows);
  // The lamps are seen, each as bright as it shines.
  REQUIRE(scene.objects.size() == 4);
  CHECK(scene.materials[scene.objects[2].material].material.ambient == Approx(0.1 / 1.2));
  CHECK(scene.materials[scene.objects[2].material].material.model == ShadingModel::kRtLamp);
}

TEST_CASE("a lamp with a part of full light dims no other, and one without lumens has 1") {
  const auto first_of = [](const std::string& parameters, const std::string& others) {
    return scene_of(kBall + lamp("a", -20, parameters) + lamp("b", 20, others))
        .settings.lights.at(0)
        .color.r;
  };
  CHECK(first_of("b 1", "b 1000 f 0.25") == Approx(1 / 1.2));
  CHECK(first_of("b 0", "b 2") == Approx(0.5 / 1.2));
  CHECK(first_of("b -5", "b 4") == Approx(0.25 / 1.2));
}

TEST_CASE("invisible lamps shine but aren't drawn, shadowless and infinite ones are so") {
  const Scene scene = scene_of(kBall + lamp("a", 0, "invisible 1") + lamp("b", 20, "v 0") +
                               lamp("c", 40, "s 0") + lamp("d", 30, "i 1"));
  CHECK(scene.objects.size() == 3);
  const auto& lights = scene.settings.lights;
  REQUIRE(lights.size() == 4);
  CHECK(length(lights[0].position - Vec3{0, 0, 30}) < 1e-12);
  CHECK(lights[1].shadows);
  CHECK_FALSE(lights[2].shadows);
  // From where it is seen from the origin, and so far off that its rays are parallel.
  const Vec3 direction = normalized(lights[3].position - Vec3{20, 0, 15});
  CHECK(length(direction - normalized(Vec3{30, 0, 30})) < 1e-3);
  CHECK(length(lights[3].position) > 1e5);
}

TEST_CASE("a lamp with an angle shines in a beam, along its first solid's -z or at a target") {
  const auto light_of = [](const std::string& parameters) {
    const BrlcadResult result = read_brlcad(kBall + lamp("a", 20, parameters));
    REQUIRE(result.scene);
    CHECK(result.warnings.empty());
    REQUIRE(result.scene->settings.lights.size() == 1);
    return result.scene->settings.lights[0];
  };
  CHECK_FALSE(light_of("b 1").has_beam());
  CHECK_FALSE(light_of("angle 200").has_beam());
  CHECK(light_of("angle -30").angle_degrees == 30);
  const PointLight down = light_of("a 30");
  CHECK(down.angle_degrees == 30);
  CHECK(down.direction == Vec3{0, 0, -1});
  // The lamp is at (20, 0, 30).
  for (const char* name : {"t", "target", "aim", "d", "dir"}) {
    INFO(name);
    CHECK(length(light_of(std::string("a 30 ") + name + " {20 5 30}").direction - Vec3{0, 1, 0}) <
          1e-12);
  }
  // rt turns a target's direction, too, where the lamp's solid is turned: here z becomes x.
  const std::string turned =
      "put l.s ell V {0 0 0} A {1 0 0} B {0 1 0} C {0 0 1}\nput inner comb region no tree {u {l "
      "l.s "
      "{0 0 1 0 0 1 0 0 -1 0 0 0 0 0 0 1}} {l l.s}}\nput l.r comb region yes shader {light {a 40}} "
      "tree {l inner}\n";
  const Scene scene = scene_of(kBall + turned);
  REQUIRE(scene.settings.lights.size() == 1);
  CHECK(length(scene.settings.lights[0].direction - Vec3{-1, 0, 0}) < 1e-12);
}

TEST_CASE(
    "lamps beyond as many as light can be counted for are drawn and don't shine, which is told") {
  std::string text = kBall;
  for (std::uint32_t i = 0; i < kMaxCreditLights + 2; ++i) {
    text += lamp("lamp" + std::to_string(i), 4.0 * i, "b 1");
  }
  const BrlcadResult result = read_brlcad(text);
  REQUIRE(result.scene);
  CHECK(result.scene->settings.lights.size() == kMaxCreditLights);
  CHECK(result.scene->objects.size() == kMaxCreditLights + 3);
  REQUIRE(result.warnings.size() == 1);
  CHECK_THAT(result.warnings[0].text, Catch::Contains("they don't shine"));
}

TEST_CASE("a stack is its last member that is known") {
  CHECK(surface("stack {plastic {di 0.5}} {bump {file x}}").material.diffuse == 0.5);
  CHECK(surface("stack {{plastic {di 0.5}} {mirror {re 0.25}}}").material.reflect == 0.25);
  CHECK(surface("stack fbm s=1;plastic di=0.5 sp=0").material.diffuse == 0.5);
  CHECK(surface("stack {light {b 2}}").is_light);
  CHECK(surface("bump file=x; plastic di=.9").material.diffuse == 0.9);
  CHECK(surface("plastic di=.9;").material.diffuse == 0.9);
  BrlcadReport report;
  brlcad_surface("stack {wood} {plastic}", {1, 2, 3}, "r", report);
  const auto warnings = report.take_warnings();
  REQUIRE(warnings.size() == 1);
  CHECK(warnings[0].text == "1 region: the shader 'wood' of a stack isn't drawn: r");
}

TEST_CASE("camo and marble are patterns, lit by what follows them in a stack") {
  const Material m = surface(
                         "stack {{camo {s 5 c1 {144 148 146} c2 {.1 .2 1} c3 255/0/0 t1 -.5 t2 "
                         ".5 o 3 l 2 H .75 d {1 2 3}}} {plastic {re .40 di .6}}}")
                         .material;
  CHECK(m.model == ShadingModel::kRt);
  CHECK(m.reflect == 0.4);
  CHECK(m.diffuse == 0.6);
  CHECK(m.pattern.kind == PatternKind::kCamouflage);
  CHECK(m.pattern.colors ==
        std::array<Rgb, 3>{{{144 / 255.0, 148 / 255.0, 146 / 255.0}, {0.1, 0.2, 1}, {1, 0, 0}}});
  CHECK(m.pattern.thresholds == std::array<double, 2>{-0.5, 0.5});
  CHECK(m.pattern.octaves == NoiseOctaves{3, 2, 0.75});
  CHECK(length(m.pattern.to_pattern.point({5, 10, 0}) - Vec3{2, 4, 3}) < 1e-12);
  // Without a size, the sizes along the axes count; 0.0125 unless they are given.
  CHECK(length(surface("camo").material.pattern.to_pattern.point({1, 0, 0}) -
               Vec3{1080, 1000, 1000}) < 1e-9);
  CHECK(length(surface("camo vs=1,2,4").material.pattern.to_pattern.point({4, 4, 4}) -
               Vec3{1004, 1002, 1001}) < 1e-9);
  // On its own, and on top of a stack, it is seen in any light.
  for (const char* unlit : {"camo s=5", "stack plastic;camo s=5"}) {
    const Material own = surface(unlit).material;
    CHECK(own.model == ShadingModel::kPhong);
    CHECK(own.ambient == 1);
    CHECK(own.diffuse == 0);
    CHECK(own.pattern.kind == PatternKind::kCamouflage);
  }
  CHECK(surface("marble c2=1,.5,0").material.pattern.colors[0] == Rgb{1, 0.5, 0});
  CHECK(surface("plastic").material.pattern == Pattern{});
}

TEST_CASE("a pattern with sizes beyond doubles isn't drawn, which is told") {
  const BrlcadResult result = read_brlcad(
      "title t\nput s ell V {0 0 0} A {1 0 0} B {0 1 0} C {0 0 1}\n"
      "put r comb region yes shader {stack {camo {s 1e-320}} {plastic}} tree {l s}\n");
  REQUIRE(result.scene);
  CHECK(result.scene->materials.at(0).material.pattern == Pattern{});
  REQUIRE(result.warnings.size() == 1);
  CHECK(result.warnings[0].text ==
        "1 region: a pattern whose sizes leave the range of doubles isn't drawn: r");
}

TEST_CASE("a pattern lies in the coordinates of its region") {
  const Scene scene = scene_of(
      "title t\nput s ell V {0 0 0} A {1 0 0} B {0 1 0} C {0 0 1}\n"
      "put r comb region yes shader {stack {camo {s 2}} {plastic}} tree {l s}\n"
      "put g comb region no tree {u {l r {1 0 0 10 0 1 0 0 0 0 1 0 0 0 0 1}} {l r}}\n");
  REQUIRE(scene.objects.size() == 2);
  REQUIRE(scene.materials.size() == 2);
  const auto at = [&](std::size_t i, const Vec3& p) {
    return scene.materials[scene.objects[i].material].material.pattern.to_pattern.point(p);
  };
  CHECK(length(at(0, {12, 0, 0}) - Vec3{1001, 1000, 1000}) < 1e-9);
  CHECK(length(at(1, {2, 0, 0}) - Vec3{1001, 1000, 1000}) < 1e-9);
}

TEST_CASE("a checker of one colour has that colour in any light") {
  for (const char* shader :
       {"checker a=0/0/150 b=0/0/150", "checker {a {0 0 150.9} b {0 0 150}}"}) {
    const Scene scene = scene_of(
        "title t\nput s ell V {0 0 0} A {1 0 0} B {0 1 0} C {0 0 1}\n"
        "put r comb region yes shader {" +
        std::string(shader) + "} tree {l s}\n");
    const Material& m = scene.materials.at(0).material;
    CHECK(m.model == ShadingModel::kPhong);
    CHECK(m.color == Rgb{0, 0, 150 / 255.0});
    CHECK(m.ambient == 1);
    CHECK(m.diffuse == 0);
    CHECK(m.pattern == Pattern{});
  }
}

TEST_CASE("a checker on a half-space has squares of 5 m about the normal through the origin") {
  const std::string text =
      "title t\nput h half N {0 0 1} d -7\nput s ell V {0 0 0} A {9 0 0} B {0 9 "
      "0} C {0 0 9}\nput r comb region yes shader {checker a=255/0/0 b=0/0/255} "
      "tree {- {l h} {l s}}\n";
  const Scene scene = scene_of(text);
  const Material& m = scene.materials.at(0).material;
  REQUIRE(m.pattern.kind == PatternKind::kChecker);
  CHECK(m.ambient == 1);
  const auto red_at = [&](double x, double y) {
    return color_at(m.pattern, m.color, {x, y, -7}).r;
  };
  CHECK(red_at(0, 0) == 1);
  CHECK(red_at(2400, -2400) == 1);
  CHECK(red_at(2600, 0) == 0);
  CHECK(red_at(0, -2600) == 0);
  CHECK(red_at(-2600, 2600) == 1);
  CHECK(red_at(7400, 0) == 0);
  CHECK(red_at(7600, 0) == 1);
}

TEST_CASE("the region of an envmap isn't drawn, which is told") {
  const BrlcadResult result = read_brlcad(
      kBall +
      "put e ell V {0 0 0} A {900 0 0} B {0 900 0} C {0 0 900}\nput e.r comb region yes "
      "shader {envmap cloud} tree {l e}\n");
  REQUIRE(result.scene);
  REQUIRE(result.scene->objects.size() == 1);
  CHECK(result.scene->objects[0].name == "s.r");
  REQUIRE(result.warnings.size() == 1);
  CHECK(result.warnings[0].text ==
        "1 region: an envmap is no background here, and isn't drawn: e.r");
}

TEST_CASE("flat is its own colour, or the region's, in any light") {
  const Material own = surface("flat {rgb {255 0 51}}").material;
  CHECK(own.color == Rgb{1, 0, 0.2});
  CHECK(own.model == ShadingModel::kPhong);
  CHECK(own.ambient == 1);
  CHECK(own.diffuse == 0);
  CHECK(surface("flat bright=.25").material.color == Rgb{0.25, 0.25, 0.25});
  CHECK(surface("flat").material.color == surface("plastic").material.color);
}

TEST_CASE("surfaces are rt's: its shines are whole numbers and its ambient light is 0.4") {
  const Material m = surface("plastic {sh 12.7 sp 0.9 di .1 re 0.02}").material;
  CHECK(m.model == ShadingModel::kRt);
  CHECK(m.shininess == 12);
  CHECK(m.specular == 0.9);
  CHECK(m.diffuse == 0.1);
  CHECK(m.reflect == 0.02);
  CHECK(m.ambient == 0.4);
}
