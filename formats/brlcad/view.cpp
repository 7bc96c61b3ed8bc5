#include "formats/brlcad/view.hpp"

#include <cmath>
#include <vector>

#include "formats/brlcad/database/words.hpp"
#include "geometry/portable_math.hpp"

namespace graycube {
namespace {

/// rt puts the eye this far in front of the model's middle, in halves of the view's size.
const double kEyeBackoff = std::sqrt(2.0);
constexpr double kMaxPerspective = 179;
constexpr double kMostNumber = 1e12;
constexpr double kLeastViewSize = 1e-12;

/// A camera that looks like rt's, whose rays go through the lower-left corners of its cells.
Camera looking(const Vec3& eye, const Vec3& up, const Vec3& backward, double view_size) {
  Camera camera;
  camera.projection = Projection::kOrthographic;
  camera.eye = eye;
  // The point is as far off as the picture is wide, or as the eye is from the origin if that is
  // more: enough digits must be left when the eye is subtracted.
  camera.look_at = eye - std::fmax(view_size, max_abs(eye)) * backward;
  camera.up = up;
  camera.width = view_size;
  camera.pixel_offset = {0, 0};
  camera.inside = InsideView::kEntry;
  return camera;
}

/// The commands of a script: words up to a semicolon, also across line ends.
std::vector<std::vector<std::string_view>> commands_of(std::string_view script) {
  std::vector<std::vector<std::string_view>> commands;
  constexpr std::size_t kMostWords = 32;
  while (!script.empty()) {
    const std::size_t end = std::min(script.find(';'), script.size());
    const std::string_view command = script.substr(0, end);
    script.remove_prefix(std::min(end + 1, script.size()));
    std::vector<std::string_view> words;
    for (std::size_t at = 0; at < command.size() && words.size() < kMostWords;) {
      const std::size_t from = command.find_first_not_of(" \t\r\n=", at);
      if (from == std::string_view::npos) break;
      at = std::min(command.find_first_of(" \t\r\n=", from), command.size());
      words.push_back(command.substr(from, at - from));
    }
    if (!words.empty()) commands.push_back(std::move(words));
  }
  return commands;
}

class ViewReader {
 public:
  explicit ViewReader(BrlcadReport& report) : report_(report) {}

  std::optional<BrlcadView> read(std::string_view script) {
    for (const auto& words : commands_of(script)) {
      if (words.front() == "end") break;
      if (!command(words)) return std::nullopt;
    }
    if (look_at_) orient_by_point();
    if (!view_size_ || !eye_ || !axes_) {
      report_.error("",
                    "the view lacks " + std::string(!view_size_ ? "viewsize"
                                                    : !eye_     ? "eye_pt"
                                                            : "viewrot, orientation or lookat_pt"));
      return std::nullopt;
    }
    Camera camera = looking(*eye_, axes_->up, axes_->backward, *view_size_);
    if (perspective_ > 0) {
      camera.projection = Projection::kPerspective;
      camera.inside = InsideView::kExit;
      camera.fov_degrees = perspective_;
    }
    return BrlcadView{camera, *view_size_};
  }

 private:
  bool fail(std::string_view command, const std::string& why) {
    report_.error(std::string(command), why);
    return false;
  }

  /// Reads `count` numbers behind the first `from` words.
  bool numbers(const std::vector<std::string_view>& words, std::size_t from, std::size_t count,
               std::array<double, 16>& out) {
    for (std::size_t i = 0; i < count; ++i) {
      const auto v = from + i < words.size() ? parse_brlcad_number(words[from + i]) : std::nullopt;
      if (!v || std::fabs(*v) > kMostNumber) {
        return fail(words.front(),
                    "expected " + std::to_string(count) + " numbers, none beyond 1e12");
      }
      out[i] = *v;
    }
    return true;
  }

