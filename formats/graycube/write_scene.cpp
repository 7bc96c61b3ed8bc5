#include "formats/graycube/write_scene.hpp"

#include <charconv>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "check.hpp"
#include "formats/graycube/scene_words.hpp"
#include "scene/scene_fault.hpp"

namespace graycube {
namespace {

/// Appends JSON to a text. Members and elements write the commas before them.
class SceneWriter {
 public:
  explicit SceneWriter(const Scene& scene) : scene_(scene) {}

  std::string write() {
    text_ = "{\n";
    key("graycube");
    text_ += '1';
    if (scene_.digits != 0) {
      start_line("digits");
      write(scene_.digits);
    }
    write_settings();
    start_line("materials");
    list('{', '}', scene_.materials,
         [&](const NamedMaterial& m) { key(m.name), write(m.material); });
    start_line("shapes");
    list('{', '}', scene_.shapes, [&](const NamedShape& s) { key(s.name), write(s.node); });
    start_line("objects");
    list('[', ']', scene_.objects, [&](const SceneObject& o) { write(o); });
    text_ += "\n}\n";
    return std::move(text_);
  }

 private:
  void number(double v) {
    // An importer's arithmetic can come to this, with numbers near the ends of doubles.
    if (!std::isfinite(v))
      throw UnrenderableScene(
          std::vector<SceneFault>{{"", "the model's numbers leave the range of doubles"}});
    char digits[32];
    const auto end = std::to_chars(digits, digits + sizeof digits, v).ptr;
    text_.append(digits, end);
  }

  void string(std::string_view s) {
    constexpr std::string_view kHex = "0123456789abcdef";
    text_ += '"';
    for (const char c : s) {
      const auto byte = static_cast<unsigned char>(c);
      if (c == '"' || c == '\\') {
        text_ += '\\';
        text_ += c;
      } else if (byte < 0x20) {
        text_ += "\\u00";
        text_ += kHex[byte >> 4];
        text_ += kHex[byte & 15];
      } else {
        text_ += c;
      }
    }
    text_ += '"';
  }

  void key(std::string_view name) {
    string(name);
    text_ += ": ";
  }
  /// Writes the key of a member that is not its object's first.
  void next_key(std::string_view name) {
    text_ += ", ";
    key(name);
  }
  void start_line(std::string_view name) {
    text_ += ",\n";
    key(name);
  }

  void write(double v) { number(v); }
  void write(std::uint32_t v) { text_ += std::to_string(v); }
  void write(std::string_view v) { string(v); }
  void write(const Vec3& v) { write_numbers({v.x, v.y, v.z}); }
  void write(const Rgb& c) { write_numbers({c.r, c.g, c.b}); }
  void write_numbers(std::initializer_list<double> numbers) {
    char before = '[';
    for (const double v : numbers) {
      text_ += before;
      number(v);
      before = ',';
    }
    text_ += ']';
  }

  template <typename T>
  void member(std::string_view name, const T& value) {
    next_key(name);
    write(value);
  }

  /// Writes a list with one element to a line.
  template <typename T, typename WriteOne>
  void list(char open, char close, const std::vector<T>& elements, const WriteOne& write_one) {
    text_ += open;
    const char* before = "\n  ";
    for (const T& element : elements) {
      text_ += before;
      write_one(element);
      before = ",\n  ";
    }
    if (!elements.empty()) text_ += '\n';
    text_ += close;
  }

  void write_settings() {
    const RenderSettings& s = scene_.settings;
    start_line("image");
    text_ += "{\"width\": ";
    write(s.image.width);
    member("height", s.image.height);
    member("samples", s.image.samples);
    text_ += '}';
    write_camera(s.camera);
    start_line("background");
    write(s.background);
    start_line("ambient");
    write(s.ambient);
    start_line("max_depth");
    write(s.max_depth);
    start_line("min_weight");
    write(s.min_weight);
    start_line("lights");
    list('[', ']', s.lights, [&](const PointLight& l) { write(l); });
  }

