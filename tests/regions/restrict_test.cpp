// The part of a model that a macro-region needs: it must look the same from inside the region.
#include "regions/restrict.hpp"

#include <vector>

#include "catch.hpp"
#include "csg/random_model.hpp"
#include "csg/whole_tree.hpp"

using namespace graycube;
using namespace graycube::testing;

namespace {

struct Grid {
  std::uint32_t columns, rows;
};
const std::vector<Grid> kGrids{{1, 1}, {2, 1}, {1, 2}, {2, 2}, {3, 3}, {4, 2}, {8, 4}};

template <typename Visit>
void for_each_region(const MacroGrid& grid, const Visit& visit) {
  for (std::uint32_t row = 0; row < grid.rows(); ++row) {
    for (std::uint32_t column = 0; column < grid.columns(); ++column) {
      visit(RegionIndex{static_cast<std::uint16_t>(column), static_cast<std::uint16_t>(row)});
    }
  }
}

/// The position of the object's counterpart in the restricted model, if it has a surface there.
std::optional<std::size_t> position_of(const Model& model, std::uint32_t id) {
  for (std::size_t i = 0; i < model.objects.size(); ++i) {
    if (model.objects[i].id == id) return i;
  }
  return std::nullopt;
}

}  // namespace

TEST_CASE("what a share needs of each object is all of it, a part or nothing") {
  std::size_t whole = 0, parts = 0, nothing = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    INFO("seed " << seed);
    const Model model = compile_scene(RandomModel(seed).scene());
    const MacroGrid grid =
        MacroGrid::regular(CameraFrame::from(model.settings.camera, model.settings.image), 4, 4);
    ModelContents contents = contents_of_share(model, grid, {4, 4, 1, 2});
    const Model slice = extract(model, contents);
    std::size_t part = 0;
    for (std::uint32_t i = 0; i < model.objects.size(); ++i) {
      const bool is_part = part < contents.parts.size() && contents.parts[part].object == i;
      REQUIRE_FALSE((is_part && contents.is_whole[i]));
      if (is_part) {
        REQUIRE(position_of(slice, model.objects[i].id));
        REQUIRE(contents.parts[part].tree.size() < model.objects[i].node_count);
        ++part;
      }
      (is_part ? parts : contents.is_whole[i] ? whole : nothing) += 1;
    }
    REQUIRE(part == contents.parts.size());
    // Objects that are held whole take the place of their parts.
    contents.hold_whole(std::vector<bool>(model.objects.size(), true));
    REQUIRE(contents.parts.empty());
    REQUIRE(extract(model, contents) == model);
  }
  CHECK(whole > 20);
  CHECK(parts > 10);
  CHECK(nothing > 20);
}

TEST_CASE("points of a region have the membership of the whole model") {
  std::size_t inside = 0, compared = 0, dropped = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    const Model model = compile_scene(RandomModel(seed).scene());
    const WholeTrees whole(model);
    const CameraFrame frame = CameraFrame::from(model.settings.camera, model.settings.image);
    for (const auto& [columns, rows] : kGrids) {
      const MacroGrid grid = MacroGrid::regular(frame, columns, rows);
      std::vector<std::vector<Vec3>> points(columns * rows);
      Dice dice(seed);
      for (int i = 0; i < 600; ++i) {
        const Vec3 p = dice.one_in(3) ? frame.eye + dice.point(1) : dice.point(4);
        const RegionIndex r = grid.region_of_point(p);
        points[r.row * columns + r.column].push_back(p);
      }
      for_each_region(grid, [&](RegionIndex r) {
        INFO("seed " << seed << ", grid " << columns << " x " << rows << ", region " << r.column
                     << ' ' << r.row);
        const Model part = restrict_to_share(model, grid, only(r, grid));
        const WholeTrees trees(part);
        for (std::uint32_t o = 0; o < model.objects.size(); ++o) {
          const auto at = position_of(part, o);
          dropped += at ? 0 : 1;
          std::optional<bool> constant;
          for (const Vec3& p : points[r.row * columns + r.column]) {
            const bool expected = whole.contains_point(o, p);
            ++compared;
            inside += expected ? 1 : 0;
            if (!at && !constant) constant = expected;
            REQUIRE((at ? trees.contains_point(*at, p) : *constant) == expected);
          }
        }
      });
    }
  }
  CHECK(inside > compared / 20);
  CHECK(dropped > 200);
}

