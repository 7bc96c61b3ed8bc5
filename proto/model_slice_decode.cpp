#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "proto/bytes.hpp"
#include "proto/model_layout.hpp"
#include "proto/model_slice.hpp"
#include "proto/slices/material_bytes.hpp"
#include "proto/slices/outline_bytes.hpp"
#include "proto/slices/values.hpp"

namespace graycube {
namespace {

using namespace model_layout;

struct Counts {
  std::uint32_t lights, materials, planes, primitives, nodes, objects, meshes, outlines;
};

Aabb get_box(ByteReader& r) {
  const Vec3 lo = get_vec(r);
  return {lo, get_vec(r)};
}

/// Bounds may be infinite, and "nothing" has lo > hi; only NaN is wrong.
bool is_box(const Aabb& box) {
  for (int a = 0; a < 3; ++a) {
    if (std::isnan(box.lo[a]) || std::isnan(box.hi[a])) return false;
  }
  return true;
}

/// Reads part after part; the first fault is kept and everything after it skipped.
class ModelReader {
 public:
  explicit ModelReader(std::span<const std::byte> bytes) : r_(bytes), size_(bytes.size()) {}

  std::size_t remaining() const { return r_.remaining(); }

  std::variant<Model, ModelError> read() {
    const Counts counts = header();
    if (!error_) settings(counts);
    section("light", counts.lights, model_.settings.lights, &ModelReader::light);
    section("material", counts.materials, model_.materials, &ModelReader::material);
    section("plane", counts.planes, model_.planes, &ModelReader::plane);
    section("mesh", counts.meshes, model_.meshes, &ModelReader::mesh);
    section("outline", counts.outlines, model_.outlines, &ModelReader::outline);
    section("primitive", counts.primitives, model_.primitives, &ModelReader::primitive);
    section("node", counts.nodes, model_.nodes, &ModelReader::node);
    section("object", counts.objects, model_.objects, &ModelReader::object);
    if (!error_) trees();
    if (error_) return *std::move(error_);
    return std::move(model_);
  }

 private:
  void fail(std::string where, const char* why) {
    if (!error_) error_ = ModelError{std::move(where), why};
  }

  Counts header() {
    Counts c{};
    if (size_ > kMaxModelBytes) fail("header", "too large");
    if (r_.get<std::uint32_t>() != kModelMagic) fail("header", "bad magic");
    if (r_.get<std::uint16_t>() != kModelVersion) fail("header", "unknown version");
    c.outlines = r_.get<std::uint16_t>();
    for (std::uint32_t* count :
         {&c.lights, &c.materials, &c.planes, &c.primitives, &c.nodes, &c.objects, &c.meshes}) {
      *count = r_.get<std::uint32_t>();
    }
    if (c.lights > kMaxLights || c.materials > kMaxModelMaterials || c.planes > kMaxModelPlanes ||
        c.primitives > kMaxModelPrimitives || c.nodes > kMaxModelNodes ||
        c.objects > kMaxModelObjects || c.meshes > kMaxModelMeshes) {
      fail("header", "a count beyond its limit");
    }
    const std::uint64_t least =
        kSettingsBytes + std::uint64_t{c.lights} * kLightBytes +
        std::uint64_t{c.materials} * kMaterialBytes + std::uint64_t{c.planes} * kPlaneBytes +
        std::uint64_t{c.primitives} * kPrimitiveBytes + std::uint64_t{c.nodes} * kNodeBytes +
        std::uint64_t{c.objects} * kObjectBytes +
        std::uint64_t{c.meshes} * (kMeshBytes + kPointBytes + kTriangleBytes) +
        std::uint64_t{c.outlines} * (kOutlineBytes + kLoopBytes + kSegmentBytes);
    if (!r_.ok() || least > r_.remaining()) fail("header", "fewer bytes than the counts need");
    return c;
  }

