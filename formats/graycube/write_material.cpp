#include "formats/graycube/write_material.hpp"

#include "formats/graycube/scene_words.hpp"

namespace graycube {
namespace {

void write_map(JsonText& json, const Affine& map) {
  json.text += "[{\"matrix\": ";
  char before = '[';
  for (const auto& row : map.m) {
    json.text += before;
    json.write_numbers({row[0], row[1], row[2], row[3]});
    before = ',';
  }
  json.text += "]}]";
}

void write_chart(JsonText& json, const Chart& c) {
  json.text += "{\"type\": ";
  json.write(word_of(kChartWords, c.kind));
  if (c.kind == ChartKind::kFaces) {
    json.next_key("faces");
    for (std::size_t i = 0; i < c.maps.size(); ++i) {
      json.text += i == 0 ? '[' : ',';
      write_map(json, c.maps[i]);
    }
    json.text += ']';
  } else if (c.maps.front() != Affine{}) {
    json.next_key("to_solid");
    write_map(json, c.maps.front());
  }
  if (c.kind == ChartKind::kRound) {
    json.next_key("ends");
    json.text += '[';
    json.write(word_of(kEndChartWords, c.ends[0]));
    json.text += ',';
    json.write(word_of(kEndChartWords, c.ends[1]));
    json.text += ']';
    json.next_key("top_radii");
    json.write_numbers({c.top_radii[0], c.top_radii[1]});
  }
  json.text += '}';
}

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
    write_map(json, p.to_pattern);
  }
  if (has_thresholds(p.kind)) {
    json.next_key("thresholds");
    json.write_numbers({p.thresholds[0], p.thresholds[1]});
  }
  if (has_noise(p.kind)) {
    json.member("octaves", p.octaves.count);
    json.member("lacunarity", p.octaves.lacunarity);
    json.member("decay", p.octaves.decay);
  }
  if (p.chart.kind != ChartKind::kNone) {
    json.next_key("chart");
    write_chart(json, p.chart);
  }
  json.text += '}';
}

/// A number if all colours have it, else a list of three.
void write_by_colour(JsonText& json, const char* key, const Rgb& c) {
  if (c == Rgb{c.r, c.r, c.r}) return json.member(key, c.r);
  json.member(key, c);
}

/// What only Torrance–Sparrow's and Hall–Greenberg's models have.
void write_optics(JsonText& json, const Material& m) {
  const Optics& o = m.optics;
  if (o.absorption != Rgb{0, 0, 0}) write_by_colour(json, "absorption", o.absorption);
  if (m.model == ShadingModel::kTorranceSparrow) return json.member("roughness", o.roughness);
  json.member("transmit_shininess", o.transmit_shininess);
  if (o.attenuation != Rgb{0, 0, 0}) write_by_colour(json, "attenuation", o.attenuation);
}

}  // namespace

void write_material(JsonText& json, const Material& m) {
  json.text += "{\"color\": ";
  json.write(m.color);
  json.member("ambient", m.ambient);
  json.member("diffuse", m.diffuse);
  json.member("specular", m.specular);
  if (m.model != ShadingModel::kTorranceSparrow) json.member("shininess", m.shininess);
  json.member("reflect", m.reflect);
  json.member("transmit", m.transmit);
  write_by_colour(json, "ior", has_fresnel(m) ? m.optics.index : Rgb{m.ior, m.ior, m.ior});
  json.member("model", word_of(kShadingModelWords, m.model));
  if (has_fresnel(m)) write_optics(json, m);
  if (m.pattern.kind != PatternKind::kNone) {
    json.next_key("pattern");
    write_pattern(json, m.pattern);
  }
  json.text += '}';
}

}  // namespace graycube
