// From a BRL-CAD database to a scene: regions become objects, materials are inherited, the eye is
// placed.
#include "formats/brlcad/brlcad.hpp"

#include <algorithm>
#include <map>

#include "csg/model.hpp"
#include "formats/brlcad/database.hpp"
#include "formats/brlcad/shader.hpp"
#include "formats/brlcad/solids.hpp"
#include "formats/brlcad/view.hpp"
#include "scene/compile_scene.hpp"

namespace graycube {
namespace {

using Op = BrlcadTree::Op;

/// Visits of names, so that combinations of nothing can't take for ever.
constexpr std::size_t kMaxVisits = std::size_t{1} << 23;
constexpr std::array<int, 3> kWhite{255, 255, 255};

/// What a name inherits from the combinations above it.
struct State {
  Affine to_world;
  std::optional<std::array<int, 3>> rgb;
  std::string shader;
  /// A combination above has the last word.
  bool rgb_is_set = false, shader_is_set = false;
};

/// Part of a region's tree: nothing (an empty set) without a node.
struct Part {
  std::optional<CsgNode> node;
  std::size_t levels = 0;
};

/// What applies to every region found further down: minus, or within, another solid.
struct Cut {
  bool is_minus = false;
  CsgNode node;
  std::size_t levels = 0;
};

class SceneBuilder {
 public:
  SceneBuilder(const BrlcadDatabase& database, BrlcadReport& report)
      : database_(database), report_(report) {}

  void add(const std::string& name) {
    std::vector<Cut> cuts;
    collect(name, {}, cuts);
  }
  Scene take() { return std::move(scene_); }
  /// Objects that shine, by their index, and how brightly.
  const std::vector<std::pair<std::size_t, double>>& lamps() const { return lamps_; }

 private:
  /// Goes into a name; false when it can't: unknown, a cycle, too deep, or after an error.
  bool enter(const std::string& name, const BrlcadObject*& object) {
    if (report_.has_errors()) return false;
    object = database_.find(name);
    if (object == nullptr) {
      report_.warning_once("missing " + name, name, "is not in the database, and left out");
      return false;
    }
    if (++visits_ > kMaxVisits) {
      report_.error(name, "the model has too many parts");
      return false;
    }
    if (std::find(path_.begin(), path_.end(), object) != path_.end()) {
      report_.error(name, "the combination contains itself");
      return false;
    }
    if (path_.size() >= kMaxBrlcadNesting) {
      report_.error(
          name, "combinations are nested more than " + std::to_string(kMaxBrlcadNesting) + " deep");
      return false;
    }
    path_.push_back(object);
    return true;
  }

  static State within(State state, const BrlcadTree& leaf) {
    if (leaf.matrix) state.to_world = compose(state.to_world, *leaf.matrix);
    return state;
  }

  /// Above regions: finds them.
  void collect(const std::string& name, State state, std::vector<Cut>& cuts) {
    const BrlcadObject* object = nullptr;
    if (!enter(name, object)) return;
    if (const auto* comb = std::get_if<BrlcadComb>(&object->value)) {
      inherit(*comb, state);
      if (!comb->tree) {
        // A combination of nothing.
      } else if (comb->is_region) {
        region(*object, *comb, state, cuts);
      } else {
        collect_tree(*comb->tree, state, cuts);
      }
    } else {
      add_object(name, solid(*object, state.to_world, false), surface_of(state, nullptr), cuts);
    }
    path_.pop_back();
  }

  void collect_tree(const BrlcadTree& tree, const State& state, std::vector<Cut>& cuts) {
    switch (tree.op) {
      case Op::kLeaf: return collect(tree.name, within(state, tree), cuts);
      case Op::kUnion:
        for (const BrlcadTree& child : tree.children) collect_tree(child, state, cuts);
        return;
      case Op::kDifference:
      case Op::kIntersection: return collect_cut(tree, state, cuts);
      default:
        add_object(path_.back()->name, build(tree, state.to_world, false),
                   surface_of(state, nullptr), cuts);
    }
  }

