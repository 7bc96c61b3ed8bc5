// Cuts flush with faces, in turned regions, look like the same solids with longer cuts.
#include <cmath>
#include <limits>
#include <random>
#include <sstream>

#include "catch.hpp"
#include "crossings/surface_tree.hpp"
#include "formats/brlcad/reading.hpp"
#include "geometry/affine.hpp"
#include "scene/compile_scene.hpp"

using namespace graycube;
using namespace graycube::testing;

namespace {

/// The matrix as BRL-CAD writes it, in all digits.
std::string words_of(const Affine& map) {
  std::ostringstream out;
  out.precision(17);
  for (const auto& row : map.m) {
    for (const double x : row) out << x << ' ';
  }
  out << "0 0 0 1";
  return out.str();
}

/// A plate of 100 × 60 × 8 mm with a bore, a slot and an oval hole, each reaching `beyond`
/// out of it, and a boss on it. The group is turned by `outer`, and its members by
/// `inner`.
std::string plate(const Affine& outer, const Affine& inner, double beyond) {
  std::ostringstream text;
  const double low = -beyond, high = 8 + beyond, h = high - low;
  text << "title plate\nunits mm\n"
       << "put base arb8 V1 {0 0 0} V2 {100 0 0} V3 {100 60 0} V4 {0 60 0} V5 {0 0 8} V6 {100 0 8} "
          "V7 {100 60 8} V8 {0 60 8}\n"
       << "put bore tgc V {25 30 " << low << "} H {0 0 " << h
       << "} A {12 0 0} B {0 12 0} C {12 0 0} D {0 12 0}\n"
       << "put slot arb8 V1 {60 " << low << ' ' << low << "} V2 {70 " << low << ' ' << low
       << "} V3 {70 30 " << low << "} V4 {60 30 " << low << "} V5 {60 " << low << ' ' << high
       << "} V6 {70 " << low << ' ' << high << "} V7 {70 30 " << high << "} V8 {60 30 " << high
       << "}\n"
       << "put oval tgc V {85 45 " << low << "} H {0 0 " << h
       << "} A {9 0 0} B {0 5 0} C {9 0 0} D {0 5 0}\n"
       << "put boss tgc V {80 15 8} H {0 0 10} A {8 0 0} B {0 8 0} C {8 0 0} D {0 8 0}\n";
  const auto member = [&](const char* name) {
    return std::string("{l ") + name + " {" + words_of(inner) + "}}";
  };
  text << "put r comb region yes id 1000 tree {u {- {- {- " << member("base") << ' '
       << member("bore") << "} " << member("slot") << "} " << member("oval") << "} "
       << member("boss") << "}\n"
       << "put all comb region no tree {l r {" << words_of(outer) << "}}\n";
  return text.str();
}

class Picture {
 public:
  explicit Picture(const std::string& text)
      : model_(compile_scene(scene_of(text))), tree_(SurfaceTree::build(model_)) {}
  /// The least parameter at which the ray meets anything; infinite if it meets nothing.
  double first(const Ray& ray) {
    constexpr double kInfinite = std::numeric_limits<double>::infinity();
    const auto hit = tree_.first_crossing(ray, 0, kInfinite, scratch_);
    return hit ? hit->t : kInfinite;
  }

 private:
  Model model_;
  SurfaceTree tree_;
  TreeScratch scratch_;
};

}  // namespace

TEST_CASE("flush cuts in turned regions are those that reach farther") {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    INFO("seed " << seed);
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> part(-1, 1);
    const auto point = [&](double size) {
      return Vec3{size * part(random), size * part(random), size * part(random)};
    };
    const Affine outer = compose(translation(point(500)), rotation(point(1), 180 * part(random))),
                 inner = compose(rotation(point(1), 180 * part(random)), translation(point(50)));
    Picture flush(plate(outer, inner, 0)), longer(plate(outer, inner, 1));
    const Affine map = compose(outer, inner);
    int differ = 0, met = 0;
    for (int i = 0; i < 400; ++i) {
      const Vec3 at = map.point({50 + 50 * part(random), 30 + 30 * part(random), 8});
      const Vec3 from = at + 200.0 * normalized(point(1));
      const Ray ray{from, normalized(at - from)};
      const double a = flush.first(ray), b = longer.first(ray);
      met += std::isfinite(a) ? 1 : 0;
      differ += a == b || std::fabs(a - b) < 1e-6 ? 0 : 1;
    }
    CHECK(differ == 0);
    CHECK(met > 100);
  }
}
