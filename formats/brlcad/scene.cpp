// Turns a BRL-CAD database into a scene: chooses the objects, places the eye and the lights.
#include <algorithm>
#include <charconv>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string_view>
#include <utility>

#include "csg/model.hpp"
#include "formats/brlcad/brlcad.hpp"
#include "formats/brlcad/database/database.hpp"
#include "formats/brlcad/lights.hpp"
#include "formats/brlcad/scene_builder.hpp"
#include "formats/brlcad/view.hpp"
#include "scene/compile_scene.hpp"
#include "scene/scene_fault.hpp"

namespace graycube {
namespace {

using Op = BrlcadTree::Op;

/// Names that no combination refers to, in the file's order.
std::vector<std::string> top_names(const BrlcadDatabase& database) {
  std::map<std::string, bool> is_used;
  const auto note = [&](const auto& self, const BrlcadTree& tree) -> void {
    if (tree.op == Op::kLeaf) is_used[tree.name] = true;
    for (const BrlcadTree& child : tree.children) self(self, child);
  };
  for (const BrlcadObject& o : database.objects) {
    const auto* comb = std::get_if<BrlcadComb>(&o.value);
    if (comb != nullptr && comb->tree) note(note, *comb->tree);
  }
  std::vector<std::string> names;
  for (const BrlcadObject& o : database.objects) {
    if (is_used.count(o.name) == 0) names.push_back(o.name);
  }
  return names;
}

/// Notes the names that a tree holds, and that those hold.
void note_below(const BrlcadDatabase& database, const std::string& name,
                std::set<std::string>& seen) {
  std::vector<std::string> ahead{name};
  std::vector<const BrlcadTree*> trees;
  while (!ahead.empty()) {
    const std::string next = std::move(ahead.back());
    ahead.pop_back();
    const BrlcadObject* object = database.find(next);
    if (object == nullptr || !seen.insert(next).second) continue;
    const auto* comb = std::get_if<BrlcadComb>(&object->value);
    if (comb != nullptr && comb->tree) trees.push_back(&*comb->tree);
    while (!trees.empty()) {
      const BrlcadTree* tree = trees.back();
      trees.pop_back();
      if (tree->op == Op::kLeaf) ahead.push_back(tree->name);
      for (const BrlcadTree& child : tree->children) trees.push_back(&child);
    }
  }
}

/// Tells of the combinations that no top leads to.
void tell_of_circles(const BrlcadDatabase& database, const std::vector<std::string>& tops,
                     BrlcadReport& report) {
  std::set<std::string> seen;
  for (const std::string& name : tops) note_below(database, name, seen);
  for (const BrlcadObject& o : database.objects) {
    if (seen.count(o.name) == 0 && std::holds_alternative<BrlcadComb>(o.value))
      report.left_out("combinations", "they contain themselves, or only such contain them", o.name);
  }
}

/// How often solids occur below each name, saturating; cycles count as nothing.
class PrimitiveCounter {
 public:
  explicit PrimitiveCounter(const BrlcadDatabase& database) : database_(database) {}

  std::uint64_t count(const std::string& name) {
    const BrlcadObject* object = database_.find(name);
    if (object == nullptr) return 0;
    const auto* comb = std::get_if<BrlcadComb>(&object->value);
    if (comb == nullptr) return 1;
    const auto [known, is_new] = counts_.emplace(name, 0);
    if (!is_new || !comb->tree || depth_ > kMaxBrlcadNesting) return known->second;
    ++depth_;
    const std::uint64_t sum = count(*comb->tree);
    --depth_;
    return counts_[name] = sum;
  }

 private:
  static constexpr std::uint64_t kMany = 1ull << 62;

  std::uint64_t count(const BrlcadTree& tree) {
    if (tree.op == Op::kLeaf) return count(tree.name);
    std::uint64_t sum = 0;
    for (const BrlcadTree& child : tree.children) sum = std::min(kMany, sum + count(child));
    return sum;
  }

