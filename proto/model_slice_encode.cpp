#include <algorithm>
#include <unordered_map>

#include "check.hpp"
#include "proto/bytes.hpp"
#include "proto/model_layout.hpp"
#include "proto/model_slice.hpp"
#include "proto/slices/material_bytes.hpp"
#include "proto/slices/outline_bytes.hpp"
#include "proto/slices/values.hpp"
#include "regions/kept_trees.hpp"
#include "stop_point.hpp"

namespace graycube {
namespace {

using namespace model_layout;

void put_box(ByteWriter& w, const Aabb& box) {
  put_vec(w, box.lo);
  put_vec(w, box.hi);
}

void put_settings(ByteWriter& w, const RenderSettings& s, double delta) {
  w.put(s.image.width);
  w.put(s.image.height);
  w.put(s.image.samples);
  w.put(static_cast<std::uint8_t>(s.camera.projection));
  w.put(static_cast<std::uint8_t>(s.camera.handedness));
  w.put(s.aovs.bits());
  w.put(static_cast<std::uint8_t>(s.camera.inside));
  put_vec(w, s.camera.eye);
  put_vec(w, s.camera.look_at);
  put_vec(w, s.camera.up);
  w.put(s.camera.fov_degrees);
  w.put(s.camera.width);
  put_rgb(w, s.background);
  put_rgb(w, s.ambient);
  w.put(s.max_depth);
  w.put(s.min_weight);
  w.put(delta);
  for (const double v : s.camera.pixel_offset) w.put(v);
}

void put_light(ByteWriter& w, const PointLight& light) {
  put_vec(w, light.position);
  put_rgb(w, light.color);
  const auto falloff = static_cast<std::uint8_t>(light.falloff);
  w.put(static_cast<std::uint8_t>(falloff | (light.shadows ? 0 : kShadowlessBit)));
  put_vec(w, light.direction);
  w.put(light.angle_degrees);
}

void put_primitive(ByteWriter& w, const Primitive& p, unsigned flags) {
  w.put(static_cast<std::uint8_t>(p.kind));
  w.put(static_cast<std::uint16_t>(flags));
  w.put(p.material);
  for (std::size_t i = 0; i < p.v.size(); ++i) {
    if ((flags >> i & 1) != 0) w.put(p.v[i]);
  }
  if ((flags & kHasMap) != 0) {
    for (const auto& row : p.to_local.m) {
      for (const double v : row) w.put(v);
    }
  }
  if ((flags & kHasBounds) != 0) put_box(w, p.bounds);
  if ((flags & kHasPlanes) != 0) {
    w.put(p.first_plane);
    w.put(p.plane_count);
  }
  if ((flags & kHasMesh) != 0) w.put(p.mesh);
  if ((flags & kHasOutline) != 0) w.put(p.outline);
}

void put_plane(ByteWriter& w, const Plane& plane) {
  put_vec(w, plane.normal);
  w.put(plane.offset);
}

void put_mesh(ByteWriter& w, const TriangleMesh& mesh) {
  w.put(static_cast<std::uint32_t>(mesh.points.size()));
  w.put(static_cast<std::uint32_t>(mesh.triangles.size()));
  w.put(static_cast<std::uint32_t>(mesh.planes.size()));
  for (const Vec3& p : mesh.points) put_vec(w, p);
  for (const Triangle& t : mesh.triangles) {
    for (const std::uint32_t i : t) w.put(i);
  }
  for (const Plane& plane : mesh.planes) put_plane(w, plane);
  for (const std::uint32_t plane : mesh.plane_of) w.put(plane);
}

/// One number is written: a leaf's size is 1 anyhow, and an inner node has no primitive.
void put_node(ByteWriter& w, const TreeNode& n) {
  GRAYCUBE_CHECK(is_inner(n.kind) ? n.primitive == 0 : n.size == 1,
                 "kind %d, primitive %u, size %u", static_cast<int>(n.kind), n.primitive, n.size);
  w.put(static_cast<std::uint8_t>(n.kind));
  w.put(is_inner(n.kind) ? n.size : n.primitive);
}

void put_object(ByteWriter& w, const Object& o) {
  w.put(o.id);
  w.put(o.first_node);
  w.put(o.node_count);
  put_box(w, o.bounds);
}

struct Counts {
  std::size_t planes = 0, primitives = 0, nodes = 0, objects = 0, meshes = 0, outlines = 0;
};

std::size_t beginning_bytes(const Model& model) {
  std::size_t bytes = kHeaderBytes + kSettingsBytes + model.settings.lights.size() * kLightBytes;
  for (const Material& m : model.materials) bytes += material_bytes(m);
  return bytes;
}

/// Writes the header, settings, lights and materials.
void put_beginning(ByteWriter& w, const Model& model, const Counts& counts) {
  w.put(kModelMagic);
  w.put(kModelVersion);
  w.put(static_cast<std::uint16_t>(counts.outlines));
  for (const std::size_t count :
       {model.settings.lights.size(), model.materials.size(), counts.planes, counts.primitives,
        counts.nodes, counts.objects, counts.meshes}) {
    w.put(static_cast<std::uint32_t>(count));
  }
  put_settings(w, model.settings, model.delta);
  for (const PointLight& light : model.settings.lights) put_light(w, light);
  for (const Material& material : model.materials) put_material(w, material);
}

/// The deepest nesting of a preorder list of trees whose sizes are trusted.
std::size_t depth_of(const std::vector<TreeNode>& nodes) {
  std::vector<std::size_t> ends;
  std::size_t deepest = 0;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    while (!ends.empty() && ends.back() <= i) ends.pop_back();
    ends.push_back(i + nodes[i].size);
    deepest = std::max(deepest, ends.size());
  }
  return deepest;
}

}  // namespace

