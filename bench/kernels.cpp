// Google Benchmark micro-benchmarks of the hot kernels: intersection and normal of every kind of
// primitive, first crossings and shadow rays through whole scenes, the highlight's power, reading,
// compiling, building, light as it travels.
#include <benchmark/benchmark.h>

#include <array>
#include <cmath>
#include <string>
#include <variant>
#include <vector>

#include "bench/dice.hpp"
#include "bench/scene_families.hpp"
#include "csg/build_primitive.hpp"
#include "csg/kinds.hpp"
#include "formats/graycube/read_scene.hpp"
#include "formats/graycube/write_scene.hpp"
#include "geometry/infinity.hpp"
#include "geometry/portable_math.hpp"
#include "mesh/close_mesh.hpp"
#include "proto/batch.hpp"
#include "scene/compile_scene.hpp"
#include "scene/outline_solids.hpp"
#include "trace/domain.hpp"

namespace graycube::bench {
namespace {

constexpr std::size_t kRays = 1024;

/// Cuts a triangle of the unit sphere into four, and each of these again.
void add_facets(PolygonMesh& mesh, const Vec3& a, const Vec3& b, const Vec3& c, int times) {
  if (times == 0) {
    const auto n = static_cast<std::uint32_t>(mesh.points.size());
    mesh.points.insert(mesh.points.end(), {a, b, c});
    mesh.add_face(std::array{n, n + 1, n + 2});
    return;
  }
  const Vec3 ab = normalized(a + b), bc = normalized(b + c), ca = normalized(c + a);
  add_facets(mesh, a, ab, ca, times - 1);
  add_facets(mesh, b, bc, ab, times - 1);
  add_facets(mesh, c, ca, bc, times - 1);
  add_facets(mesh, ab, bc, ca, times - 1);
}

/// An octahedron refined to 8 · 4⁵ triangles.
TriangleMesh ball_mesh() {
  PolygonMesh mesh;
  for (const double x : {-1.0, 1.0}) {
    for (const double y : {-1.0, 1.0}) {
      for (const double z : {-1.0, 1.0}) {
        const bool is_turned = x * y * z < 0;
        add_facets(mesh, {x, 0, 0}, is_turned ? Vec3{0, 0, z} : Vec3{0, y, 0},
                   is_turned ? Vec3{0, y, 0} : Vec3{0, 0, z}, 5);
      }
    }
  }
  return std::get<TriangleMesh>(closed_mesh(mesh));
}

/// One primitive of each kind, each about 1 in radius about the origin.
struct Specimen {
  explicit Specimen(PrimitiveKind kind) {
    const Affine none;
    Affine skewed = rotation({1, 2, 3}, 40);
    skewed.m[0][1] += 0.2;
    switch (kind) {
      case PrimitiveKind::kSphere: primitive = build_sphere(none, {}, 1); break;
      case PrimitiveKind::kEllipsoid: primitive = build_sphere(skewed, {}, 1); break;
      case PrimitiveKind::kBox: primitive = build_box(none, {-1, -1, -1}, {1, 1, 1}); break;
      case PrimitiveKind::kParallelepiped:
        primitive = build_box(skewed, {-1, -1, -1}, {1, 1, 1});
        break;
      case PrimitiveKind::kCylinder:
        primitive = build_cylinder(none, {0, -1, 0}, {0, 1, 0}, 1);
        break;
      case PrimitiveKind::kCone: primitive = build_cone(none, {0, -1, 0}, 1, {0, 1, 0}, 0.3); break;
      case PrimitiveKind::kTorus: primitive = build_torus(none, {}, {0, 1, 0}, 0.8, 0.3); break;
      case PrimitiveKind::kHalfSpace: primitive = build_half_space(none, {{0, 1, 0}, 0.2}); break;
      case PrimitiveKind::kEllipticCone:
        primitive =
            build_elliptic_cone(none, {0, -1, 0}, {0.2, 1, 0}, {1, 0, 0}, {0, 0, 0.7}, 0.4, 0.6);
        break;
      case PrimitiveKind::kEllipticTorus:
        primitive = build_elliptic_torus(none, {}, {0, 1, 0}, 0.7, 0.3, 0.1, 0.2);
        break;
      case PrimitiveKind::kQuadric:  // the paraboloid y ≥ x² + z² − 1, cut at y = 1
        primitive = build_quadric(none, {1, 1, 0, -1}, {-1.5, -1.5, -1}, {1.5, 1.5, 1}, planes);
        break;
      case PrimitiveKind::kMesh: primitive = build_mesh(none, ball_mesh(), meshes); break;
      case PrimitiveKind::kLathe: primitive = build_lathe(none, stock.of(vase_outline)); break;
      case PrimitiveKind::kSweep:
        primitive = build_sweep(none, stock.of(vase_outline), -0.5, 1);
        break;
      case PrimitiveKind::kPolyhedron: {
        const std::array<Plane, 4> faces{
            {{{1, 1, 1}, 1}, {{-1, -1, 1}, 1}, {{-1, 1, -1}, 1}, {{1, -1, -1}, 1}}};
        primitive = build_polyhedron(none, faces, planes);
        break;
      }
    }
  }
  PrimitiveData data() const { return {planes, meshes, outlines}; }

