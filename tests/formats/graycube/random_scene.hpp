// Valid scenes from a seed, with every kind of node and every setting.
#pragma once

#include <cmath>
#include <cstdint>
#include <iterator>
#include <random>
#include <string>
#include <utility>

#include "bezier/samples.hpp"
#include "mesh/samples.hpp"
#include "scene/scene.hpp"

namespace graycube::testing {

class RandomScene {
 public:
  explicit RandomScene(std::uint64_t seed) : random_(seed) {}

  Scene make() {
    scene_ = {};
    settings(scene_.settings);
    const auto materials = 1 + below(4);
    for (std::size_t i = 0; i < materials; ++i)
      scene_.materials.push_back({name("material", i), material()});
    const auto shapes = below(4);
    for (std::size_t i = 0; i < shapes; ++i) {
      // A shape may use the shapes before it.
      CsgNode node = tree(2);
      scene_.shapes.push_back({name("shape", i), std::move(node)});
    }
    const auto objects = below(6);
    for (std::size_t i = 0; i < objects; ++i)
      scene_.objects.push_back({below(3) == 0 ? "" : name("object", i), some_material(), tree(3)});
    if (below(2) == 0) scene_.digits = static_cast<std::uint32_t>(1 + below(17));
    return std::move(scene_);
  }

 private:
  std::size_t below(std::size_t n) { return static_cast<std::size_t>(random_() % n); }
  /// A positive number with all 53 bits in use, of many magnitudes.
  double positive() {
    return std::ldexp(1 + std::generate_canonical<double, 53>(random_),
                      static_cast<int>(below(40)) - 20);
  }
  double number() { return below(8) == 0 ? 0 : below(2) == 0 ? positive() : -positive(); }
  double fraction() { return std::generate_canonical<double, 53>(random_); }
  Vec3 vector() { return {number(), number(), number()}; }
  Vec3 direction() { return {positive(), number(), number()}; }
  Rgb color() { return {positive(), positive(), below(2) == 0 ? 0 : positive()}; }
  MaterialIndex some_material() {
    return static_cast<MaterialIndex>(below(scene_.materials.size()));
  }

  std::string name(const std::string& kind, std::size_t i) {
    static const char* const kOddities[] = {"",         " \"quoted\"",     "\\", "/~1", "\n\t\x01",
                                            "\xC3\xA9", "\xF0\x9F\x98\x80"};
    return kind + std::to_string(i) + kOddities[below(std::size(kOddities))];
  }

  void settings(RenderSettings& s) {
    s.image = {static_cast<std::uint32_t>(1 + below(500)),
               static_cast<std::uint32_t>(1 + below(500)),
               static_cast<std::uint32_t>(1 + below(8))};
    s.camera.projection = below(2) == 0 ? Projection::kPerspective : Projection::kOrthographic;
    s.camera.eye = vector();
    s.camera.look_at = s.camera.eye + Vec3{2e6, fraction(), 1e6};
    s.camera.up = {fraction(), 1, fraction()};
    (s.camera.projection == Projection::kPerspective ? s.camera.fov_degrees : s.camera.width) =
        1 + 178 * fraction();
    s.camera.handedness = below(2) == 0 ? Handedness::kRight : Handedness::kLeft;
    if (below(2) == 0) s.camera.pixel_offset = {fraction(), fraction()};
    if (s.camera.projection == Projection::kOrthographic && below(2) == 0) {
      s.camera.inside = InsideView::kEntry;
    }
    s.background = color();
    s.ambient = color();
    s.max_depth = static_cast<std::uint32_t>(below(1001));
    s.min_weight = fraction();
    const auto lights = below(4);
    for (std::size_t i = 0; i < lights; ++i)
      s.lights.push_back({vector(), color(),
                          below(2) == 0 ? Falloff::kNone : Falloff::kInverseSquare, below(2) == 0,
                          Vec3{fraction(), 1, fraction()},
                          below(2) == 0 ? 180.0 : 180 * fraction()});
  }

  Material material() {
    constexpr ShadingModel kModels[] = {ShadingModel::kPhong, ShadingModel::kTorranceSparrow,
                                        ShadingModel::kHallGreenberg, ShadingModel::kRt,
                                        ShadingModel::kRtLamp};
    Material m{color(),    positive(), positive(), positive(),        positive(),
               positive(), fraction(), positive(), kModels[below(5)], pattern()};
    if (has_fresnel(m)) optics(m);
    return m;
  }
  /// What the model doesn't use keeps its default: it isn't written.
  void optics(Material& m) {
    for (double* share : {&m.diffuse, &m.specular, &m.reflect}) *share = fraction();
    const auto each = [&] { return Rgb{0.1 + fraction(), 0.1 + fraction(), 0.1 + fraction()}; };
    Optics& o = m.optics;
    o.index = each();
    if (below(2) == 0) {
      m.transmit = 0;
      o.absorption = each();
    } else {
      o.index = {o.index.r, o.index.r, o.index.r};
    }
    m.ior = o.index.r;
    if (m.model == ShadingModel::kTorranceSparrow) {
      m.shininess = 1;
      o.roughness = kLeastRoughness + fraction() * (kMostRoughness - kLeastRoughness);
    } else {
      o.transmit_shininess = positive();
      if (below(2) == 0) o.attenuation = color();
    }
  }
  /// What the kind doesn't use keeps its default: it isn't written.
  Pattern pattern() {
    Pattern p;
    p.kind = static_cast<PatternKind>(below(kPatternKinds));
    if (p.kind == PatternKind::kNone) return p;
    if (below(2) == 0) p.to_pattern = transform();
    for (std::size_t i = 0; i < colors_of(p.kind); ++i) p.colors[i] = color();
    if (has_thresholds(p.kind)) p.thresholds = {fraction(), fraction()};
    if (has_noise(p.kind)) p.octaves = {kMaxOctaves * fraction(), positive(), fraction()};
    if (below(2) == 0) p.chart = chart();
    return p;
  }
  /// What the kind doesn't use keeps its default, as above.
  Chart chart() {
    Chart c;
    c.kind = static_cast<ChartKind>(1 + below(kChartKinds - 1));
    const std::size_t maps = c.kind == ChartKind::kFaces ? 1 + below(kMaxChartFaces) : 1;
    for (std::size_t i = 0; i < maps; ++i) c.maps.push_back(transform());
    if (c.kind != ChartKind::kRound) return c;
    for (EndChart& end : c.ends) end = static_cast<EndChart>(below(kEndCharts));
    c.top_radii = {fraction(), positive()};
    return c;
  }

