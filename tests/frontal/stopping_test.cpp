// Preparations that nobody waits for any more.
#include <algorithm>
#include <atomic>
#include <functional>
#include <random>

#include "catch.hpp"
#include "coincidence/coincidence.hpp"
#include "csg/random_model.hpp"
#include "formats/graycube/write_scene.hpp"
#include "frontal/prepared.hpp"
#include "mesh/close_mesh.hpp"
#include "mesh/edges.hpp"
#include "mesh/join_points.hpp"
#include "mesh/tree.hpp"
#include "proto/model_slice.hpp"
#include "scene/compile_scene.hpp"
#include "stop_point.hpp"
#include "stoppable_sort.hpp"

using namespace graycube;
using namespace graycube::testing;

TEST_CASE("work on a thread stops at the next point if its flag says so, and only then") {
  std::atomic<bool> stops{false};
  stop_if_asked();
  {
    const Stoppable stoppable(stops);
    stop_if_asked();
    stops = true;
    CHECK_THROWS_AS(stop_if_asked(), WorkStopped);
    {
      const std::atomic<bool> goes_on{false};
      const Stoppable inner(goes_on);
      stop_if_asked();
    }
    CHECK_THROWS_AS(stop_if_asked(), WorkStopped);
  }
  stop_if_asked();
}

namespace {

/// How often the clock of a preparation was read until it stopped, if that was asked for when the
/// clock was read for the `last`th time: before the scene is read, and before it is cut.
int stopped_at(const PreparationWork& work, int last) {
  std::atomic<bool> stops{false};
  const Stoppable stoppable(stops);
  int asked = 0;
  CHECK_THROWS_AS(prepare(work,
                          [&] {
                            if (++asked == last) stops = true;
                            return 0.0;
                          }),
                  WorkStopped);
  return asked;
}

/// Whether work ends as soon as it is asked to, and else comes to its end.
template <typename Work>
void check_stops(const Work& work) {
  std::atomic<bool> stops{true};
  const Stoppable stoppable(stops);
  CHECK_THROWS_AS(work(), WorkStopped);
  stops = false;
  CHECK_NOTHROW(work());
}

/// A tetrahedron of triangles, with two of its faces turned.
PolygonMesh tetrahedron() {
  PolygonMesh mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  mesh.corners = {0, 1, 2, 0, 1, 3, 1, 2, 3, 2, 0, 3};
  mesh.face_ends = {3, 6, 9, 12};
  return mesh;
}

}  // namespace

TEST_CASE("a preparation that is stopped ends without a result, wherever it is") {
  const std::string text = write_scene_text(RandomModel(3).scene());
  PreparationWork work = work_of(text);
  work.options.algorithm = Algorithm::kMacro;
  // While it reads the text; the careful parser reads what the fast one gives up at.
  CHECK(stopped_at(work, 1) == 1);
  CHECK(stopped_at(work_of(text + "]"), 1) == 1);
  // While it cuts the scene.
  CHECK(stopped_at(work, 2) == 2);
  CHECK(prepare(work, [] { return 0.0; }).scene);
}

TEST_CASE("long work on a scene that was read stops when it is asked to") {
  const Scene scene = RandomModel(3).scene();
  check_stops([&] { compile_scene(scene); });
  const Model model = compile_scene(scene);
  check_stops([&] { encode_model(model); });
  check_stops([&] {
    Model moved = model;
    unify_coincident_surfaces(moved, std::vector<Exactness>(model.primitives.size()));
  });
}

TEST_CASE("long work on a mesh stops when it is asked to") {
  check_stops([] { closed_mesh(tetrahedron()); });
  const auto mesh = std::get<TriangleMesh>(closed_mesh(tetrahedron()));
  check_stops([&] { closed_mesh(mesh); });
  check_stops([&] { const MeshEdges edges(mesh.triangles); });
  check_stops([&] {
    auto triangles = mesh.triangles;
    agree_on_orientation(triangles);
  });
  check_stops([&] { joined_points(mesh.points, std::vector<std::uint32_t>{0, 1}, 0.5); });
  check_stops([&] { const MeshTree tree(mesh); });
}

TEST_CASE("a long sort gives what std::sort gives, and stops when it is asked to") {
  std::mt19937 random(5);
  for (const std::size_t count : {std::size_t{0}, std::size_t{9}, 5 * kSortedAtOnce + 3}) {
    std::vector<unsigned> numbers(count);
    for (unsigned& n : numbers) n = static_cast<unsigned>(random() % 1000);
    std::vector<unsigned> expected = numbers;
    std::sort(expected.begin(), expected.end(), std::greater<>{});
    check_stops([&] { stoppable_sort(std::span(numbers), std::greater<>{}); });
    CHECK(numbers == expected);
  }
}
