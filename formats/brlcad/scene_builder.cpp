#include "formats/brlcad/scene_builder.hpp"

#include <algorithm>
#include <utility>

#include "formats/brlcad/shader_pattern.hpp"
#include "formats/brlcad/solid_chart.hpp"
#include "formats/brlcad/solids.hpp"

namespace graycube::brlcad {
namespace {

using Op = BrlcadTree::Op;

/// Most visits of names, so that combinations of nothing can't take for ever.
constexpr std::size_t kMaxVisits = std::size_t{1} << 23;
constexpr std::array<int, 3> kWhite{255, 255, 255};
constexpr const char* kBrokenMatrix = "their matrix is no invertible affine map";

/// All of a material, as numbers that can be compared.
std::vector<double> key_of(const Material& m) {
  const Pattern& p = m.pattern;
  std::vector<double> key{m.color.r,
                          m.color.g,
                          m.color.b,
                          m.ambient,
                          m.diffuse,
                          m.specular,
                          m.shininess,
                          m.reflect,
                          m.transmit,
                          m.ior,
                          static_cast<double>(m.model),
                          static_cast<double>(p.kind)};
  if (p.kind == PatternKind::kNone) return key;
  const auto add_map = [&](const Affine& map) {
    for (const auto& row : map.m) key.insert(key.end(), row.begin(), row.end());
  };
  add_map(p.to_pattern);
  for (const Rgb& c : p.colors) key.insert(key.end(), {c.r, c.g, c.b});
  key.insert(key.end(), {p.thresholds[0], p.thresholds[1], p.octaves.count, p.octaves.lacunarity,
                         p.octaves.decay});
  const Chart& c = p.chart;
  for (const auto value :
       {static_cast<int>(c.kind), static_cast<int>(c.ends[0]), static_cast<int>(c.ends[1])})
    key.push_back(value);
  key.insert(key.end(), c.top_radii.begin(), c.top_radii.end());
  for (const Affine& map : c.maps) add_map(map);
  return key;
}

}  // namespace

SceneBuilder::SceneBuilder(const BrlcadDatabase& database, BrlcadReport& report)
    : database_(database), report_(report) {
  for (const BrlcadObject& o : database.objects) {
    const auto* comb = std::get_if<BrlcadComb>(&o.value);
    if (comb == nullptr) continue;
    for (const ShaderWords& words : shaders_of(comb->shader)) {
      marks_solids_ = marks_solids_ || pattern_on_solids_of(words);
    }
  }
}

void SceneBuilder::add(const std::string& name) {
  std::vector<Cut> cuts;
  collect(name, {}, cuts);
}

bool SceneBuilder::enter(const std::string& name, const BrlcadObject*& object) {
  if (report_.has_errors()) return false;
  object = database_.find(name);
  if (object == nullptr) {
    report_.missing(name);
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

State SceneBuilder::within(State state, const BrlcadTree& leaf) {
  if (leaf.matrix) state.to_world = compose(state.to_world, *leaf.matrix);
  return state;
}

void SceneBuilder::collect(const std::string& name, State state, std::vector<Cut>& cuts) {
  const BrlcadObject* object = nullptr;
  if (!enter(name, object)) return;
  if (const auto* comb = std::get_if<BrlcadComb>(&object->value)) {
    inherit(*comb, state);
    if (!comb->tree) {
      // A combination of nothing is left out.
    } else if (comb->is_region) {
      region(*object, *comb, state, cuts);
    } else {
      collect_tree(*comb->tree, state, cuts);
    }
  } else {
    add_object(name, solid(*object, state.to_world, false), surface_of(name, state, nullptr), cuts,
               first_solid_of(*object, state.to_world));
  }
  path_.pop_back();
}

void SceneBuilder::collect_tree(const BrlcadTree& tree, const State& state,
                                std::vector<Cut>& cuts) {
  switch (tree.op) {
    case Op::kLeaf:
      if (tree.has_broken_matrix) {
        return report_.left_out("members", kBrokenMatrix, path_.back()->name + "/" + tree.name);
      }
      return collect(tree.name, within(state, tree), cuts);
    case Op::kUnion:
      for (const BrlcadTree& child : tree.children) collect_tree(child, state, cuts);
      return;
    case Op::kDifference:
    case Op::kIntersection: return collect_cut(tree, state, cuts);
    default:
      add_object(path_.back()->name, build(tree, state.to_world, false),
                 surface_of(path_.back()->name, state, nullptr), cuts,
                 first_solid_of(tree, state.to_world));
  }
}

void SceneBuilder::collect_cut(const BrlcadTree& tree, const State& state, std::vector<Cut>& cuts) {
  const std::size_t before = cuts.size();
  const bool is_minus = tree.op == Op::kDifference;
  bool is_empty = false;
  for (std::size_t i = 1; i < tree.children.size() && !is_empty; ++i) {
    Part part = build(tree.children[i], state.to_world, is_minus);
    Lack lacks = std::exchange(lacks_, {});
    is_empty = !part.node && !is_minus && !lacks;
    if (lacks) {
      cuts.push_back({is_minus, {}, 0, std::move(lacks)});
    } else if (part.node) {
      cuts.push_back({is_minus, std::move(*part.node), part.levels, {}});
    }
  }
  if (!is_empty) collect_tree(tree.children.front(), state, cuts);
  cuts.erase(cuts.begin() + static_cast<std::ptrdiff_t>(before), cuts.end());
}

void SceneBuilder::inherit(const BrlcadComb& comb, State& state) {
  if (comb.rgb && !state.rgb_is_set) {
    state.rgb = comb.rgb;
    state.rgb_is_set = comb.inherits;
  }
  if (!comb.shader.empty() && !state.shader_is_set) {
    state.shader = comb.shader;
    state.shader_is_set = comb.inherits;
  }
}

void SceneBuilder::region(const BrlcadObject& object, const BrlcadComb& comb, const State& state,
                          const std::vector<Cut>& cuts) {
  if (comb.air != 0) return report_.air(object.name);
  add_object(object.name, build(*comb.tree, state.to_world, false),
             surface_of(object.name, state, &comb), cuts,
             first_solid_of(*comb.tree, state.to_world));
}

SceneBuilder::FirstSolid SceneBuilder::first_solid_of(const BrlcadTree& tree,
                                                      const Affine& to_world) const {
  FirstSolid first{nullptr, to_world};
  const BrlcadTree* at = &tree;
  // Names that go round in a circle were found when the region was built; this just ends.
  for (std::size_t names = 0; names < kMaxBrlcadNesting; ++names) {
    while (at->op != Op::kLeaf) at = &at->children.front();
    if (at->matrix) first.to_world = compose(first.to_world, *at->matrix);
    const BrlcadObject* object = database_.find(at->name);
    if (object == nullptr) break;
    const auto* comb = std::get_if<BrlcadComb>(&object->value);
    if (comb == nullptr || !comb->tree) return first_solid_of(*object, first.to_world);
    at = &*comb->tree;
  }
  return first;
}
SceneBuilder::FirstSolid SceneBuilder::first_solid_of(const BrlcadObject& object,
                                                      const Affine& to_world) {
  return {std::get_if<BrlcadSolid>(&object.value), to_world};
}

bool SceneBuilder::paint(const std::string& name, const BrlcadSurface& surface, CsgNode& node) {
  if (node.material != kInheritMaterial) {
    node.material = painted(name, surface, marked_[node.material]);
    return node.material != kInheritMaterial;
  }
  auto* inner = std::get_if<OperationNode>(&node.value);
  if (inner == nullptr) return false;
  bool are_all = true;
  for (CsgNode& child : inner->children) are_all = paint(name, surface, child) && are_all;
  return are_all;
}

MaterialIndex SceneBuilder::painted(const std::string& name, const BrlcadSurface& surface,
                                    const MarkedSolid& marked) {
  if (!surface.on_solids || surface.on_solids->kind == PatternKind::kNone) return kInheritMaterial;
  if (has_no_chart(marked.solid->kind)) return kInheritMaterial;
  BrlcadSurface own = surface;
  const auto pattern = laid_on(*surface.on_solids, *marked.solid, marked.to_world, marked.grow);
  if (pattern) {
    own.material.pattern = *pattern;
    return material_of(own);
  }
  report_.changed("regions", "a pattern is one colour on solids without a size to measure it by",
                  name);
  return kInheritMaterial;
}

BrlcadSurface SceneBuilder::surface_of(const std::string& name, const State& state,
                                       const BrlcadComb* region) {
  std::array<int, 3> rgb = state.rgb.value_or(kWhite);
  if (region != nullptr && !state.rgb) {
    // The last range that holds the number counts: later ones are laid over those before.
    for (const BrlcadColorRange& range : database_.colors) {
      if (region->region_id >= range.low && region->region_id <= range.high) rgb = range.rgb;
    }
  }
  BrlcadSurface surface = brlcad_surface(state.shader, rgb, name, report_);
  Pattern& pattern = surface.material.pattern;
  if (pattern.kind == PatternKind::kNone) return surface;
  const auto to_region = state.to_world.inverse();
  if (to_region) pattern.to_pattern = compose(pattern.to_pattern, *to_region);
  if (to_region && pattern.to_pattern.is_finite() && pattern.to_pattern.inverse()) return surface;
  report_.changed("regions", "a pattern whose sizes leave the range of doubles isn't drawn", name);
  pattern = {};
  return surface;
}

MaterialIndex SceneBuilder::material_of(const BrlcadSurface& surface) {
  const Material& m = surface.material;
  const auto index = static_cast<MaterialIndex>(scene_.materials.size());
  const std::string name = "material " + std::to_string(index + 1);
  if (surface.is_light) {
    // A lamp's brightness, which its material tells, is only known when all lamps are.
    scene_.materials.push_back({name, m});
    return index;
  }
  const auto [known, is_new] = materials_.emplace(key_of(m), index);
  if (is_new) scene_.materials.push_back({name, m});
  return known->second;
}

void SceneBuilder::add_object(const std::string& name, Part part, BrlcadSurface surface,
                              const std::vector<Cut>& cuts, const FirstSolid& first) {
  Lack lacks = std::exchange(lacks_, {});
  for (const Cut& cut : cuts) {
    if (!lacks) lacks = cut.lacks;
  }
  if (lacks) return report_.left_out("regions", lacks.why, name, lacks.detail);
  if (surface.is_environment) {
    return report_.changed("regions", "an envmap is no background here, and isn't drawn", name);
  }
  for (const Cut& cut : cuts) {
    if (!part.node) return;
    leaves_ += leaves_below(cut.node);
    part = join(cut.is_minus ? Operation::kDifference : Operation::kIntersection, std::move(part),
                {cut.node, cut.levels});
  }
  if (!part.node || !check_limits(name, part)) return;
  if (surface.is_light) lamps_.push_back({scene_.objects.size(), surface.lamp, first.to_world});
  const bool has_own = marks_solids_ && paint(name, surface, *part.node);
  const MaterialIndex material = has_own ? kInheritMaterial : material_of(surface);
  scene_.objects.push_back({printable(name), material, std::move(*part.node)});
}

std::string SceneBuilder::printable(std::string name) {
  for (char& c : name) {
    if (static_cast<unsigned char>(c) < 0x20 || static_cast<unsigned char>(c) >= 0x7F) c = '?';
  }
  return name;
}

bool SceneBuilder::check_limits(const std::string& name, const Part& part) {
  if (part.levels > kMaxBrlcadLevels) {
    report_.error(name, "its tree has more than " + std::to_string(kMaxBrlcadLevels) + " levels");
  } else if (leaves_ > kMaxBrlcadLeaves) {
    report_.error(name, "the model has more than " + std::to_string(kMaxBrlcadLeaves) + " solids");
  }
  return !report_.has_errors();
}

Part SceneBuilder::build(const std::string& name, const Affine& to_world, bool is_cut) {
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

Part SceneBuilder::build(const BrlcadTree& tree, const Affine& to_world, bool is_cut) {
  switch (tree.op) {
    case Op::kLeaf:
      if (tree.has_broken_matrix) lack("a member's matrix is no invertible affine map");
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

Part SceneBuilder::solid(const BrlcadObject& object, const Affine& to_world, bool is_cut) {
  if (const auto* foreign = std::get_if<BrlcadForeign>(&object.value)) {
    lack(foreign->kind + " is not supported");
    return {};
  }
  if (const auto* broken = std::get_if<BrlcadBroken>(&object.value)) {
    lack("an object can't be read", object.where + ": " + object.name + ": " + broken->why);
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
    if (built.is_unsupported) {
      lack(built.problem);
    } else {
      report_.left_out("solids", built.problem, object.name, built.detail);
    }
    return {};
  }
  if (!built.change.empty()) report_.changed("solids", built.change, object.name);
  if (marks_solids_) {
    built.node->material = static_cast<MaterialIndex>(marked_.size());
    marked_.push_back({&is, to_world, is_cut ? kBrlcadSkin : 0});
  }
  return {std::move(built.node), levels_of(*built.node)};
}

}  // namespace graycube::brlcad