std::size_t encoded_model_bytes(const Model& model) {
  std::size_t bytes = beginning_bytes(model) + model.planes.size() * kPlaneBytes +
                      model.nodes.size() * kNodeBytes + model.objects.size() * kObjectBytes;
  for (const Mesh& m : model.meshes) bytes += mesh_bytes(m.surface());
  for (const Outline& o : model.outlines) bytes += outline_bytes(o);
  for (const Primitive& p : model.primitives) bytes += primitive_bytes(flags_of(p));
  return bytes;
}

std::size_t encoded_object_bytes(const Model& model, const Object& object) {
  std::size_t bytes = kObjectBytes + object.node_count * kNodeBytes;
  std::vector<std::uint32_t> outlines;
  for (const TreeNode& n : model.tree(object)) {
    if (is_inner(n.kind)) continue;
    const Primitive& p = model.primitives[n.primitive];
    bytes += primitive_bytes(flags_of(p)) + p.plane_count * kPlaneBytes;
    if (p.kind == PrimitiveKind::kMesh) bytes += mesh_bytes(model.meshes[p.mesh].surface());
    if (csg::has_outline(p.kind)) outlines.push_back(p.outline);
  }
  // Primitives may share an outline, which is sent once.
  std::sort(outlines.begin(), outlines.end());
  outlines.erase(std::unique(outlines.begin(), outlines.end()), outlines.end());
  for (const std::uint32_t outline : outlines) bytes += outline_bytes(model.outlines[outline]);
  return bytes;
}

namespace {

bool meshes_fit(const Model& model) {
  std::size_t points = 0, triangles = 0;
  for (const Mesh& m : model.meshes) {
    points += m.surface().points.size();
    triangles += m.surface().triangles.size();
  }
  return model.meshes.size() <= kMaxModelMeshes && points <= kMaxModelPoints &&
         triangles <= kMaxMeshTriangles;
}

bool outlines_fit(const Model& model) {
  std::size_t segments = 0;
  for (const Outline& o : model.outlines) segments += segment_count(o);
  return model.outlines.size() <= kMaxModelOutlines && segments <= kMaxModelSegments;
}

bool fits_limits(const Model& model, std::size_t bytes) {
  return model.settings.lights.size() <= kMaxLights &&
         model.materials.size() <= kMaxModelMaterials &&
         model.primitives.size() <= kMaxModelPrimitives && model.planes.size() <= kMaxModelPlanes &&
         meshes_fit(model) && outlines_fit(model) && model.nodes.size() <= kMaxModelNodes &&
         model.objects.size() <= kMaxModelObjects && depth_of(model.nodes) <= kMaxModelTreeDepth &&
         bytes <= kMaxModelBytes;
}

}  // namespace

bool fits_model_limits(const Model& model) {
  return fits_limits(model, encoded_model_bytes(model));
}

std::vector<std::byte> encode_model(const Model& model) {
  const std::size_t size = encoded_model_bytes(model);
  GRAYCUBE_CHECK(fits_limits(model, size), "a model of %zu bytes, %zu primitives, %zu nodes", size,
                 model.primitives.size(), model.nodes.size());
  ByteWriter w(size);
  put_beginning(w, model,
                {model.planes.size(), model.primitives.size(), model.nodes.size(),
                 model.objects.size(), model.meshes.size(), model.outlines.size()});
  for (const Plane& plane : model.planes) put_plane(w, plane);
  for (const Mesh& mesh : model.meshes) put_mesh(w, mesh.surface());
  for (const Outline& outline : model.outlines) put_outline(w, outline);
  for (const Primitive& p : model.primitives) {
    stop_if_asked();
    put_primitive(w, p, flags_of(p));
  }
  for (const TreeNode& node : model.nodes) put_node(w, node);
  for (const Object& object : model.objects) put_object(w, object);
  return std::move(w).take();
}

/// The parts of a model that go into a slice.
struct SliceEncoder::Kept {
  struct Tree {
    const Object* object;
    std::span<const TreeNode> nodes;
  };
  std::vector<Tree> trees;
  Counts counts;

  Kept(const Model& model, const ModelContents& contents) {
    for_each_kept(model, contents, [&](const Object& object, std::span<const TreeNode> nodes) {
      trees.push_back({&object, nodes});
      counts.nodes += nodes.size();
    });
    counts.objects = trees.size();
    number_outlines(model);
  }

