#include "formats/graycube/write_settings.hpp"

#include "formats/graycube/scene_words.hpp"

namespace graycube {

void write_camera(JsonText& json, const Camera& c) {
  const bool perspective = c.projection == Projection::kPerspective;
  json.text += "{\"type\": ";
  json.write(word_of(kProjectionWords, c.projection));
  json.member("eye", c.eye);
  json.member("look_at", c.look_at);
  json.member("up", c.up);
  json.member(perspective ? "fov" : "width", perspective ? c.fov_degrees : c.width);
  json.member("handedness", word_of(kHandednessWords, c.handedness));
  if (c.pixel_offset != Camera{}.pixel_offset) {
    json.next_key("pixel_offset");
    json.write_numbers({c.pixel_offset[0], c.pixel_offset[1]});
  }
  if (c.inside != InsideView::kExit) json.member("inside", word_of(kInsideViewWords, c.inside));
  json.text += '}';
}

void write_light(JsonText& json, const PointLight& l) {
  json.text += "{\"type\": \"point\"";
  json.member("position", l.position);
  json.member("color", l.color);
  json.member("falloff", word_of(kFalloffWords, l.falloff));
  if (!l.shadows) {
    json.next_key("shadows");
    json.text += "false";
  }
  if (l.has_beam() || l.direction != PointLight{}.direction) {
    json.member("direction", l.direction);
    json.member("angle", l.angle_degrees);
  }
  json.text += '}';
}

namespace {

void write_pattern(JsonText& json, const Pattern& p) {
  json.text += "{\"type\": ";
  json.write(word_of(kPatternWords, p.kind));
  json.next_key("colors");
  for (std::size_t i = 0; i < colors_of(p.kind); ++i) {
    json.text += i == 0 ? '[' : ',';
    json.write(p.colors[i]);
  }
  json.text += ']';
  if (p.to_pattern != Affine{}) {
    json.next_key("to_pattern");
    json.text += "[{\"matrix\": ";
    char before = '[';
    for (const auto& row : p.to_pattern.m) {
      json.text += before;
      json.write_numbers({row[0], row[1], row[2], row[3]});
      before = ',';
    }
    json.text += "]}]";
  }
  if (p.kind == PatternKind::kCamouflage) {
    json.next_key("thresholds");
    json.write_numbers({p.thresholds[0], p.thresholds[1]});
  }
  if (has_noise(p.kind)) {
    json.member("octaves", p.octaves.count);
    json.member("lacunarity", p.octaves.lacunarity);
    json.member("decay", p.octaves.decay);
  }
  json.text += '}';
}

}  // namespace

void write_material(JsonText& json, const Material& m) {
  json.text += "{\"color\": ";
  json.write(m.color);
  json.member("ambient", m.ambient);
  json.member("diffuse", m.diffuse);
  json.member("specular", m.specular);
  json.member("shininess", m.shininess);
  json.member("reflect", m.reflect);
  json.member("transmit", m.transmit);
  json.member("ior", m.ior);
  json.member("model", word_of(kShadingModelWords, m.model));
  if (m.pattern.kind != PatternKind::kNone) {
    json.next_key("pattern");
    write_pattern(json, m.pattern);
  }
  json.text += '}';
}

}  // namespace graycube
