// Solids as wholes: laws of set algebra along rays, faces that coincide, maps, the space outside.
#include <algorithm>
#include <cmath>
#include <vector>

#include "catch.hpp"
#include "csg/one_primitive.hpp"
#include "csg/random_rays.hpp"
#include "csg/whole_tree.hpp"
#include "subdivisions/linked_cells.hpp"

using namespace graycube;
using namespace graycube::testing;

namespace {

/// The solids of a scene, asked through the walk.
class Solids {
 public:
  explicit Solids(const Scene& scene)
      : model_(compile_scene(scene)), search_(LinkedCells(model_)) {}
  explicit Solids(CsgNode node) : Solids(scene_of({std::move(node)})) {}
  Solids(const Solids&) = delete;
  Solids& operator=(const Solids&) = delete;

  const Model& model() const { return model_; }
  std::optional<Crossing> first(const Ray& ray, double t0 = 0) {
    return search_.first_crossing(ray, t0, kInf, mailbox_);
  }
  /// All crossings with t ≥ t0, one after another.
  std::vector<WholeCrossing> all(const Ray& ray, double t0 = 0) {
    std::vector<WholeCrossing> r;
    while (const auto c = first(ray, t0)) {
      r.push_back({c->t, c->primitive, c->object, c->entering});
      t0 = std::nextafter(c->t, kInf);
    }
    return r;
  }

 private:
  Model model_;
  WalkingSearch<LinkedCells> search_;
  Mailbox mailbox_;
};

CsgNode minus(CsgNode a, CsgNode b) {
  return operation(Operation::kDifference, {std::move(a), std::move(b)});
}
CsgNode plus(CsgNode a, CsgNode b) {
  return operation(Operation::kUnion, {std::move(a), std::move(b)});
}
CsgNode both(CsgNode a, CsgNode b) {
  return operation(Operation::kIntersection, {std::move(a), std::move(b)});
}
CsgNode complement(CsgNode a) { return operation(Operation::kComplement, {std::move(a)}); }

CsgNode random_leaf(RandomModel& random) {
  return transformed(random.leaf(random.dice().below(kLeafKinds)), random.map());
}

/// The crossings without pieces that are only a few last places long, at an edge.
std::vector<WholeCrossing> without_skins(const std::vector<WholeCrossing>& crossings) {
  std::vector<WholeCrossing> r;
  for (const WholeCrossing& c : crossings) {
    if (!r.empty() && r.back().entering && !c.entering &&
        c.t - r.back().t <= 1e-12 * (1 + std::fabs(c.t))) {
      r.pop_back();
    } else {
      r.push_back(c);
    }
  }
  return r;
}

/// Whether two lists have the same crossings, with parameters equal but for the last places: if a
/// mesh stands twice, its faces coincide with others, and are crossed at the planes that they
/// share.
bool agree(std::vector<WholeCrossing> a, std::vector<WholeCrossing> b, bool with_primitives) {
  a = without_skins(a);
  b = without_skins(b);
  return std::equal(
      a.begin(), a.end(), b.begin(), b.end(), [&](const WholeCrossing& c, const WholeCrossing& d) {
        if (with_primitives && (c.primitive != d.primitive || c.object != d.object)) return false;
        return c.entering == d.entering && std::fabs(c.t - d.t) <= 1e-12 * (1 + std::fabs(c.t));
      });
}

/// Only the parameters of the crossings.
std::vector<double> parameters(const std::vector<WholeCrossing>& crossings) {
  std::vector<double> r;
  for (const WholeCrossing& c : crossings) r.push_back(c.t);
  return r;
}

}  // namespace

TEST_CASE("a solid minus itself is empty, and with its complement it is everything") {
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    INFO("seed " << seed);
    RandomModel random(seed);
    const CsgNode a = random_leaf(random);
    Solids nothing(minus(a, a)), none(both(a, complement(a))), everything(plus(a, complement(a)));
    RandomRays rays(seed, nothing.model());
    for (std::size_t i = 0; i < 4 * kRayCases; ++i) {
      const Ray ray = rays.make(i % kRayCases).ray;
      for (Solids* s : {&nothing, &none, &everything}) REQUIRE_FALSE(s->first(ray, -1e3));
    }
  }
}

