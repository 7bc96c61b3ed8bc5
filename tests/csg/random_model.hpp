// Scenes from a seed, made to be hard for a ray tracer: every kind of primitive, maps with shear
// and mirror, operation trees, faces that coincide, floors, complements.
#pragma once

#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "bezier/samples.hpp"
#include "csg/dice.hpp"
#include "geometry/affine.hpp"
#include "geometry/portable_math.hpp"
#include "mesh/samples.hpp"
#include "scene/compile_scene.hpp"
#include "scene/scene.hpp"

namespace graycube::testing {

/// Kinds of leaves of random scenes; half-spaces, which alone are never bounded, are the last.
inline constexpr std::size_t kLeafKinds = 15;

struct RandomOptions {
  /// Half of all coordinates are multiples of 1/2, and some leaves repeat others: faces coincide.
  bool coincidences = true;
  /// Half-spaces, unbounded polyhedra, complements.
  bool unbounded = true;
  std::size_t max_objects = 6;
  int max_tree_depth = 3;
};

/// A node for a shape; maps and materials are left out.
template <typename Shape>
CsgNode node_of(Shape shape) {
  CsgNode node;
  node.value = std::move(shape);
  return node;
}
inline CsgNode operation(Operation o, std::vector<CsgNode> children) {
  return node_of(OperationNode{o, std::move(children)});
}
inline CsgNode transformed(CsgNode node, const Affine& map) {
  node.transform = node.transform ? compose(map, *node.transform) : map;
  return node;
}

class RandomModel {
 public:
  explicit RandomModel(std::uint64_t seed, RandomOptions options = {})
      : dice_(seed), options_(options) {}

  Dice& dice() { return dice_; }

  /// A scene as valid as if read from a file; a small picture, the eye anywhere, even in a solid.
  Scene scene() {
    Scene s;
    settings(s.settings);
    for (int i = 0; i < 4; ++i) s.materials.push_back({"m" + std::to_string(i), material()});
    s.shapes.push_back({"shape", tree(1)});
    shapes_ = 1;
    const std::size_t count = 1 + dice_.below(options_.max_objects);
    for (std::size_t i = 0; i < count; ++i) {
      s.objects.push_back({"object " + std::to_string(i), some_material(), object()});
    }
    return s;
  }

  /// A leaf of kind number 0 … kLeafKinds − 1, in its own coordinates near the origin.
  CsgNode leaf(std::size_t kind) {
    switch (kind) {
      case 0: return node_of(SphereShape{place(), size()});
      case 1: return node_of(box());
      case 2: return node_of(cylinder());
      case 3: return node_of(cone());
      case 4: return node_of(torus());
      case 5: return node_of(ellipsoid());
      case 6: return node_of(polyhedron());
      case 7: return node_of(elliptic_cone());
      case 8: return node_of(elliptic_torus());
      case 9: return node_of(quadric());
      case 10: return node_of(mesh());
      case 11: return node_of(LatheShape{outline(0)});
      case 12: return node_of(SweepShape{outline(-1), size(), is_on_grid() ? -0.5 : 0.0});
      case 13:
        return node_of(BezierShape{cube_net(dice_.between(0, 0.2), dice_.below(1000)), 0.05});
      default: return node_of(half_space());
    }
  }

  /// An invertible map: translations, quarter turns, rotations, scales, mirrors, shears.
  Affine map() {
    switch (dice_.below(6)) {
      case 0: return translation(place());
      case 1: return compose(translation(place()), rotation(dice_.axis(), 90));
      case 2: return rotation(dice_.unit_vector(), dice_.between(0, 360));
      case 3: return scaling({size(), dice_.sign() * size(), size()});
      case 4: return compose(shear(), translation(place()));
      default: return compose(rotation(dice_.unit_vector(), dice_.between(0, 360)), shear());
    }
  }
  Affine rigid() {
    return compose(translation(dice_.point(3)),
                   rotation(dice_.unit_vector(), dice_.between(0, 360)));
  }
  /// A map far from singular, with shear, and in half of all cases a mirror.
  Affine shear() {
    Affine a;
    for (std::size_t row = 0; row < 3; ++row) {
      for (std::size_t column = 0; column < 3; ++column) {
        a.m[row][column] = (row == column ? 1.0 : 0.0) + dice_.between(-0.3, 0.3);
      }
    }
    if (dice_.one_in(2)) {
      for (double& v : a.m[0]) v = -v;
    }
    return a;
  }

