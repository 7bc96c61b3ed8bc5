#include "figures/page/svg.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>

#include "utf8.hpp"

namespace graycube::figures {
namespace {

constexpr double kHeadLength = 8, kHeadHalfWidth = 3.6;
/// Coordinates beyond this are of no drawing.
constexpr double kFarthest = 1e6;

std::string attribute(std::string_view name, std::string_view value) {
  return " " + std::string(name) + "=\"" + std::string(value) + "\"";
}
std::string attribute(std::string_view name, double value) {
  return attribute(name, coordinate(value));
}

std::string attributes_of(const Paint& paint) {
  std::string text = attribute("fill", paint.fill);
  if (paint.stroke != "none") {
    text += attribute("stroke", paint.stroke) + attribute("stroke-width", paint.width);
    if (!paint.dashes.empty()) text += attribute("stroke-dasharray", paint.dashes);
  }
  char opacity[16];
  std::snprintf(opacity, sizeof opacity, "%.3g", paint.opacity);
  if (paint.opacity < 1) text += attribute("opacity", std::string_view(opacity));
  return text;
}

std::string list_of(std::span<const Point> points) {
  std::string list;
  for (const Point& p : points) {
    list += (list.empty() ? "" : " ") + coordinate(p.x) + "," + coordinate(p.y);
  }
  return list;
}

std::string escaped(std::string_view character) {
  switch (character.front()) {
    case '<': return "&lt;";
    case '>': return "&gt;";
    case '&': return "&amp;";
    case '"': return "&quot;";
    default: break;
  }
  if (static_cast<unsigned char>(character.front()) < 0x20) return " ";
  // The two that UTF-8 has but XML hasn't.
  if (character == "\xEF\xBF\xBE" || character == "\xEF\xBF\xBF") return "?";
  return std::string(character);
}

}  // namespace

std::string coordinate(double value) {
  if (!std::isfinite(value)) return "0";
  char text[32];
  std::snprintf(text, sizeof text, "%.1f", std::clamp(value, -kFarthest, kFarthest));
  std::string s = text;
  if (s.ends_with(".0")) s.resize(s.size() - 2);
  return s == "-0" ? "0" : s;
}

std::string figure_text(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", value);
  return text;
}

std::string count_text(std::uint64_t value) {
  const std::string digits = std::to_string(value);
  std::string text;
  for (std::size_t i = 0; i < digits.size(); ++i) {
    if (i > 0 && (digits.size() - i) % 3 == 0) text += "\u2009";
    text += digits[i];
  }
  return text;
}

std::string xml_text(std::string_view text) {
  std::string out;
  while (!text.empty()) {
    const std::size_t bytes = utf8_bytes(text);
    out += bytes == 0 ? "?" : escaped(text.substr(0, bytes));
    text.remove_prefix(std::max<std::size_t>(bytes, 1));
  }
  return out;
}

Svg::Svg(double width, double height, std::string_view title) : width_(width), height_(height) {
  const std::string w = coordinate(width), h = coordinate(height);
  text_ = "<svg xmlns=\"http://www.w3.org/2000/svg\"" + attribute("width", w) +
          attribute("height", h) + " viewBox=\"0 0 " + w + " " + h +
          "\" font-family=\"Helvetica, Arial, 'DejaVu Sans', sans-serif\">\n<title>" +
          xml_text(title) + "</title>\n";
  rectangle({0, 0, width, height}, {.fill = "#ffffff"});
}

void Svg::rectangle(const Box& box, const Paint& paint, double radius) {
  text_ += "<rect" + attribute("x", box.x) + attribute("y", box.y) +
           attribute("width", std::max(0.0, box.width)) +
           attribute("height", std::max(0.0, box.height)) +
           (radius > 0 ? attribute("rx", radius) : "") + attributes_of(paint) + "/>\n";
}

void Svg::line(Point from, Point to, const Paint& paint) {
  text_ += "<line" + attribute("x1", from.x) + attribute("y1", from.y) + attribute("x2", to.x) +
           attribute("y2", to.y) + attributes_of(paint) + "/>\n";
}

void Svg::polyline(std::span<const Point> points, const Paint& paint) {
  text_ += "<polyline" + attribute("points", list_of(points)) + attributes_of(paint) + "/>\n";
}

void Svg::polygon(std::span<const Point> corners, const Paint& paint) {
  text_ += "<polygon" + attribute("points", list_of(corners)) + attributes_of(paint) + "/>\n";
}

void Svg::circle(Point center, double radius, const Paint& paint) {
  text_ += "<circle" + attribute("cx", center.x) + attribute("cy", center.y) +
           attribute("r", radius) + attributes_of(paint) + "/>\n";
}

void Svg::path(std::string_view commands, const Paint& paint) {
  text_ += "<path" + attribute("d", commands) + attributes_of(paint) + "/>\n";
}

void Svg::arrow(Point from, Point to, const Paint& paint, double bend) {
  const double dx = to.x - from.x, dy = to.y - from.y, length = std::hypot(dx, dy);
  if (!(length > 0)) return;
  const Point middle{(from.x + to.x) / 2 + dy / length * bend * 2,
                     (from.y + to.y) / 2 - dx / length * bend * 2};
  // The head lies along the curve's end, whose tangent comes from the middle.
  const double tx = to.x - middle.x, ty = to.y - middle.y, t = std::max(std::hypot(tx, ty), 1e-9);
  const double ux = tx / t, uy = ty / t, size = 1 + 0.25 * (paint.width - 1);
  const double back = kHeadLength * size, wide = kHeadHalfWidth * size;
  const Point neck{to.x - back * ux, to.y - back * uy};
  path("M" + coordinate(from.x) + " " + coordinate(from.y) + "Q" + coordinate(middle.x) + " " +
           coordinate(middle.y) + " " + coordinate(neck.x) + " " + coordinate(neck.y),
       {.stroke = paint.stroke,
        .width = paint.width,
        .opacity = paint.opacity,
        .dashes = paint.dashes});
  const Point head[] = {
      to, {neck.x - wide * uy, neck.y + wide * ux}, {neck.x + wide * uy, neck.y - wide * ux}};
  polygon(head, {.fill = paint.stroke, .opacity = paint.opacity});
}

void Svg::text(Point at, std::string_view words, const Lettering& lettering) {
  text_ += "<text" + attribute("x", at.x) + attribute("y", at.y) +
           attribute("font-size", lettering.size) + attribute("fill", lettering.color);
  if (lettering.anchor == Anchor::kMiddle) text_ += attribute("text-anchor", "middle");
  if (lettering.anchor == Anchor::kEnd) text_ += attribute("text-anchor", "end");
  if (lettering.is_bold) text_ += attribute("font-weight", "bold");
  if (lettering.has_rim) {
    text_ += attribute("stroke", "#ffffff") + attribute("stroke-width", 3.0) +
             attribute("paint-order", "stroke") + attribute("stroke-linejoin", "round");
  }
  text_ += ">" + xml_text(words) + "</text>\n";
}

void Svg::image(const Box& box, std::string_view uri) {
  text_ += "<image" + attribute("x", box.x) + attribute("y", box.y) +
           attribute("width", box.width) + attribute("height", box.height) +
           " preserveAspectRatio=\"none\"" + attribute("href", uri) + "/>\n";
}

void Svg::begin_clip(const Box& box) {
  const std::string name = "clip" + std::to_string(++clips_);
  text_ += "<clipPath" + attribute("id", name) + ">\n";
  rectangle(box, {.fill = "#000000"});
  text_ += "</clipPath>\n<g" + attribute("clip-path", "url(#" + name + ")") + ">\n";
}

void Svg::end_clip() { text_ += "</g>\n"; }

std::string Svg::finish() const { return text_ + "</svg>\n"; }

}  // namespace graycube::figures
