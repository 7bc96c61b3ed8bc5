#include "formats/openscad/hulls/convex_hull.hpp"

#include <array>
#include <cstdio>
#include <memory>

extern "C" {
#include <libqhull_r/qhull_ra.h>
}

#include "formats/openscad/language/limits.hpp"

namespace graycube {
namespace {

struct FileCloser {
  void operator()(std::FILE* file) const { std::fclose(file); }
};

/// Qhull's state, freed at the end.
class Hull {
 public:
  Hull() { qh_zero(&state_, nullptr); }
  ~Hull() {
    qh_freeqhull(&state_, !qh_ALL);
    int remaining = 0, blocks = 0;
    qh_memfreeshort(&state_, &remaining, &blocks);
  }
  Hull(const Hull&) = delete;
  Hull& operator=(const Hull&) = delete;

  /// Builds the hull; false for points in a plane.
  bool build(std::vector<Vec3>& points) {
    // Qhull's messages are thrown away: its status tells enough.
    const std::unique_ptr<std::FILE, FileCloser> silence(std::fopen("/dev/null", "w"));
    if (!silence) return false;
    std::array<char, 10> command{"qhull Qt"};
    static_assert(sizeof(Vec3) == 3 * sizeof(coordT));
    return qh_new_qhull(&state_, 3, static_cast<int>(points.size()), &points.front().x, False,
                        command.data(), silence.get(), silence.get()) == 0;
  }

  template <typename Use>
  void for_each_triangle(const Use& use) {
    for (facetT* facet = state_.facet_list; facet != nullptr && facet->next != nullptr;
         facet = facet->next) {
      if (qh_setsize(&state_, facet->vertices) != 3) continue;
      std::array<std::uint32_t, 3> corners{};
      for (int i = 0; i < 3; ++i) {
        auto* vertex = static_cast<vertexT*>(facet->vertices->e[i].p);
        corners[static_cast<std::size_t>(i)] =
            static_cast<std::uint32_t>(qh_pointid(&state_, vertex->point));
      }
      use(corners);
    }
  }

 private:
  qhT state_;
};

}  // namespace

ScadMesh convex_hull(const std::vector<Vec3>& points) {
  ScadMesh mesh;
  mesh.points = points;
  if (points.size() < 4) return mesh;
  // Qhull crashes when its products overflow.
  for (const Vec3& p : points) {
    if (!is_finite(p) || max_abs(p) > kMaxOpenscadCoordinate) return mesh;
  }
  Hull hull;
  std::vector<Vec3> given = points;
  if (!hull.build(given)) return mesh;
  hull.for_each_triangle([&](const std::array<std::uint32_t, 3>& t) {
    mesh.faces.push_back({t[0], t[1], t[2]});
  });
  return mesh;
}

}  // namespace graycube
