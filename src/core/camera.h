// A pinhole camera, and where it sees a point.
#pragma once

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <limits>

namespace plumb {

/// A pinhole camera in world coordinates (right-handed, z up, metres). Pixel (0, 0) is top left,
/// its centre (0.5, 0.5).
///
/// View coordinates of a point are (x, y, w): x to the right, y upwards, w the depth along
/// `forward`. A point is seen at pixel (centre_px.x + gamma_h * x / w, centre_px.y - gamma_v * y /
/// w).
struct Camera {
  glm::dvec3 eye_m{0.0};
  glm::dvec3 right{1.0, 0.0, 0.0};  // right, up, forward: orthonormal
  glm::dvec3 up{0.0, 0.0, 1.0};
  glm::dvec3 forward{0.0, 1.0, 0.0};
  int width_px = 1920;
  int height_px = 1080;
  double gamma_h = 1000.0;  // pixels that one unit across spans at view depth one, > 0
  double gamma_v = 1000.0;  // the same upwards
  glm::dvec2 centre_px{
      960.0, 540.0};    // the pixel that `forward` meets; off the middle for a jittered projection
  double near_m = 0.1;  // least view depth that is seen, > 0
  double far_m = std::numeric_limits<double>::infinity();

  friend bool operator==(const Camera&, const Camera&) = default;
};

/// What people write down to describe a camera.
struct LookAt {
  glm::dvec3 eye_m{0.0};
  glm::dvec3 target_m{0.0, 1.0, 0.0};
  glm::dvec3 up{0.0, 0.0, 1.0};
  double fov_y_deg = 50.0;  // in (0, 180)
  int width_px = 1920;      // 1..65536
  int height_px = 1080;
  double near_m = 0.1;  // > 0
  double far_m = std::numeric_limits<double>::infinity();
};

/// The camera that looks from `eye_m` to `target_m` with square pixels and its centre in the
/// image's middle. Looking straight along `up`, the picture's upper side points north (or, should
/// `up` be north, to +z). Throws std::invalid_argument if a value is out of range or eye and target
/// coincide.
Camera make_camera(const LookAt& description);

/// World point to view coordinates (x, y, w), metres.
inline glm::dvec3 to_view(const Camera& camera, const glm::dvec3& world_m) {
  const glm::dvec3 d = world_m - camera.eye_m;
  return {glm::dot(d, camera.right), glm::dot(d, camera.up), glm::dot(d, camera.forward)};
}

/// View coordinates with w > 0 to pixels.
inline glm::dvec2 view_to_pixel(const Camera& camera, const glm::dvec3& view) {
  return {camera.centre_px.x + camera.gamma_h * (view.x / view.z),
          camera.centre_px.y - camera.gamma_v * (view.y / view.z)};
}

/// Direction of the ray through an image point (pixels), scaled to view depth one: eye + t *
/// direction has view depth t.
inline glm::dvec3 ray_direction(const Camera& camera, double x_px, double y_px) {
  const double x = (x_px - camera.centre_px.x) / camera.gamma_h;
  const double y = (camera.centre_px.y - y_px) / camera.gamma_v;
  return camera.forward + (x * camera.right + y * camera.up);
}

/// The same camera with its eye given relative to `origin_m`.
inline Camera relative_to(Camera camera, const glm::dvec3& origin_m) {
  camera.eye_m -= origin_m;
  return camera;
}

}  // namespace plumb