TEST_CASE("a solid united or intersected with itself is itself") {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    INFO("seed " << seed);
    RandomModel random(seed);
    const CsgNode a = random_leaf(random);
    Solids once(a), united(plus(a, a)), intersected(both(a, a));
    RandomRays rays(seed, once.model());
    for (std::size_t i = 0; i < 4 * kRayCases; ++i) {
      const Ray ray = rays.make(i % kRayCases).ray;
      const auto expected = once.all(ray, -1e3);
      REQUIRE(agree(united.all(ray, -1e3), expected, true));  // the first of equal children is hit
      REQUIRE(agree(intersected.all(ray, -1e3), expected, true));
    }
  }
}

TEST_CASE("distributing an intersection over a union changes no crossing") {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    INFO("seed " << seed);
    RandomModel random(seed);
    const CsgNode a = random_leaf(random), b = random_leaf(random), c = random_leaf(random);
    Solids left(both(a, plus(b, c))), right(plus(both(a, b), both(a, c)));
    RandomRays rays(seed, left.model());
    for (std::size_t i = 0; i < 4 * kRayCases; ++i) {
      const Ray ray = rays.make(i % kRayCases).ray;
      REQUIRE(agree(left.all(ray, -1e3), right.all(ray, -1e3), false));
    }
  }
}

TEST_CASE("membership along a ray is that of its points") {
  std::size_t inside = 0, compared = 0;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    const Model model = compile_scene(RandomModel(seed).scene());
    const WholeTrees trees(model);
    RandomRays rays(seed, model);
    for (std::size_t i = 0; i < 2 * kRayCases; ++i) {
      const Ray ray = rays.make(i % kRayCases).ray;
      for (std::uint32_t o = 0; o < model.objects.size(); ++o) {
        const auto crossings = trees.crossings(o, ray);
        if (crossings.empty()) continue;
        for (int k = 0; k < 6; ++k) {
          const double t = rays.dice().between(-10, 10);
          const auto next = std::find_if(crossings.begin(), crossings.end(),
                                         [&](const auto& c) { return c.t > t; });
          const bool member = next == crossings.end() ? crossings.back().entering : !next->entering;
          // Near a surface rounding decides: all points around must agree.
          const Vec3 p = ray.at(t);
          bool clear = true;
          for (int n = 0; n < 27; ++n) {
            const Vec3 d{n % 3 - 1.0, n / 3 % 3 - 1.0, n / 9 - 1.0};
            clear = clear && trees.contains_point(o, p + 1e-7 * d) == trees.contains_point(o, p);
          }
          if (!clear) continue;
          ++compared;
          inside += member ? 1 : 0;
          INFO("seed " << seed << ", object " << o << ", t " << t);
          REQUIRE(member == trees.contains_point(o, p));
        }
      }
    }
  }
  CHECK(compared > 20000);
  CHECK(inside > compared / 10);
}

