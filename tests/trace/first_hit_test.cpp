#include "trace/first_hit.hpp"

#include <bit>

#include "catch.hpp"
#include "formats/graycube/read_scene.hpp"
#include "scene/compile_scene.hpp"
#include "trace/render_serial.hpp"

namespace graycube {
namespace {

/// The picture of one pixel: a ray from `eye` along +z into a scene of objects.
struct Probe {
  Probe(const std::string& eye, const std::string& objects, unsigned samples = 1,
        const std::string& inside = "exit") {
    ReadResult read = read_scene_text(
        R"({"graycube": 1, "image": {"width": 1, "height": 1, "samples": )" +
        std::to_string(samples) + R"(}, "camera": {"type": "orthographic", "width": 0.1, "eye": )" +
        eye + R"(, "look_at": )" + eye.substr(0, eye.rfind(',')) +
        R"(, 100], "up": [0,1,0], "inside": ")" + inside + R"("},
      "lights": [], "materials": {"red": {"color": [0.5,0.25,0.125], "transmit": 1}},
      "objects": [)" +
        objects + "]}");
    REQUIRE(read.scene);
    read.scene->settings.aovs = AovSet::all();
    const Domain domain(compile_scene(*read.scene));
    Film film(1, 1, samples * samples, AovSet::all());
    render_serial(domain, {}, film);
    picture = film.develop();
  }

  float number(std::size_t plane, std::size_t word) const {
    return std::bit_cast<float>(picture.aov_planes[plane][word]);
  }
  float depth() const { return number(kDepthPlane, 0); }
  std::uint32_t object() const { return picture.aov_planes[kDepthPlane][1]; }
  Vec3 normal() const {
    return {number(kNormalPlane, 0), number(kNormalPlane, 1), number(kNormalPlane, 2)};
  }
  Vec3 albedo() const {
    return {number(kAlbedoPlane, 0), number(kAlbedoPlane, 1), number(kAlbedoPlane, 2)};
  }

  Picture picture;
};

constexpr const char* kFarBox =
    R"({"material": "red", "csg": {"type": "box", "min": [5,5,5], "max": [6,6,6]}},)";
constexpr const char* kSphere =
    R"({"material": "red", "csg": {"type": "sphere", "center": [0,0,4], "radius": 1}})";

TEST_CASE("the first hit gives depth, normal, albedo and the object's place in the file") {
  const Probe probe("[0,0,-2]", std::string(kFarBox) + kSphere);
  CHECK(probe.depth() == 5.0f);
  CHECK(probe.normal() == Vec3{0, 0, -1});
  CHECK(probe.albedo() == Vec3{0.5, 0.25, 0.125});
  CHECK(probe.object() == 2);
}

TEST_CASE("a normal seen from inside points out of the solid all the same") {
  const Probe probe("[0,0,4]", kSphere);
  CHECK(probe.depth() == 1.0f);
  CHECK(probe.normal() == Vec3{0, 0, 1});
}

TEST_CASE("the normal of a hole's wall points out of the solid, into the hole") {
  const Probe probe("[0,0,4]", R"({"material": "red", "csg": {"type": "difference", "children": [
      {"type": "box", "min": [-9,-9,-9], "max": [9,9,9]},
      {"type": "sphere", "center": [0,0,4], "radius": 1}]}})");
  CHECK(probe.normal() == Vec3{0, 0, -1});
}

TEST_CASE("where nothing is hit the depth is infinite and the object 0") {
  const Probe probe("[0,3,-2]", kSphere);
  CHECK(probe.depth() == std::numeric_limits<float>::infinity());
  CHECK(probe.object() == 0);
  CHECK(probe.normal() == Vec3{});
}

TEST_CASE("a ray that starts within a solid may show where it entered it") {
  const std::string ball =
      R"({"material": "red", "csg": {"type": "sphere", "center": [0,0,4], "radius": 2}})";
  const std::string behind =
      R"({"material": "red", "csg": {"type": "sphere", "center": [0,0,-9], "radius": 1}})";
  const Probe exit("[0,0,4]", ball + "," + behind);
  CHECK(exit.depth() == 2.0f);
  const Probe entry("[0,0,4]", behind + "," + ball, 1, "entry");
  CHECK(entry.depth() == -2.0f);
  CHECK(entry.normal() == Vec3{0, 0, -1});
  CHECK(entry.object() == 2);
  // A shell around another solid, both around the start: the inner one was entered last.
  const Probe two(
      "[0,0,4]",
      R"({"material": "red", "csg": {"type": "box", "min": [-5,-5,-5], "max": [5,5,5]}},)" + ball,
      1, "entry");
  CHECK(two.object() == 2);
  CHECK(Probe("[0,0,-2]", ball, 1, "entry").depth() == 4.0f);
  CHECK(Probe("[0,0,8]", ball, 1, "entry").object() == 0);
}

TEST_CASE("of many samples one gives the AOVs, and they are the first hit's") {
  for (const unsigned samples : {2u, 3u, 5u}) {
    const Probe probe("[0,0,-2]", kSphere, samples);
    CHECK(length(probe.normal()) == Approx(1).epsilon(1e-6));
    CHECK(probe.depth() == Approx(5).epsilon(1e-3));
    CHECK(probe.object() == 1);
  }
}

}  // namespace
}  // namespace graycube
