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

}  // namespace graycube
