// Models for the tests of slices: anything that a slice may hold, and a small one to break.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "catch.hpp"
#include "proto/model_slice.hpp"
#include "proto/random.hpp"

namespace graycube::test {

using Bytes = std::vector<std::byte>;

inline Aabb some_box(Random& random) {
  if (random.chance(5)) return Aabb::everything();
  if (random.chance(9)) return Aabb::nothing();
  Aabb box{random.vec(), random.vec()};
  if (random.chance(3)) box.hi.y = kInf;
  return box;
}

inline Primitive some_primitive(Random& random, const Model& model) {
  Primitive p;
  p.kind = static_cast<PrimitiveKind>(random.below(kPrimitiveKinds));
  p.material = static_cast<std::uint32_t>(random.below(model.materials.size()));
  if (p.kind == PrimitiveKind::kPolyhedron && !model.planes.empty()) {
    p.first_plane = static_cast<std::uint32_t>(random.below(model.planes.size()));
    p.plane_count =
        static_cast<std::uint32_t>(1 + random.below(model.planes.size() - p.first_plane));
  }
  if (p.kind == PrimitiveKind::kMesh)
    p.mesh = static_cast<std::uint32_t>(random.below(model.meshes.size()));
  if (csg::has_outline(p.kind))
    p.outline = static_cast<std::uint32_t>(random.below(model.outlines.size()));
  for (double& v : p.v) v = random.chance(2) ? 0.0 : random.any_finite();
  if (random.chance(2)) {
    for (auto& row : p.to_local.m) {
      for (double& v : row) v = random.any_finite();
    }
  }
  p.bounds = some_box(random);
  return p;
}

/// A mesh that isn't closed, which a slice may hold.
inline Mesh some_mesh(Random& random) {
  TriangleMesh m;
  for (std::uint64_t n = 1 + random.below(5); n > 0; --n) m.points.push_back(random.vec());
  const auto point = [&] { return static_cast<std::uint32_t>(random.below(m.points.size())); };
  for (std::uint64_t n = 1 + random.below(9); n > 0; --n)
    m.triangles.push_back({point(), point(), point()});
  return Mesh(std::move(m));
}

inline Outline some_outline(Random& random) {
  OutlineLoops loops(1 + random.below(3));
  for (OutlineLoop& loop : loops) {
    loop.resize(3 * (1 + random.below(5)));
    for (OutlinePoint& p : loop) p = {random.uniform(0, 1), random.uniform(-1, 1)};
  }
  return Outline(std::move(loops));
}

/// Appends a tree of at most `depth` levels.
inline void append_tree(Random& random, Model& model, int depth) {
  const std::size_t root = model.nodes.size();
  if (depth == 1 || random.chance(3)) {
    const auto primitive = static_cast<std::uint32_t>(random.below(model.primitives.size()));
    model.nodes.push_back(
        {random.chance(3) ? TreeNode::Kind::kInvertedLeaf : TreeNode::Kind::kLeaf, primitive, 1});
    return;
  }
  model.nodes.push_back({random.chance(2) ? TreeNode::Kind::kAnd : TreeNode::Kind::kOr, 0, 1});
  for (std::uint64_t n = 1 + random.below(4); n > 0; --n) append_tree(random, model, depth - 1);
  model.nodes[root].size = static_cast<std::uint32_t>(model.nodes.size() - root);
}

inline RenderSettings some_settings(Random& random) {
  RenderSettings s;
  s.image = {static_cast<std::uint32_t>(1 + random.below(4096)),
             static_cast<std::uint32_t>(1 + random.below(4096)),
             static_cast<std::uint32_t>(1 + random.below(64))};
  s.camera = {random.chance(2) ? Projection::kPerspective : Projection::kOrthographic,
              {0, 2, random.uniform(-9, -1)},
              {random.uniform(-1, 1), 0, 0},
              {0, 1, 0},
              random.uniform(1, 179),
              random.uniform(0.1, 9),
              random.chance(2) ? Handedness::kLeft : Handedness::kRight,
              {random.uniform(0, 1), random.uniform(0, 1)},
              InsideView::kExit};
  if (s.camera.projection == Projection::kOrthographic && random.chance(2)) {
    s.camera.inside = InsideView::kEntry;
  }
  s.aovs = AovSet::from_bits(static_cast<std::uint8_t>(random.below(16)));
  s.background = random.rgb();
  s.ambient = random.rgb();
  s.max_depth = static_cast<std::uint32_t>(random.below(kMaxDepth + 1));
  s.min_weight = random.not_negative();
  for (std::uint64_t n = random.below(4); n > 0; --n) {
    s.lights.push_back(
        {random.vec(), random.rgb(), random.chance(2) ? Falloff::kNone : Falloff::kInverseSquare,
         random.chance(2), Vec3{random.uniform(-1, 1), 1, 0}, random.uniform(0, 180)});
  }
  return s;
}

constexpr ShadingModel kModels[] = {ShadingModel::kPhong, ShadingModel::kTorranceSparrow,
                                    ShadingModel::kHallGreenberg, ShadingModel::kRt,
                                    ShadingModel::kRtLamp};

inline Affine some_map(Random& random) {
  Affine map;
  for (auto& row : map.m) {
    for (double& v : row) v = random.any_finite();
  }
  return map;
}

inline Chart some_chart(Random& random) {
  Chart c;
  c.kind = static_cast<ChartKind>(random.below(kChartKinds));
  for (EndChart& end : c.ends) end = static_cast<EndChart>(random.below(kEndCharts));
  for (double& v : c.top_radii) v = random.not_negative();
  const std::size_t most = most_maps_of(c.kind);
  for (std::size_t i = 0; i < most && (i == 0 || random.below(4) > 0); ++i)
    c.maps.push_back(some_map(random));
  return c;
}

inline Pattern some_pattern(Random& random) {
  Pattern p;
  p.kind = static_cast<PatternKind>(random.below(kPatternKinds));
  if (p.kind == PatternKind::kNone) return p;
  p.to_pattern = some_map(random);
  p.chart = some_chart(random);
  for (Rgb& c : p.colors) c = random.rgb();
  for (double& v : p.thresholds) v = random.any_finite();
  p.octaves = {random.uniform(0, kMaxOctaves), random.uniform(0.1, 9), random.any_finite()};
  return p;
}

/// Gives a material of Torrance–Sparrow's or Hall–Greenberg's model its optics.
inline void add_optics(Random& random, Material& m) {
  for (double* share : {&m.diffuse, &m.specular, &m.reflect}) *share = random.uniform(0, 1);
  const auto colour = [&](double lo, double hi) {
    return Rgb{random.uniform(lo, hi), random.uniform(lo, hi), random.uniform(lo, hi)};
  };
  m.optics = {{m.ior, m.ior, m.ior},
              {0, 0, 0},
              random.rgb(),
              random.uniform(0.01, 1),
              random.not_negative()};
  if (random.chance(2)) return;
  m.transmit = 0;
  m.optics.index = colour(0.1, 3);
  m.optics.absorption = colour(0, 9);
}

inline Model some_model(std::uint64_t seed) {
  Random random(seed);
  Model model;
  model.settings = some_settings(random);
  model.delta = random.not_negative();
  for (std::uint64_t n = 1 + random.below(3); n > 0; --n) {
    model.materials.push_back({random.rgb(), random.not_negative(), random.not_negative(),
                               random.not_negative(), random.not_negative(), random.not_negative(),
                               random.uniform(0, 1), random.uniform(0.1, 3),
                               kModels[random.below(5)], some_pattern(random)});
    if (has_fresnel(model.materials.back())) add_optics(random, model.materials.back());
  }
  for (std::uint64_t n = random.below(5); n > 0; --n)
    model.planes.push_back({random.vec(), random.any_finite()});
  for (std::uint64_t n = 1 + random.below(2); n > 0; --n) model.meshes.push_back(some_mesh(random));
  for (std::uint64_t n = 1 + random.below(3); n > 0; --n)
    model.outlines.push_back(some_outline(random));
  for (std::uint64_t n = 1 + random.below(6); n > 0; --n) {
    model.primitives.push_back(some_primitive(random, model));
  }
  std::uint32_t id = 0;
  for (std::uint64_t n = random.below(4); n > 0; --n) {
    Object object;
    object.id = id + static_cast<std::uint32_t>(random.below(5));
    object.first_node = static_cast<std::uint32_t>(model.nodes.size());
    append_tree(random, model, 4);
    object.node_count = static_cast<std::uint32_t>(model.nodes.size()) - object.first_node;
    object.bounds = some_box(random);
    id = object.id + 1;
    model.objects.push_back(object);
  }
  return model;
}

/// Two objects, (0 ∧ (1 ∨ ¬0)) and 1: nodes 0 … 4 and 5.
inline Model small_model() {
  Model model;
  model.settings.image = {4, 3, 1};
  model.settings.camera = {Projection::kPerspective, {0, 0, -5}, {0, 0, 0},        {0, 1, 0}, 40, 0,
                           Handedness::kRight,       {0.5, 0.5}, InsideView::kExit};
  model.materials.resize(1);
  model.planes = {{{1, 0, 0}, 2}, {{0, 1, 0}, 3}};
  model.meshes.emplace_back(TriangleMesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}},
                                         {{0, 1, 2}, {2, 1, 0}},
                                         {{{0, 0, 1}, 0}},
                                         {TriangleMesh::kOwnPlane, 0}});
  model.primitives.resize(2);
  model.primitives[0].v = {1, 2, 3, 0.5, 0, 0};
  model.primitives[0].bounds = {{0.5, 1.5, 2.5}, {1.5, 2.5, 3.5}};
  model.primitives[1].kind = PrimitiveKind::kPolyhedron;
  model.primitives[1].plane_count = 2;
  model.nodes = {{TreeNode::Kind::kAnd, 0, 5},          {TreeNode::Kind::kLeaf, 0, 1},
                 {TreeNode::Kind::kOr, 0, 3},           {TreeNode::Kind::kLeaf, 1, 1},
                 {TreeNode::Kind::kInvertedLeaf, 0, 1}, {TreeNode::Kind::kLeaf, 1, 1}};
  model.objects = {{2, 0, 5, {}}, {7, 5, 1, {}}};
  return model;
}

inline ModelError error_of(const Bytes& bytes) {
  auto result = decode_model(bytes);
  REQUIRE(std::holds_alternative<ModelError>(result));
  return std::get<ModelError>(result);
}

/// A change of the small model, the part that is then refused, and a word of the reason.
struct BrokenModel {
  const char* where;
  const char* why;
  std::function<void(Model&)> change;
};
inline void check_refusals(std::span<const BrokenModel> changes) {
  REQUIRE(decode_model(encode_model(small_model())).index() == 0);
  for (const auto& [where, why, change] : changes) {
    Model model = small_model();
    change(model);
    const ModelError error = error_of(encode_model(model));
    INFO(where << ": " << why << " expected, " << error.where << ": " << error.why);
    CHECK(error.where == where);
    CHECK(error.why.find(why) != std::string::npos);
  }
}

}  // namespace graycube::test
