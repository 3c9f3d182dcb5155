#include "core/camera.h"

#include <cmath>

#include "core/check.h"
#include "core/reproducible_math.h"

namespace plumb {
namespace {

bool finite(const glm::dvec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

glm::dvec3 unit(const glm::dvec3& v) { return v / std::sqrt(glm::dot(v, v)); }

// sin(angle) below which two unit vectors count as parallel.
constexpr double kParallel = 1e-9;

}  // namespace

Camera make_camera(const LookAt& d) {
  require(finite(d.eye_m) && finite(d.target_m) && finite(d.up),
          "a camera's eye, target and up must be finite");
  require(d.fov_y_deg > 0.0 && d.fov_y_deg < 180.0, "fov_y_deg must lie in (0, 180), got {}",
          d.fov_y_deg);
  require(d.width_px >= 1 && d.width_px <= 65536 && d.height_px >= 1 && d.height_px <= 65536,
          "an image must be 1 to 65536 pixels wide and high, got {} x {}", d.width_px, d.height_px);
  require(d.near_m > 0.0 && d.near_m < d.far_m,
          "near and far must satisfy 0 < near < far, got {} and {}", d.near_m, d.far_m);
  const glm::dvec3 line = d.target_m - d.eye_m;
  require(glm::dot(line, line) > 0.0,
          "a camera's eye and target must differ, both are ({}, {}, {})", d.eye_m.x, d.eye_m.y,
          d.eye_m.z);
  require(glm::dot(d.up, d.up) > 0.0, "a camera's up must not be zero");

  Camera camera;
  camera.eye_m = d.eye_m;
  camera.forward = unit(line);
  glm::dvec3 right = glm::cross(camera.forward, unit(d.up));
  if (glm::dot(right, right) < kParallel * kParallel) {
    const glm::dvec3 north{0.0, 1.0, 0.0}, upward{0.0, 0.0, 1.0};
    right = glm::cross(camera.forward, north);
    if (glm::dot(right, right) < kParallel * kParallel) right = glm::cross(camera.forward, upward);
  }
  camera.right = unit(right);
  camera.up = glm::cross(camera.right, camera.forward);
  camera.width_px = d.width_px;
  camera.height_px = d.height_px;
  camera.gamma_v = d.height_px / (2.0 * reproducible_tan(radians(d.fov_y_deg) / 2.0));
  camera.gamma_h = camera.gamma_v;
  camera.centre_px = {d.width_px / 2.0, d.height_px / 2.0};
  camera.near_m = d.near_m;
  camera.far_m = d.far_m;
  return camera;
}

}  // namespace plumb
