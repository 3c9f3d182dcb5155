#include "raster/vertex_stage.h"

#include <cmath>

#include "core/check.h"
#include "core/parallel.h"

namespace plumb::raster {
namespace {

constexpr double kFarthest_m = 1e30;  // squares and products of such lengths stay finite
constexpr double kFarthestCentre_px = 524288.0;
constexpr std::int64_t kGrain = 8192;  // vertices a task takes

bool finite(const glm::dvec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

bool usable(const glm::dvec3& v) {  // false for NaN
  return std::abs(v.x) <= kFarthest_m && std::abs(v.y) <= kFarthest_m &&
         std::abs(v.z) <= kFarthest_m;
}

}  // namespace

glm::dvec3 Projection::view(const glm::dvec3& from_eye_m) const {
  return {glm::dot(from_eye_m, camera.right), glm::dot(from_eye_m, camera.up),
          glm::dot(from_eye_m, camera.forward)};
}

double Projection::distance(ClipPlane plane, const glm::dvec3& v) const {
  switch (plane) {
    case kNear:
      return v.z - camera.near_m;
    case kLeft:
      return camera.gamma_h * v.x + (kGuardBand_px + camera.centre_px.x) * v.z;
    case kRight:
      return (kGuardBand_px - camera.centre_px.x) * v.z - camera.gamma_h * v.x;
    case kTop:
      return (kGuardBand_px + camera.centre_px.y) * v.z - camera.gamma_v * v.y;
    default:
      return camera.gamma_v * v.y + (kGuardBand_px - camera.centre_px.y) * v.z;
  }
}

ScreenVertex Projection::to_window(const glm::dvec3& view_m) const {
  const glm::dvec2 window_px = view_to_pixel(camera, view_m);
  return {snap(window_px.x), snap(window_px.y), 1.0 / view_m.z};
}

unsigned Projection::outcode(const glm::dvec3& view_m) const {
  unsigned code = 0;
  for (int plane = 0; plane < kClipPlanes; ++plane) {
    if (!(distance(static_cast<ClipPlane>(plane), view_m) >= 0.0)) code |= 1u << plane;
  }
  return code;
}

Projection make_projection(const Camera& camera, const glm::dvec3& mesh_origin_m) {
  require(camera.width_px >= 1 && camera.width_px <= 65536 && camera.height_px >= 1 &&
              camera.height_px <= 65536,
          "an image must be 1 to 65536 pixels wide and high, got {} x {}", camera.width_px,
          camera.height_px);
  require(finite(camera.eye_m) && finite(camera.right) && finite(camera.up) &&
              finite(camera.forward) && finite(mesh_origin_m),
          "a camera's eye and axes and a mesh's origin must be finite");
  require(camera.gamma_h > 0.0 && std::isfinite(camera.gamma_h) && camera.gamma_v > 0.0 &&
              std::isfinite(camera.gamma_v),
          "a camera's gamma must be positive and finite, got {} and {}", camera.gamma_h,
          camera.gamma_v);
  require(camera.near_m > 0.0 && camera.near_m < camera.far_m,
          "near and far must satisfy 0 < near < far, got {} and {}", camera.near_m, camera.far_m);
  require(std::abs(camera.centre_px.x) <= kFarthestCentre_px &&
              std::abs(camera.centre_px.y) <= kFarthestCentre_px,
          "a camera's centre must lie within 2^19 pixels, got ({}, {})", camera.centre_px.x,
          camera.centre_px.y);
  return {camera, mesh_origin_m - camera.eye_m};
}

std::vector<ScreenVertex> transform(const Projection& projection,
                                    std::span<const glm::dvec3> vertices_m) {
  std::vector<ScreenVertex> result(vertices_m.size());
  const auto transform_some = [&](std::int64_t begin, std::int64_t end, bool all_usable) {
    for (std::int64_t i = begin; i < end; ++i) {
      const glm::dvec3 from_eye_m = projection.from_eye(vertices_m[i]);
      all_usable = all_usable && usable(from_eye_m);
      const glm::dvec3 view_m = projection.view(from_eye_m);
      const unsigned code = projection.outcode(view_m);
      result[i] = code == 0 ? projection.to_window(view_m)
                            : ScreenVertex{kClipped, static_cast<std::int32_t>(code), 0.0};
    }
    return all_usable;
  };
  const bool all_usable =
      parallel_ordered_reduce(static_cast<std::int64_t>(vertices_m.size()), kGrain, true,
                              transform_some, [](bool a, bool b) { return a && b; });
  require(all_usable, "a mesh's vertices must be finite and within 1e30 m of the eye");
  return result;
}

}  // namespace plumb::raster