  /// The first operand's regions, each cut by the others.
  void collect_cut(const BrlcadTree& tree, const State& state, std::vector<Cut>& cuts) {
    const std::size_t before = cuts.size();
    const bool is_minus = tree.op == Op::kDifference;
    bool is_empty = false;
    for (std::size_t i = 1; i < tree.children.size() && !is_empty; ++i) {
      Part part = build(tree.children[i], state.to_world, is_minus);
      is_empty = !part.node && !is_minus;
      if (part.node) cuts.push_back({is_minus, std::move(*part.node), part.levels});
    }
    if (!is_empty) collect_tree(tree.children.front(), state, cuts);
    cuts.erase(cuts.begin() + static_cast<std::ptrdiff_t>(before), cuts.end());
  }

  static void inherit(const BrlcadComb& comb, State& state) {
    if (comb.rgb && !state.rgb_is_set) {
      state.rgb = comb.rgb;
      state.rgb_is_set = comb.inherits;
    }
    if (!comb.shader.empty() && !state.shader_is_set) {
      state.shader = comb.shader;
      state.shader_is_set = comb.inherits;
    }
  }

  void region(const BrlcadObject& object, const BrlcadComb& comb, const State& state,
              const std::vector<Cut>& cuts) {
    if (comb.air != 0) return;
    add_object(object.name, build(*comb.tree, state.to_world, false), surface_of(state, &comb),
               cuts);
  }

  BrlcadSurface surface_of(const State& state, const BrlcadComb* region) {
    std::array<int, 3> rgb = state.rgb.value_or(kWhite);
    if (region != nullptr) {
      for (const BrlcadColorRange& range : database_.colors) {
        if (region->region_id >= range.low && region->region_id <= range.high) rgb = range.rgb;
      }
    }
    return brlcad_surface(state.shader, rgb, report_);
  }

  MaterialIndex material_of(const Material& m) {
    const std::array<double, 10> key{m.color.r,  m.color.g,   m.color.b, m.ambient,  m.diffuse,
                                     m.specular, m.shininess, m.reflect, m.transmit, m.ior};
    const auto index = static_cast<MaterialIndex>(scene_.materials.size());
    const auto [known, is_new] = materials_.emplace(key, index);
    if (is_new) scene_.materials.push_back({"material " + std::to_string(index + 1), m});
    return known->second;
  }

  void add_object(const std::string& name, Part part, const BrlcadSurface& surface,
                  const std::vector<Cut>& cuts) {
    for (const Cut& cut : cuts) {
      if (!part.node) return;
      leaves_ += leaves_below(cut.node);
      part = join(cut.is_minus ? Operation::kDifference : Operation::kIntersection, std::move(part),
                  {cut.node, cut.levels});
    }
    if (!part.node || !check_limits(name, part)) return;
    if (surface.is_light) lamps_.emplace_back(scene_.objects.size(), surface.brightness);
    scene_.objects.push_back(
        {printable(name), material_of(surface.material), std::move(*part.node)});
  }

  /// A scene's text is UTF-8; names in databases are any bytes.
  static std::string printable(std::string name) {
    for (char& c : name) {
      if (static_cast<unsigned char>(c) < 0x20 || static_cast<unsigned char>(c) >= 0x7F) c = '?';
    }
    return name;
  }

  static std::size_t leaves_below(const CsgNode& node) {
    const auto* inner = std::get_if<OperationNode>(&node.value);
    if (inner == nullptr) return 1;
    std::size_t sum = 0;
    for (const CsgNode& child : inner->children) sum += leaves_below(child);
    return sum;
  }

  bool check_limits(const std::string& name, const Part& part) {
    if (part.levels > kMaxBrlcadLevels) {
      report_.error(name, "its tree has more than " + std::to_string(kMaxBrlcadLevels) + " levels");
    } else if (leaves_ > kMaxBrlcadLeaves) {
      report_.error(name,
                    "the model has more than " + std::to_string(kMaxBrlcadLeaves) + " solids");
    }
    return !report_.has_errors();
  }

  /// Within a region. `is_cut`: what is built gets subtracted, and so is grown.
  Part build(const std::string& name, const Affine& to_world, bool is_cut) {
    const BrlcadObject* object = nullptr;
    if (!enter(name, object)) return {};
    Part part;
    if (const auto* comb = std::get_if<BrlcadComb>(&object->value)) {
      if (comb->tree) part = build(*comb->tree, to_world, is_cut);
    } else {
      part = solid(*object, to_world, is_cut);
    }
    path_.pop_back();
    return part;
  }

