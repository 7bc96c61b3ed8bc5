#include "proto/slices/material_bytes.hpp"

#include <cmath>

#include "proto/model_layout.hpp"
#include "proto/slices/values.hpp"
#include "shading/rt_model.hpp"

namespace graycube {
namespace {

using namespace model_layout;

void put_map(ByteWriter& w, const Affine& map) {
  for (const auto& row : map.m) {
    for (const double v : row) w.put(v);
  }
}

void put_chart(ByteWriter& w, const Chart& c) {
  w.put(static_cast<std::uint8_t>(c.kind));
  w.put(static_cast<std::uint8_t>(c.maps.size()));
  for (const EndChart end : c.ends) w.put(static_cast<std::uint8_t>(end));
  for (const double v : c.top_radii) w.put(v);
  for (const Affine& map : c.maps) put_map(w, map);
}

void put_pattern(ByteWriter& w, const Pattern& p) {
  put_map(w, p.to_pattern);
  for (const Rgb& c : p.colors) put_rgb(w, c);
  for (const double v : p.thresholds) w.put(v);
  for (const double v : {p.octaves.count, p.octaves.lacunarity, p.octaves.decay}) w.put(v);
  put_chart(w, p.chart);
}

void put_optics(ByteWriter& w, const Optics& o) {
  for (const Rgb& c : {o.index, o.absorption, o.attenuation}) put_rgb(w, c);
  w.put(o.roughness);
  w.put(o.transmit_shininess);
}

/// False when a coefficient isn't finite.
bool get_map(ByteReader& r, Affine& map) {
  for (auto& row : map.m) {
    for (double& v : row) v = r.get<double>();
  }
  return map.is_finite();
}

const char* get_chart(ByteReader& r, Chart& c) {
  constexpr const char* kWrong = "a chart out of range";
  const auto kind = r.get<std::uint8_t>(), maps = r.get<std::uint8_t>();
  if (kind >= kChartKinds) return "unknown chart";
  c.kind = static_cast<ChartKind>(kind);
  if (maps > most_maps_of(c.kind) || (maps == 0 && kind != 0)) return kWrong;
  for (EndChart& end : c.ends) {
    const auto word = r.get<std::uint8_t>();
    if (word >= kEndCharts) return kWrong;
    end = static_cast<EndChart>(word);
  }
  bool valid = true;
  for (double& v : c.top_radii) {
    v = r.get<double>();
    valid = valid && std::isfinite(v) && v >= 0;
  }
  c.maps.resize(maps);
  for (Affine& map : c.maps) valid = get_map(r, map) && valid;
  return valid ? nullptr : kWrong;
}

const char* get_pattern(ByteReader& r, Pattern& p) {
  bool valid = get_map(r, p.to_pattern);
  for (Rgb& c : p.colors) {
    c = get_rgb(r);
    valid = valid && is_color(c);
  }
  for (double& v : p.thresholds) {
    v = r.get<double>();
    valid = valid && std::isfinite(v);
  }
  NoiseOctaves& o = p.octaves;
  for (double* v : {&o.count, &o.lacunarity, &o.decay}) {
    *v = r.get<double>();
    valid = valid && std::isfinite(*v);
  }
  valid = valid && o.count >= 0 && o.count <= kMaxOctaves && o.lacunarity > 0;
  return valid ? get_chart(r, p.chart) : "a pattern out of range";
}

const char* get_optics(ByteReader& r, Material& m) {
  Optics& o = m.optics;
  for (Rgb* c : {&o.index, &o.absorption, &o.attenuation}) *c = get_rgb(r);
  o.roughness = r.get<double>();
  o.transmit_shininess = r.get<double>();
  bool valid = m.diffuse <= 1 && m.specular <= 1 && m.reflect <= 1 && is_color(o.attenuation) &&
               is_coefficient(o.transmit_shininess) && o.roughness >= kLeastRoughness &&
               o.roughness <= kMostRoughness;
  for (const double n : {o.index.r, o.index.g, o.index.b})
    valid = valid && n >= kLeastIndex && n <= kMostIndex;
  for (const double k : {o.absorption.r, o.absorption.g, o.absorption.b})
    valid = valid && k >= 0 && k <= kMostIndex;
  if (m.transmit > 0) {
    valid = valid && o.index == Rgb{m.ior, m.ior, m.ior} && o.absorption == Rgb{0, 0, 0};
  }
  return valid ? nullptr : "the optics out of range";
}

}  // namespace

std::size_t material_bytes(const Material& m) {
  return kMaterialBytes + (has_fresnel(m) ? kOpticsBytes : 0) +
         (m.pattern.kind != PatternKind::kNone
              ? kPatternBytes + m.pattern.chart.maps.size() * kChartMapBytes
              : 0);
}

void put_material(ByteWriter& w, const Material& m) {
  put_rgb(w, m.color);
  for (const double v :
       {m.ambient, m.diffuse, m.specular, m.shininess, m.reflect, m.transmit, m.ior}) {
    w.put(v);
  }
  w.put(static_cast<std::uint8_t>(m.model));
  w.put(static_cast<std::uint8_t>(m.pattern.kind));
  if (has_fresnel(m)) put_optics(w, m.optics);
  if (m.pattern.kind != PatternKind::kNone) put_pattern(w, m.pattern);
}

const char* get_material(ByteReader& r, Material& m) {
  m.color = get_rgb(r);
  bool valid = is_color(m.color);
  for (double* v :
       {&m.ambient, &m.diffuse, &m.specular, &m.shininess, &m.reflect, &m.transmit, &m.ior}) {
    *v = r.get<double>();
    valid = valid && is_coefficient(*v);
  }
  m.model = static_cast<ShadingModel>(r.get<std::uint8_t>());
  if (m.model > ShadingModel::kHallGreenberg && !is_rt_model(m)) return "unknown shading model";
  if (!valid || m.transmit > 1 || !(m.ior > 0)) return "a coefficient out of range";
  const auto kind = r.get<std::uint8_t>();
  if (kind >= kPatternKinds) return "unknown pattern";
  m.pattern.kind = static_cast<PatternKind>(kind);
  if (has_fresnel(m)) {
    if (const char* why = get_optics(r, m)) return why;
  }
  return m.pattern.kind == PatternKind::kNone ? nullptr : get_pattern(r, m.pattern);
}

}  // namespace graycube