  /// Gives the outlines that are used their numbers in the slice.
  void number_outlines(const Model& model) {
    for_each_primitive([&](std::uint32_t index) {
      const Primitive& p = model.primitives[index];
      if (!csg::has_outline(p.kind)) return;
      const auto next = static_cast<std::uint32_t>(outlines.size());
      if (outline_numbers.try_emplace(p.outline, next).second) outlines.push_back(p.outline);
    });
    counts.outlines = outlines.size();
  }

  /// The numbers of outlines in the model, in the slice's order; and those in the slice.
  std::vector<std::uint32_t> outlines;
  std::unordered_map<std::uint32_t, std::uint32_t> outline_numbers;

  /// Calls f(index of a primitive) for all of them, in the order in which they are renumbered.
  template <typename F>
  void for_each_primitive(F&& f) const {
    for (const Tree& t : trees) {
      for (const TreeNode& n : t.nodes) {
        if (!is_inner(n.kind)) f(n.primitive);
      }
    }
  }
};

SliceEncoder::SliceEncoder(const Model& model) : model_(model) {
  flags_.reserve(model.primitives.size());
  for (const Primitive& p : model.primitives) {
    const unsigned flags = flags_of(p) & ~(kHasMesh | kHasOutline | kHasPlanes);
    flags_.push_back(static_cast<std::uint16_t>(flags | (p.plane_count > 0 ? kHasPlanes : 0)));
  }
}

std::vector<std::byte> SliceEncoder::encode(
    const ModelContents& contents, std::span<const std::span<const std::byte>> tails) const {
  Kept kept(model_, contents);
  Counts& counts = kept.counts;
  std::size_t bytes =
      beginning_bytes(model_) + counts.nodes * kNodeBytes + counts.objects * kObjectBytes;
  // The first mesh and outline of a slice are number 0, which is not written.
  const auto flags = [&](const Primitive& p, unsigned of_whole) {
    if (csg::has_outline(p.kind) && kept.outline_numbers.at(p.outline) > 0)
      return of_whole | kHasOutline;
    return p.kind == PrimitiveKind::kMesh && counts.meshes > 0 ? of_whole | kHasMesh : of_whole;
  };
  kept.for_each_primitive([&](std::uint32_t index) {
    const Primitive& p = model_.primitives[index];
    bytes += primitive_bytes(flags(p, flags_[index])) + p.plane_count * kPlaneBytes;
    ++counts.primitives;
    counts.planes += p.plane_count;
    if (p.kind != PrimitiveKind::kMesh) return;
    bytes += mesh_bytes(model_.meshes[p.mesh].surface());
    ++counts.meshes;
  });
  for (const std::uint32_t o : kept.outlines) bytes += outline_bytes(model_.outlines[o]);
  for (const auto tail : tails) bytes += tail.size();
  ByteWriter w(bytes);
  put_beginning(w, model_, counts);
  kept.for_each_primitive([&](std::uint32_t index) {
    const Primitive& p = model_.primitives[index];
    for (std::uint32_t i = 0; i < p.plane_count; ++i)
      put_plane(w, model_.planes[p.first_plane + i]);
  });
  kept.for_each_primitive([&](std::uint32_t index) {
    const Primitive& p = model_.primitives[index];
    if (p.kind == PrimitiveKind::kMesh) put_mesh(w, model_.meshes[p.mesh].surface());
  });
  for (const std::uint32_t o : kept.outlines) put_outline(w, model_.outlines[o]);
  counts.planes = counts.meshes = 0;
  kept.for_each_primitive([&](std::uint32_t index) {
    stop_if_asked();
    const Primitive& p = model_.primitives[index];
    const unsigned written = flags(p, flags_[index]);
    if (p.plane_count == 0 && p.kind != PrimitiveKind::kMesh && !csg::has_outline(p.kind))
      return put_primitive(w, p, written);
    Primitive renumbered = p;
    renumbered.first_plane = static_cast<std::uint32_t>(counts.planes);
    counts.planes += p.plane_count;
    renumbered.mesh = static_cast<std::uint32_t>(counts.meshes);
    counts.meshes += p.kind == PrimitiveKind::kMesh ? 1 : 0;
    if (csg::has_outline(p.kind)) renumbered.outline = kept.outline_numbers.at(p.outline);
    put_primitive(w, renumbered, written);
  });
  std::uint32_t primitives = 0, nodes = 0;
  for (const Kept::Tree& t : kept.trees) {
    for (TreeNode n : t.nodes) {
      if (!is_inner(n.kind)) n.primitive = primitives++;
      put_node(w, n);
    }
  }
  for (const Kept::Tree& t : kept.trees) {
    const auto count = static_cast<std::uint32_t>(t.nodes.size());
    put_object(w, {t.object->id, nodes, count, t.object->bounds});
    nodes += count;
  }
  for (const auto tail : tails) std::copy(tail.begin(), tail.end(), w.room(tail.size()));
  return std::move(w).take();
}

}  // namespace graycube
