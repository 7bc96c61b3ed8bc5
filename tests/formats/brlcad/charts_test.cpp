// Shaders that follow a solid's own u and v. The right values are worked out by hand from librt's
// rt_*_uv functions.
#include <cmath>
#include <string>

#include "formats/brlcad/shader.hpp"
#include "formats/brlcad/solids.hpp"
#include "reading.hpp"

using namespace graycube;
using namespace graycube::testing;

namespace {

std::string region(const std::string& solids, const std::string& tree,
                   const std::string& shader = "testmap") {
  return "title t\n" + solids + "put r comb region yes shader {" + shader + "} tree {" + tree +
         "}\n";
}

const Material& material_of(const Scene& scene, const CsgNode& node) {
  REQUIRE(node.material != kInheritMaterial);
  return scene.materials.at(node.material).material;
}

/// (u, v, 0) at a point of the only leaf of a scene.
Vec3 uv_at(const Scene& scene, const Vec3& p) {
  const Material& m = material_of(scene, scene.objects.at(0).csg);
  CHECK(m.ambient == 1);
  CHECK(m.diffuse == 0);
  const Rgb c = color_at(m.pattern, m.color, p);
  CHECK(c.g == 0);
  return {c.r, c.b, 0};
}

/// A solid that testmap colours: red is u, blue is v.
Scene mapped(const std::string& solid) { return scene_of(region("put s " + solid + "\n", "l s")); }
bool is_near(const Vec3& a, const Vec3& b) { return length(a - b) < 1e-9; }

constexpr const char* kBox =
    "arb8 V1 {4 0 0} V2 {4 2 0} V3 {4 2 3} V4 {4 0 3} V5 {0 0 0} V6 {0 2 0} V7 {0 2 3} V8 {0 0 3}";

}  // namespace

TEST_CASE("ell counts u from A and v along C, turned with its matrix") {
  const Scene ball = mapped("ell V {1 0 0} A {2 0 0} B {0 2 0} C {0 0 2}");
  CHECK(is_near(uv_at(ball, {1, 2, 0}), {0.25, 0.5, 0}));
  CHECK(is_near(uv_at(ball, {1, 0, -2}), {0, 0, 0}));
  CHECK(is_near(uv_at(mapped("ell V {0 0 0} A {0 9 0} B {0 0 4} C {3 0 0}"), {0, 0, 4}),
                {0.25, 0.5, 0}));
  // A quarter turn about z, and 10 along x.
  const Scene turned = scene_of(region("put s ell V {1 0 0} A {2 0 0} B {0 2 0} C {0 0 2}\n",
                                       "l s {0 -1 0 10 1 0 0 0 0 0 1 0 0 0 0 1}"));
  CHECK(is_near(uv_at(turned, {8, 1, 0}), {0.25, 0.5, 0}));
}

TEST_CASE("tgc counts u from behind A, a right cylinder from B") {
  const Scene cone = mapped("tgc V {0 0 0} H {0 0 4} A {2 0 0} B {0 2 0} C {1 0 0} D {0 1 0}");
  CHECK(is_near(uv_at(cone, {1.5, 0, 2}), {0.5, 0.5, 0}));
  CHECK(is_near(uv_at(cone, {0, 1.75, 1}), {0.75, 0.25, 0}));
  CHECK(is_near(uv_at(cone, {0.5, 0, 4}), {0.5, 0.5, 0}));
  CHECK(is_near(uv_at(cone, {0.5, 0, 0}), {0.5, 0.75, 0}));
  const Scene rec = mapped("tgc V {0 0 0} H {0 0 4} A {2 0 0} B {0 1 0} C {2 0 0} D {0 1 0}");
  CHECK(is_near(uv_at(rec, {0, 1, 1}), {0, 0.25, 0}));
  CHECK(is_near(uv_at(rec, {2, 0, 3}), {0.25, 0.75, 0}));
  CHECK(is_near(uv_at(rec, {-1, 0, 4}), {0.75, 0.5, 0}));
  CHECK(is_near(uv_at(rec, {-0.5, 0, 0}), {0.75, 0.75, 0}));
  // An end without extent is always the top.
  const Scene turned = mapped("tgc V {0 0 4} H {0 0 -4} A {0 0 0} B {0 0 0} C {2 0 0} D {0 2 0}");
  CHECK(is_near(uv_at(turned, {0, 1, 2}), {0.75, 0.5, 0}));
}