  Vec3 place() { return is_on_grid() ? dice_.grid_point(2) : dice_.point(2); }
  double size() {
    return is_on_grid() ? 0.5 + 0.5 * static_cast<double>(dice_.below(3)) : dice_.between(0.3, 1.6);
  }

 private:
  bool is_on_grid() { return options_.coincidences && dice_.one_in(2); }
  MaterialIndex some_material() { return static_cast<MaterialIndex>(dice_.below(4)); }
  Rgb color() { return {dice_.unit(), dice_.unit(), dice_.unit()}; }

  void settings(RenderSettings& s) {
    s.image = {24, 16, dice_.one_in(4) ? 2u : 1u};
    Camera& c = s.camera;
    c.projection = dice_.one_in(3) ? Projection::kOrthographic : Projection::kPerspective;
    c.eye = dice_.one_in(4) ? dice_.point(2) : 7 * dice_.unit_vector();
    c.look_at = is_on_grid() ? Vec3{0, 0, 0} : dice_.point(1);
    c.up = {0.1, 1, 0.05};
    c.fov_degrees = dice_.between(30, 100);
    c.width = dice_.between(4, 12);
    c.handedness = dice_.one_in(2) ? Handedness::kLeft : Handedness::kRight;
    s.background = color();
    s.max_depth = 4;
    if (dice_.one_in(3)) s.min_weight = 0.05;
    const std::size_t lights = dice_.below(4);
    for (std::size_t i = 0; i < lights; ++i) {
      s.lights.push_back({dice_.one_in(3) ? dice_.point(3) : 9 * dice_.unit_vector(), color(),
                          dice_.one_in(3) ? Falloff::kInverseSquare : Falloff::kNone});
    }
    // The third light shines in a beam.
    if (lights == 3) {
      s.lights.back().direction = -s.lights.back().position;
      s.lights.back().angle_degrees = 20;
    }
  }

  Material material() {
    Material m;
    m.color = color();
    m.ambient = 0.2;
    m.diffuse = dice_.unit();
    m.specular = dice_.one_in(2) ? 0 : dice_.unit();
    m.shininess = dice_.between(0, 60);
    m.reflect = dice_.one_in(2) ? 0 : dice_.unit();
    if (dice_.one_in(2)) {
      m.transmit = dice_.between(0.2, 1);
      m.ior = dice_.one_in(3) ? 1 : dice_.between(0.6, 2);
    }
    // The glossiest have a pattern, those before them another model. No dice: the scenes of the
    // seeds stay what they are.
    if (m.shininess > 50)
      m.pattern.kind = PatternKind::kMarble;
    else if (m.shininess > 30) {
      m.model = m.shininess > 35 ? ShadingModel::kHallGreenberg : ShadingModel::kTorranceSparrow;
      if (m.transmit == 0) m.ior = 1.5;
      m.optics.index = {m.ior, m.ior, m.ior};
      m.optics.transmit_shininess = 8;
      m.optics.attenuation = {0.05, 0, 0.2};
    }
    return m;
  }

  CsgNode object() {
    if (options_.unbounded && dice_.one_in(6)) {
      return node_of(HalfSpaceShape{{0, 1, 0}, dice_.on_grid(2)});  // a floor
    }
    return tree(options_.max_tree_depth);
  }

