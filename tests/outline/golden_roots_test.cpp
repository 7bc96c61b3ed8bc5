// Roots that tests/golden/outline_roots.py computed in fractions.
#include <cmath>
#include <vector>

#include "catch.hpp"
#include "outline/samples.hpp"

using namespace graycube;
using namespace graycube::testing;

namespace {

Placed vase() {
  OutlineLoop loop;
  for (const auto& [x, y] : std::initializer_list<std::pair<int, int>>{{0, -14},
                                                                       {5, -14},
                                                                       {9, -13},
                                                                       {10, -9},
                                                                       {16, 1},
                                                                       {3, 6},
                                                                       {8, 14},
                                                                       {7, 14},
                                                                       {6, 15},
                                                                       {6, 14},
                                                                       {1, 6},
                                                                       {13, 1},
                                                                       {8, -8},
                                                                       {6, -11},
                                                                       {2, -11},
                                                                       {0, -11},
                                                                       {0, -12},
                                                                       {0, -13}})
    loop.push_back({x / 16.0, y / 16.0});
  return Placed({loop});
}

Ray ray_of(const Vec3& origin, const Vec3& direction) {
  return {(1.0 / 16) * origin, (1.0 / 16) * direction};
}

const std::vector<Ray> kRays{
    ray_of({-48, 3, 1}, {16, 0, 0}),    ray_of({4, 1, 32}, {0, 0, -1}),
    ray_of({-40, 3, 20}, {40, 1, -21}), ray_of({30, -31, -40}, {-29, 33, 41}),
    ray_of({7, 48, 9}, {1, -40, -1}),   ray_of({2, 1, 0}, {3, 5, 7}),
    ray_of({-33, 2, -9}, {33, 1, 1})};

void compare(const Spans& spans, const std::vector<double>& golden) {
  REQUIRE(2 * static_cast<std::size_t>(spans.count) == golden.size());
  for (std::size_t i = 0; i < golden.size(); ++i) {
    const auto& s = spans.interval[i / 2];
    CHECK(std::fabs((i % 2 == 0 ? s.enter : s.leave) - golden[i]) <= 4e-15 * golden.back());
  }
}

}  // namespace

TEST_CASE("a lathe's roots are those of exact arithmetic") {
  const std::vector<std::vector<double>> golden{{2.37123229267657502582, 2.52553653773587986542,
                                                 3.47446346226412013458, 3.62876770732342497418},
                                                {42.59337126996076933197, 45.68567789268374703534},
                                                {0.78844418804811982586, 0.83873588889291284455,
                                                 1.20088477662370233227, 1.25846902018568904880},
                                                {0.75739889989659288230, 0.79682644386582216243,
                                                 1.10814276997845309260, 1.14546104208298710048},
                                                {},
                                                {-1.71194564473743544157, -1.38178322136479774253,
                                                 0.71457544692530645955, 0.96495036122168566060},
                                                {0.69588720693093352022, 0.77769930964356944505,
                                                 1.22588827658398281715, 1.30811312927282733355}};
  for (std::size_t i = 0; i < kRays.size(); ++i) {
    INFO("ray " << i);
    compare(csg::lathe_spans(vase().place(), kRays[i]), golden[i]);
  }
}

TEST_CASE("a sweep's roots are those of exact arithmetic") {
  const std::vector<std::vector<double>> golden{
      {3.44962128746249845573, 3.59427627896422958107},
      {},
      {1.16478849284078353877, 1.22130229079882888147},
      {0.68055869590355211652, 0.73700478770218079864},
      {0.84982116997146075334, 0.85595250220454796655, 1.05589430764847652879,
       1.17574755059659539613, 1.38130226494529097160, 1.49259743487261202176},
      {1.14057928658129610911, 1.63463824067068629972},
      {1.21463887404500366861, 1.28354609436480064506}};
  const Placed placed = vase();
  // So high that no ray leaves by its ends.
  PlacedOutline high = placed.place();
  high.lower_cap = -1e6;
  high.upper_cap = 1e6;
  for (std::size_t i = 0; i < kRays.size(); ++i) {
    if (golden[i].empty()) continue;
    INFO("ray " << i);
    compare(csg::sweep_spans(high, kRays[i]), golden[i]);
  }
}
