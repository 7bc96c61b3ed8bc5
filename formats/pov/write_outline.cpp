#include "formats/pov/write_outline.hpp"

#include <array>
#include <charconv>
#include <cstddef>

namespace graycube {
namespace {

/// x stays, y and z change places. (For a solid of revolution a mirror is none.)
constexpr const char* kYToZ = " matrix <1,0,0,0,0,1,0,1,0,0,0,0>";

void number(double v, std::string& text) {
  char digits[32];
  text.append(digits, std::to_chars(digits, digits + sizeof digits, v + 0.0).ptr);
}

/// The four points of a segment.
std::array<OutlinePoint, 4> segment_of(const OutlineLoop& loop, std::size_t first) {
  return {loop[first], loop[first + 1], loop[first + 2],
          loop[first + 3 < loop.size() ? first + 3 : 0]};
}

bool is_on_axis(const std::array<OutlinePoint, 4>& segment) {
  for (const OutlinePoint& p : segment) {
    if (p.x != 0) return false;
  }
  return true;
}

/// Four points a segment; without those along a lathe's axis, which enclose nothing.
class Points {
 public:
  Points(const OutlineLoops& outline, bool leaves_axis_out) {
    for (const OutlineLoop& loop : outline) {
      for (std::size_t i = 0; i + 2 < loop.size(); i += 3) {
        const auto segment = segment_of(loop, i);
        if (!leaves_axis_out || !is_on_axis(segment)) add(segment);
      }
    }
  }
  std::string text() const { return std::to_string(count_) + text_; }

 private:
  void add(const std::array<OutlinePoint, 4>& segment) {
    for (const OutlinePoint& p : segment) {
      text_ += ", <";
      number(p.x, text_);
      text_ += ',';
      number(p.y, text_);
      text_ += '>';
      ++count_;
    }
  }

  std::size_t count_ = 0;
  std::string text_;
};

}  // namespace

std::string pov_lathe(const LatheShape& lathe) {
  return "lathe { bezier_spline " + Points(lathe.outline, true).text() + " sturm" + kYToZ;
}

std::string pov_prism(const SweepShape& sweep) {
  std::string text = "prism { linear_sweep bezier_spline ";
  number(sweep.base, text);
  text += ", ";
  number(sweep.base + sweep.height, text);
  return text + ", " + Points(sweep.outline, false).text() + kYToZ;
}

}  // namespace graycube