TEST_CASE("tor and eto count from libbn's vector across their axis") {
  // Across z that is -y.
  const Scene tor = mapped("tor V {0 0 5} H {0 0 1} r_a 4 r_h 1");
  CHECK(is_near(uv_at(tor, {0, -5, 5}), {0.5, 0.5, 0}));
  CHECK(is_near(uv_at(tor, {4, 0, 6}), {0.75, 0.75, 0}));
  CHECK(is_near(uv_at(tor, {-4, 0, 4}), {0.25, 0.25, 0}));
  // Across an axis that is least along z it is (-y, x).
  CHECK(
      is_near(uv_at(mapped("tor V {0 0 0} H {0.6 0.8 0} r_a 4 r_h 1"), {-4, 3, 0}), {0.5, 0.5, 0}));
  // A mirrored one is the same: rt's vectors are those of the world.
  const Scene mirrored = scene_of(region("put s tor V {0 0 5} H {0 0 1} r_a 4 r_h 1\n",
                                         "l s {-1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1}"));
  CHECK(is_near(uv_at(mirrored, {4, 0, 6}), {0.75, 0.75, 0}));
  const Scene eto = mapped("eto V {0 0 0} N {0 0 2} C {1 0 0} r 4 r_d 1");
  CHECK(is_near(uv_at(eto, {5, 0, 0}), {0.5, 0.25, 0}));
  CHECK(is_near(uv_at(eto, {4, 0, 1}), {0.25, 0.25, 0}));
  CHECK(is_near(uv_at(eto, {0, -4, -1}), {0.75, 0, 0}));
}

TEST_CASE("each face of an arb has its own u and v, along its first edge and across it") {
  const Scene box = mapped(kBox);
  CHECK(is_near(uv_at(box, {4, 0.5, 0.75}), {0.25, 0.25, 0}));
  CHECK(is_near(uv_at(box, {0, 0.5, 0.75}), {0.25, 0.75, 0}));
  CHECK(is_near(uv_at(box, {1, 0, 0.75}), {0.25, 0.75, 0}));
  CHECK(is_near(uv_at(box, {1, 2, 0.75}), {0.75, 0.25, 0}));
  CHECK(is_near(uv_at(box, {1, 0.5, 0}), {0.75, 0.25, 0}));
  CHECK(is_near(uv_at(box, {1, 0.5, 3}), {0.25, 0.75, 0}));
  // A wedge: u of its slope is 5 long, and that of its face of three corners lies along it, too.
  const Scene wedge = mapped(
      "arb8 V1 {0 0 0} V2 {4 0 0} V3 {4 2 0} V4 {0 2 0} V5 {0 0 3} V6 {0 0 3} V7 {0 2 3} V8 {0 2 "
      "3}");
  CHECK(is_near(uv_at(wedge, {2, 0.5, 1.5}), {0.5, 0.25, 0}));
  CHECK(is_near(uv_at(wedge, {1, 0, 0.75}), {0.57, 0.5, 0}));
}

TEST_CASE("u and v of an arb's face reach over all of its corners") {
  // The fourth corner lies before the first.
  const Scene wide = mapped(
      "arb8 V1 {4 -1 0} V2 {4 2 0} V3 {4 2 3} V4 {4 0 3} V5 {0 -1 0} V6 {0 2 0} V7 {0 2 3} V8 {0 0 "
      "3}");
  CHECK(is_near(uv_at(wide, {4, 0.5, 0.75}), {0.5, 0.25, 0}));
  // The first three corners lie on a line.
  const Scene prism = mapped(
      "arb8 V1 {4 0 3} V2 {4 2 0} V3 {4 1 0} V4 {4 0 0} V5 {0 0 3} V6 {0 2 0} V7 {0 1 0} V8 {0 0 "
      "0}");
  CHECK(is_near(uv_at(prism, {4, 0.5, 0.75}), {0.25, 0.75, 0}));
}