  /// Reads `count` records into `out`. Memory is taken only here, after the header has shown that
  /// the bytes have room for all counts.
  template <class Record>
  void section(const char* name, std::uint32_t count, std::vector<Record>& out,
               const char* (ModelReader::*record)(Record&)) {
    if (error_) return;
    out.resize(count);
    for (std::uint32_t i = 0; i < count; ++i) {
      const char* why = (this->*record)(out[i]);
      if (!r_.ok()) why = "too short";
      if (why != nullptr) [[unlikely]] {
        fail(std::string(name) + ' ' + std::to_string(i), why);
        return;
      }
    }
  }

  void settings(const Counts& counts) {
    RenderSettings& s = model_.settings;
    s.image.width = r_.get<std::uint32_t>();
    s.image.height = r_.get<std::uint32_t>();
    s.image.samples = r_.get<std::uint32_t>();
    const auto projection = r_.get<std::uint8_t>(), handedness = r_.get<std::uint8_t>();
    const auto aovs = r_.get<std::uint8_t>(), inside = r_.get<std::uint8_t>();
    Camera& camera = s.camera;
    camera.eye = get_vec(r_);
    camera.look_at = get_vec(r_);
    camera.up = get_vec(r_);
    camera.fov_degrees = r_.get<double>();
    camera.width = r_.get<double>();
    s.background = get_rgb(r_);
    s.ambient = get_rgb(r_);
    s.max_depth = r_.get<std::uint32_t>();
    s.min_weight = r_.get<double>();
    model_.delta = r_.get<double>();
    for (double& v : camera.pixel_offset) v = r_.get<double>();
    if (projection > 1 || handedness > 1 || aovs > AovSet::kAllBits || inside > 1 ||
        (inside == 1 && projection == 0)) {
      return fail("camera", "unknown projection, handedness, AOV or view of insides");
    }
    camera.inside = static_cast<InsideView>(inside);
    s.aovs = AovSet::from_bits(aovs);
    camera.projection = static_cast<Projection>(projection);
    camera.handedness = static_cast<Handedness>(handedness);
    if (const char* why = why_wrong(s.image)) return fail("image", why);
    if (const char* why = why_wrong(camera)) return fail("camera", why);
    if (!is_color(s.background) || !is_color(s.ambient) || s.max_depth > kMaxDepth ||
        !is_coefficient(s.min_weight) || !is_coefficient(model_.delta) ||
        counts.lights > kMaxLights) {
      fail("settings", "a value out of range");
    }
  }

  static const char* why_wrong(const ImageSize& image) {
    if (image.width < 1 || image.width > kMaxImageSide || image.height < 1 ||
        image.height > kMaxImageSide || std::uint64_t{image.width} * image.height > kMaxPixels) {
      return "size out of range";
    }
    return image.samples < 1 || image.samples > kMaxSamples ? "samples out of range" : nullptr;
  }

  static const char* why_wrong(const Camera& camera) {
    if (!is_finite(camera.eye) || !is_finite(camera.look_at) || !is_finite(camera.up) ||
        !std::isfinite(camera.fov_degrees) || !std::isfinite(camera.width)) {
      return "not finite";
    }
    for (const double v : camera.pixel_offset) {
      if (!(v >= 0 && v <= 1)) return "pixel offset out of range";
    }
    const Vec3 view = normalized(camera.look_at - camera.eye);
    if (length(cross(view, normalized(camera.up))) == 0) return "no view direction, or up along it";
    if (camera.projection == Projection::kPerspective) {
      return camera.fov_degrees > 0 && camera.fov_degrees < 180 ? nullptr : "fov out of range";
    }
    return camera.width > 0 ? nullptr : "width out of range";
  }

  const char* light(PointLight& light) {
    light.position = get_vec(r_);
    light.color = get_rgb(r_);
    const auto bits = r_.get<std::uint8_t>();
    const unsigned falloff = bits & ~unsigned{kShadowlessBit};
    if (falloff > 1) return "unknown falloff";
    light.falloff = static_cast<Falloff>(falloff);
    light.shadows = (bits & kShadowlessBit) == 0;
    light.direction = get_vec(r_);
    light.angle_degrees = r_.get<double>();
    if (!is_finite(light.direction) || !(light.angle_degrees >= 0 && light.angle_degrees <= 180) ||
        length(normalized(light.direction)) == 0) {
      return "a beam out of range";
    }
    return is_finite(light.position) && is_color(light.color) ? nullptr : "a value out of range";
  }

