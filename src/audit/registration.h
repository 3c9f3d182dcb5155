// Whether a picture was made with the camera that it is audited with.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "core/camera.h"
#include "core/hit_image.h"
#include "core/triangle_mesh.h"

namespace plumb::audit {

/// Two tests that need no truth: each point drawn must be seen at its own pixel's centre, and must
/// lie on the triangle that the picture names. A surface without triangles passes the second.
struct Registration {
  glm::dvec2 mean_shift_px{0.0};  // of the points' pixels from the pixels' centres
  double largest_shift_px = 0.0;  // 1/512 a side is what snapping to 1/256 pixel gives
  glm::dvec3 eye_offset_m{
      0.0};  // least-squares offset of the eye that brings all points onto their triangles
  double largest_off_plane_m = 0.0;
  double allowed_off_plane_m = 0.0;  // what rounding explains
  bool agrees = true;
};

/// Largest shift that snapping to 1/256 pixel explains: half a step along each axis, and a
/// rounding.
inline constexpr double kSnapShiftPx = 1.4142135624 / 512.0 + 1e-6;

/// `mesh` is null where the picture is of none.
Registration registration_of(const TriangleMesh* mesh, const HitImage& drawn, const Camera& camera);

}  // namespace plumb::audit
