// What a slice may not say: parts out of range, counts and depths beyond their limits.
#include "proto/model_slice.hpp"

#include "catch.hpp"
#include "proto/bytes.hpp"
#include "proto/model_samples.hpp"

using namespace graycube;
using namespace graycube::test;

using Kind = TreeNode::Kind;

namespace {

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

}  // namespace

TEST_CASE("a broken model is refused, and the error names the part") {
  const BrokenModel changes[] = {
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
  check_refusals(changes);
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