TEST_CASE("part, the bowls, hyp and the troughs have u about their axis") {
  const Scene part = mapped("part V {0 0 0} H {0 0 8} r_v 1 r_h 1");
  const Scene& scene = part;
  // Across z is -y, and x behind it; v goes from -1 to 9.
  CHECK(is_near(uv_at(scene, {1, 0, 1.5}), {0.25, 0.25, 0}));
  CHECK(is_near(uv_at(scene, {0, 0, 9}), {0, 1, 0}));
  // A tapered one ends where the cone around it would, not its balls.
  const Scene tapered = mapped("part V {0 0 0} H {0 0 8} r_v 2 r_h 1");
  const double before = 2 / std::sqrt(1 - 1 / 64.0), behind = 0.5 * before;
  CHECK(uv_at(tapered, {2, 0, 0}).y == Approx(before / (8 + before + behind)));
  for (const char* bowl : {"epa V {0 0 0} H {0 0 4} A {0 1 0} r_1 2 r_2 1",
                           "ehy V {0 0 0} H {0 0 4} A {0 1 0} r_1 2 r_2 1 c 3"}) {
    INFO(bowl);
    // x is H x A, which is -x.
    CHECK(is_near(uv_at(mapped(bowl), {-0.8, 0, 1}), {0, 0.25, 0}));
    CHECK(is_near(uv_at(mapped(bowl), {0, 1.5, 1}), {0.25, 0.25, 0}));
    CHECK(is_near(uv_at(mapped(bowl), {0, 0.5, 0}), {0.25, 0.75, 0}));
  }
  const Scene hyp = mapped("hyp V {0 0 0} H {0 0 4} A {2 0 0} b 1 bnr 0.5");
  CHECK(is_near(uv_at(hyp, {0, -0.5, 2}), {0, 0.5, 0}));
  CHECK(is_near(uv_at(hyp, {1.5, 0, 1}), {0.25, 0.25, 0}));
  CHECK(is_near(uv_at(hyp, {0.5, 0, 0}), {0.25, 0.25, 0}));
  CHECK(is_near(uv_at(hyp, {0.5, 0, 4}), {0.25, 0.75, 0}));
  for (const char* trough :
       {"rpc V {0 0 0} H {8 0 0} B {0 0 -2} r 3", "rhc V {0 0 0} H {8 0 0} B {0 0 -2} r 3 c 1"}) {
    INFO(trough);
    // y is B x H, which is -y.
    CHECK(is_near(uv_at(mapped(trough), {2, 0, -2}), {0.5, 0.25, 0}));
    CHECK(is_near(uv_at(mapped(trough), {2, -1.5, 0}), {0.25, 0.25, 0}));
    CHECK(is_near(uv_at(mapped(trough), {8, 0, -0.5}), {0.5, 0.25, 0}));
  }
}

TEST_CASE("a half-space has u and v to and fro over 10 m, and squares of 5 m at scale 2") {
  // Across z is y, and x across both.
  const Scene half = mapped("half N {0 0 1} d 7");
  const Vec3 at = uv_at(half, {1250, 2500, 7}), other = uv_at(half, {-1250, 7500, 7});
  CHECK(std::fmin(at.x, at.y) == Approx(0.25));
  CHECK(std::fmax(at.x, at.y) == Approx(0.5));
  CHECK(is_near(at, other));
}

TEST_CASE("squares on a half-space differ in size where the scale isn't 2") {
  const Scene scene = scene_of(
      region("put s half N {0 0 1} d 0\n", "l s", "checker {a {255 0 0} b {0 0 255} s 3}"));
  const Material& m = material_of(scene, scene.objects.at(0).csg);
  const auto red_at = [&](double x) { return color_at(m.pattern, m.color, {x, 10, 0}).r; };
  // Thirds of 5 m, and the middle one is twice as wide where u turns.
  CHECK(red_at(1600) == 1);
  CHECK(red_at(1700) == 0);
  CHECK(red_at(3400) == 1);
  CHECK(red_at(6600) == 1);
  CHECK(red_at(6700) == 0);
  CHECK(red_at(-1600) == 1);
}