  CsgNode tree(int depth) {
    CsgNode node;
    if (depth == 0 || dice_.one_in(3)) {
      node = some_leaf();
    } else if (shapes_ > 0 && dice_.one_in(8)) {
      node = node_of(ReferenceNode{0});
    } else if (dice_.one_in(10)) {
      node = node_of(repeat(depth));
    } else {
      node = some_operation(depth);
    }
    if (dice_.one_in(3)) node = transformed(std::move(node), map());
    if (dice_.one_in(4)) node.material = some_material();
    return node;
  }

  CsgNode some_leaf() {
    if (options_.coincidences && !earlier_.empty() && dice_.one_in(5)) {
      return earlier_[dice_.below(earlier_.size())];
    }
    CsgNode node = leaf(dice_.below(options_.unbounded ? kLeafKinds : kLeafKinds - 1));
    earlier_.push_back(node);
    return node;
  }

  RepeatNode repeat(int depth) {
    RepeatNode r{{tree(depth - 1)}, {map()}, static_cast<std::uint32_t>(dice_.below(3)), {}};
    if (dice_.one_in(2)) r.maps.push_back(map());
    if (dice_.one_in(3)) r.kept = KeptCopies::kLast;
    return r;
  }

  CsgNode some_operation(int depth) {
    auto o = static_cast<Operation>(dice_.below(4));
    if (o == Operation::kComplement && !options_.unbounded) o = Operation::kDifference;
    const std::size_t count = o == Operation::kComplement ? 1 : 1 + dice_.below(4);
    std::vector<CsgNode> children;
    for (std::size_t i = 0; i < count; ++i) children.push_back(tree(depth - 1));
    return operation(o, std::move(children));
  }

