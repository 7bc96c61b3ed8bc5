// Preparations that nobody waits for any more.
#include <atomic>

#include "catch.hpp"
#include "csg/random_model.hpp"
#include "formats/graycube/write_scene.hpp"
#include "frontal/preparation/preparation.hpp"
#include "stop_point.hpp"

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

TEST_CASE("a preparation that is stopped while it cuts the scene ends without a result") {
  const std::string text = write_scene_text(RandomModel(3).scene());
  PreparationWork work;
  const auto* bytes = reinterpret_cast<const std::byte*>(text.data());
  work.scene.assign(bytes, bytes + text.size());
  work.options.algorithm = Algorithm::kMacro;
  work.cube = *Hypercube::of_size(4);
  std::atomic<bool> stops{false};
  const Stoppable stoppable(stops);
  int asked = 0;
  // The clock is read before the scene is read, and before it is cut.
  CHECK_THROWS_AS(prepare(work,
                          [&] {
                            if (++asked == 2) stops = true;
                            return 0.0;
                          }),
                  WorkStopped);
  CHECK(asked == 2);
  stops = false;
  CHECK(prepare(work, [] { return 0.0; }).scene);
}

TEST_CASE("a preparation that is stopped while it reads the scene's text ends without a result") {
  const std::string text = write_scene_text(RandomModel(3).scene());
  // Both parsers, as the careful one reads what the fast one gives up at.
  for (const std::string& scene : {text, text + "]"}) {
    PreparationWork work;
    const auto* bytes = reinterpret_cast<const std::byte*>(scene.data());
    work.scene.assign(bytes, bytes + scene.size());
    work.cube = *Hypercube::of_size(4);
    std::atomic<bool> stops{false};
    const Stoppable stoppable(stops);
    int asked = 0;
    CHECK_THROWS_AS(prepare(work,
                            [&] {
                              ++asked;
                              stops = true;
                              return 0.0;
                            }),
                    WorkStopped);
    CHECK(asked == 1);
  }
}