  void write_camera(const Camera& c) {
    const bool perspective = c.projection == Projection::kPerspective;
    start_line("camera");
    text_ += "{\"type\": ";
    write(word_of(kProjectionWords, c.projection));
    member("eye", c.eye);
    member("look_at", c.look_at);
    member("up", c.up);
    member(perspective ? "fov" : "width", perspective ? c.fov_degrees : c.width);
    member("handedness", word_of(kHandednessWords, c.handedness));
    if (c.pixel_offset != Camera{}.pixel_offset) {
      next_key("pixel_offset");
      write_numbers({c.pixel_offset[0], c.pixel_offset[1]});
    }
    if (c.inside != InsideView::kExit) member("inside", word_of(kInsideViewWords, c.inside));
    text_ += '}';
  }

  void write(const PointLight& l) {
    text_ += "{\"type\": \"point\"";
    member("position", l.position);
    member("color", l.color);
    member("falloff", word_of(kFalloffWords, l.falloff));
    if (!l.shadows) {
      next_key("shadows");
      text_ += "false";
    }
    if (l.has_beam() || l.direction != PointLight{}.direction) {
      member("direction", l.direction);
      member("angle", l.angle_degrees);
    }
    text_ += '}';
  }

  void write(const Material& m) {
    text_ += "{\"color\": ";
    write(m.color);
    member("ambient", m.ambient);
    member("diffuse", m.diffuse);
    member("specular", m.specular);
    member("shininess", m.shininess);
    member("reflect", m.reflect);
    member("transmit", m.transmit);
    member("ior", m.ior);
    member("model", word_of(kShadingModelWords, m.model));
    text_ += '}';
  }

  void write(const SceneObject& o) {
    text_ += '{';
    if (!o.name.empty()) {
      key("name");
      write(std::string_view(o.name));
      text_ += ", ";
    }
    if (o.material != kInheritMaterial) {
      key("material");
      write(material_name(o.material));
      text_ += ", ";
    }
    key("csg");
    write(o.csg);
    text_ += '}';
  }

  std::string_view material_name(MaterialIndex index) const {
    GRAYCUBE_CHECK(index < scene_.materials.size(), "material %u of %zu", index,
                   scene_.materials.size());
    return scene_.materials[index].name;
  }

  void write(const CsgNode& node) {
    text_ += "{\"type\": ";
    std::visit([&](const auto& value) { write_value(value); }, node.value);
    if (node.transform) {
      text_ += ", \"transform\": [{\"matrix\": ";
      char before = '[';
      for (const auto& row : node.transform->m) {
        text_ += before;
        write_numbers({row[0], row[1], row[2], row[3]});
        before = ',';
      }
      text_ += "]}]";
    }
    if (node.material != kInheritMaterial) member("material", material_name(node.material));
    text_ += '}';
  }