TEST_CASE("each surface of a region follows the solid that it is of, cut from another, too") {
  const std::string solids =
      std::string("put box ") + kBox + "\nput ball ell V {4 1 1.5} A {1 0 0} B {0 1 0} C {0 0 1}\n";
  const Scene scene =
      scene_of(region(solids, "- {l box} {l ball}", "checker {a {255 0 0} b {0 0 255} s 8}"));
  CHECK(scene.objects.at(0).material == kInheritMaterial);
  const auto& cut = std::get<OperationNode>(scene.objects[0].csg.value);
  REQUIRE(cut.children.size() == 2);
  const Pattern& outside = material_of(scene, cut.children[0]).pattern;
  const Pattern& hole = material_of(scene, cut.children[1]).pattern;
  CHECK(outside.chart.kind == ChartKind::kFaces);
  CHECK(hole.chart.kind == ChartKind::kSphere);
  // u = v = 0.9375: both are in square 7; beside it in square 6.
  CHECK(color_at(outside, {}, {4, 1.875, 2.8125}) == Rgb{1, 0, 0});
  CHECK(color_at(outside, {}, {4, 1.625, 2.8125}) == Rgb{0, 0, 1});
  // Just off -x and the equator: u = 0.49 and v = 0.51, squares 3 and 4.
  CHECK(color_at(hole, {}, {3, 1.06, 1.53}) == Rgb{0, 0, 1});
  CHECK(color_at(hole, {}, {3, 1.06, 1.47}) == Rgb{1, 0, 0});
}

TEST_CASE("the ends of a solid that cuts are where its skin is") {
  const struct {
    std::string solid;
    Vec3 at, uv;
  } cases[] = {
      {"tgc V {0 0 0} H {0 0 4} A {2 0 0} B {0 2 0} C {1 0 0} D {0 1 0}",
       {0.5, 0, -kBrlcadSkin},
       {0.5, 0.75, 0}},
      {"epa V {0 0 0} H {0 0 4} A {0 1 0} r_1 2 r_2 1", {0, 0.5, -kBrlcadSkin}, {0.25, 0.75, 0}},
      {"hyp V {0 0 0} H {0 0 4} A {2 0 0} b 1 bnr 0.5", {0.5, 0, -kBrlcadSkin}, {0.25, 0.25, 0}},
      {"rpc V {0 0 0} H {8 0 0} B {0 0 -2} r 3", {2, -1.5, kBrlcadSkin}, {0.25, 0.25, 0}},
  };
  for (const auto& c : cases) {
    INFO(c.solid);
    const Scene scene = scene_of(
        region(std::string("put box ") + kBox + "\nput s " + c.solid + "\n", "- {l box} {l s}"));
    const auto& cut = std::get<OperationNode>(scene.objects.at(0).csg.value);
    const Material& m = material_of(scene, cut.children.at(1));
    const Rgb color = color_at(m.pattern, m.color, c.at);
    CHECK(length(Vec3{color.r, color.b, 0} - c.uv) < 1e-3);
  }
}

TEST_CASE("solids that differ in their place or their taper have materials of their own") {
  const std::string cone = " tgc V {0 0 0} H {0 0 4} A {2 0 0} B {0 2 0} C ";
  const Scene scene = scene_of(region(
      "put a ell V {0 0 0} A {2 0 0} B {0 2 0} C {0 0 2}\nput b ell V {9 0 0} A {2 0 0} B {0 2 "
      "0} C {0 0 2}\nput c" +
          cone + "{1 0 0} D {0 1 0}\nput d" + cone + "{1 0 0} D {0 0.5 0}\n",
      "u {u {u {u {l a} {l b}} {l c}} {l d}} {l a}"));
  const auto& sum = std::get<OperationNode>(scene.objects.at(0).csg.value);
  REQUIRE(sum.children.size() == 5);
  CHECK(sum.children[0].material != sum.children[1].material);
  CHECK(sum.children[2].material != sum.children[3].material);
  CHECK(sum.children[4].material == sum.children[0].material);
}

