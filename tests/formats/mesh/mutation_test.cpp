// Hostile input: whatever happens to a mesh file, reading it ends with a mesh or with a fault.
#include <cstring>
#include <random>

#include "catch.hpp"
#include "fuzz/mesh_fuzz.hpp"
#include "mesh/samples.hpp"

using namespace graycube;
using namespace graycube::testing;

namespace {

std::string off_text() {
  const PolygonMesh ring = ring_polygons(2, 1, 5, 4);
  std::string text = "OFF\n" + std::to_string(ring.points.size()) + " " +
                     std::to_string(ring.face_ends.size()) + " 0\n";
  for (const Vec3& p : ring.points) {
    text += std::to_string(p.x) + " " + std::to_string(p.y) + " " + std::to_string(p.z) + "\n";
  }
  for (std::size_t f = 0; f < ring.face_ends.size(); ++f) {
    text += "4";
    for (std::size_t i = 0; i < 4; ++i) text += " " + std::to_string(ring.corners[4 * f + i]);
    text += "\n";
  }
  return text;
}

std::string stl_text() {
  const TriangleMesh box = closed(box_polygons({0, 0, 0}, {1, 2, 3}));
  std::string text = "solid box\n";
  for (const Triangle& t : box.triangles) {
    text += "facet normal 0 0 0\nouter loop\n";
    for (const std::uint32_t i : t) {
      const Vec3& p = box.points[i];
      text += "vertex " + std::to_string(p.x) + " " + std::to_string(p.y) + " " +
              std::to_string(p.z) + "\n";
    }
    text += "endloop\nendfacet\n";
  }
  return text + "endsolid box\n";
}

std::string stl_bytes() {
  const TriangleMesh box = closed(box_polygons({0, 0, 0}, {1, 2, 3}));
  std::string bytes(80, ' ');
  const auto put = [&](auto v) {
    char raw[sizeof v];
    std::memcpy(raw, &v, sizeof v);
    bytes.append(raw, sizeof v);
  };
  put(static_cast<std::uint32_t>(box.triangles.size()));
  for (const Triangle& t : box.triangles) {
    for (int i = 0; i < 3; ++i) put(0.0f);
    for (const std::uint32_t i : t) {
      for (int a = 0; a < 3; ++a) put(static_cast<float>(box.points[i][a]));
    }
    put(std::uint16_t{0});
  }
  return bytes;
}

void mutate(std::string& bytes, std::mt19937& random) {
  if (bytes.empty()) return;
  const auto at = [&] { return static_cast<std::size_t>(random()) % bytes.size(); };
  static const char* const kWords[] = {"1e300",  "-1", "0",          "nan", "inf", "-0.0",
                                       "1e-300", "\n", "9999999999", "#",   " "};
  switch (random() % 7) {
    case 0: bytes[at()] = static_cast<char>(random()); break;
    case 1:
    case 2: bytes[at()] = static_cast<char>('0' + random() % 10); break;
    case 3: bytes.erase(at(), random() % 9); break;
    case 4: bytes.insert(at(), kWords[random() % std::size(kWords)]); break;
    case 5: bytes.insert(at(), bytes.substr(at(), random() % 60)); break;
    default:
      if (random() % 4 == 0) bytes.resize(at());
  }
}

}  // namespace

TEST_CASE("whatever happens to a mesh file, it is read or refused") {
  int seed = 0;
  for (const std::string& whole : {off_text(), stl_text(), stl_bytes()}) {
    fuzz_mesh(whole);
    for (int i = 0; i < 1000; ++i) {
      std::mt19937 random(static_cast<unsigned>(++seed));
      std::string bytes = whole;
      for (unsigned n = 1 + static_cast<unsigned>(random() % 4); n > 0; --n) mutate(bytes, random);
      INFO("seed " << seed);
      fuzz_mesh(bytes);
    }
  }
}