  const char* material(Material& m) {
    if (const char* why = get_material(r_, m)) return why;
    media_ += attenuates(m) ? 1 : 0;
    return media_ > kMaxMedia ? "more media than there may be" : nullptr;
  }

  const char* plane(Plane& plane) {
    plane.normal = get_vec(r_);
    plane.offset = r_.get<double>();
    return is_finite(plane.normal) && std::isfinite(plane.offset) ? nullptr : "not finite";
  }

  const char* mesh(Mesh& out) {
    const std::uint64_t points = r_.get<std::uint32_t>(), triangles = r_.get<std::uint32_t>();
    const std::uint64_t planes = r_.get<std::uint32_t>();
    mesh_points_ += points;
    mesh_triangles_ += triangles;
    if (points == 0 || triangles == 0) return "empty";
    if (mesh_points_ > kMaxModelPoints || mesh_triangles_ > kMaxMeshTriangles)
      return "a count beyond its limit";
    if (planes > triangles) return "more planes than triangles";
    const std::uint64_t plane_numbers = planes > 0 ? triangles : 0;
    const std::uint64_t bytes = points * kPointBytes + triangles * kTriangleBytes +
                                planes * kPlaneBytes + plane_numbers * kPlaneNumberBytes;
    if (bytes > r_.remaining()) return "too short";
    TriangleMesh surface;
    surface.points.resize(points);
    surface.triangles.resize(triangles);
    for (Vec3& p : surface.points) {
      p = get_vec(r_);
      if (!is_finite(p)) return "not finite";
    }
    for (Triangle& t : surface.triangles) {
      for (std::uint32_t& i : t) {
        i = r_.get<std::uint32_t>();
        if (i >= points) return "no such point";
      }
    }
    if (const char* fault = mesh_planes(planes, surface)) return fault;
    out = Mesh(std::move(surface));
    return nullptr;
  }

  /// Reads the planes of other solids in which the mesh's triangles lie; a mesh may have none.
  const char* mesh_planes(std::uint64_t count, TriangleMesh& surface) {
    if (count == 0) return nullptr;
    surface.planes.resize(count);
    surface.plane_of.resize(surface.triangles.size());
    for (Plane& p : surface.planes) {
      if (const char* fault = plane(p)) return fault;
    }
    for (std::uint32_t& i : surface.plane_of) {
      i = r_.get<std::uint32_t>();
      if (i >= count && i != TriangleMesh::kOwnPlane) return "no such plane";
    }
    return nullptr;
  }

  const char* outline(Outline& out) { return get_outline(r_, segments_, out); }

  const char* primitive(Primitive& p) {
    const auto kind = r_.get<std::uint8_t>();
    const unsigned flags = r_.get<std::uint16_t>();
    p.material = r_.get<std::uint32_t>();
    if (kind >= kPrimitiveKinds) return "unknown kind";
    if (flags > kAllFlags) return "unknown flags";
    if (p.material >= model_.materials.size()) return "no such material";
    p.kind = static_cast<PrimitiveKind>(kind);
    bool finite = true;
    const auto number = [&](double& v) {
      v = r_.get<double>();
      finite = finite && std::isfinite(v);
    };
    for (std::size_t i = 0; i < p.v.size(); ++i) {
      if ((flags >> i & 1) != 0) number(p.v[i]);
    }
    if ((flags & kHasMap) != 0) {
      for (auto& row : p.to_local.m) {
        for (double& v : row) number(v);
      }
    }
    if ((flags & kHasBounds) != 0) p.bounds = get_box(r_);
    if ((flags & kHasPlanes) != 0) {
      p.first_plane = r_.get<std::uint32_t>();
      p.plane_count = r_.get<std::uint32_t>();
      if (std::uint64_t{p.first_plane} + p.plane_count > model_.planes.size())
        return "no such plane";
    }
    if ((flags & kHasMesh) != 0) p.mesh = r_.get<std::uint32_t>();
    if (p.kind == PrimitiveKind::kMesh ? p.mesh >= model_.meshes.size() : p.mesh != 0)
      return "no such mesh";
    if ((flags & kHasOutline) != 0) p.outline = r_.get<std::uint32_t>();
    if (csg::has_outline(p.kind) ? p.outline >= model_.outlines.size() : p.outline != 0)
      return "no such outline";
    return finite && is_box(p.bounds) ? nullptr : "not finite";
  }

