#include "raster/vertex_stage.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/check.h"
#include "core/parallel.h"
#include "raster/vertex_kernel.h"

namespace plumb::raster {
namespace {

constexpr double kFarthest_m = 1e30;  // squares and products of such lengths stay finite
constexpr double kFarthestCentre_px = 524288.0;
constexpr std::int64_t kGrain = 8192;  // vertices a task takes

bool finite(const glm::dvec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
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

namespace {

WindowTransform window_transform(const Projection& projection) {
  const Camera& camera = projection.camera;
  WindowTransform to{};
  for (int k = 0; k < 3; ++k) {
    to.origin[k] = projection.origin_from_eye_m[k];
    to.right[k] = camera.right[k];
    to.up[k] = camera.up[k];
    to.forward[k] = camera.forward[k];
  }
  to.gamma_h = camera.gamma_h;
  to.gamma_v = camera.gamma_v;
  to.centre_x = camera.centre_px.x;
  to.centre_y = camera.centre_px.y;
  to.near = camera.near_m;
  to.guard_left = kGuardBand_px + camera.centre_px.x;
  to.guard_right = kGuardBand_px - camera.centre_px.x;
  to.guard_top = kGuardBand_px + camera.centre_px.y;
  to.guard_bottom = kGuardBand_px - camera.centre_px.y;
  to.farthest = kFarthest_m;
  to.clipped = kClipped;
  return to;
}

// Which chunks of vertices the runs in view use.
std::vector<std::uint8_t> chunks_in_view(const MeshRuns& runs,
                                         std::span<const std::uint8_t> in_view) {
  std::vector<std::uint8_t> used((runs.mesh()->vertices_m.size() + MeshRuns::kVertices - 1) /
                                 MeshRuns::kVertices);
  for (std::size_t run = 0; run < runs.count(); ++run) {
    if (in_view[run] == 0) continue;
    for (const std::uint32_t chunk : runs.vertex_chunks(run)) used[chunk] = 1;
  }
  return used;
}

}  // namespace

ScreenVertices transform(const Projection& projection, std::span<const glm::dvec3> vertices_m,
                         const MeshRuns* runs, std::span<const std::uint8_t> in_view) {
  static_assert(sizeof(glm::dvec3) == 3 * sizeof(double));
  ScreenVertices result(vertices_m.size());
  const WindowTransform to = window_transform(projection);
  const TransformVertices kernel = transform_vertices(instruction_set());
  const auto some = [&](std::size_t begin, std::size_t end) {
    return kernel(to, &vertices_m[begin].x, static_cast<std::int64_t>(end - begin),
                  result.data() + begin);
  };
  const auto both = [](bool a, bool b) { return a && b; };
  bool usable = true;
  if (runs == nullptr) {
    usable = parallel_ordered_reduce(
        static_cast<std::int64_t>(vertices_m.size()), kGrain, true,
        [&](std::int64_t begin, std::int64_t end, bool before) {
          return some(static_cast<std::size_t>(begin), static_cast<std::size_t>(end)) && before;
        },
        both);
  } else {
    const std::vector<std::uint8_t> used = chunks_in_view(*runs, in_view);
    constexpr std::size_t kChunk = MeshRuns::kVertices;
    usable = parallel_ordered_reduce(
        static_cast<std::int64_t>(used.size()), kGrain / static_cast<std::int64_t>(kChunk), true,
        [&](std::int64_t begin, std::int64_t end, bool before) {
          for (auto chunk = static_cast<std::size_t>(begin); chunk < static_cast<std::size_t>(end);
               ++chunk) {
            if (used[chunk] == 0) continue;
            before =
                some(chunk * kChunk, std::min((chunk + 1) * kChunk, vertices_m.size())) && before;
          }
          return before;
        },
        both);
  }
  require(usable, "a mesh's vertices must be finite and within 1e30 m of the eye");
  return result;
}

}  // namespace plumb::raster