  Primitive primitive;
  std::vector<Plane> planes;
  std::vector<Mesh> meshes;
  std::vector<Outline> outlines;
  OutlineStock stock{outlines};
  /// A vase with a wall, or its half seen from the side.
  OutlineLoops vase_outline{{{0, -0.9},
                             {0.3, -0.9},
                             {0.5, -0.9},
                             {0.6, -0.6},
                             {1, 0},
                             {0.2, 0.4},
                             {0.5, 0.9},
                             {0.45, 0.9},
                             {0.42, 0.9},
                             {0.4, 0.9},
                             {0.1, 0.4},
                             {0.9, 0},
                             {0.5, -0.6},
                             {0.3, -0.8},
                             {0.2, -0.8},
                             {0, -0.8},
                             {0, -0.82},
                             {0, -0.86}}};
};

/// Rays about the origin; about two of three hit what Specimen makes.
std::vector<Ray> rays_about_the_origin() {
  Dice dice(1987);
  std::vector<Ray> rays;
  while (rays.size() < kRays) {
    const Vec3 from = 8 * dice.direction();
    rays.push_back({from, normalized(dice.point_between({-1, -1, -1}, {1, 1, 1}) - from)});
  }
  return rays;
}

void spans_of_kind(benchmark::State& state, PrimitiveKind kind) {
  const Specimen specimen(kind);
  const std::vector<Ray> rays = rays_about_the_origin();
  std::size_t i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(spans_along(specimen.primitive, specimen.data(), rays[i++ % kRays]));
  }
  state.SetItemsProcessed(state.iterations());
}

void normal_of_kind(benchmark::State& state, PrimitiveKind kind) {
  const Specimen specimen(kind);
  std::vector<std::pair<Ray, double>> hits;
  for (const Ray& ray : rays_about_the_origin()) {
    const Spans spans = spans_along(specimen.primitive, specimen.data(), ray);
    if (spans.count > 0 && std::isfinite(spans.interval[0].enter)) {
      hits.emplace_back(ray, spans.interval[0].enter);
    }
  }
  std::size_t i = 0;
  for (auto _ : state) {
    const auto& [ray, t] = hits[i++ % hits.size()];
    benchmark::DoNotOptimize(outward_normal(specimen.primitive, specimen.data(), ray, t));
  }
  state.SetItemsProcessed(state.iterations());
}

void highlight_power(benchmark::State& state) {
  Dice dice(1);
  std::array<double, kRays> bases{};
  for (double& base : bases) base = dice.between(0, 1);
  std::size_t i = 0;
  for (auto _ : state) benchmark::DoNotOptimize(portable_pow(bases[i++ % kRays], 30));
}
BENCHMARK(highlight_power);

struct Subject {
  const char* name;
  Family family;
  std::uint32_t size;
};
constexpr std::array<Subject, 5> kSubjects{{{"csg1k", Family::kCsg, 1000},
                                            {"csg10k", Family::kCsg, 10'000},
                                            {"flake4", Family::kFlake, 4},
                                            {"menger3", Family::kMenger, 3},
                                            {"deepcsg2000", Family::kDeepCsg, 2000}}};
constexpr std::uint32_t kSide = 128;
constexpr std::uint64_t kSeed = 1987;

struct Lit {
  Ray ray;
  double t0, t1;
};

std::vector<Ray> primary_rays(const Domain& domain) {
  std::vector<Ray> rays;
  for (std::uint32_t y = 0; y < kSide; ++y) {
    for (std::uint32_t x = 0; x < kSide; ++x)
      rays.push_back(domain.frame().primary_ray(x, y, 0, 0));
  }
  return rays;
}

void first_crossings(benchmark::State& state, const Subject& subject) {
  const Domain domain(compile_scene(make_scene(subject.family, subject.size, kSeed, kSide)));
  const std::vector<Ray> rays = primary_rays(domain);
  CrossingScratch scratch;
  std::size_t i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(domain.first_crossing(rays[i++ % rays.size()], 0, kInf, scratch));
  }
  state.SetItemsProcessed(state.iterations());
}

void shadow_rays(benchmark::State& state, const Subject& subject) {
  const Domain domain(compile_scene(make_scene(subject.family, subject.size, kSeed, kSide)));
  CrossingScratch scratch;
  std::vector<Lit> rays;
  for (const Ray& ray : primary_rays(domain)) {
    const auto hit = domain.first_crossing(ray, 0, kInf, scratch);
    if (!hit) continue;
    const Vec3 p = ray.at(hit->t);
    for (const PointLight& light : domain.settings().lights) {
      const Vec3 to_light = light.position - p;
      rays.push_back({{p, normalized(to_light)}, 1e-9 * max_abs(p), length(to_light)});
    }
  }
  std::size_t i = 0;
  for (auto _ : state) {
    const Lit& lit = rays[i++ % rays.size()];
    Rgb light{1, 1, 1};
    benchmark::DoNotOptimize(domain.pass_light(lit.ray, lit.t0, lit.t1, scratch, light));
  }
  state.SetItemsProcessed(state.iterations());
}

void read_text(benchmark::State& state, const Subject& subject) {
  const std::string text = write_scene_text(make_scene(subject.family, subject.size, kSeed));
  for (auto _ : state) benchmark::DoNotOptimize(read_scene_text(text));
  state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(text.size()));
}

