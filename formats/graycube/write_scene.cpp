#include "formats/graycube/write_scene.hpp"

#include <cstdint>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "check.hpp"
#include "formats/graycube/json_text.hpp"
#include "formats/graycube/scene_words.hpp"
#include "formats/graycube/write_material.hpp"
#include "formats/graycube/write_settings.hpp"

namespace graycube {
namespace {

class SceneWriter {
 public:
  explicit SceneWriter(const Scene& scene) : scene_(scene) {}

  std::string write() {
    json_.text = "{\n";
    json_.key("graycube");
    json_.text += '1';
    if (scene_.digits != 0) {
      json_.start_line("digits");
      json_.write(scene_.digits);
    }
    write_settings();
    json_.start_line("materials");
    json_.list('{', '}', scene_.materials, [&](const NamedMaterial& m) {
      json_.key(m.name), write_material(json_, m.material);
    });
    json_.start_line("shapes");
    json_.list('{', '}', scene_.shapes,
               [&](const NamedShape& s) { json_.key(s.name), write(s.node); });
    json_.start_line("objects");
    json_.list('[', ']', scene_.objects, [&](const SceneObject& o) { write(o); });
    json_.text += "\n}\n";
    return std::move(json_.text);
  }

 private:
  void write_settings() {
    const RenderSettings& s = scene_.settings;
    json_.start_line("image");
    json_.text += "{\"width\": ";
    json_.write(s.image.width);
    json_.member("height", s.image.height);
    json_.member("samples", s.image.samples);
    json_.text += '}';
    json_.start_line("camera");
    write_camera(json_, s.camera);
    json_.start_line("background");
    json_.write(s.background);
    json_.start_line("ambient");
    json_.write(s.ambient);
    json_.start_line("max_depth");
    json_.write(s.max_depth);
    json_.start_line("min_weight");
    json_.write(s.min_weight);
    json_.start_line("lights");
    json_.list('[', ']', s.lights, [&](const PointLight& l) { write_light(json_, l); });
  }

  void write(const SceneObject& o) {
    json_.text += '{';
    if (!o.name.empty()) {
      json_.key("name");
      json_.write(std::string_view(o.name));
      json_.text += ", ";
    }
    if (o.material != kInheritMaterial) {
      json_.key("material");
      json_.write(material_name(o.material));
      json_.text += ", ";
    }
    json_.key("csg");
    write(o.csg);
    json_.text += '}';
  }

  std::string_view material_name(MaterialIndex index) const {
    GRAYCUBE_CHECK(index < scene_.materials.size(), "material %u of %zu", index,
                   scene_.materials.size());
    return scene_.materials[index].name;
  }

  void write(const CsgNode& node) {
    json_.text += "{\"type\": ";
    std::visit([&](const auto& value) { write_value(value); }, node.value);
    if (node.transform) {
      json_.next_key("transform");
      write(*node.transform);
    }
    if (node.material != kInheritMaterial) json_.member("material", material_name(node.material));
    json_.text += '}';
  }

  void write(const Affine& map) {
    json_.text += "[{\"matrix\": ";
    char before = '[';
    for (const auto& row : map.m) {
      json_.text += before;
      json_.write_numbers({row[0], row[1], row[2], row[3]});
      before = ',';
    }
    json_.text += "]}]";
  }

