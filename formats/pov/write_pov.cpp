#include "formats/pov/write_pov.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <set>
#include <string_view>
#include <utility>
#include <variant>

#include "formats/graycube/scene_words.hpp"
#include "formats/pov/scene_membership.hpp"
#include "formats/pov/write_outline.hpp"
#include "geometry/affine.hpp"
#include "geometry/portable_math.hpp"
#include "scene/bezier_solid.hpp"
#include "scene/flat_solids.hpp"
#include "scene/repeat.hpp"
#include "shading/nearest_phong.hpp"

namespace graycube {
namespace {

/// The highest trace level that POV-Ray accepts.
constexpr std::uint32_t kMaxPovTraceLevel = 256;
/// Half the angle of the widest cone of a spotlight, in degrees.
constexpr double kWidestSpotlight = 90;
/// POV-Ray's falloff is 2 / (1 + (d / f)²): with a small f this is 2 f² / d², with a relative error
/// of f² / d².
constexpr double kFadeDistance = 1e-4;

class PovWriter {
 public:
  explicit PovWriter(const Scene& scene) : scene_(scene), merges_(inner_surfaces_show(scene)) {}

  PovScene write() {
    write_header();
    write_camera();
    for (const auto& light : scene_.settings.lights) write_light(light);
    for (std::size_t i = 0; i < scene_.materials.size(); ++i) write_material(i);
    declared_.resize(scene_.shapes.size(), false);
    for (std::uint32_t s = 0; s < scene_.shapes.size(); ++s) declare_shape(s);
    for (const auto& object : scene_.objects) {
      declare_used(object.csg);
      write_node(object.csg, object.material);
      text_ += '\n';
    }
    return {std::move(text_), std::move(warnings_), std::move(errors_)};
  }

 private:
  /// Whether surfaces inside a union can be seen: through a transparent surface, or by an eye that
  /// is inside. POV-Ray's union keeps them; its merge does not, but is slower.
  static bool inner_surfaces_show(const Scene& scene) {
    for (const auto& m : scene.materials)
      if (m.material.transmit > 0) return true;
    const Camera& camera = scene.settings.camera;
    return camera.projection == Projection::kOrthographic || any_object_holds(scene, camera.eye);
  }

  void number(double v) {
    char digits[32];
    text_.append(digits, std::to_chars(digits, digits + sizeof digits, v + 0.0).ptr);
  }
  void numbers(std::initializer_list<double> list) {
    char before = '<';
    for (const double v : list) {
      text_ += before;
      number(v);
      before = ',';
    }
    text_ += '>';
  }
  void vector(const Vec3& v) { numbers({v.x, v.y, v.z}); }
  void color(const Rgb& c) { numbers({c.r, c.g, c.b}); }
  /// Writes "NAME VALUE"; the name brings its own spaces.
  void item(std::string_view name, double value) {
    text_ += name;
    number(value);
  }
  void item(std::string_view name, const Vec3& value) {
    text_ += name;
    vector(value);
  }

  void write_header() {
    const RenderSettings& s = scene_.settings;
    const std::uint32_t samples = s.image.samples;
    text_ += "// povray +INAME.pov +ONAME.png +FN16 File_Gamma=1.0 +W" +
             std::to_string(s.image.width * samples) + " +H" +
             std::to_string(s.image.height * samples) + " -A -D -P -GA\n";
    if (samples > 1) {
      const std::string n = std::to_string(samples);
      text_ += "// then take the mean of every block of " + n + " x " + n + " pixels\n";
      warnings_.push_back("POV-Ray has no regular supersampling: render " + n +
                          " times as large and take means, as the file's first lines say");
    }
    std::uint32_t level = s.max_depth + 1;
    if (level > kMaxPovTraceLevel) {
      level = kMaxPovTraceLevel;
      warnings_.push_back("POV-Ray follows at most " + std::to_string(level) + " generations");
    }
    if (s.min_weight > 0)
      warnings_.push_back("POV-Ray's adc_bailout, written for min_weight, weighs rays otherwise");
    text_ += "#version 3.7;\nglobal_settings { assumed_gamma 1.0 max_trace_level " +
             std::to_string(level);
    item(" adc_bailout ", s.min_weight);
    text_ += " ambient_light rgb ";
    color(s.ambient);
    text_ += " }\nbackground { rgb ";
    color(s.background);
    text_ += " }\n";
  }

