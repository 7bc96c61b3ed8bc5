// The subdivision of the screen: rays in its planes and about the eye, entry by links, and primary
// rays that aren't shot.
#include "subdivisions/arnaldi_cells.hpp"

#include "catch.hpp"
#include "subdivisions/camera_rays.hpp"
#include "subdivisions/linked_cells.hpp"

using namespace graycube;
using namespace graycube::testing;

namespace {

constexpr std::uint64_t kScenes = 400;

/// Random scenes, of which every third has an orthographic camera and every fifth many objects.
Scene scene_number(std::uint64_t seed) {
  RandomOptions options;
  if (seed % 5 == 0) options = {.coincidences = true, .unbounded = false, .max_objects = 60};
  return RandomModel(seed, options).scene();
}

template <typename Order>
bool enters_alike(const Bsp& bsp, const OutermostLeaves& outermost, const Order& order, double t,
                  WalkCounts& counts) {
  return &outermost.enter(bsp, order, t, counts) == &leaf_at(bsp, 0, order, t, counts);
}

/// A box of 0.2 before a camera that sees 2 × 2 at its distance, and one behind the camera.
Model small_box(Projection projection) {
  Scene scene = scene_of({node_of(BoxShape{{-0.1, -0.1, -0.1}, {0.1, 0.1, 0.1}}),
                          node_of(BoxShape{{-1, -1, -13}, {1, 1, -12}})});
  Camera& camera = scene.settings.camera;
  camera.projection = projection;
  camera.width = 2;
  camera.fov_degrees = 11.4;
  scene.settings.image = {40, 40, 1};
  return compile_scene(scene);
}

}  // namespace

TEST_CASE("rays in planes through the eye, and from it, cross what the whole trees say") {
  Mailbox mailbox;
  std::size_t crossing = 0;
  for (std::uint64_t seed = 0; seed < kScenes; ++seed) {
    const Scene scene = scene_number(seed);
    const Model model = compile_scene(scene);
    const WholeTrees trees(model, scene);
    const WalkingSearch<ArnaldiCells> search(ArnaldiCells(model, Entry::kExtremal));
    CameraRays rays(seed, model, search.cells());
    for (std::size_t i = 0; i < 20 * CameraRays::kCases; ++i) {
      const RayCase c = rays.make(i % CameraRays::kCases);
      const auto expected = trees.crossings_between(c.ray, c.t0, c.t1);
      crossing += expected.empty() ? 0 : 1;
      const bool same = agrees(
          model, c, expected,
          [&](double t0, double t1) { return search.first_crossing(c.ray, t0, t1, mailbox); },
          [&](double t0, double t1, Rgb& light) {
            return search.pass_light(c.ray, t0, t1, mailbox, light);
          });
      if (!same) FAIL(describe(seed, c));
    }
  }
  CHECK(crossing > 4 * CameraRays::kCases * kScenes);
}

TEST_CASE("links from an outermost leaf region lead to the one that the root leads to") {
  WalkCounts by_links;
  std::size_t entries = 0;
  for (std::uint64_t seed = 0; seed < kScenes; ++seed) {
    const Model model = compile_scene(scene_number(seed));
    const ArnaldiCells cells(model, Entry::kExtremal);
    const LinkedCells linked(model);
    const OutermostLeaves outermost(linked.bsp());
    CameraRays rays(seed, model, cells);
    for (std::size_t i = 0; i < 10 * CameraRays::kCases; ++i) {
      const RayCase c = rays.make(i % CameraRays::kCases);
      INFO(describe(seed, c));
      for (int k = 0; k < 4; ++k) {
        const double t = rays.dice().between(-3, 12);
        REQUIRE(enters_alike(linked.bsp(), outermost, PlaneOrder(c.ray), t, by_links));
        for (const ArnaldiCells::Half& half : cells.halves()) {
          const FrustumOrder order(half.space, c.ray);
          const double z = order.line().origin.z + t * order.line().direction.z;
          if (half.space.is_perspective() && !(z > 1e-6)) continue;
          REQUIRE(enters_alike(half.bsp, half.outermost, order, t, by_links));
          ++entries;
        }
      }
    }
  }
  CHECK(entries > 20 * kScenes * CameraRays::kCases);
  CHECK(by_links.entry_links > entries);
}

TEST_CASE("a primary ray isn't shot where nothing shows") {
  for (const Projection projection : {Projection::kPerspective, Projection::kOrthographic}) {
    const Model model = small_box(projection);
    const CameraFrame frame = CameraFrame::from(model.settings.camera, model.settings.image);
    const WalkingSearch<ArnaldiCells> search(ArnaldiCells(model, Entry::kExtremal));
    std::uint64_t hits = 0, shot = 0;
    for (std::uint32_t y = 0; y < 40; ++y) {
      for (std::uint32_t x = 0; x < 40; ++x) {
        Mailbox mailbox;
        const bool hit =
            search.first_crossing(frame.primary_ray(x, y, 0, 0), 0, kInf, mailbox).has_value();
        hits += hit ? 1 : 0;
        if (mailbox.counts.rays_not_shot == 0) {
          ++shot;
          continue;
        }
        CHECK_FALSE(hit);
        CHECK(mailbox.counts.rays_not_shot == 1);
        CHECK(mailbox.counts.cells_visited == 0);
        CHECK(mailbox.counts.primitives_tested == 0);
      }
    }
    CHECK(hits == 16);
    // An orthographic camera's columns reach behind it, where the second box fills them.
    CHECK(shot == (projection == Projection::kPerspective ? hits : 40 * 40));
  }
}

TEST_CASE("behind the eye space is cut as a camera that looks backward sees it") {
  const Model model = small_box(Projection::kPerspective);
  const ArnaldiCells cells(model, Entry::kExtremal);
  REQUIRE(cells.halves().size() == 2);
  Mailbox mailbox;
  const WalkingSearch<ArnaldiCells> search(cells);
  const Vec3 eye = model.settings.camera.eye;
  // From far behind the box behind the camera through that camera to the box before it.
  const Ray through{eye - Vec3{0, 0, 90}, {0, 0, 1}};
  const auto first = search.first_crossing(through, 0, kInf, mailbox);
  REQUIRE(first.has_value());
  CHECK(first->object == 1);
  const auto second = search.first_crossing(through, first->t + 2, kInf, mailbox);
  REQUIRE(second.has_value());
  CHECK(second->object == 0);
  CHECK(ArnaldiCells(small_box(Projection::kOrthographic), Entry::kDescent).halves().size() == 1);
}