  Part build(const BrlcadTree& tree, const Affine& to_world, bool is_cut) {
    switch (tree.op) {
      case Op::kLeaf:
        return build(tree.name, tree.matrix ? compose(to_world, *tree.matrix) : to_world, is_cut);
      case Op::kNot: {
        Part part = build(tree.children.front(), to_world, !is_cut);
        if (!part.node) return everything();
        return inverted(std::move(part));
      }
      case Op::kXor: {
        const BrlcadTree &a = tree.children[0], &b = tree.children[1];
        Part one =
            join(Operation::kDifference, build(a, to_world, is_cut), build(b, to_world, !is_cut));
        Part other =
            join(Operation::kDifference, build(b, to_world, is_cut), build(a, to_world, !is_cut));
        return join(Operation::kUnion, std::move(one), std::move(other));
      }
      default: break;
    }
    const Operation op = tree.op == Op::kUnion          ? Operation::kUnion
                         : tree.op == Op::kIntersection ? Operation::kIntersection
                                                        : Operation::kDifference;
    Part sum = build(tree.children.front(), to_world, is_cut);
    for (std::size_t i = 1; i < tree.children.size(); ++i) {
      if (!sum.node && op != Operation::kUnion) return {};
      sum = join(op, std::move(sum),
                 build(tree.children[i], to_world, is_cut != (op == Operation::kDifference)));
    }
    return sum;
  }

  static Part everything() {
    CsgNode half;
    half.value = HalfSpaceShape{{0, 0, 1}, 0};
    return join(Operation::kUnion, {half, 1}, inverted({half, 1}));
  }
  static Part inverted(Part part) {
    CsgNode node;
    OperationNode inner{Operation::kComplement, {}};
    inner.children.push_back(std::move(*part.node));
    node.value = std::move(inner);
    return {std::move(node), part.levels + 1};
  }

  /// One node for a chain of one operation.
  static Part join(Operation op, Part a, Part b) {
    if (!a.node || !b.node) {
      if (op == Operation::kUnion) return a.node ? std::move(a) : std::move(b);
      if (op == Operation::kDifference) return a;
      return {};
    }
    auto* chain = std::get_if<OperationNode>(&a.node->value);
    if (chain != nullptr && chain->operation == op && !a.node->transform) {
      chain->children.push_back(std::move(*b.node));
      a.levels = std::max(a.levels, b.levels + 1);
      return a;
    }
    Part out;
    OperationNode both{op, {}};
    both.children.push_back(std::move(*a.node));
    both.children.push_back(std::move(*b.node));
    out.node.emplace().value = std::move(both);
    out.levels = std::max(a.levels, b.levels) + 1;
    return out;
  }

  Part solid(const BrlcadObject& object, const Affine& to_world, bool is_cut) {
    if (const auto* foreign = std::get_if<BrlcadForeign>(&object.value)) {
      report_.error(object.name, foreign->kind + " is not supported");
      return {};
    }
    if (++leaves_ > kMaxBrlcadLeaves) {
      report_.error(object.name,
                    "the model has more than " + std::to_string(kMaxBrlcadLeaves) + " solids");
      return {};
    }
    const BrlcadSolid& is = std::get<BrlcadSolid>(object.value);
    triangles_ += is.mesh.faces.size();
    if (triangles_ > kMaxMeshTriangles) {
      report_.error(object.name, "the meshes have more than " + std::to_string(kMaxMeshTriangles) +
                                     " triangles, each use of one counted");
      return {};
    }
    BrlcadNode built = brlcad_node(is, to_world, is_cut ? kBrlcadSkin : 0);
    if (!built.node) {
      if (built.is_error) {
        report_.error(object.name, built.problem);
      } else {
        report_.warning_once("solid " + object.name, object.name,
                             built.problem + "; it is left out");
      }
      return {};
    }
    return {std::move(built.node), count_levels(*built.node)};
  }
  static std::size_t count_levels(const CsgNode& node) {
    std::size_t most = 0;
    if (const auto* inner = std::get_if<OperationNode>(&node.value)) {
      for (const CsgNode& child : inner->children) most = std::max(most, count_levels(child));
    }
    return most + 1;
  }