TEST_CASE("a scene moved, scaled, sheared or mirrored with its rays has the same hits") {
  std::size_t hits = 0, grazing = 0, rays_traced = 0;
  for (std::uint64_t seed = 0; seed < 150; ++seed) {
    INFO("seed " << seed);
    const RandomOptions options{
        .coincidences = false, .unbounded = true, .max_objects = 5, .max_tree_depth = 3};
    RandomModel random(seed, options);
    Scene scene = random.scene();
    const Affine map = random.dice().one_in(2)
                           ? random.rigid()
                           : compose(translation(random.place()), random.shear());
    Solids here(scene);
    for (SceneObject& o : scene.objects) o.csg = transformed(o.csg, map);
    Solids there(scene);
    for (int i = 0; i < 60; ++i) {
      const Ray ray{random.dice().point(6), random.dice().unit_vector()};
      const Vec3 direction = map.vector(ray.direction);
      const double stretch = length(direction);
      const auto a = here.first(ray);
      const auto b = there.first({map.point(ray.origin), (1 / stretch) * direction});
      ++rays_traced;
      hits += a ? 1 : 0;
      const bool same = a.has_value() == b.has_value() &&
                        (!a || (a->primitive == b->primitive && a->object == b->object &&
                                a->entering == b->entering &&
                                std::fabs(a->t * stretch - b->t) < 1e-7 * std::fmax(1, b->t)));
      grazing += same ? 0 : 1;
    }
  }
  INFO(grazing << " of " << rays_traced);
  CHECK(4 * hits > rays_traced);
  CHECK(grazing == 0);
}

TEST_CASE("solids that share a face are one solid to a ray across it") {
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    INFO("seed " << seed);
    Dice dice(seed);
    // Heights that aren't whole numbers: bases, tops and corners must still give the same bits.
    const double low = dice.between(-3, -1), middle = dice.between(-0.9, 0.9),
                 high = dice.between(1, 3);
    const auto part = [&](double from, double to) {
      switch (dice.below(5)) {
        case 0: return node_of(BoxShape{{-1, from, -1}, {1, to, 1}});
        case 1: return node_of(CylinderShape{{0, from, 0}, {0, to, 0}, 1});
        case 2: return node_of(CylinderShape{{0, to, 0}, {0, from, 0}, 1});
        case 3: return node_of(ConeShape{{0, from, 0}, 1, {0, to, 0}, 0.6});
        default: return node_of(ConeShape{{0, from, 0}, 0.6, {0, to, 0}, 1});
      }
    };
    const CsgNode lower = part(low, middle), upper = part(middle, high);
    CsgNode stack = plus(lower, upper);
    if (dice.one_in(2)) stack = transformed(stack, translation({0.1, dice.between(-1, 1), 0.2}));
    if (dice.one_in(2)) stack = transformed(stack, rotation({1, 0, 0}, 90));
    Solids united(stack);
    const Affine map = stack.transform.value_or(Affine{});
    const Vec3 axis = map.vector({0, 1, 0});
    for (int i = 0; i < 20; ++i) {
      const Vec3 inner = map.point({dice.between(-0.3, 0.3), middle, dice.between(-0.3, 0.3)});
      const Vec3 d = normalized(axis + 0.05 * dice.unit_vector());
      const auto all = united.all({inner - 9 * d, d});
      REQUIRE(all.size() == 2);
      // With the upper part cut away the lower one is left as it was.
      REQUIRE(all[0].entering);
    }
  }
}

TEST_CASE("cutting flush with a face leaves no skin") {
  const CsgNode block = node_of(BoxShape{{0, 0, 0}, {1, 1, 1}});
  const CsgNode tool = node_of(BoxShape{{0.25, 0.25, 0.5}, {0.75, 0.75, 1}});  // flush with the top
  Solids pocket(minus(block, tool));
  CHECK(parameters(pocket.all({{0.5, 0.5, 3}, {0, 0, -1}})) == std::vector<double>{2.5, 3});
  CHECK(pocket.first({{0.5, 0.5, 3}, {0, 0, -1}})->primitive == 1);
  CHECK(parameters(pocket.all({{0.1, 0.5, 3}, {0, 0, -1}})) == std::vector<double>{2, 3});
  // A drill exactly as long as the block is thick.
  Solids drilled(minus(block, node_of(CylinderShape{{0.5, 0.5, 0}, {0.5, 0.5, 1}, 0.25})));
  CHECK(drilled.all({{0.5, 0.5, 3}, {0, 0, -1}}).empty());
  CHECK(drilled.all({{0.6, 0.5, -3}, {0, 0, 1}}).empty());
}