  void write_value(const OperationNode& o) {
    if (o.operation == Operation::kComplement) {
      GRAYCUBE_CHECK(o.children.size() == 1, "a complement of %zu children", o.children.size());
      json_.text += "\"complement\"";
      json_.next_key("child");
      return write(o.children.front());
    }
    json_.text += o.operation == Operation::kUnion          ? "\"union\""
                  : o.operation == Operation::kIntersection ? "\"intersection\""
                                                            : "\"difference\"";
    json_.text += ", \"children\": ";
    char before = '[';
    for (const CsgNode& child : o.children) {
      json_.text += before;
      write(child);
      before = ',';
    }
    json_.text += ']';
  }
  void write_value(const ReferenceNode& r) {
    GRAYCUBE_CHECK(r.shape < scene_.shapes.size(), "shape %u of %zu", r.shape,
                   scene_.shapes.size());
    json_.text += "\"ref\"";
    json_.member("shape", std::string_view(scene_.shapes[r.shape].name));
  }
  void write_value(const RepeatNode& r) {
    GRAYCUBE_CHECK(r.child.size() == 1, "a repeat of %zu children", r.child.size());
    json_.text += "\"repeat\"";
    json_.next_key("child");
    write(r.child.front());
    json_.next_key("maps");
    char before = '[';
    for (const Affine& map : r.maps) {
      json_.text += before;
      write(map);
      before = ',';
    }
    json_.text += ']';
    json_.member("depth", r.depth);
    if (r.kept != KeptCopies::kAll) json_.member("keep", word_of(kKeptCopiesWords, r.kept));
  }
  void write_value(const SphereShape& s) {
    json_.text += "\"sphere\"";
    json_.member("center", s.center);
    json_.member("radius", s.radius);
  }
  void write_value(const BoxShape& b) {
    json_.text += "\"box\"";
    json_.member("min", b.min);
    json_.member("max", b.max);
  }
  void write_value(const CylinderShape& c) {
    json_.text += "\"cylinder\"";
    json_.member("base", c.base);
    json_.member("top", c.top);
    json_.member("radius", c.radius);
  }
  void write_value(const ConeShape& c) {
    json_.text += "\"cone\"";
    json_.member("base", c.base);
    json_.member("base_radius", c.base_radius);
    json_.member("top", c.top);
    json_.member("top_radius", c.top_radius);
  }
  void write_value(const TorusShape& t) {
    json_.text += "\"torus\"";
    json_.member("center", t.center);
    json_.member("axis", t.axis);
    json_.member("major", t.major);
    json_.member("minor", t.minor);
  }
  void write_value(const HalfSpaceShape& h) {
    json_.text += "\"half_space\"";
    json_.member("normal", h.normal);
    json_.member("offset", h.offset);
  }
  void write_value(const EllipsoidShape& e) {
    json_.text += "\"ellipsoid\"";
    json_.member("center", e.center);
    json_.text += ", \"axes\": [";
    for (std::size_t i = 0; i < e.axes.size(); ++i) {
      if (i > 0) json_.text += ',';
      json_.write(e.axes[i]);
    }
    json_.text += ']';
  }
  void write_value(const EllipticConeShape& c) {
    json_.text += "\"elliptic_cone\"";
    json_.member("base", c.base);
    json_.member("top", c.top);
    json_.member("a", c.a);
    json_.member("b", c.b);
    json_.member("top_a", c.top_a);
    json_.member("top_b", c.top_b);
  }
  void write_value(const EllipticTorusShape& t) {
    json_.text += "\"elliptic_torus\"";
    json_.member("center", t.center);
    json_.member("axis", t.axis);
    json_.member("radius", t.radius);
    json_.member("outward", t.outward);
    json_.member("upward", t.upward);
    json_.member("across", t.across);
  }
  void write_value(const QuadricShape& q) {
    json_.text += "\"quadric\"";
    json_.next_key("coefficients");
    const auto& c = q.coefficients;
    json_.write_numbers({c[0], c[1], c[2], c[3]});
    json_.member("min", q.min);
    json_.member("max", q.max);
  }
  void write_value(const PrismShape& p) {
    json_.text += "\"prism\", \"points\": ";
    char before = '[';
    for (const FlatPoint& point : p.points) {
      json_.text += before;
      json_.write_numbers({point.x, point.y});
      before = ',';
    }
    json_.text += ']';
    if (!p.paths.empty()) {
      json_.next_key("paths");
      before = '[';
      for (const auto& path : p.paths) {
        json_.text += before;
        json_.text += '[';
        for (std::size_t i = 0; i < path.size(); ++i) {
          if (i > 0) json_.text += ',';
          json_.write(path[i]);
        }
        json_.text += ']';
        before = ',';
      }
      json_.text += ']';
    }
    json_.member("height", p.height);
    if (p.base != 0) json_.member("base", p.base);
  }
  void write_value(const MeshShape& m) {
    json_.text += "\"mesh\"";
    write_points(m.mesh.points);
    json_.next_key("faces");
    char before = '[';
    for (const auto& [a, b, c] : m.mesh.triangles) {
      json_.text += before;
      json_.text +=
          '[' + std::to_string(a) + ',' + std::to_string(b) + ',' + std::to_string(c) + ']';
      before = ',';
    }
    json_.text += ']';
    if (m.digits != 0) json_.member("digits", m.digits);
  }
  void write_value(const BezierShape& b) {
    json_.text += "\"bezier\"";
    write_points(b.net.points);
    json_.next_key("patches");
    char before = '[';
    for (const BezierPatch& patch : b.net.patches) {
      json_.text += before;
      char inner = '[';
      for (const std::uint32_t number : patch) {
        json_.text += inner;
        json_.write(number);
        inner = ',';
      }
      json_.text += ']';
      before = ',';
    }
    json_.text += ']';
    if (b.tolerance != 0) json_.member("tolerance", b.tolerance);
  }
  void write_value(const LatheShape& l) {
    json_.text += "\"lathe\"";
    write_outline(l.outline);
  }
  void write_value(const SweepShape& s) {
    json_.text += "\"sweep\"";
    write_outline(s.outline);
    json_.member("height", s.height);
    if (s.base != 0) json_.member("base", s.base);
  }
  void write_outline(const OutlineLoops& outline) {
    json_.next_key("outline");
    char before = '[';
    for (const OutlineLoop& loop : outline) {
      json_.text += before;
      char inner = '[';
      for (const OutlinePoint& p : loop) {
        json_.text += inner;
        json_.write_numbers({p.x, p.y});
        inner = ',';
      }
      json_.text += ']';
      before = ',';
    }
    json_.text += ']';
  }
  void write_points(const std::vector<Vec3>& points) {
    json_.next_key("points");
    char before = '[';
    for (const Vec3& p : points) {
      json_.text += before;
      json_.write(p);
      before = ',';
    }
    json_.text += ']';
  }
  void write_value(const PolyhedronShape& p) {
    json_.text += "\"polyhedron\", \"planes\": ";
    char before = '[';
    for (const auto& plane : p.planes) {
      json_.text += before;
      json_.write_numbers({plane.normal.x, plane.normal.y, plane.normal.z, plane.offset});
      before = ',';
    }
    json_.text += ']';
  }

  const Scene& scene_;
  JsonText json_;
};

}  // namespace

std::string write_scene_text(const Scene& scene) { return SceneWriter(scene).write(); }

}  // namespace graycube