void compile(benchmark::State& state, const Subject& subject) {
  const Scene scene = make_scene(subject.family, subject.size, kSeed);
  std::size_t primitives = 0;
  for (auto _ : state) primitives = compile_scene(scene).primitives.size();
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(primitives));
}

void build(benchmark::State& state, const Subject& subject) {
  const Model model = compile_scene(make_scene(subject.family, subject.size, kSeed));
  for (auto _ : state) benchmark::DoNotOptimize(Domain(model).model().objects.size());
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(model.primitives.size()));
}

/// A batch as a node sends it: 8192 pixels, blocks of 8 × 8 beside each other in a picture 1024
/// wide.
std::vector<Contribution> lit_blocks() {
  Dice dice(kSeed);
  std::vector<Contribution> light;
  const auto component = [&] { return static_cast<std::int64_t>(dice.between(0, 1) * kFixedOne); };
  for (std::uint32_t block = 0; block < 128; ++block) {
    for (std::uint32_t i = 0; i < 64; ++i) {
      light.push_back(
          {8 * block + i % 8 + 1024 * (i / 8), {component(), component(), component()}});
    }
  }
  return light;
}

constexpr BatchLimits kBatchLimits{.pixel_count = 1u << 20, .tile_count = 1, .nodes = 1};

void light_out(benchmark::State& state) {
  const auto light = lit_blocks();
  for (auto _ : state) benchmark::DoNotOptimize(encode_contributions({}, {}, light));
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(light.size()));
}

void light_in(benchmark::State& state) {
  const auto light = lit_blocks();
  const auto batch = encode_contributions({}, {}, light);
  std::vector<TileCredit> credits;
  std::vector<Contribution> again;
  for (auto _ : state)
    benchmark::DoNotOptimize(decode_contributions(batch, kBatchLimits, credits, again));
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(light.size()));
}

void register_all() {
  benchmark::RegisterBenchmark("light/encode", light_out);
  benchmark::RegisterBenchmark("light/decode", light_in);
  for (const csg::KindTraits& traits : csg::kKinds) {
    const PrimitiveKind kind = traits.kind;
    const std::string name(traits.name);
    benchmark::RegisterBenchmark(("spans_along/" + name).c_str(), spans_of_kind, kind);
    benchmark::RegisterBenchmark(("outward_normal/" + name).c_str(), normal_of_kind, kind);
  }
  for (const Subject& s : kSubjects) {
    const std::string name = s.name;
    benchmark::RegisterBenchmark(("first_crossing/" + name).c_str(), first_crossings, s);
    benchmark::RegisterBenchmark(("pass_light/" + name).c_str(), shadow_rays, s);
    benchmark::RegisterBenchmark(("read_scene/" + name).c_str(), read_text, s);
    benchmark::RegisterBenchmark(("compile_scene/" + name).c_str(), compile, s);
    benchmark::RegisterBenchmark(("build/" + name).c_str(), build, s);
  }
}

}  // namespace
}  // namespace graycube::bench

int main(int argc, char** argv) {
  graycube::bench::register_all();
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
