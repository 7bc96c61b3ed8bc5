#include "scene/compile_scene.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "check.hpp"
#include "coincidence/coincidence.hpp"
#include "coincidence/exactness.hpp"
#include "csg/build_primitive.hpp"
#include "csg/kinds.hpp"
#include "csg/soundness.hpp"
#include "csg/tree.hpp"
#include "geometry/infinity.hpp"
#include "overloaded.hpp"
#include "scene/bezier_solid.hpp"
#include "scene/flat_solids.hpp"
#include "scene/leaf_reach.hpp"
#include "scene/outline_solids.hpp"
#include "scene/repeat.hpp"
#include "scene/scene_fault.hpp"
#include "scene/scene_place.hpp"
#include "spelling.hpp"
#include "stop_point.hpp"

namespace graycube {
namespace {

/// Counts the leaves of all objects, references expanded; a prism is one, whatever it becomes.
class LeafCounter {
 public:
  explicit LeafCounter(const Scene& scene) : scene_(scene), shapes_(scene.shapes.size()) {}

  std::size_t count(const CsgNode& node) {
    if (const auto* operation = std::get_if<OperationNode>(&node.value)) {
      std::size_t sum = 0;
      for (const CsgNode& child : operation->children) sum += count(child);
      return sum;
    }
    if (const auto* repeat = std::get_if<RepeatNode>(&node.value))
      return counts_of(*repeat).copies * count(repeat->child.front());
    const auto* reference = std::get_if<ReferenceNode>(&node.value);
    if (reference == nullptr) return 1;
    std::optional<std::size_t>& known = shapes_[reference->shape];
    if (!known) known = count(scene_.shapes[reference->shape].node);
    return *known;
  }

 private:
  const Scene& scene_;
  std::vector<std::optional<std::size_t>> shapes_;
};

std::size_t leaf_count(const Scene& scene) {
  LeafCounter counter(scene);
  std::size_t sum = 0;
  for (const SceneObject& object : scene.objects) sum += counter.count(object.csg);
  return sum;
}

/// Whether all objects are under one and the same map.
bool has_one_root_map(const Scene& scene) {
  return std::all_of(scene.objects.begin(), scene.objects.end(), [&](const SceneObject& object) {
    const auto& own = object.csg.transform;
    const auto& first = scene.objects.front().csg.transform;
    return own && first && *own == *first;
  });
}

class Compiler {
 public:
  explicit Compiler(const Scene& scene) : scene_(scene), share_(share_of_digits(scene.digits)) {}

  Model run() {
    model_.settings = scene_.settings;
    for (const NamedMaterial& m : scene_.materials) model_.materials.push_back(m.material);
    const std::size_t leaves = leaf_count(scene_);
    model_.objects.reserve(scene_.objects.size());
    model_.nodes.reserve(leaves);
    model_.primitives.reserve(leaves);
    unifier_.reserve(leaves);
    for (const SceneObject& object : scene_.objects) add_object(object);
    check_settings();
    if (!faults_.is_empty()) throw UnrenderableScene(std::move(faults_).take());
    if (unifier_.unify()) measure_again();
    model_.delta = delta();
    return std::move(model_);
  }

 private:
  /// The properties that a node inherits from those above it.
  struct Context {
    MeasuredMap to_world;
    MaterialIndex material = kInheritMaterial;
    bool inverted = false;
    /// The node is a root, and its map, whose digits are few, is that of all roots.
    bool is_around_all = false;
    ScenePlace place;
  };

  /// The children of an operation, in prefix order. One child alone needs no operation, and
  /// children of the same operation give their own children in their place.
  class Group {
   public:
    Group(std::vector<TreeNode>& nodes, bool is_and, std::uint64_t children)
        : nodes_(nodes),
          kind_(is_and ? TreeNode::Kind::kAnd : TreeNode::Kind::kOr),
          start_(nodes.size()),
          is_one_(children == 1) {
      if (!is_one_) nodes_.push_back({kind_, 0, 1});
    }
    template <typename Emit>
    void add(const Emit& emit_child) {
      const std::size_t at = nodes_.size();
      emit_child();
      if (!is_one_ && nodes_[at].kind == kind_)
        nodes_.erase(nodes_.begin() + static_cast<std::ptrdiff_t>(at));
    }
    void close() {
      if (!is_one_) nodes_[start_].size = static_cast<std::uint32_t>(nodes_.size() - start_);
    }

   private:
    std::vector<TreeNode>& nodes_;
    TreeNode::Kind kind_;
    std::size_t start_;
    bool is_one_;
  };

  /// Eye and lights keep to the range of solids; the reader has checked all else.
  void check_settings() {
    const Camera& camera = scene_.settings.camera;
    check_point("/camera/eye", "the eye", camera.eye);
    check_point("/camera/look_at", "the point looked at", camera.look_at);
    const auto& lights = scene_.settings.lights;
    for (std::size_t i = 0; i < lights.size(); ++i)
      check_point("/lights/" + std::to_string(i) + "/position", "the light", lights[i].position);
  }
  void check_point(std::string pointer, const std::string& what, const Vec3& point) {
    if (!is_within_range(point)) faults_.add(std::move(pointer), what + " lies beyond 1e18");
  }

