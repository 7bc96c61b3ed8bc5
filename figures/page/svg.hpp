// Drawings as SVG text: shapes in pixels from the top left, written in the order of the calls.
// The same calls give the same bytes.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace graycube::figures {

struct Point {
  double x = 0, y = 0;
};

struct Box {
  double x = 0, y = 0, width = 0, height = 0;

  double right() const { return x + width; }
  double bottom() const { return y + height; }
  Point center() const { return {x + width / 2, y + height / 2}; }
};

/// Colours are CSS's; "none" draws nothing.
struct Paint {
  std::string_view fill = "none";
  std::string_view stroke = "none";
  double width = 1;
  double opacity = 1;
  /// Lengths of dashes and gaps, as "4 3"; empty for a solid line.
  std::string_view dashes{};
};

enum class Anchor { kStart, kMiddle, kEnd };

struct Lettering {
  double size = 12;
  std::string_view color = "#1f2933";
  Anchor anchor = Anchor::kStart;
  bool is_bold = false;
  /// A white rim, for letters on top of a picture.
  bool has_rim = false;
};

class Svg {
 public:
  /// The sides in pixels, and what a browser shows as the page's name.
  Svg(double width, double height, std::string_view title);

  double width() const { return width_; }
  double height() const { return height_; }

  void rectangle(const Box& box, const Paint& paint, double radius = 0);
  void line(Point from, Point to, const Paint& paint);
  void polyline(std::span<const Point> points, const Paint& paint);
  void polygon(std::span<const Point> corners, const Paint& paint);
  void circle(Point center, double radius, const Paint& paint);
  /// A path of SVG's own commands.
  void path(std::string_view commands, const Paint& paint);
  /// A line with a head at its end; `bend` moves its middle to the left of its way, in pixels.
  void arrow(Point from, Point to, const Paint& paint, double bend = 0);
  void text(Point at, std::string_view words, const Lettering& lettering = {});
  /// A picture, given as a data URI, stretched over the box without smoothing.
  void image(const Box& box, std::string_view uri);
  /// Until end_clip() nothing is drawn outside of the box. Clips don't nest.
  void begin_clip(const Box& box);
  void end_clip();

  /// The whole drawing.
  std::string finish() const;

 private:
  double width_, height_;
  std::string text_;
  int clips_ = 0;
};

/// A coordinate with at most one decimal, without zeros at its end; 0 if it isn't finite.
std::string coordinate(double value);
/// A length, time or count for people: four significant digits at most.
std::string figure_text(double value);
/// A whole number with thin spaces between thousands.
std::string count_text(std::uint64_t value);
/// Text as XML takes it: markup is escaped, and what is no UTF-8 or no character of XML becomes
/// '?'.
std::string xml_text(std::string_view text);

}  // namespace graycube::figures