  BoxShape box() {
    const Vec3 lo = place();
    return {lo, lo + Vec3{size(), size(), size()}};
  }
  Vec3 axis() { return is_on_grid() ? size() * dice_.axis() : size() * dice_.unit_vector(); }
  CylinderShape cylinder() {
    const Vec3 base = place();
    return {base, base + axis(), size()};
  }
  ConeShape cone() {
    const Vec3 base = place();
    ConeShape c{base, size(), base + axis(), dice_.one_in(2) ? 0 : size()};
    if (dice_.one_in(2)) std::swap(c.base_radius, c.top_radius);
    return c;
  }
  TorusShape torus() {
    const double major = size();
    return {place(), axis(), major, major * dice_.between(0.1, 0.9)};
  }
  EllipsoidShape ellipsoid() {
    const Affine a = shear();
    return {place(), {size() * a.row(0), size() * a.row(1), size() * a.row(2)}};
  }
  EllipticConeShape elliptic_cone() {
    const Affine a = shear();
    EllipticConeShape c{place(), {}, size() * a.row(0), size() * a.row(1), size(), size()};
    c.top = c.base + size() * a.row(2);
    if (dice_.one_in(4)) c.top_a = 0;
    if (dice_.one_in(4)) c.top_b = c.top_a;
    return c;
  }
  EllipticTorusShape elliptic_torus() {
    const double radius = size();
    return {place(),
            axis(),
            radius,
            radius * dice_.between(-0.6, 0.6),
            radius * dice_.between(0.05, 0.6),
            radius * dice_.between(0.1, 0.6)};
  }
  /// A quadric of BRL-CAD's kinds rpc, rhc, epa, ehy or hyp.
  QuadricShape quadric() {
    const double k = 1 + 2 * size();
    switch (dice_.below(5)) {
      case 0: return {{0, 0, 1, -1}, {-1, 0, 0}, {1, 1, 1}};
      case 1: return {{0, -1 / k, (k + 1) / k, -1}, {-1, 0, 0}, {1, 1, 1}};
      case 2: return {{1, 0, 1, -1}, {-1, -1, 0}, {1, 1, 1}};
      case 3: return {{1, -1 / k, (k + 1) / k, -1}, {-1, -1, 0}, {1, 1, 1}};
      default: return {{1, 1 - k * k, 0, -1}, {-k, -k, -1}, {k, k, 1}};
    }
  }
  /// A mesh so coarse that its flat faces matter; with cavities, and with parts that overlap.
  MeshShape mesh() {
    PolygonMesh polygons;
    switch (dice_.below(4)) {
      case 0: {
        const BoxShape b = box();
        polygons = box_polygons(b.min, b.max);
        if (dice_.one_in(2)) {
          const Vec3 e = 0.25 * (b.max - b.min);
          append(polygons, box_polygons(b.min + e, b.max - e), true);
        }
        break;
      }
      case 1: polygons = ring_polygons(1.5, 0.5, 5, 4); break;
      case 2: polygons = ball_polygons(size(), 3, 6); break;
      default: {
        const BoxShape a = box(), b = box();
        polygons = box_polygons(a.min, a.max);
        append(polygons, box_polygons(b.min, b.max));
      }
    }
    return {closed(polygons)};
  }
  /// One loop about a middle and perhaps a hole in it; x is no less than `least`.
  OutlineLoops outline(double least) {
    const double x = 1 + dice_.between(-0.3, 0.3), y = dice_.between(-0.3, 0.3);
    OutlineLoops loops{ring_of_curves(x, y, 0.4, least < 0 || dice_.one_in(2) ? 1.0 : 1.6, least)};
    if (dice_.one_in(2)) loops.push_back(ring_of_curves(x, y, 0.15, 0.3, least));
    return loops;
  }
  /// Curves and straight sides through points that far around a middle.
  OutlineLoop ring_of_curves(double x, double y, double near, double far, double least) {
    OutlineLoop loop;
    for (int i = 0; i < 4; ++i) {
      const bool is_straight = dice_.one_in(3);
      for (int k = 0; k < 3; ++k) {
        const double around = 90 * i + 30 * k;
        const double away = k > 0 && is_straight ? 0.7 * far : dice_.between(near, far);
        loop.push_back(
            {std::fmax(least, x + away * cos_degrees(around)), y + away * sin_degrees(around)});
      }
    }
    return loop;
  }
  HalfSpaceShape half_space() {
    return {axis(), is_on_grid() ? dice_.on_grid(2) : dice_.between(-2, 2)};
  }
  PolyhedronShape polyhedron() {
    PolyhedronShape p;
    if (!options_.unbounded || dice_.one_in(2)) {
      // A box cut by other planes is bounded.
      const BoxShape b = box();
      for (int a = 0; a < 3; ++a) {
        Vec3 n;
        n[a] = 1;
        p.planes.push_back({n, b.max[a]});
        p.planes.push_back({-n, -b.min[a]});
      }
      const Vec3 middle = 0.5 * (b.min + b.max);
      for (std::size_t i = dice_.below(4); i > 0; --i) {
        const Vec3 n = axis();
        p.planes.push_back({n, dot(n, middle) + 0.3 * length(n)});
      }
      return p;
    }
    for (std::size_t i = 1 + dice_.below(5); i > 0; --i) p.planes.push_back(half_space());
    return p;
  }

  Dice dice_;
  RandomOptions options_;
  std::vector<CsgNode> earlier_;
  std::uint32_t shapes_ = 0;
};

/// A scene of one object that is the tree, with a camera that looks at the origin along +z.
inline Scene scene_of(std::vector<CsgNode> objects) {
  Scene s;
  s.settings.image = {1, 1, 1};
  s.settings.camera.projection = Projection::kOrthographic;
  s.settings.camera.eye = {0, 0, -10};
  s.settings.camera.look_at = {0, 0, 0};
  s.settings.camera.up = {0, 1, 0};
  s.settings.camera.width = 1;
  s.materials.push_back({"plain", {}});
  for (CsgNode& o : objects) s.objects.push_back({"", 0, std::move(o)});
  return s;
}

}  // namespace graycube::testing
