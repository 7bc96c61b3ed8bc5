#include "proto/model_slice.hpp"

#include <functional>

#include "catch.hpp"
#include "fuzz/proto_fuzz.hpp"
#include "proto/bytes.hpp"
#include "proto/random.hpp"

using namespace graycube;
using graycube::test::Random;

namespace {

using Bytes = std::vector<std::byte>;
using Kind = TreeNode::Kind;

Aabb some_box(Random& random) {
  if (random.chance(5)) return Aabb::everything();
  if (random.chance(9)) return Aabb::nothing();
  Aabb box{random.vec(), random.vec()};
  if (random.chance(3)) box.hi.y = kInf;
  return box;
}

Primitive some_primitive(Random& random, const Model& model) {
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
Mesh some_mesh(Random& random) {
  TriangleMesh m;
  for (std::uint64_t n = 1 + random.below(5); n > 0; --n) m.points.push_back(random.vec());
  const auto point = [&] { return static_cast<std::uint32_t>(random.below(m.points.size())); };
  for (std::uint64_t n = 1 + random.below(9); n > 0; --n)
    m.triangles.push_back({point(), point(), point()});
  return Mesh(std::move(m));
}

Outline some_outline(Random& random) {
  OutlineLoops loops(1 + random.below(3));
  for (OutlineLoop& loop : loops) {
    loop.resize(3 * (1 + random.below(5)));
    for (OutlinePoint& p : loop) p = {random.uniform(0, 1), random.uniform(-1, 1)};
  }
  return Outline(std::move(loops));
}

/// Appends a tree of at most `depth` levels.
void append_tree(Random& random, Model& model, int depth) {
  const std::size_t root = model.nodes.size();
  if (depth == 1 || random.chance(3)) {
    const auto primitive = static_cast<std::uint32_t>(random.below(model.primitives.size()));
    model.nodes.push_back({random.chance(3) ? Kind::kInvertedLeaf : Kind::kLeaf, primitive, 1});
    return;
  }
  model.nodes.push_back({random.chance(2) ? Kind::kAnd : Kind::kOr, 0, 1});
  for (std::uint64_t n = 1 + random.below(4); n > 0; --n) append_tree(random, model, depth - 1);
  model.nodes[root].size = static_cast<std::uint32_t>(model.nodes.size() - root);
}

RenderSettings some_settings(Random& random) {
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

Affine some_map(Random& random) {
  Affine map;
  for (auto& row : map.m) {
    for (double& v : row) v = random.any_finite();
  }
  return map;
}

Chart some_chart(Random& random) {
  Chart c;
  c.kind = static_cast<ChartKind>(random.below(kChartKinds));
  for (EndChart& end : c.ends) end = static_cast<EndChart>(random.below(kEndCharts));
  for (double& v : c.top_radii) v = random.not_negative();
  const std::size_t most = most_maps_of(c.kind);
  for (std::size_t i = 0; i < most && (i == 0 || random.below(4) > 0); ++i)
    c.maps.push_back(some_map(random));
  return c;
}

Pattern some_pattern(Random& random) {
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
void add_optics(Random& random, Material& m) {
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

Model some_model(std::uint64_t seed) {
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
Model small_model() {
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
  model.nodes = {{Kind::kAnd, 0, 5},  {Kind::kLeaf, 0, 1},         {Kind::kOr, 0, 3},
                 {Kind::kLeaf, 1, 1}, {Kind::kInvertedLeaf, 0, 1}, {Kind::kLeaf, 1, 1}};
  model.objects = {{2, 0, 5, {}}, {7, 5, 1, {}}};
  return model;
}

ModelError error_of(const Bytes& bytes) {
  auto result = decode_model(bytes);
  REQUIRE(std::holds_alternative<ModelError>(result));
  return std::get<ModelError>(result);
}

}  // namespace

TEST_CASE("any model comes back equal, and bit for bit the same when encoded again") {
  for (std::uint64_t seed = 0; seed < 500; ++seed) {
    INFO("seed " << seed);
    const Model model = some_model(seed);
    const Bytes bytes = encode_model(model);
    CHECK(bytes.size() == encoded_model_bytes(model));
    const auto result = decode_model(bytes);
    if (const auto* error = std::get_if<ModelError>(&result))
      FAIL(error->where << ": " << error->why);
    CHECK(std::get<Model>(result) == model);
    // Equality takes −0 for +0; the bytes don't.
    CHECK(encode_model(std::get<Model>(result)) == bytes);
  }
}

TEST_CASE("a model without solids, lights or materials comes back") {
  Model model;
  model.settings = small_model().settings;
  const auto result = decode_model(encode_model(model));
  REQUIRE(std::holds_alternative<Model>(result));
  CHECK(std::get<Model>(result) == model);
}

TEST_CASE("a sphere takes 87 bytes: no matrix, no planes") {
  Model model = small_model();
  const std::size_t before = encoded_model_bytes(model);
  model.primitives.push_back(model.primitives[0]);
  CHECK(encoded_model_bytes(model) - before == 7 + 4 * 8 + 6 * 8);
}

TEST_CASE("the header of a model slice lies at the offsets that FORMAT.md gives") {
  const Bytes bytes = encode_model(small_model());
  CHECK(std::memcmp(bytes.data(), "GCM1", 4) == 0);
  CHECK(load_little<std::uint16_t>(bytes.data() + 4) == kModelVersion);
  const std::uint32_t counts[] = {0, 1, 2, 2, 6, 2, 1};
  for (std::size_t i = 0; i < 7; ++i)
    CHECK(load_little<std::uint32_t>(bytes.data() + 8 + 4 * i) == counts[i]);
  CHECK(load_little<std::uint32_t>(bytes.data() + 36) == 4);
  CHECK(load_little<std::uint32_t>(bytes.data() + 40) == 3);
  CHECK(load_little<double>(bytes.data() + 52 + 16) == -5);
  // Settings end at 224; a material of 82 bytes, two planes, a mesh of three points, two triangles
  // and a plane, then the first primitive.
  const std::byte* mesh = bytes.data() + 224 + 82 + 64;
  CHECK(load_little<std::uint32_t>(mesh) == 3);
  CHECK(load_little<std::uint32_t>(mesh + 4) == 2);
  CHECK(load_little<std::uint32_t>(mesh + 8) == 1);
  CHECK(load_little<double>(mesh + 12 + 24) == 1);
  CHECK(load_little<std::uint32_t>(mesh + 12 + 72 + 4) == 1);
  CHECK(load_little<double>(mesh + 12 + 72 + 24 + 16) == 1);
  CHECK(load_little<std::uint32_t>(mesh + 12 + 72 + 24 + 32) == TriangleMesh::kOwnPlane);
  CHECK(load_little<std::uint32_t>(mesh + 12 + 72 + 24 + 32 + 4) == 0);
  const std::byte* primitive = mesh + 12 + 72 + 24 + 32 + 8;
  CHECK(load_little<std::uint8_t>(primitive) == 0);
  CHECK(load_little<std::uint16_t>(primitive + 1) == (0x0F | 0x80));
  CHECK(load_little<double>(primitive + 7 + 24) == 0.5);
}

/// The chart of a sphere that the first material's pattern gets.
Chart& charted(Model& m) {
  Pattern& pattern = m.materials[0].pattern;
  pattern.kind = PatternKind::kMarble;
  pattern.chart = {};
  pattern.chart.kind = ChartKind::kSphere;
  pattern.chart.maps.resize(1);
  return pattern.chart;
}

/// Makes the first material one of Hall–Greenberg's model, whose index isn't its `ior`.
Material& glaze(Model& m) {
  m.materials[0].model = ShadingModel::kHallGreenberg;
  return m.materials[0];
}

TEST_CASE("a broken model is refused, and the error names the part") {
  using Change = std::function<void(Model&)>;
  const std::tuple<const char*, const char*, Change> changes[] = {
      {"image", "size", [](Model& m) { m.settings.image.width = 0; }},
      {"image", "size",
       [](Model& m) {
         m.settings.image = {16384, 16384, 1};
       }},
      {"image", "samples", [](Model& m) { m.settings.image.samples = 65; }},
      {"camera", "fov", [](Model& m) { m.settings.camera.fov_degrees = 180; }},
      {"camera", "view", [](Model& m) { m.settings.camera.look_at = m.settings.camera.eye; }},
      {"camera", "view",
       [](Model& m) {
         m.settings.camera.up = {0, 0, 3};
       }},
      {"camera", "finite", [](Model& m) { m.settings.camera.eye.x = kInf; }},
      {"camera", "offset", [](Model& m) { m.settings.camera.pixel_offset[1] = -0.5; }},
      {"camera", "offset", [](Model& m) { m.settings.camera.pixel_offset[0] = std::nan(""); }},
      {"camera", "insides", [](Model& m) { m.settings.camera.inside = InsideView::kEntry; }},
      {"camera", "width",
       [](Model& m) { m.settings.camera.projection = Projection::kOrthographic; }},
      {"settings", "range", [](Model& m) { m.settings.max_depth = 1001; }},
      {"settings", "range", [](Model& m) { m.settings.ambient.g = -1; }},
      {"settings", "range", [](Model& m) { m.delta = std::nan(""); }},
      {"light 0", "range",
       [](Model& m) {
         m.settings.lights.push_back({{0, 0, 0}, {-1, 0, 0}, {}});
       }},
      {"light 0", "falloff",
       [](Model& m) {
         m.settings.lights.push_back({{}, {}, static_cast<Falloff>(2)});
       }},
      {"light 0", "beam",
       [](Model& m) {
         m.settings.lights.push_back({{}, {}, Falloff::kNone, true, {0, 0, 1}, 181});
       }},
      {"light 0", "beam",
       [](Model& m) {
         m.settings.lights.push_back({{}, {}, Falloff::kNone, true, {0, 0, 1}, std::nan("")});
       }},
      {"light 0", "beam",
       [](Model& m) {
         m.settings.lights.push_back({{}, {}, Falloff::kNone, true, {0, 0, 0}, 30});
       }},
      {"material 0", "range", [](Model& m) { m.materials[0].transmit = 1.5; }},
      {"material 0", "range", [](Model& m) { m.materials[0].ior = 0; }},
      {"material 0", "range", [](Model& m) { m.materials[0].diffuse = std::nan(""); }},
      {"material 0", "shading",
       [](Model& m) { m.materials[0].model = static_cast<ShadingModel>(3); }},
      {"material 0", "optics", [](Model& m) { glaze(m).optics.roughness = 0; }},
      {"material 0", "optics", [](Model& m) { glaze(m).optics.index.g = 2000; }},
      {"material 0", "optics", [](Model& m) { glaze(m).optics.absorption.b = std::nan(""); }},
      {"material 0", "optics", [](Model& m) { glaze(m).optics.attenuation.r = kInf; }},
      {"material 0", "optics", [](Model& m) { glaze(m).optics.transmit_shininess = -1; }},
      {"material 0", "optics", [](Model& m) { glaze(m).specular = 1.25; }},
      {"material 0", "optics", [](Model& m) { glaze(m).transmit = 0.5; }},
      {"material 255", "media",
       [](Model& m) {
         glaze(m).optics.attenuation = {0, 1, 0};
         m.materials.resize(kMaxMedia + 1, m.materials[0]);
       }},
      {"material 0", "unknown pattern",
       [](Model& m) { m.materials[0].pattern.kind = static_cast<PatternKind>(kPatternKinds); }},
      {"material 0", "unknown chart",
       [](Model& m) { charted(m).kind = static_cast<ChartKind>(kChartKinds); }},
      {"material 0", "chart out of range", [](Model& m) { charted(m).maps.resize(2); }},
      {"material 0", "chart out of range", [](Model& m) { charted(m).maps.clear(); }},
      {"material 0", "chart out of range",
       [](Model& m) {
         charted(m).kind = ChartKind::kFaces;
         charted(m).maps.resize(kMaxChartFaces + 1);
       }},
      {"material 0", "chart out of range",
       [](Model& m) { charted(m).ends[1] = static_cast<EndChart>(kEndCharts); }},
      {"material 0", "chart out of range", [](Model& m) { charted(m).top_radii[0] = -1; }},
      {"material 0", "chart out of range", [](Model& m) { charted(m).maps[0].m[2][3] = kInf; }},
      {"material 0", "pattern out of range",
       [](Model& m) {
         m.materials[0].pattern.kind = PatternKind::kMarble;
         m.materials[0].pattern.octaves.count = 33;
       }},
      {"material 0", "pattern out of range",
       [](Model& m) {
         m.materials[0].pattern.kind = PatternKind::kMarble;
         m.materials[0].pattern.octaves.lacunarity = 0;
       }},
      {"material 0", "pattern out of range",
       [](Model& m) {
         m.materials[0].pattern.kind = PatternKind::kMarble;
         m.materials[0].pattern.to_pattern.m[1][1] = kInf;
       }},
      {"material 0", "pattern out of range",
       [](Model& m) {
         m.materials[0].pattern.kind = PatternKind::kMarble;
         m.materials[0].pattern.colors[2].g = -1;
       }},
      {"material 0", "pattern out of range",
       [](Model& m) {
         m.materials[0].pattern.kind = PatternKind::kCamouflage;
         m.materials[0].pattern.thresholds[1] = std::nan("");
       }},
      {"plane 1", "finite", [](Model& m) { m.planes[1].offset = kInf; }},
      {"primitive 0", "kind",
       [](Model& m) { m.primitives[0].kind = static_cast<PrimitiveKind>(kPrimitiveKinds); }},
      {"primitive 0", "material", [](Model& m) { m.primitives[0].material = 1; }},
      {"primitive 0", "finite", [](Model& m) { m.primitives[0].v[3] = std::nan(""); }},
      {"primitive 0", "finite", [](Model& m) { m.primitives[0].to_local.m[1][2] = kInf; }},
      {"primitive 0", "finite", [](Model& m) { m.primitives[0].bounds.lo.x = std::nan(""); }},
      {"primitive 1", "plane", [](Model& m) { m.primitives[1].plane_count = 3; }},
      {"primitive 1", "plane", [](Model& m) { m.primitives[1].first_plane = 0xFFFFFFFF; }},
      {"primitive 1", "mesh", [](Model& m) { m.primitives[1].mesh = 1; }},
      {"primitive 1", "mesh",
       [](Model& m) {
         m.primitives[1].kind = PrimitiveKind::kMesh;
         m.primitives[1].mesh = 1;
       }},
      {"primitive 1", "mesh",
       [](Model& m) {
         m.meshes.clear();
         m.primitives[1].kind = PrimitiveKind::kMesh;
       }},
      {"mesh 0", "empty",
       [](Model& m) {
         m.meshes[0] = Mesh(TriangleMesh{{{0, 0, 0}}, {}});
       }},
      {"mesh 0", "finite",
       [](Model& m) {
         m.meshes[0] = Mesh(TriangleMesh{{{0, kInf, 0}}, {{0, 0, 0}}});
       }},
      {"mesh 0", "planes",
       [](Model& m) {
         const TriangleMesh& old = m.meshes[0].surface();
         m.meshes[0] = Mesh(
             TriangleMesh{old.points, old.triangles, std::vector<Plane>(3, old.planes[0]), {0, 1}});
       }},
      {"mesh 0", "finite",
       [](Model& m) {
         const TriangleMesh& old = m.meshes[0].surface();
         m.meshes[0] =
             Mesh(TriangleMesh{old.points, old.triangles, {{{0, 0, 1}, std::nan("")}}, {0, 0}});
       }},
      {"primitive 1", "outline", [](Model& m) { m.primitives[1].outline = 1; }},
      {"primitive 0", "outline", [](Model& m) { m.primitives[0].kind = PrimitiveKind::kLathe; }},
      {"outline 0", "empty", [](Model& m) { m.outlines = {Outline(OutlineLoops{})}; }},
      {"outline 0", "segments",
       [](Model& m) {
         m.outlines = {Outline(OutlineLoops{{{0, 0}, {0, 1}, {1, 1}}, {}})};
       }},
      {"outline 0", "range",
       [](Model& m) {
         m.outlines = {Outline(OutlineLoops{{{0, 0}, {0, 1.5}, {1, 1}}})};
       }},
      {"outline 0", "range",
       [](Model& m) {
         m.outlines = {Outline(OutlineLoops{{{0, 0}, {0, std::nan("")}, {1, 1}}})};
       }},
      {"node 1", "primitive", [](Model& m) { m.nodes[1].primitive = 2; }},
      {"node 2", "children", [](Model& m) { m.nodes[2].size = 1; }},
      {"node 2", "parent", [](Model& m) { m.nodes[2].size = 4; }},
      {"node 0", "root", [](Model& m) { m.nodes[0].size = 4; }},
      {"node 5", "kind", [](Model& m) { m.nodes[5].kind = static_cast<Kind>(4); }},
      {"object 1", "increase", [](Model& m) { m.objects[1].id = 2; }},
      {"object 0", "follow", [](Model& m) { m.objects[0].first_node = 1; }},
      {"object 1", "follow", [](Model& m) { m.objects[1].first_node = 4; }},
      {"object 1", "nodes", [](Model& m) { m.objects[1].node_count = 2; }},
      {"object 1", "nodes", [](Model& m) { m.objects[1].node_count = 0; }},
      {"object 1", "bounds", [](Model& m) { m.objects[1].bounds.hi.z = std::nan(""); }},
      {"nodes", "no object", [](Model& m) { m.objects.pop_back(); }},
  };
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

TEST_CASE("a mesh's counts and indices are checked") {
  const Bytes good = encode_model(small_model());
  constexpr std::size_t kMesh = 224 + 82 + 64;
  const auto why_with = [&](std::size_t at, std::uint32_t value) {
    Bytes bytes = good;
    store_little(bytes.data() + kMesh + at, value);
    const ModelError error = error_of(bytes);
    CHECK(error.where == "mesh 0");
    return error.why;
  };
  CHECK(why_with(0, 0) == "empty");
  CHECK(why_with(0, kMaxModelPoints) == "too short");
  CHECK(why_with(0, kMaxModelPoints + 1) == "a count beyond its limit");
  CHECK(why_with(4, kMaxMeshTriangles + 1) == "a count beyond its limit");
  CHECK(why_with(8, 3) == "more planes than triangles");
  CHECK(why_with(12 + 72, 3) == "no such point");
  CHECK(why_with(12 + 72 + 24 + 32, 1) == "no such plane");
}

TEST_CASE("an outline's counts are checked") {
  Model model = small_model();
  model.meshes.clear();
  model.outlines = {Outline(OutlineLoops{{{0, 0}, {0, 1}, {1, 1}}})};
  model.primitives[0].kind = PrimitiveKind::kSweep;
  const Bytes good = encode_model(model);
  REQUIRE(decode_model(good).index() == 0);
  CHECK(load_little<std::uint16_t>(good.data() + 6) == 1);
  constexpr std::size_t kOutline = 224 + 82 + 64;
  const auto why_with = [&](std::size_t at, std::uint32_t value) {
    Bytes bytes = good;
    store_little(bytes.data() + kOutline + at, value);
    const ModelError error = error_of(bytes);
    CHECK(error.where == "outline 0");
    return error.why;
  };
  CHECK(why_with(0, 0) == "empty");
  CHECK(why_with(0, kMaxOutlineSegments + 1) == "a count beyond its limit");
  CHECK(why_with(4, 0) == "a loop without segments");
  CHECK(why_with(4, kMaxOutlineSegments) == "too short");
  CHECK(why_with(4, kMaxOutlineSegments + 1) == "a count beyond its limit");
}

TEST_CASE("counts beyond the bytes are refused before memory is taken") {
  const Bytes good = encode_model(small_model());
  for (std::size_t field = 0; field < 7; ++field) {
    for (const std::uint32_t count : {1000u, 4000u, 1u << 20, 0xFFFFFFFFu}) {
      Bytes bytes = good;
      store_little(bytes.data() + 8 + 4 * field, count);
      CHECK(error_of(bytes).where == "header");
    }
  }
}

TEST_CASE("trees nested more deeply than the limit are neither sent nor accepted") {
  const auto nested = [](std::uint32_t depth) {
    Model model = small_model();
    model.nodes.clear();
    for (std::uint32_t i = 0; i + 1 < depth; ++i) model.nodes.push_back({Kind::kAnd, 0, depth - i});
    model.nodes.push_back({Kind::kLeaf, 0, 1});
    model.objects = {{0, 0, depth, {}}};
    return model;
  };
  CHECK(fits_model_limits(nested(kMaxModelTreeDepth)));
  CHECK_FALSE(fits_model_limits(nested(kMaxModelTreeDepth + 1)));
  REQUIRE(decode_model(encode_model(nested(kMaxModelTreeDepth))).index() == 0);
  // The same count of nodes, flat, with the deep ones written over them.
  const Model deep = nested(kMaxModelTreeDepth + 1);
  Model flat = deep;
  for (std::size_t i = 1; i < flat.nodes.size(); ++i) flat.nodes[i] = {Kind::kLeaf, 0, 1};
  Bytes bytes = encode_model(flat);
  REQUIRE(decode_model(bytes).index() == 0);
  std::byte* at = bytes.data() + bytes.size() - 60 - 5 * flat.nodes.size();
  for (std::size_t i = 0; i + 1 < deep.nodes.size(); ++i) {
    store_little(at + 5 * i, static_cast<std::uint8_t>(Kind::kAnd));
    store_little(at + 5 * i + 1, deep.nodes[i].size);
  }
  CHECK(error_of(bytes).why == "nested too deeply");
}

TEST_CASE("a model cut anywhere is refused, and so is one with a byte too many") {
  Bytes bytes = encode_model(small_model());
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    CHECK_FALSE(fuzz_model(std::span(bytes).first(size)));
  }
  bytes.push_back(std::byte{0});
  CHECK(error_of(bytes).where == "end");
}

TEST_CASE("mutated models are refused or survive a round trip") {
  int accepted = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const Bytes bytes = encode_model(some_model(seed));
    Random random(seed);
    for (int i = 0; i < 100; ++i) {
      INFO("seed " << seed << ", mutation " << i);
      accepted += fuzz_model(test::mutated(bytes, random)) ? 1 : 0;
    }
  }
  CHECK(accepted > 1000);
}