  void write_camera() {
    const Camera& c = scene_.settings.camera;
    const ImageSize& image = scene_.settings.image;
    const Vec3 forward = normalized(c.look_at - c.eye);
    const Vec3 sideways = normalized(cross(forward, c.up));
    const Vec3 right = c.handedness == Handedness::kRight ? sideways : -sideways;
    const Vec3 up = cross(sideways, forward);
    const bool perspective = c.projection == Projection::kPerspective;
    const double width = perspective ? 2 * tan_degrees(0.5 * c.fov_degrees) : c.width;
    if (c.inside == InsideView::kEntry)
      warnings_.push_back("POV-Ray doesn't show entries behind the camera");
    // Rays may miss the pixels' middles: then the whole picture is shifted against them.
    const double cell = width / image.width / image.samples;
    const Vec3 shift =
        (c.pixel_offset[0] - 0.5) * cell * right + (c.pixel_offset[1] - 0.5) * cell * up;
    text_ += perspective ? "camera { perspective" : "camera { orthographic";
    item(" location ", perspective ? c.eye : c.eye + shift);
    item(" direction ", perspective ? forward + shift : forward);
    item(" right ", width * right);
    item(" up ", width * image.height / image.width * up);
    text_ += " }\n";
  }

  void write_light(const PointLight& light) {
    const bool fades = light.falloff == Falloff::kInverseSquare;
    const double gain = fades ? 1 / (2 * kFadeDistance * kFadeDistance) : 1;
    item("light_source { ", light.position);
    text_ += ", rgb ";
    color(gain * light.color);
    if (fades) item(" fade_power 2 fade_distance ", kFadeDistance);
    if (!light.shadows) text_ += " shadowless";
    if (light.has_beam()) write_beam(light);
    text_ += " }\n";
  }

  /// A spotlight whose cone has the full brightness everywhere, and none outside.
  void write_beam(const PointLight& light) {
    if (light.angle_degrees > kWidestSpotlight)
      warnings_.push_back("a light's beam is wider than POV-Ray's spotlights, which it gets");
    const double angle = std::min(light.angle_degrees, kWidestSpotlight);
    item(" spotlight radius ", angle);
    item(" falloff ", angle);
    item(" tightness 0 point_at ",
         light.position + std::fmax(1, max_abs(light.position)) * normalized(light.direction));
  }

  void write_material(std::size_t index) {
    const auto& [name, written] = scene_.materials[index];
    const Material m = nearest_phong(written);
    if (written.model != ShadingModel::kPhong)
      warnings_.push_back("material \"" + name + "\": POV-Ray has no " +
                          std::string(word_of(kShadingModelWords, written.model)) +
                          " model; written as phong");
    if (m.pattern.kind != PatternKind::kNone)
      warnings_.push_back("material \"" + name + "\": its pattern is left out, it has one colour");
    // The transmit of rt's lamps only says that they don't stand in their own light.
    const double transmit = m.model == ShadingModel::kRtLamp ? 0 : m.transmit;
    const std::string number_text = std::to_string(index);
    text_ += "#declare M" + number_text + " = texture { pigment { rgbt ";
    numbers({m.color.r, m.color.g, m.color.b, transmit});
    item(" } finish { ambient ", m.ambient);
    item(" diffuse ", m.diffuse);
    item(" phong ", m.specular);
    item(" phong_size ", m.shininess);
    if (m.reflect > 0) {
      item(" reflection { ", m.reflect);
      text_ += " }";
    }
    text_ += " } }  // " + one_line(name) + "\n";
    if (transmit > 0) {
      item("#declare I" + number_text + " = interior { ior ", m.ior);
      text_ += " }\n";
    }
  }

  /// The name as a comment of one line; names may hold anything, a comment ends with its line.
  static std::string one_line(std::string_view name) {
    std::string line;
    for (const char c : name) line += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
    return line;
  }

  /// Writes a shape after the shapes that it uses; refs nest at most kMaxTreeDepth deep.
  void declare_shape(std::uint32_t shape) {
    if (declared_[shape]) return;
    declared_[shape] = true;
    const auto& [name, node] = scene_.shapes[shape];
    declare_used(node);
    text_ += "#declare S" + std::to_string(shape) + " =  // " + one_line(name) + "\n";
    write_node(node, kInheritMaterial);
    text_ += '\n';
  }