TEST_CASE("a solid that cuts several regions has each one's pattern, or none") {
  const std::string text = std::string("title t\nput a ") + kBox +
                           "\nput b ell V {0 0 0} A {1 0 0} B {0 1 0} C {0 0 1}\n"
                           "put one comb region yes shader {checker} tree {l a}\n"
                           "put two comb region yes shader {plastic} tree {l a}\n"
                           "put all comb region no tree {- {u {l one} {l two}} {l b}}\n";
  const Scene scene = scene_of(text);
  REQUIRE(scene.objects.size() == 2);
  const auto material_of_cut = [&](std::size_t object) {
    return std::get<OperationNode>(scene.objects[object].csg.value).children.at(1).material;
  };
  CHECK(scene.materials.at(material_of_cut(0)).material.pattern.chart.kind == ChartKind::kSphere);
  CHECK(material_of_cut(1) == kInheritMaterial);
  CHECK(scene.materials.at(scene.objects[1].material).material.model == ShadingModel::kRt);
}

TEST_CASE("a pipe in a union keeps its material to itself") {
  const Scene scene = scene_of(region(
      "put p pipe V0 {0 0 0} O0 2 I0 0 R0 3 V1 {10 0 0} O1 2 I1 0 R1 3 V2 {10 10 0} O2 2 I2 0 "
      "R2 3\nput b ell V {0 0 9} A {1 0 0} B {0 1 0} C {0 0 1}\n",
      "u {l p} {l b}", "cloud"));
  const auto& sum = std::get<OperationNode>(scene.objects.at(0).csg.value);
  REQUIRE(sum.children.size() == 2);
  CHECK(material_of(scene, sum.children[1]).pattern.kind == PatternKind::kClouds);
  CHECK(sum.children[0].material == kInheritMaterial);
}

TEST_CASE("where rt knows no u and v a solid has the colour of 0 and 0") {
  const std::string bot =
      "put s bot mode volume orient no flags {} V {{0 0 0} {4 0 0} {0 4 0} {0 0 4}} F {{0 2 1} {0 "
      "1 "
      "3} {0 3 2} {1 2 3}}\n";
  const BrlcadResult result = read_brlcad(region(bot, "l s", "checker {a {255 0 0} b {0 0 255}}"));
  REQUIRE(result.scene);
  CHECK(result.warnings.empty());
  const Material& m = result.scene->materials.at(result.scene->objects.at(0).material).material;
  CHECK(m.color == Rgb{1, 0, 0});
  CHECK(m.pattern == Pattern{});
}

TEST_CASE("cloud has the sky's colour, thresh and range, and a stack lights what it colours") {
  BrlcadReport report;
  const auto surface = [&](const std::string& shader) {
    return brlcad_surface(shader, {255, 0, 0}, "r", report);
  };
  const auto cloud = surface("cloud thresh=0.2 range=0.4").on_solids;
  REQUIRE(cloud);
  CHECK(cloud->kind == PatternKind::kClouds);
  CHECK(cloud->colors[0] == Rgb{0.31, 0.31, 0.78});
  CHECK(cloud->thresholds == std::array<double, 2>{0.2, 0.4});
  CHECK(surface("cloud").on_solids->thresholds == std::array<double, 2>{0.35, 0.3});
  const BrlcadSurface lit = surface("stack {checker {s 4}} {plastic {di 0.5}}");
  REQUIRE(lit.on_solids);
  CHECK(lit.on_solids->to_pattern == scaling({4, 4, 1}));
  CHECK(lit.material.model == ShadingModel::kRt);
  CHECK(lit.material.diffuse == 0.5);
  CHECK(surface("stack {plastic} {checker}").material.ambient == 1);
  CHECK(surface("stack {checker} {camo}").material.pattern.kind == PatternKind::kCamouflage);
  CHECK_FALSE(surface("stack {checker} {camo}").on_solids);
  CHECK(report.take_warnings().empty());
}
