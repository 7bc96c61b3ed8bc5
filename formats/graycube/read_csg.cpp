#include "formats/graycube/read_csg.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "formats/graycube/read_leaf.hpp"
#include "formats/graycube/read_transform.hpp"
#include "scene/limits.hpp"
#include "spelling.hpp"

namespace graycube {
namespace {

/// The rules of the node's type; null, after reporting, when the node names none.
const NodeRules* rules_for(JsonAccess& json, JsonIndex at) {
  if (!json.is_object(at)) return nullptr;
  JsonIndex type = 0;
  for (JsonIndex m = json.tree.first_child(at); type == 0 && m != json.tree.end(at);
       m = json.tree.next(m))
    if (json.tree.key(m) == "type") type = m;
  if (type == 0) {
    json.errors.add(at, "a CSG node needs the key \"type\"");
    return nullptr;
  }
  std::string_view written;
  if (!json.read(type, written)) return nullptr;
  const auto all = node_rules();
  const auto found =
      std::find_if(all.begin(), all.end(), [&](const NodeRules& r) { return r.name == written; });
  if (found != all.end()) return &*found;
  std::vector<std::string_view> names;
  for (const auto& r : all) names.push_back(r.name);
  json.unknown_word(type, names);
  return nullptr;
}

Operation operation_of(NodeType type) {
  switch (type) {
    case NodeType::kIntersection: return Operation::kIntersection;
    case NodeType::kDifference: return Operation::kDifference;
    case NodeType::kComplement: return Operation::kComplement;
    default: return Operation::kUnion;
  }
}

/// The index of a name; nothing, after reporting, when the table doesn't have it.
std::optional<std::uint32_t> look_up(JsonAccess& json, JsonIndex at, const NameTable& table,
                                     const char* what) {
  std::string_view name;
  if (!json.read(at, name)) return std::nullopt;
  const auto index = table.find(name);
  if (index) return index;
  if (json.errors.has_room())
    json.errors.add(at, std::string("unknown ") + what + " " + json.tree.describe(at) +
                            did_you_mean(name, table.names()));
  else
    json.errors.count();
  return std::nullopt;
}

}  // namespace

TreeSummary CsgReader::read_shape(JsonIndex at, CsgNode& out) {
  TreeSummary summary;
  Context context{summary, false};
  read_node(at, out, false, 1, context);
  return summary;
}

TreeSummary CsgReader::read_object(JsonIndex at, CsgNode& out, bool has_material) {
  TreeSummary summary;
  Context context{summary, true};
  read_node(at, out, has_material, 1, context);
  return summary;
}

MaterialIndex CsgReader::read_material_name(JsonIndex at) {
  return look_up(json_, at, materials_, "material").value_or(0);
}

void CsgReader::read_node(JsonIndex at, CsgNode& out, bool has_material, std::uint32_t depth,
                          Context& context) {
  if (depth > kMaxTreeDepth)
    return json_.errors.add(at,
                            "the tree is deeper than " + std::to_string(kMaxTreeDepth) + " levels");
  ++context.summary.counts.nodes;
  context.summary.depth = std::max(context.summary.depth, depth);
  const NodeRules* rules = rules_for(json_, at);
  if (rules == nullptr) return;
  std::array<JsonIndex, kMaxNodeKeys> member{};
  json_.members(at, rules->owner, rules->rules(), {member.data(), rules->key_count});
  if (member[kTransformKey] != 0) out.transform = read_transform(json_, member[kTransformKey]);
  if (member[kMaterialKey] != 0) {
    out.material = read_material_name(member[kMaterialKey]);
    has_material = true;
  }
  const JsonIndex body = member[kCommonKeys];
  switch (rules->type) {
    case NodeType::kUnion:
    case NodeType::kIntersection:
    case NodeType::kDifference:
    case NodeType::kComplement: {
      auto& operation = out.value.emplace<OperationNode>();
      operation.operation = operation_of(rules->type);
      if (body == 0) return;
      if (rules->type != NodeType::kComplement)
        return read_children(body, operation, has_material, depth, context);
      operation.children.resize(1);
      ++nodes_read_;
      return read_node(body, operation.children.front(), has_material, depth + 1, context);
    }
    case NodeType::kRef:
      if (body != 0) out.value = read_reference(body, at, has_material, depth, context);
      return;
    case NodeType::kRepeat:
      return read_repeat(member, at, out.value.emplace<RepeatNode>(), has_material, depth, context);
    case NodeType::kBezier:
      read_leaf(at, has_material, rules->owner, context);
      return read_bezier_leaf(at, member, out, context);
    case NodeType::kMesh:
      read_leaf(at, has_material, rules->owner, context);
      return read_mesh_leaf(at, member, out, context);
    case NodeType::kLathe:
    case NodeType::kSweep:
      read_leaf(at, has_material, rules->owner, context);
      return read_outlined_leaf(at, rules->type, member, out);
    default:
      read_leaf(at, has_material, rules->owner, context);
      read_leaf_value(json_, rules->type, member, out);
      // A prism counts one leaf per corner, as it is cut into fewer pieces than it has corners.
      if (const auto* prism = std::get_if<PrismShape>(&out.value)) {
        for (const auto& path : prism->paths) context.summary.counts.leaves += path.size();
        if (prism->paths.empty()) context.summary.counts.leaves += prism->points.size();
      }
      if (const auto* polyhedron = std::get_if<PolyhedronShape>(&out.value))
        context.summary.counts.planes += polyhedron->planes.size();
  }
}

void CsgReader::read_leaf(JsonIndex at, bool has_material, std::string_view owner,
                          Context& context) {
  ++context.summary.counts.leaves;
  if (has_material) return;
  if (context.summary.bare_leaf == 0) context.summary.bare_leaf = at;
  if (context.reports_bare_leaves)
    json_.errors.add(
        at, std::string(owner) + " without a material: neither it nor anything above it names one");
}

void CsgReader::read_mesh_leaf(JsonIndex at, const std::array<JsonIndex, kMaxNodeKeys>& members,
                               CsgNode& out, Context& context) {
  auto& shape = out.value.emplace<MeshShape>();
  read_mesh(json_, at, members, load_mesh_, shape);
  if (!count_mesh(at, shape.mesh.points.size(), shape.mesh.triangles.size(), context)) shape = {};
}

void CsgReader::read_bezier_leaf(JsonIndex at, const std::array<JsonIndex, kMaxNodeKeys>& members,
                                 CsgNode& out, Context& context) {
  auto& shape = out.value.emplace<BezierShape>();
  const std::uint64_t triangles = read_bezier(json_, members, shape);
  // A closed mesh has about half as many points as triangles, a net never more.
  if (!count_mesh(at, shape.net.points.size(), triangles, context)) shape = {};
}

void CsgReader::read_outlined_leaf(JsonIndex at, NodeType type,
                                   const std::array<JsonIndex, kMaxNodeKeys>& members,
                                   CsgNode& out) {
  segments_read_ += read_outlined(json_, type, members, out);
  ++outlines_read_;
  if (outlines_read_ <= kMaxOutlines && segments_read_ <= kMaxSegmentsOfOutlines) return;
  json_.errors.add(at, "more than " + std::to_string(kMaxOutlines) + " outlines or " +
                           std::to_string(kMaxSegmentsOfOutlines) + " segments of them together");
  out.value = {};
}

bool CsgReader::count_mesh(JsonIndex at, std::uint64_t points, std::uint64_t triangles,
                           Context& context) {
  mesh_points_read_ += points;
  triangles_read_ += triangles;
  if (mesh_points_read_ <= kMaxMeshPoints && triangles_read_ <= kMaxMeshTriangles) {
    context.summary.counts.triangles += triangles;
    return true;
  }
  json_.errors.add(at, "the meshes have more than " + std::to_string(kMaxMeshPoints) +
                           " points or " + std::to_string(kMaxMeshTriangles) +
                           " triangles together");
  return false;
}

void CsgReader::read_children(JsonIndex at, OperationNode& out, bool has_material,
                              std::uint32_t depth, Context& context) {
  if (!json_.is_array(at)) return;
  const std::uint32_t count = json_.tree.size(at);
  if (count == 0) {
    json_.wrong(at, "one child or more");
    return;
  }
  nodes_read_ += count;
  if (nodes_read_ > kMaxExpandedNodes)
    return json_.errors.add(at, "more than " + std::to_string(kMaxExpandedNodes) + " CSG nodes");
  out.children.resize(count);
  JsonIndex child = json_.tree.first_child(at);
  for (CsgNode& node : out.children) {
    read_node(child, node, has_material, depth + 1, context);
    child = json_.tree.next(child);
  }
}

ReferenceNode CsgReader::read_reference(JsonIndex name, JsonIndex at, bool has_material,
                                        std::uint32_t depth, Context& context) {
  const auto shape = look_up(json_, name, shapes_, "shape");
  if (!shape) return {};
  context.summary.uses.push_back({at, *shape, depth, has_material});
  return {*shape};
}

}  // namespace graycube