  const BrlcadDatabase& database_;
  BrlcadReport& report_;
  Scene scene_;
  std::map<std::array<double, 10>, MaterialIndex> materials_;
  std::vector<const BrlcadObject*> path_;
  std::size_t visits_ = 0, leaves_ = 0, triangles_ = 0;
  std::vector<std::pair<std::size_t, double>> lamps_;
};

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

/// The finite bounds of each object: where a half-space makes them infinite, those of its finite
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

constexpr double kLampDistance = 1.0001;
/// Without lamps in the model: over the eye's left and right shoulder, in sizes of the model.
constexpr Vec3 kKeyDirection{-0.8, 0.9, 1.2}, kFillDirection{1.0, 0.2, 0.7};
constexpr double kKeyBrightness = 1.0, kFillBrightness = 0.4, kLightDistance = 4;

void add_lights(const std::vector<std::pair<std::size_t, double>>& lamps,
                const std::vector<Aabb>& bounds, const Aabb& whole, Scene& scene,
                BrlcadReport& report) {
  auto& lights = scene.settings.lights;
  for (const auto& [object, brightness] : lamps) {
    if (lights.size() == kMaxCreditLights) {
      report.warning("",
                     "lamps beyond the first " + std::to_string(kMaxCreditLights) + " don't shine");
      break;
    }
    const Aabb& box = bounds[object];
    if (box.is_empty()) continue;
    // Just outside of the lamp, so that it doesn't shade its own light.
    const Vec3 towards = normalized(whole.center() - box.center());
    const double radius = 0.5 * length(box.hi - box.lo);
    const Rgb color = scene.materials[scene.objects[object].material].material.color;
    lights.push_back(
        {box.center() + kLampDistance * radius * towards, brightness * color, Falloff::kNone});
  }
  if (!lights.empty()) return;
  const BrlcadAxes axes = brlcad_axes(scene.settings.camera);
  const double size = std::max(length(whole.hi - whole.lo), 1e-3);
  const auto light = [&](const Vec3& d, double brightness) {
    const Vec3 to = d.x * axes.right + d.y * axes.up + d.z * axes.backward;
    lights.push_back({whole.center() + kLightDistance * size * to,
                      Rgb{brightness, brightness, brightness}, Falloff::kNone});
  };
  light(kKeyDirection, kKeyBrightness);
  light(kFillDirection, kFillBrightness);
}

void place_eye(const BrlcadOptions& options,
               const std::vector<std::pair<std::size_t, double>>& lamps, Scene& scene,
               BrlcadReport& report) {
  RenderSettings& s = scene.settings;
  s.image = options.image;
  s.max_depth = options.max_depth;
  const std::vector<Aabb> bounds = finite_bounds(compile_scene(scene));
  Aabb whole = Aabb::nothing();
  for (const Aabb& box : bounds) whole = union_of(whole, box);
  if (whole.is_empty()) whole = {{-1, -1, -1}, {1, 1, 1}};
  if (options.view) {
    const auto camera = read_brlcad_view(*options.view, report);
    if (camera) s.camera = *camera;
  } else {
    s.camera = brlcad_camera(options.azimuth_degrees, options.elevation_degrees, whole);
  }
  if (!report.has_errors()) add_lights(lamps, bounds, whole, scene, report);
}

}  // namespace

BrlcadResult read_brlcad(std::string_view bytes, const BrlcadOptions& options) {
  BrlcadReport report;
  BrlcadResult result;
  const BrlcadDatabase database = read_brlcad_database(bytes, report);
  if (!report.has_errors()) {
    SceneBuilder builder(database, report);
    for (const std::string& name : options.objects) {
      if (database.find(name) == nullptr) report.error(name, "is not in the database");
    }
    for (const std::string& name :
         options.objects.empty() ? top_names(database) : options.objects) {
      builder.add(name);
    }
    Scene scene = builder.take();
    if (!report.has_errors() && scene.objects.empty())
      report.warning("", "there is nothing to see");
    if (!report.has_errors()) place_eye(options, builder.lamps(), scene, report);
    if (!report.has_errors()) result.scene = std::move(scene);
  }
  result.errors = report.take_errors();
  result.warnings = report.take_warnings();
  return result;
}

namespace {

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

}  // namespace

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