  /// A map that scales, mirrors and shears, always well away from singular.
  Affine transform() {
    Affine map;
    for (std::size_t row = 0; row < 3; ++row)
      for (std::size_t column = 0; column < 4; ++column)
        map.m[row][column] = (row == column ? (below(4) == 0 ? -2 : 2) : 0) + 0.3 * fraction();
    return map;
  }

  CsgNode tree(int depth) {
    CsgNode node;
    if (depth == 0 || below(3) == 0)
      leaf(node);
    else
      operation(node, depth);
    if (below(2) == 0) node.transform = transform();
    if (below(3) == 0) node.material = some_material();
    return node;
  }

  void operation(CsgNode& node, int depth) {
    if (below(5) == 0) return repeat(node, depth);
    OperationNode o;
    o.operation = static_cast<Operation>(below(4));
    const std::size_t children = o.operation == Operation::kComplement ? 1 : 1 + below(4);
    for (std::size_t i = 0; i < children; ++i) o.children.push_back(tree(depth - 1));
    node.value = std::move(o);
  }

  void repeat(CsgNode& node, int depth) {
    RepeatNode r;
    r.child.push_back(tree(depth - 1));
    r.depth = static_cast<std::uint32_t>(below(3));
    r.kept = below(2) == 0 ? KeptCopies::kAll : KeptCopies::kLast;
    for (std::size_t i = 0, count = 1 + below(3); i < count; ++i) r.maps.push_back(transform());
    node.value = std::move(r);
  }

  void leaf(CsgNode& node) {
    const Vec3 corner = vector();
    const double major = positive();
    switch (below(scene_.shapes.empty() ? 15 : 16)) {
      case 0: node.value = SphereShape{vector(), positive()}; return;
      case 1:
        node.value =
            BoxShape{corner, corner + Vec3{1 + positive(), 1 + positive(), 1 + positive()}};
        return;
      case 2:
        node.value = CylinderShape{corner, corner + direction() + Vec3{1, 0, 0}, positive()};
        return;
      case 3:
        node.value = ConeShape{corner, below(3) == 0 ? 0 : positive(),
                               corner + direction() + Vec3{1, 0, 0}, positive()};
        return;
      case 4:
        node.value = TorusShape{vector(), direction(), major, major * (0.1 + 0.8 * fraction())};
        return;
      case 5: node.value = HalfSpaceShape{direction(), number()}; return;
      case 6:
        // Axes of like lengths: very unequal ones are, to working precision, dependent.
        node.value = EllipsoidShape{
            vector(), {{{1 + fraction(), 0, 0}, {fraction(), 2, 0}, {fraction(), fraction(), 3}}}};
        return;
      case 7:
        node.value = PolyhedronShape{};
        for (std::size_t i = 0, count = 1 + below(5); i < count; ++i)
          std::get<PolyhedronShape>(node.value).planes.push_back({direction(), number()});
        return;
      case 8:
        node.value = EllipticConeShape{
            corner,    corner + Vec3{0.1, 0.2, 2}, {1, fraction(), 0}, {0, 2, 0.1}, positive(),
            positive()};
        return;
      case 9:
        node.value = EllipticTorusShape{vector(),    direction(), major, major * 0.5 * fraction(),
                                        major * 0.5, major * 0.5};
        return;
      case 10:
        node.value = QuadricShape{{positive(), number(), number(), number()},
                                  corner,
                                  corner + Vec3{1 + positive(), 1 + positive(), 1 + positive()}};
        return;
      case 11:
        node.value =
            MeshShape{closed(box_polygons(
                          corner, corner + Vec3{1 + positive(), 1 + positive(), 1 + positive()})),
                      static_cast<std::uint32_t>(below(18))};
        return;
      case 12: node.value = BezierShape{cube_net(0.2, random_()), 0.05 + fraction()}; return;
      case 13: node.value = LatheShape{outline()}; return;
      case 14: node.value = SweepShape{outline(), positive(), number()}; return;
      default:
        node.value = ReferenceNode{static_cast<std::uint32_t>(below(scene_.shapes.size()))};
        return;
    }
  }

  /// x is not negative.
  OutlineLoops outline() {
    OutlineLoops loops(1 + below(2));
    for (OutlineLoop& loop : loops) {
      loop.resize(3 * (1 + below(3)));
      for (OutlinePoint& p : loop) p = {positive(), number()};
    }
    return loops;
  }

  std::mt19937_64 random_;
  Scene scene_;
};

}  // namespace graycube::testing