  bool command(const std::vector<std::string_view>& words) {
    std::array<double, 16> v{};
    const std::string_view verb = words.front();
    if (verb == "viewsize") {
      if (!numbers(words, 1, 1, v)) return false;
      view_size_ = v[0];
      return v[0] >= kLeastViewSize || fail(verb, "expected a number > 0");
    }
    if (verb == "eye_pt") {
      if (!numbers(words, 1, 3, v)) return false;
      eye_ = {v[0], v[1], v[2]};
      return true;
    }
    if (verb == "lookat_pt") {
      if (!numbers(words, 1, 3, v)) return false;
      look_at_ = {v[0], v[1], v[2]};
      return true;
    }
    if (verb == "viewrot") return numbers(words, 1, 16, v) && orient_by_rows(verb, v);
    if (verb == "orientation") return numbers(words, 1, 4, v) && orient_by_quaternion(verb, v);
    if (verb == "perspective" || (verb == "set" && words.size() > 1 && words[1] == "perspective")) {
      if (!numbers(words, verb == "set" ? 2 : 1, 1, v)) return false;
      perspective_ = v[0];
      return v[0] <= kMaxPerspective || fail("perspective", "expected an angle below 180 degrees");
    }
    return true;  // start, clean, anim and the like don't move the eye
  }

  bool set_axes(std::string_view verb, const Vec3& up, const Vec3& backward) {
    const Vec3 z = normalized(backward);
    const Vec3 y = normalized(up - dot(up, z) * z);
    if (z == Vec3{} || y == Vec3{}) return fail(verb, "no rotation");
    axes_ = BrlcadAxes{cross(y, z), y, z};
    return true;
  }
  bool orient_by_rows(std::string_view verb, const std::array<double, 16>& m) {
    return set_axes(verb, {m[4], m[5], m[6]}, {m[8], m[9], m[10]});
  }
  /// The rotation of the quaternion x, y, z, w; its rows are the picture's axes.
  bool orient_by_quaternion(std::string_view verb, const std::array<double, 16>& q) {
    const double l = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    if (!(l > 0) || !std::isfinite(l)) return fail(verb, "no rotation");
    const double x = q[0] / l, y = q[1] / l, z = q[2] / l, w = q[3] / l;
    // The inverse of the rotation turns model axes into the picture's.
    return set_axes(verb, {2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w)},
                    {2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y)});
  }
  void orient_by_point() {
    if (!eye_) return;
    const Vec3 backward = *eye_ - *look_at_;
    const bool is_upright = length(cross(backward, {0, 0, 1})) > 1e-9 * length(backward);
    set_axes("lookat_pt", is_upright ? Vec3{0, 0, 1} : Vec3{0, 1, 0}, backward);
  }

  BrlcadReport& report_;
  std::optional<double> view_size_;
  std::optional<Vec3> eye_, look_at_;
  std::optional<BrlcadAxes> axes_;
  double perspective_ = 0;
};

}  // namespace

std::optional<BrlcadView> read_brlcad_view(std::string_view script, BrlcadReport& report) {
  return ViewReader(report).read(script);
}

BrlcadView brlcad_view(double azimuth_degrees, double elevation_degrees, const Aabb& bounds) {
  const double sa = sin_degrees(azimuth_degrees), ca = cos_degrees(azimuth_degrees);
  const double se = sin_degrees(elevation_degrees), ce = cos_degrees(elevation_degrees);
  const Vec3 backward{ca * ce, sa * ce, se};
  const Vec3 up{-ca * se, -sa * se, ce};
  const Vec3 lo{std::floor(bounds.lo.x), std::floor(bounds.lo.y), std::floor(bounds.lo.z)};
  const Vec3 hi{std::ceil(bounds.hi.x), std::ceil(bounds.hi.y), std::ceil(bounds.hi.z)};
  double size = length(hi - lo);
  if (!(size > kLeastViewSize)) size = 1;
  const Vec3 eye = 0.5 * (lo + hi) + 0.5 * size * kEyeBackoff * backward;
  return {looking(eye, up, backward, size), size};
}

BrlcadAxes brlcad_axes(const Camera& camera) {
  const Vec3 backward = normalized(camera.eye - camera.look_at);
  const Vec3 right = normalized(cross(camera.up, backward));
  return {right, cross(backward, right), backward};
}

}  // namespace graycube