  void add_object(const SceneObject& object) {
    Object out;
    out.id = static_cast<std::uint32_t>(model_.objects.size());
    out.first_node = static_cast<std::uint32_t>(model_.nodes.size());
    emit(object.csg, {.to_world = {},
                      .material = object.material,
                      .inverted = false,
                      .is_around_all = has_one_rounded_root_map_,
                      .place = {.index = out.id}});
    out.node_count = static_cast<std::uint32_t>(model_.nodes.size()) - out.first_node;
    out.bounds = bounds_of(model_.tree(out), model_.primitives);
    model_.objects.push_back(out);
  }

  void emit(const CsgNode& node, Context context) {
    if (node.transform) context.to_world = compose(context.to_world, *node.transform);
    if (std::exchange(context.is_around_all, false))
      context.to_world = moving_all_alike(context.to_world, kRoundedShare, share_);
    if (node.material != kInheritMaterial) context.material = node.material;
    std::visit(Overloaded{[&](const OperationNode& n) { emit_operation(n, context); },
                          [&](const ReferenceNode& n) { emit_shape(n, context); },
                          [&](const RepeatNode& n) { emit_repeat(n, context); },
                          [&](const PrismShape& shape) { emit_prism(shape, context); },
                          [&](const BezierShape& shape) { emit_bezier(shape, context); },
                          [&](const auto& shape) {
                            emit_leaf(node, build(context.to_world.map, shape), context);
                          }},
               node.value);
  }

  void emit_shape(const ReferenceNode& n, const Context& context) {
    Context inner = context;
    inner.place = {&context.place, ScenePlace::Step::kShape, n.shape};
    emit(scene_.shapes[n.shape].node, inner);
  }

  void emit_operation(const OperationNode& n, const Context& context) {
    if (n.operation == Operation::kComplement) {
      Context inverted = context;
      inverted.inverted = !context.inverted;
      inverted.place = {&context.place, ScenePlace::Step::kOnlyChild, 0};
      emit(n.children.front(), inverted);
      return;
    }
    // De Morgan: inversion swaps ∧ and ∨ and goes on to the leaves.
    const bool is_and = (n.operation != Operation::kUnion) != context.inverted;
    Group group(model_.nodes, is_and, n.children.size());
    for (std::size_t i = 0; i < n.children.size(); ++i) {
      Context child = context;
      child.place = {&context.place, ScenePlace::Step::kChild, i};
      if (n.operation == Operation::kDifference && i > 0) child.inverted = !context.inverted;
      group.add([&] { emit(n.children[i], child); });
    }
    group.close();
  }

  void emit_repeat(const RepeatNode& n, const Context& context) {
    Group group(model_.nodes, context.inverted, counts_of(n).copies);
    for_each_copy(n, context.to_world, [&](const MeasuredMap& to_world, std::size_t level) {
      Context copy = context;
      copy.to_world = to_world;
      copy.place = {&context.place, ScenePlace::Step::kCopy, level};
      group.add([&] { emit(n.child.front(), copy); });
    });
    group.close();
  }

  void emit_prism(const PrismShape& shape, const Context& context) {
    const auto solid = prism_of(shape);
    if (solid) return emit(*solid, context);
    report(context.place, "prism", "goes round no area to working precision");
    emit(CsgNode{SphereShape{{}, 1}, {}, kInheritMaterial}, context);
  }

  void emit_bezier(const BezierShape& shape, const Context& context) {
    const auto [known, is_new] = meshes_of_nets_.try_emplace(&shape);
    CsgNode& mesh = known->second;
    if (is_new) {
      auto made = mesh_of(shape);
      if (auto* surface = std::get_if<TriangleMesh>(&made)) {
        mesh.value = MeshShape{std::move(*surface), 0};
      } else {
        report(context.place, "bezier", "encloses no solid: " + std::get<MeshFault>(made).why);
        mesh.value = SphereShape{{}, 1};
      }
    }
    emit(mesh, context);
  }

  /// Of a leaf that a repeat copies only the first fault is told.
  void report(const ScenePlace& place, std::string_view kind, std::string_view why) {
    const ScenePlace* copy = place.copy();
    if (copy && !told_.insert(place.pointer(scene_) + ' ' + root_pointer(place)).second) return;
    if (!faults_.has_room()) return faults_.count();
    const std::string& object = scene_.objects[place.object()].name;
    std::string text = "the " + std::string(kind);
    if (!object.empty()) text += " of " + quoted(object);
    text += " " + std::string(why);
    if (copy) {
      text += ", under " + std::to_string(copy->index) + (copy->index == 1 ? " map" : " maps") +
              " of " + copy->above->pointer(scene_);
    }
    if (place.is_in_shape()) text += ", where " + root_pointer(place) + " uses it";
    faults_.add(place.pointer(scene_), std::move(text));
  }
  static std::string root_pointer(const ScenePlace& place) {
    return "/objects/" + std::to_string(place.object()) + "/csg";
  }