  void declare_used(const CsgNode& node) {
    if (const auto* ref = std::get_if<ReferenceNode>(&node.value)) declare_shape(ref->shape);
    if (const auto* operation = std::get_if<OperationNode>(&node.value))
      for (const auto& child : operation->children) declare_used(child);
    if (const auto* repeat = std::get_if<RepeatNode>(&node.value)) declare_repeated(*repeat);
  }

  /// Writes the child of a repeat, whose copies refer to it.
  void declare_repeated(const RepeatNode& repeat) {
    declare_used(repeat.child.front());
    const auto number_of_child = std::to_string(repeated_.size());
    repeated_.emplace(&repeat, number_of_child);
    text_ += "#declare R" + number_of_child + " =\n";
    write_node(repeat.child.front(), kInheritMaterial);
    text_ += '\n';
  }

  /// Writes a node as one POV-Ray object; `outer` is its material if it has none of its own.
  void write_node(const CsgNode& node, MaterialIndex outer) {
    std::visit([&](const auto& value) { write_value(value); }, node.value);
    if (node.transform) write_matrix(*node.transform);
    const MaterialIndex material = node.material != kInheritMaterial ? node.material : outer;
    if (material != kInheritMaterial && !is_covered(node)) {
      const std::string index = std::to_string(material);
      text_ += " texture { M" + index + " }";
      if (scene_.materials[material].material.transmit > 0) text_ += " interior { I" + index + " }";
    }
    text_ += " }";
  }

  /// Whether POV-Ray's object for the node has a texture of its own already. Another would be laid
  /// over it, but the format says that the nearest material wins.
  bool is_covered(const CsgNode& node) const {
    const auto* ref = std::get_if<ReferenceNode>(&node.value);
    const auto* operation = std::get_if<OperationNode>(&node.value);
    const auto* repeat = std::get_if<RepeatNode>(&node.value);
    const CsgNode* same =
        ref != nullptr                                            ? &scene_.shapes[ref->shape].node
        : repeat != nullptr && counts_of(*repeat).copies == 1     ? &repeat->child.front()
        : operation != nullptr && operation->children.size() == 1 ? &operation->children.front()
                                                                  : nullptr;
    return same != nullptr && (same->material != kInheritMaterial || is_covered(*same));
  }

  /// POV-Ray's rows are the images of the axes, then the translation.
  void write_matrix(const Affine& map) {
    const auto& m = map.m;
    text_ += " matrix ";
    numbers({m[0][0], m[1][0], m[2][0], m[0][1], m[1][1], m[2][1], m[0][2], m[1][2], m[2][2],
             m[0][3], m[1][3], m[2][3]});
  }
  void write_matrix(const Vec3& x, const Vec3& y, const Vec3& z, const Vec3& origin) {
    text_ += " matrix ";
    numbers({x.x, x.y, x.z, y.x, y.y, y.z, z.x, z.y, z.z, origin.x, origin.y, origin.z});
  }

  // The functions below leave the object's brace open, for its modifiers.