TEST_CASE("solids that only touch at a face have that face in common only") {
  const CsgNode a = node_of(BoxShape{{0, 0, 0}, {1, 1, 1}}),
                b = node_of(BoxShape{{0, 0, 1}, {1, 1, 2}});
  Solids meeting(both(a, b));
  CHECK(meeting.all({{0.5, 0.5, -3}, {0, 0, 1}}).empty());
  Solids rest(minus(a, b));
  CHECK(parameters(rest.all({{0.5, 0.5, -3}, {0, 0, 1}})) == std::vector<double>{3, 4});
}

TEST_CASE("of coincident objects the first in the file is hit") {
  const CsgNode small = node_of(BoxShape{{0, 0, 0}, {1, 1, 1}}),
                large = node_of(BoxShape{{-1, -1, 0}, {2, 2, 2}});
  Solids two(scene_of({large, small})), other(scene_of({small, large}));
  const Ray ray{{0.5, 0.5, -3}, {0, 0, 1}};
  CHECK(two.first(ray)->object == 0);
  CHECK(other.first(ray)->object == 0);
  CHECK(other.first(ray)->primitive == 0);
  CHECK(other.first({{-0.5, 0.5, -3}, {0, 0, 1}})->object == 1);
}

TEST_CASE("an eye inside a solid sees where it leaves") {
  Solids shell(minus(node_of(SphereShape{{0, 0, 0}, 3}), node_of(SphereShape{{0, 0, 0}, 1})));
  const auto in_wall = shell.first({{2, 0, 0}, {1, 0, 0}});
  REQUIRE(in_wall);
  CHECK(in_wall->t == 1);
  CHECK_FALSE(in_wall->entering);
  const auto in_hollow = shell.first({{0, 0, 0}, {1, 0, 0}});
  REQUIRE(in_hollow);
  CHECK(in_hollow->t == 1);
  CHECK(in_hollow->entering);
  CHECK(in_hollow->primitive == 1);
}

TEST_CASE("a ray that starts on a surface crosses it at zero") {
  Solids box(node_of(BoxShape{{0, 0, 0}, {1, 1, 1}}));
  const auto inwards = box.all({{0.5, 0.5, 0}, {0, 0, 1}});
  CHECK(parameters(inwards) == std::vector<double>{0, 1});
  const auto outwards = box.all({{0.5, 0.5, 1}, {0, 0, 1}});
  REQUIRE(outwards.size() == 1);
  CHECK(outwards[0].t == 0);
  CHECK_FALSE(std::signbit(outwards[0].t));
  CHECK_FALSE(outwards[0].entering);
  CHECK(box.all({{0.5, 0.5, 0}, {0, 0, 1}}, 1e-9).size() == 1);
}

TEST_CASE("floors and complements reach to infinity") {
  const CsgNode floor = node_of(HalfSpaceShape{{0, 1, 0}, 0});
  Solids ground(minus(floor, node_of(SphereShape{{0, 0, 0}, 1})));
  CHECK(ground.first({{5, 2, 0}, {0, -1, 0}})->t == 2);
  const auto pit = ground.first({{0, 2, 0}, {0, -1, 0}});
  CHECK(pit->t == 3);
  CHECK(pit->entering);
  const auto far = ground.first({{0, 1, 0}, normalized(Vec3{1, -1e-6, 0})});
  REQUIRE(far);
  CHECK(far->t == Approx(1e6));
  CHECK_FALSE(ground.first({{0, 1, 0}, {1, 0, 0}}));
  CHECK_FALSE(ground.first({{0, -3, 0}, {0, -1, 0}}));  // for ever inside

  Solids cave(complement(node_of(SphereShape{{0, 0, 0}, 2})));
  const auto wall = cave.first({{0, 0, 0}, {0, 0, 1}});
  CHECK(wall->t == 2);
  CHECK(wall->entering);
  CHECK(cave.all({{0, 0, -5}, {0, 0, 1}}).size() == 2);
}