  void emit_leaf(const CsgNode& leaf, Primitive primitive, const Context& context) {
    stop_if_asked();
    GRAYCUBE_CHECK(context.material != kInheritMaterial, "a leaf without a material");
    if (const char* why = why_unsound(primitive, model_.planes)) {
      report(context.place, csg::traits_of(primitive.kind).name, why);
      primitive = {};
    }
    primitive.material = context.material;
    const auto kind = context.inverted ? TreeNode::Kind::kInvertedLeaf : TreeNode::Kind::kLeaf;
    model_.nodes.push_back({kind, static_cast<std::uint32_t>(model_.primitives.size()), 1});
    model_.primitives.push_back(primitive);
    include(primitive.bounds);
    const LeafReach reach = reach_of(leaf, primitive, context.to_world.map);
    unifier_.add(exactness_of(context.to_world, reach.most, reach.turn, share_of(leaf), share_));
  }

  double share_of(const CsgNode& leaf) const {
    const auto* mesh = std::get_if<MeshShape>(&leaf.value);
    return mesh == nullptr ? share_ : std::max(share_, share_of_digits(mesh->digits));
  }

  /// Computes bounds again after those of primitives have changed.
  void measure_again() {
    for (Object& object : model_.objects)
      object.bounds = bounds_of(model_.tree(object), model_.primitives);
    largest_ = 0;
    for (const Primitive& p : model_.primitives) include(p.bounds);
  }

  void include(const Aabb& bounds) {
    for (int a = 0; a < 3; ++a) {
      for (const double x : {bounds.lo[a], bounds.hi[a]}) {
        const double size = std::fabs(x);
        if (size > largest_ && size < kInf) largest_ = size;
      }
    }
  }

  static Primitive build(const Affine& m, const SphereShape& s) {
    return build_sphere(m, s.center, s.radius);
  }
  static Primitive build(const Affine& m, const BoxShape& s) { return build_box(m, s.min, s.max); }
  static Primitive build(const Affine& m, const CylinderShape& s) {
    return build_cylinder(m, s.base, s.top, s.radius);
  }
  static Primitive build(const Affine& m, const ConeShape& s) {
    return build_cone(m, s.base, s.base_radius, s.top, s.top_radius);
  }
  static Primitive build(const Affine& m, const TorusShape& s) {
    return build_torus(m, s.center, s.axis, s.major, s.minor);
  }
  static Primitive build(const Affine& m, const HalfSpaceShape& s) {
    return build_half_space(m, {s.normal, s.offset});
  }
  static Primitive build(const Affine& m, const EllipsoidShape& s) {
    return build_ellipsoid(m, s.center, s.axes);
  }
  static Primitive build(const Affine& m, const EllipticConeShape& s) {
    return build_elliptic_cone(m, s.base, s.top, s.a, s.b, s.top_a, s.top_b);
  }
  static Primitive build(const Affine& m, const EllipticTorusShape& s) {
    return build_elliptic_torus(m, s.center, s.axis, s.radius, s.outward, s.upward, s.across);
  }
  Primitive build(const Affine& m, const QuadricShape& s) {
    return build_quadric(m, s.coefficients, s.min, s.max, model_.planes);
  }
  Primitive build(const Affine& m, const PolyhedronShape& s) {
    std::vector<Plane> faces;
    for (const HalfSpaceShape& f : s.planes) faces.push_back({f.normal, f.offset});
    return build_polyhedron(m, faces, model_.planes);
  }

  Primitive build(const Affine& m, const MeshShape& s) {
    return build_mesh(m, s.mesh, model_.meshes);
  }
  Primitive build(const Affine& m, const LatheShape& s) {
    return build_lathe(m, outlines_.of(s.outline));
  }
  Primitive build(const Affine& m, const SweepShape& s) {
    return build_sweep(m, outlines_.of(s.outline), s.base, s.height);
  }

  double delta() const {
    double largest = std::fmax(largest_, max_abs(scene_.settings.camera.eye));
    for (const PointLight& l : scene_.settings.lights)
      largest = std::fmax(largest, max_abs(l.position));
    return 1e-9 * largest;
  }

  const Scene& scene_;
  double share_;
  bool has_one_rounded_root_map_ = share_ > kRoundedShare&& has_one_root_map(scene_);
  SceneFaults faults_;
  /// What stands for each net of patches, which refs and repeats may use often.
  std::map<const BezierShape*, CsgNode> meshes_of_nets_;
  /// Places of leaves in repeats whose fault has been told.
  std::set<std::string> told_;
  Model model_;
  OutlineStock outlines_{model_.outlines};
  CoincidenceUnifier unifier_{model_};
  /// The largest finite coordinate of the primitives' bounds so far.
  double largest_ = 0;
};

}  // namespace

Model compile_scene(const Scene& scene) { return Compiler(scene).run(); }

}  // namespace graycube
