#include "formats/graycube/read_settings.hpp"

#include <array>
#include <cmath>
#include <string>

#include "formats/graycube/scene_words.hpp"
#include "spelling.hpp"

namespace graycube {
namespace {

/// If the sine of the angle between them is less, `up` counts as lying along the view.
constexpr double kLeastUpSine = 1e-9;

constexpr NumberRule kFieldOfView{
    .what = "an angle between 0 and 180 degrees", .min = 0, .max = 180, .open = true};
constexpr NumberRule kBeamAngle{.what = "an angle from 0 to 180 degrees", .min = 0, .max = 180};

void check_frame(JsonAccess& json, JsonIndex look_at_at, JsonIndex up_at, const Camera& camera) {
  const Vec3 view = camera.look_at - camera.eye;
  const double distance = length(view);
  if (!(distance > 0) || !std::isfinite(distance)) {
    json.wrong(look_at_at, "a point at a finite, non-zero distance from the eye");
    return;
  }
  if (!(length(cross(normalized(view), normalized(camera.up))) > kLeastUpSine))
    json.wrong(up_at, "a vector that is not along the view");
}

void read_pixel_offset(JsonAccess& json, JsonIndex at, std::array<double, 2>& out) {
  if (json.tree.kind(at) != JsonKind::kArray || json.tree.size(at) != 2) {
    json.wrong(at, "two numbers from 0 to 1");
    return;
  }
  const JsonIndex x = json.tree.first_child(at);
  json.read(x, out[0], kFraction);
  json.read(json.tree.next(x), out[1], kFraction);
}

void read_yes_or_no(JsonAccess& json, JsonIndex at, bool& out) {
  const JsonKind kind = json.tree.kind(at);
  if (kind != JsonKind::kTrue && kind != JsonKind::kFalse) {
    json.wrong(at, "true or false");
    return;
  }
  out = kind == JsonKind::kTrue;
}

void read_light(JsonAccess& json, JsonIndex at, PointLight& out) {
  enum : std::size_t { kType, kPosition, kColor, kFalloff, kShadows, kDirection, kAngle, kKeys };
  constexpr std::array<KeyRule, kKeys> kRules{{{"type", true},
                                               {"position", true},
                                               {"color"},
                                               {"falloff"},
                                               {"shadows"},
                                               {"direction"},
                                               {"angle"}}};
  constexpr std::array<Word<int>, 1> kTypes{{{"point", 0}}};
  std::array<JsonIndex, kKeys> member{};
  json.members(at, "a light", kRules, member);
  int type = 0;
  json.read_word(member[kType], type, kTypes);
  json.read_optional(member[kPosition], out.position);
  json.read_optional(member[kColor], out.color);
  json.read_word(member[kFalloff], out.falloff, kFalloffWords);
  if (member[kShadows] != 0) read_yes_or_no(json, member[kShadows], out.shadows);
  if (member[kDirection] != 0) json.read_direction(member[kDirection], out.direction);
  json.read_optional(member[kAngle], out.angle_degrees, kBeamAngle);
  if ((member[kDirection] == 0) != (member[kAngle] == 0))
    json.errors.add(at, "a beam needs the keys \"direction\" and \"angle\"");
}

}  // namespace

void read_image(JsonAccess& json, JsonIndex at, ImageSize& out) {
  enum : std::size_t { kWidth, kHeight, kSamples, kKeys };
  constexpr std::array<KeyRule, kKeys> kRules{{{"width", true}, {"height", true}, {"samples"}}};
  std::array<JsonIndex, kKeys> member{};
  json.members(at, "the image", kRules, member);
  json.read_optional(member[kWidth], out.width, 1u, kMaxImageSide);
  json.read_optional(member[kHeight], out.height, 1u, kMaxImageSide);
  json.read_optional(member[kSamples], out.samples, 1u, kMaxSamples);
  const std::uint64_t pixels = std::uint64_t{out.width} * out.height;
  if (pixels > kMaxPixels)
    json.errors.add(at, "expected at most " + std::to_string(kMaxPixels) + " pixels, found " +
                            std::to_string(out.width) + " x " + std::to_string(out.height));
}

void read_camera(JsonAccess& json, JsonIndex at, Camera& out) {
  enum : std::size_t {
    kType,
    kEye,
    kLookAt,
    kUp,
    kFov,
    kWidth,
    kHandedness,
    kPixelOffset,
    kInside,
    kKeys
  };
  constexpr std::array<KeyRule, kKeys> kRules{{{"type", true},
                                               {"eye", true},
                                               {"look_at", true},
                                               {"up", true},
                                               {"fov"},
                                               {"width"},
                                               {"handedness"},
                                               {"pixel_offset"},
                                               {"inside"}}};
  std::array<JsonIndex, kKeys> member{};
  const bool complete = json.members(at, "the camera", kRules, member);
  json.read_word(member[kHandedness], out.handedness, kHandednessWords);
  json.read_word(member[kInside], out.inside, kInsideViewWords);
  if (member[kPixelOffset] != 0) read_pixel_offset(json, member[kPixelOffset], out.pixel_offset);
  const bool type_known =
      member[kType] != 0 && json.read_word(member[kType], out.projection, kProjectionWords);
  json.read_optional(member[kFov], out.fov_degrees, kFieldOfView);
  json.read_optional(member[kWidth], out.width, kPositive);
  if (type_known) {
    const bool perspective = out.projection == Projection::kPerspective;
    const auto [wanted, unwanted] =
        perspective ? std::array{kFov, kWidth} : std::array{kWidth, kFov};
    const std::string kind = perspective ? "a perspective camera" : "an orthographic camera";
    if (member[wanted] == 0)
      json.errors.add(at, kind + " needs the key " + quoted(kRules[wanted].name));
    if (member[unwanted] != 0)
      json.errors.add(member[unwanted], kind + " has no key " + quoted(kRules[unwanted].name) +
                                            "; did you mean " + quoted(kRules[wanted].name) + "?");
  }
  if (type_known && out.inside == InsideView::kEntry &&
      out.projection == Projection::kPerspective) {
    json.errors.add(member[kInside], "only an orthographic camera shows entries");
  }
  bool frame_good = json.read_optional(member[kEye], out.eye);
  frame_good = json.read_optional(member[kLookAt], out.look_at) && frame_good;
  frame_good = (member[kUp] == 0 || json.read_direction(member[kUp], out.up)) && frame_good;
  if (complete && frame_good) check_frame(json, member[kLookAt], member[kUp], out);
}

void read_lights(JsonAccess& json, JsonIndex at, std::vector<PointLight>& out) {
  if (!json.is_array(at)) return;
  if (json.tree.size(at) > kMaxLights) {
    json.wrong(at, "at most " + std::to_string(kMaxLights) + " lights");
    return;
  }
  for (JsonIndex l = json.tree.first_child(at); l != json.tree.end(at); l = json.tree.next(l))
    read_light(json, l, out.emplace_back());
}

}  // namespace graycube