TEST_CASE("a restricted model keeps settings, materials and ids, and is restricted for good") {
  for (std::uint64_t seed = 0; seed < 80; ++seed) {
    INFO("seed " << seed);
    const Model model = compile_scene(RandomModel(seed).scene());
    const MacroGrid grid =
        MacroGrid::regular(CameraFrame::from(model.settings.camera, model.settings.image), 4, 2);
    for_each_region(grid, [&](RegionIndex r) {
      const Model part = restrict_to_share(model, grid, only(r, grid));
      REQUIRE(part.settings == model.settings);
      REQUIRE(part.materials == model.materials);
      REQUIRE(part.delta == model.delta);
      REQUIRE(part.primitives.size() <= model.primitives.size());
      std::uint32_t next = 0, primitive = 0;
      for (const Object& o : part.objects) {
        REQUIRE(o.id >= next);
        next = o.id + 1;
        REQUIRE(o.first_node + o.node_count <= part.nodes.size());
        for (std::uint32_t i = 0; i < o.node_count; ++i) {
          const TreeNode& n = part.nodes[o.first_node + i];
          if (n.size == 1) REQUIRE(n.primitive == primitive++);
        }
      }
      REQUIRE(primitive == part.primitives.size());
      REQUIRE(restrict_to_share(part, grid, only(r, grid)) == part);
    });
  }
}

TEST_CASE("a scattered share holds what each of its regions needs, and each of it once") {
  std::size_t together = 0, apart = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    INFO("seed " << seed);
    const Model model = compile_scene(RandomModel(seed).scene());
    const WholeTrees whole(model);
    const CameraFrame frame = CameraFrame::from(model.settings.camera, model.settings.image);
    const MacroGrid grid = MacroGrid::regular(frame, 6, 4);
    Dice dice(seed);
    std::vector<Vec3> points;
    for (int i = 0; i < 300; ++i) points.push_back(dice.point(4));
    for (const RegionShare& share : {RegionShare{2, 2, 1, 0}, RegionShare{3, 2, 2, 1}}) {
      const Model part = restrict_to_share(model, grid, share);
      together += part.primitives.size();
      for_each_region(grid, [&](RegionIndex r) {
        if (!share.owns(r)) return;
        apart += restrict_to_share(model, grid, only(r, grid)).primitives.size();
        REQUIRE(restrict_to_share(part, grid, only(r, grid)) ==
                restrict_to_share(model, grid, only(r, grid)));
      });
      const WholeTrees trees(part);
      for (std::uint32_t o = 0; o < model.objects.size(); ++o) {
        const auto at = position_of(part, o);
        if (!at) continue;
        for (const Vec3& p : points) {
          if (!share.owns(grid.region_of_point(p))) continue;
          REQUIRE(trees.contains_point(*at, p) == whole.contains_point(o, p));
        }
      }
    }
  }
  CHECK(together < apart);
}

TEST_CASE("the one region of a grid of one holds all that has a surface") {
  const CsgNode ball = node_of(SphereShape{{0, 0, 0}, 1});
  Scene scene = scene_of(
      {ball, operation(Operation::kComplement, {ball}), node_of(HalfSpaceShape{{0, 1, 0}, 0})});
  const Model model = compile_scene(scene);
  const MacroGrid grid =
      MacroGrid::regular(CameraFrame::from(model.settings.camera, model.settings.image), 1, 1);
  CHECK(restrict_to_share(model, grid, {}) == model);
}

TEST_CASE("space is shared out: a region of many holds few of many small solids") {
  std::vector<CsgNode> balls;
  Dice dice(1);
  for (int i = 0; i < 400; ++i) balls.push_back(node_of(SphereShape{dice.point(3), 0.05}));
  Scene scene = scene_of(std::move(balls));
  scene.settings.image = {64, 64, 1};
  scene.settings.camera.projection = Projection::kPerspective;
  scene.settings.camera.fov_degrees = 40;
  const Model model = compile_scene(scene);
  const MacroGrid grid =
      MacroGrid::regular(CameraFrame::from(scene.settings.camera, scene.settings.image), 4, 4);
  std::size_t held = 0, most = 0;
  for_each_region(grid, [&](RegionIndex r) {
    const std::size_t n = restrict_to_share(model, grid, only(r, grid)).primitives.size();
    held += n;
    most = std::max(most, n);
  });
  CHECK(held >= 400);
  CHECK(held < 800);
  CHECK(most < 120);
}

TEST_CASE("a node holds the meshes that its region may meet, and no others") {
  const TriangleMesh box = closed(box_polygons({-1, -1, -1}, {1, 1, 1}));
  const auto placed = [&](double x, double y) {
    return transformed(node_of(MeshShape{box}),
                       compose(translation({x, y, 0}), scaling({0.5, 0.5, 0.5})));
  };
  Scene scene =
      scene_of({placed(-2, 2), placed(2, 2), placed(2, -2), placed(-2, -2), placed(0, 0)});
  scene.settings.image = {64, 64, 1};
  scene.settings.camera.width = 8;
  const Model model = compile_scene(scene);
  REQUIRE(model.meshes.size() == 5);
  const MacroGrid grid =
      MacroGrid::regular(CameraFrame::from(scene.settings.camera, scene.settings.image), 2, 2);
  for_each_region(grid, [&](RegionIndex r) {
    const Model part = restrict_to_share(model, grid, only(r, grid));
    // The part has its own mesh, and the one in the middle.
    REQUIRE(part.meshes.size() == 2);
    for (const Primitive& p : part.primitives) {
      CHECK(part.meshes[p.mesh].bounds() == p.bounds);
      CHECK(part.meshes[p.mesh].surface().triangles.size() == 12);
    }
  });
}