  const char* node(TreeNode& n) {
    const auto kind = r_.get<std::uint8_t>();
    const auto value = r_.get<std::uint32_t>();
    if (kind > static_cast<std::uint8_t>(TreeNode::Kind::kInvertedLeaf)) return "unknown kind";
    n.kind = static_cast<TreeNode::Kind>(kind);
    if (is_inner(n.kind)) {
      n.size = value;
      return value >= 2 ? nullptr : "an operation without children";
    }
    n.primitive = value;
    return value < model_.primitives.size() ? nullptr : "no such primitive";
  }

  const char* object(Object& o) {
    o.id = r_.get<std::uint32_t>();
    o.first_node = r_.get<std::uint32_t>();
    o.node_count = r_.get<std::uint32_t>();
    o.bounds = get_box(r_);
    // Objects keep the file's order, and so do their trees: one behind the other, nothing between.
    const bool first = &o == model_.objects.data();
    if (!first && o.id <= (&o)[-1].id) return "ids must increase";
    const std::uint64_t begin =
        first ? 0 : (&o)[-1].first_node + std::uint64_t{(&o)[-1].node_count};
    if (o.first_node != begin) return "its nodes must follow those of the object before";
    if (o.node_count < 1 || begin + o.node_count > model_.nodes.size()) return "no such nodes";
    return is_box(o.bounds) ? nullptr : "not a number in its bounds";
  }

  /// Every subtree must end where or before its parent does, and every object's tree where its
  /// nodes do.
  void trees() {
    std::uint64_t covered = 0;
    std::vector<std::uint64_t> ends;
    for (const Object& object : model_.objects) {
      if (model_.nodes[object.first_node].size != object.node_count) {
        return fail("node " + std::to_string(object.first_node),
                    "not the root of its object's nodes");
      }
      covered = std::uint64_t{object.first_node} + object.node_count;
      for (std::uint64_t i = object.first_node; i < covered; ++i) {
        while (!ends.empty() && ends.back() <= i) ends.pop_back();
        const std::uint64_t end = i + model_.nodes[i].size;
        if (!ends.empty() && end > ends.back()) {
          return fail("node " + std::to_string(i), "its subtree ends beyond its parent's");
        }
        ends.push_back(end);
        if (ends.size() > kMaxModelTreeDepth)
          return fail("node " + std::to_string(i), "nested too deeply");
      }
      ends.clear();
    }
    if (covered != model_.nodes.size()) fail("nodes", "some belong to no object");
  }

  ByteReader r_;
  std::size_t size_;
  std::uint64_t mesh_points_ = 0, mesh_triangles_ = 0;
  /// Of the outlines so far.
  std::uint64_t segments_ = 0;
  std::size_t media_ = 0;
  Model model_;
  std::optional<ModelError> error_;
};

}  // namespace

bool is_encoded_model(std::span<const std::byte> bytes) {
  return bytes.size() >= sizeof kModelMagic &&
         load_little<std::uint32_t>(bytes.data()) == kModelMagic;
}

std::variant<Model, ModelError> decode_model(std::span<const std::byte> bytes) {
  auto model = take_model(bytes);
  if (model.index() == 0 && !bytes.empty()) return ModelError{"end", "bytes left over"};
  return model;
}

std::variant<Model, ModelError> take_model(std::span<const std::byte>& bytes) {
  ModelReader reader(bytes);
  auto model = reader.read();
  bytes = bytes.last(reader.remaining());
  return model;
}

}  // namespace graycube