  void write_value(const OperationNode& o) {
    if (o.operation == Operation::kComplement) {
      GRAYCUBE_CHECK(o.children.size() == 1, "a complement of %zu children", o.children.size());
      text_ += "\"complement\"";
      return member("child", o.children.front());
    }
    text_ += o.operation == Operation::kUnion          ? "\"union\""
             : o.operation == Operation::kIntersection ? "\"intersection\""
                                                       : "\"difference\"";
    text_ += ", \"children\": ";
    char before = '[';
    for (const CsgNode& child : o.children) {
      text_ += before;
      write(child);
      before = ',';
    }
    text_ += ']';
  }
  void write_value(const ReferenceNode& r) {
    GRAYCUBE_CHECK(r.shape < scene_.shapes.size(), "shape %u of %zu", r.shape,
                   scene_.shapes.size());
    text_ += "\"ref\"";
    member("shape", std::string_view(scene_.shapes[r.shape].name));
  }
  void write_value(const SphereShape& s) {
    text_ += "\"sphere\"";
    member("center", s.center);
    member("radius", s.radius);
  }
  void write_value(const BoxShape& b) {
    text_ += "\"box\"";
    member("min", b.min);
    member("max", b.max);
  }
  void write_value(const CylinderShape& c) {
    text_ += "\"cylinder\"";
    member("base", c.base);
    member("top", c.top);
    member("radius", c.radius);
  }
  void write_value(const ConeShape& c) {
    text_ += "\"cone\"";
    member("base", c.base);
    member("base_radius", c.base_radius);
    member("top", c.top);
    member("top_radius", c.top_radius);
  }
  void write_value(const TorusShape& t) {
    text_ += "\"torus\"";
    member("center", t.center);
    member("axis", t.axis);
    member("major", t.major);
    member("minor", t.minor);
  }
  void write_value(const HalfSpaceShape& h) {
    text_ += "\"half_space\"";
    member("normal", h.normal);
    member("offset", h.offset);
  }
  void write_value(const EllipsoidShape& e) {
    text_ += "\"ellipsoid\"";
    member("center", e.center);
    text_ += ", \"axes\": [";
    for (std::size_t i = 0; i < e.axes.size(); ++i) {
      if (i > 0) text_ += ',';
      write(e.axes[i]);
    }
    text_ += ']';
  }
  void write_value(const EllipticConeShape& c) {
    text_ += "\"elliptic_cone\"";
    member("base", c.base);
    member("top", c.top);
    member("a", c.a);
    member("b", c.b);
    member("top_a", c.top_a);
    member("top_b", c.top_b);
  }
  void write_value(const EllipticTorusShape& t) {
    text_ += "\"elliptic_torus\"";
    member("center", t.center);
    member("axis", t.axis);
    member("radius", t.radius);
    member("outward", t.outward);
    member("upward", t.upward);
    member("across", t.across);
  }
  void write_value(const QuadricShape& q) {
    text_ += "\"quadric\"";
    next_key("coefficients");
    const auto& c = q.coefficients;
    write_numbers({c[0], c[1], c[2], c[3]});
    member("min", q.min);
    member("max", q.max);
  }
  void write_value(const PrismShape& p) {
    text_ += "\"prism\", \"points\": ";
    char before = '[';
    for (const FlatPoint& point : p.points) {
      text_ += before;
      write_numbers({point.x, point.y});
      before = ',';
    }
    text_ += ']';
    if (!p.paths.empty()) {
      next_key("paths");
      before = '[';
      for (const auto& path : p.paths) {
        text_ += before;
        text_ += '[';
        for (std::size_t i = 0; i < path.size(); ++i) {
          if (i > 0) text_ += ',';
          write(path[i]);
        }
        text_ += ']';
        before = ',';
      }
      text_ += ']';
    }
    member("height", p.height);
    if (p.base != 0) member("base", p.base);
  }
  void write_value(const MeshShape& m) {
    text_ += "\"mesh\", \"points\": ";
    char before = '[';
    for (const Vec3& p : m.mesh.points) {
      text_ += before;
      write(p);
      before = ',';
    }
    text_ += "], \"faces\": ";
    before = '[';
    for (const auto& [a, b, c] : m.mesh.triangles) {
      text_ += before;
      text_ += '[' + std::to_string(a) + ',' + std::to_string(b) + ',' + std::to_string(c) + ']';
      before = ',';
    }
    text_ += ']';
    if (m.digits != 0) member("digits", m.digits);
  }
  void write_value(const PolyhedronShape& p) {
    text_ += "\"polyhedron\", \"planes\": ";
    char before = '[';
    for (const auto& plane : p.planes) {
      text_ += before;
      write_numbers({plane.normal.x, plane.normal.y, plane.normal.z, plane.offset});
      before = ',';
    }
    text_ += ']';
  }

  const Scene& scene_;
  std::string text_;
};

}  // namespace

std::string write_scene_text(const Scene& scene) { return SceneWriter(scene).write(); }

}  // namespace graycube