  const BrlcadDatabase& database_;
  std::map<std::string, std::uint64_t> counts_;
  std::size_t depth_ = 0;
};

/// The finite bounds of each object: if a half-space makes them infinite, those of its finite
/// primitives.
std::vector<Aabb> finite_bounds(const Model& model) {
  std::vector<Aabb> all;
  for (const Object& o : model.objects) {
    Aabb box = o.bounds;
    if (!box.is_finite()) {
      box = Aabb::nothing();
      for (std::uint32_t i = o.first_node; i < o.first_node + o.node_count; ++i) {
        const TreeNode& n = model.nodes[i];
        if (n.kind != TreeNode::Kind::kLeaf) continue;
        const Aabb& b = model.primitives[n.primitive].bounds;
        if (b.is_finite()) box = union_of(box, b);
      }
      box = intersection_of(box, o.bounds);
    }
    all.push_back(box);
  }
  return all;
}

/// Each time that a scene is compiled, its first kMaxSceneFaults solids that can't be computed are
/// found. A model with more of them than so many times show is refused.
constexpr int kMostCompilations = 8;

/// The object that a fault lies in, if it lies in one.
std::optional<std::size_t> object_of(const SceneFault& fault, const Scene& scene) {
  constexpr std::string_view kObjects = "/objects/";
  if (!fault.pointer.starts_with(kObjects)) return std::nullopt;
  const char* digits = fault.pointer.data() + kObjects.size();
  std::size_t index = 0;
  const auto [end, error] =
      std::from_chars(digits, fault.pointer.data() + fault.pointer.size(), index);
  if (error != std::errc() || index >= scene.objects.size()) return std::nullopt;
  return index;
}

void remove_object(std::size_t object, Scene& scene, std::vector<brlcad::LampObject>& lamps) {
  scene.objects.erase(scene.objects.begin() + static_cast<std::ptrdiff_t>(object));
  std::erase_if(lamps, [&](const brlcad::LampObject& l) { return l.object == object; });
  for (brlcad::LampObject& l : lamps) l.object -= l.object > object ? 1 : 0;
}

/// Leaves out the regions with solids that can't be computed; false where that is of no use.
bool leave_out_faulty(const std::vector<SceneFault>& faults, Scene& scene,
                      std::vector<brlcad::LampObject>& lamps, BrlcadReport& report) {
  // The last ones first, so that the places of the others stay.
  std::map<std::size_t, std::string, std::greater<>> faulty;
  for (const SceneFault& f : faults) {
    if (const auto object = object_of(f, scene)) faulty.emplace(*object, f.message);
  }
  for (const auto& [object, why] : faulty) {
    report.left_out("regions", "a solid can't be computed", scene.objects[object].name, why);
    remove_object(object, scene, lamps);
  }
  return !faulty.empty();
}

/// Leaves out regions until the others can be computed. Nothing, after reporting, when none is
/// left, or too many solids are at fault.
std::optional<Model> compiled(Scene& scene, std::vector<brlcad::LampObject>& lamps,
                              BrlcadReport& report) {
  for (int turn = 1;; ++turn) {
    try {
      return compile_scene(scene);
    } catch (const UnrenderableScene& e) {
      if (turn < kMostCompilations && leave_out_faulty(e.faults(), scene, lamps, report)) {
        if (!scene.objects.empty()) continue;
        report.error("", "nothing is left to render: " + report.take_left_out());
        return std::nullopt;
      }
      for (const SceneFault& f : e.faults()) report.error("", f.message);
      return std::nullopt;
    }
  }
}

void place_eye(const BrlcadOptions& options, std::vector<brlcad::LampObject> lamps, Scene& scene,
               BrlcadReport& report) {
  RenderSettings& s = scene.settings;
  s.image = options.image;
  s.max_depth = options.max_depth;
  const std::optional<Model> model = compiled(scene, lamps, report);
  if (!model) return;
  const std::vector<Aabb> bounds = finite_bounds(*model);
  Aabb whole = Aabb::nothing();
  for (const Aabb& box : bounds) whole = union_of(whole, box);
  if (whole.is_empty()) whole = {{-1, -1, -1}, {1, 1, 1}};
  std::optional<BrlcadView> view;
  if (options.view) {
    view = read_brlcad_view(*options.view, report);
  } else {
    view = brlcad_view(options.azimuth_degrees, options.elevation_degrees, whole);
  }
  if (!view) return;
  s.camera = view->camera;
  light_scene(lamps, bounds, view->size, scene, report);
}

}  // namespace

BrlcadResult read_brlcad(std::string_view bytes, const BrlcadOptions& options) {
  BrlcadReport report;
  BrlcadResult result;
  const BrlcadDatabase database = read_brlcad_database(bytes, report);
  if (!report.has_errors()) {
    brlcad::SceneBuilder builder(database, report);
    for (const std::string& name : options.objects) {
      if (database.find(name) == nullptr) report.error(name, "is not in the database");
    }
    const std::vector<std::string> chosen =
        options.objects.empty() ? top_names(database) : options.objects;
    for (const std::string& name : chosen) builder.add(name);
    if (options.objects.empty()) tell_of_circles(database, chosen, report);
    Scene scene = builder.take();
    if (!report.has_errors() && scene.objects.empty()) {
      const std::string left_out = report.take_left_out();
      if (left_out.empty()) {
        report.warning("", "there is nothing to see");
      } else {
        report.error("", "nothing is left to render: " + left_out);
      }
    }
    if (!report.has_errors()) place_eye(options, builder.lamps(), scene, report);
    if (!report.has_errors()) result.scene = std::move(scene);
  }
  result.errors = report.take_errors();
  result.warnings = report.take_warnings();
  return result;
}

BrlcadTops list_brlcad_tops(std::string_view bytes) {
  BrlcadReport report;
  BrlcadTops result;
  const BrlcadDatabase database = read_brlcad_database(bytes, report);
  if (!report.has_errors()) {
    PrimitiveCounter counter(database);
    for (const std::string& name : top_names(database))
      result.tops.push_back({name, counter.count(name)});
  }
  result.errors = report.take_errors();
  return result;
}

}  // namespace graycube
