#include "regions/camera.hpp"

#include "geometry/portable_math.hpp"

namespace graycube {

CameraFrame CameraFrame::from(const Camera& camera, const ImageSize& image) {
  CameraFrame frame;
  frame.image = image;
  frame.projection = camera.projection;
  frame.eye = camera.eye;
  frame.forward = normalized(camera.look_at - camera.eye);
  // Right-handed: eye on −z, looking at +z, up +y gives z × y = −x, so +x is on the left of the
  // picture.
  const Vec3 right = normalized(cross(frame.forward, camera.up));
  frame.down = cross(frame.forward, right);
  frame.right = camera.handedness == Handedness::kRight ? right : -right;
  const double width = camera.projection == Projection::kPerspective
                           ? 2 * tan_degrees(0.5 * camera.fov_degrees)
                           : camera.width;
  frame.pixel_size = width / image.width;
  frame.sample_x = camera.pixel_offset[0];
  frame.sample_y = 1 - camera.pixel_offset[1];
  return frame;
}

Ray CameraFrame::primary_ray(std::uint32_t x, std::uint32_t y, std::uint32_t sx,
                             std::uint32_t sy) const {
  const Vec3 across = column_position(x + (sx + sample_x) / image.samples) * right +
                      row_position(y + (sy + sample_y) / image.samples) * down;
  if (projection == Projection::kOrthographic) return {eye + across, forward};
  return {eye, normalized(forward + across)};
}

}  // namespace graycube
