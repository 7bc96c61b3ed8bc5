// Hostile input: whatever happens to a mesh file, reading it ends with a mesh or with a fault.
#include <random>

#include "catch.hpp"
#include "formats/mesh/stl_samples.hpp"
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

TriangleMesh box() { return closed(box_polygons({0, 0, 0}, {1, 2, 3})); }

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
  for (const std::string& whole : {off_text(), stl_text(box()), stl_bytes(box())}) {
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