  void write_value(const OperationNode& o) {
    if (o.children.size() == 1) {
      // POV-Ray's operations need two children; with one, all but the complement are that child.
      text_ += "object { ";
      write_node(o.children.front(), kInheritMaterial);
      if (o.operation == Operation::kComplement) text_ += " inverse";
      return;
    }
    text_ += o.operation == Operation::kIntersection ? "intersection {"
             : o.operation == Operation::kDifference ? "difference {"
                                                     : union_of_solids();
    for (const auto& child : o.children) {
      text_ += '\n';
      write_node(child, kInheritMaterial);
    }
  }
  const char* union_of_solids() const { return merges_ ? "merge {" : "union {"; }
  void write_value(const RepeatNode& r) {
    const std::string child = "object { R" + repeated_.at(&r);
    const bool is_one = counts_of(r).copies == 1;
    if (!is_one) text_ += union_of_solids();
    for_each_copy(r, Affine{}, [&](const Affine& map, std::size_t level) {
      text_ += is_one ? child : '\n' + child;
      if (level > 0) write_matrix(map);
      if (!is_one) text_ += " }";
    });
  }
  void write_value(const ReferenceNode& r) { text_ += "object { S" + std::to_string(r.shape); }
  void write_value(const SphereShape& s) {
    item("sphere { ", s.center);
    item(", ", s.radius);
  }
  void write_value(const BoxShape& b) {
    item("box { ", b.min);
    item(", ", b.max);
  }
  void write_value(const CylinderShape& c) {
    item("cylinder { ", c.base);
    item(", ", c.top);
    item(", ", c.radius);
  }
  void write_value(const ConeShape& c) {
    item("cone { ", c.base);
    item(", ", c.base_radius);
    item(", ", c.top);
    item(", ", c.top_radius);
  }
  void write_value(const TorusShape& t) {
    // POV-Ray's torus lies about y: any frame that has the axis for y will do.
    const Vec3 y = normalized(t.axis);
    const Vec3 other = std::fabs(y.x) <= std::fabs(y.y) ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
    const Vec3 z = normalized(cross(other, y));
    item("torus { ", t.major);
    item(", ", t.minor);
    write_matrix(cross(y, z), y, z, t.center);
  }
  void write_value(const HalfSpaceShape& h) {
    // POV-Ray normalizes the normal but leaves the distance as it is.
    const double l = length(h.normal);
    item("plane { ", Vec3{h.normal.x / l, h.normal.y / l, h.normal.z / l});
    item(", ", h.offset / l);
  }
  void write_value(const EllipsoidShape& e) {
    text_ += "sphere { <0,0,0>, 1";
    write_matrix(e.axes[0], e.axes[1], e.axes[2], e.center);
  }
  void write_value(const EllipticConeShape&) { refuse("elliptic_cone"); }
  void write_value(const EllipticTorusShape&) { refuse("elliptic_torus"); }
  void write_value(const QuadricShape&) { refuse("quadric"); }
  /// Writes nothing in the place of a kind of which POV-Ray has no exact twin, and warns once.
  void refuse(const std::string& kind) {
    if (refused_.insert(kind).second) {
      errors_.push_back("a " + kind + " can't be written for POV-Ray");
    }
    text_ += "sphere { <0,0,0>, 0";
  }
  void write_value(const PrismShape& p) {
    if (const auto solid = prism_of(p)) {
      std::visit([&](const auto& value) { write_value(value); }, solid->value);
    }
  }
  /// POV-Ray counts crossings along inside_vector: an odd number is inside. That differs where
  /// shells overlap.
  void write_value(const MeshShape& m) {
    text_ += "mesh2 { vertex_vectors { " + std::to_string(m.mesh.points.size());
    for (const Vec3& p : m.mesh.points) {
      text_ += ", ";
      vector(p);
    }
    text_ += " } face_indices { " + std::to_string(m.mesh.triangles.size());
    for (const auto& [a, b, c] : m.mesh.triangles) {
      text_ += ", <" + std::to_string(a) + ',' + std::to_string(b) + ',' + std::to_string(c) + '>';
    }
    text_ += " } inside_vector <0.7236, 0.3819, 0.5749>";
  }
  /// POV-Ray's own patches have no inside.
  void write_value(const BezierShape& b) {
    auto mesh = mesh_of(b);
    if (auto* surface = std::get_if<TriangleMesh>(&mesh))
      write_value(MeshShape{std::move(*surface), 0});
    else
      refuse("bezier that encloses no solid");
  }
  void write_value(const LatheShape& l) { text_ += pov_lathe(l); }
  void write_value(const SweepShape& s) { text_ += pov_prism(s); }
  void write_value(const PolyhedronShape& p) {
    if (p.planes.size() == 1) return write_value(p.planes.front());
    text_ += "intersection {";
    for (const auto& plane : p.planes) {
      text_ += '\n';
      write_value(plane);
      text_ += " }";
    }
  }

  const Scene& scene_;
  const bool merges_;
  std::vector<bool> declared_;
  /// The numbers under which the children of repeats are declared.
  std::map<const RepeatNode*, std::string> repeated_;
  std::string text_;
  std::vector<std::string> warnings_, errors_;
  std::set<std::string> refused_;
};

}  // namespace

PovScene write_pov(const Scene& scene) { return PovWriter(scene).write(); }

}  // namespace graycube
