#include "regions/camera.hpp"

#include <cmath>

#include "catch.hpp"

namespace graycube {
namespace {

constexpr double kTiny = 1e-14;

Camera looking_along_z(Handedness handedness) {
  Camera camera;
  camera.eye = {0, 0, -5};
  camera.look_at = {0, 0, 3};
  camera.up = {0, 1, 0};
  camera.fov_degrees = 90;
  camera.width = 8;
  camera.handedness = handedness;
  return camera;
}

void check_close(const Vec3& a, const Vec3& b) {
  CAPTURE(a.x, a.y, a.z, b.x, b.y, b.z);
  CHECK(max_abs(a - b) < kTiny);
}

TEST_CASE("seen from -z a right-handed camera has +x on the left") {
  const auto frame = CameraFrame::from(looking_along_z(Handedness::kRight), {8, 4, 1});
  check_close(frame.forward, {0, 0, 1});
  check_close(frame.right, {-1, 0, 0});
  check_close(frame.down, {0, -1, 0});
  CHECK(frame.primary_ray(0, 0, 0, 0).direction.x > 0);
}

TEST_CASE("seen from -z a left-handed camera has +x on the right and the same up") {
  const auto frame = CameraFrame::from(looking_along_z(Handedness::kLeft), {8, 4, 1});
  check_close(frame.right, {1, 0, 0});
  check_close(frame.down, {0, -1, 0});
  CHECK(frame.primary_ray(0, 0, 0, 0).direction.x < 0);
}

TEST_CASE("pixel (0,0) is top left") {
  for (const auto handedness : {Handedness::kRight, Handedness::kLeft}) {
    const auto frame = CameraFrame::from(looking_along_z(handedness), {8, 4, 1});
    const Vec3 d = frame.primary_ray(0, 0, 0, 0).direction;
    CHECK(dot(d, frame.right) < 0);
    CHECK(d.y > 0);
    const Vec3 last = frame.primary_ray(7, 3, 0, 0).direction;
    CHECK(dot(last, frame.right) > 0);
    CHECK(last.y < 0);
  }
}

TEST_CASE("a pixel offset counts from the pixel's lower-left corner") {
  Camera camera = looking_along_z(Handedness::kLeft);
  camera.projection = Projection::kOrthographic;  // pixels of side 1, x −4 … 4, y −2 … 2
  camera.pixel_offset = {0, 0};
  check_close(CameraFrame::from(camera, {8, 4, 1}).primary_ray(0, 0, 0, 0).origin, {-4, 1, -5});
  check_close(CameraFrame::from(camera, {8, 4, 2}).primary_ray(7, 3, 1, 1).origin, {3.5, -2, -5});
  camera.pixel_offset = {1, 0.75};
  check_close(CameraFrame::from(camera, {8, 4, 1}).primary_ray(2, 1, 0, 0).origin, {-1, 0.75, -5});
}

TEST_CASE("fov is the full horizontal angle and pixels are square") {
  const auto frame = CameraFrame::from(looking_along_z(Handedness::kLeft), {8, 4, 1});
  // tan 45° = 1, so eight pixels span −1 … 1 and the four rows −0.5 … 0.5.
  CHECK(frame.pixel_size == Approx(0.25).epsilon(kTiny));
  CHECK(frame.column_position(0) == Approx(-1).epsilon(kTiny));
  CHECK(frame.row_position(4) == Approx(0.5).epsilon(kTiny));
  check_close(frame.primary_ray(0, 0, 0, 0).direction, normalized({-0.875, 0.375, 1}));
}

TEST_CASE("an up that is not perpendicular to the view is made so") {
  Camera camera = looking_along_z(Handedness::kRight);
  camera.eye = {3, 4, -5};
  camera.look_at = {-1, 0.5, 2};
  camera.up = {0.3, 2, 0.1};
  const auto frame = CameraFrame::from(camera, {64, 48, 1});
  for (const Vec3& axis : {frame.right, frame.down, frame.forward}) {
    CHECK(length(axis) == Approx(1).epsilon(kTiny));
  }
  CHECK(std::fabs(dot(frame.right, frame.down)) < kTiny);
  CHECK(std::fabs(dot(frame.right, frame.forward)) < kTiny);
  CHECK(std::fabs(dot(frame.down, frame.forward)) < kTiny);
  CHECK(dot(frame.down, camera.up) < 0);
  // right × up = backward in a right-handed picture.
  check_close(cross(frame.right, -frame.down), -frame.forward);
}

TEST_CASE("samples pass through the centres of the subcells of a pixel") {
  const auto frame = CameraFrame::from(looking_along_z(Handedness::kLeft), {8, 4, 2});
  for (std::uint32_t sx = 0; sx < 2; ++sx) {
    for (std::uint32_t sy = 0; sy < 2; ++sy) {
      const double x = frame.column_position(5 + 0.25 + 0.5 * sx);
      const double y = frame.row_position(1 + 0.25 + 0.5 * sy);
      check_close(frame.primary_ray(5, 1, sx, sy).direction, normalized({x, -y, 1}));
    }
  }
}

TEST_CASE("perspective rays start at the eye, all bits of it") {
  Camera camera = looking_along_z(Handedness::kRight);
  camera.eye = {0.1, 0.7, -1.0 / 3};
  const auto frame = CameraFrame::from(camera, {8, 4, 1});
  const Ray ray = frame.primary_ray(3, 2, 0, 0);
  CHECK(ray.origin == camera.eye);
  CHECK(length(ray.direction) == Approx(1).epsilon(kTiny));
}

TEST_CASE("orthographic rays are parallel and start on the plane through the eye") {
  Camera camera = looking_along_z(Handedness::kLeft);
  camera.projection = Projection::kOrthographic;
  const auto frame = CameraFrame::from(camera, {8, 4, 1});
  CHECK(frame.pixel_size == 1);
  const Ray first = frame.primary_ray(0, 0, 0, 0);
  check_close(first.origin, {-3.5, 1.5, -5});
  CHECK(first.direction == frame.forward);
  const Ray last = frame.primary_ray(7, 3, 0, 0);
  check_close(last.origin, {3.5, -1.5, -5});
  CHECK(last.direction == frame.forward);
}

}  // namespace
}  // namespace graycube
