// How far a displacement in the world reaches on the screen.
//
// Derived in docs/algorithms/ground-truth.md, "How far an error reaches on the screen".
#pragma once

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cmath>
#include <limits>

#include "core/box.h"
#include "core/camera.h"

namespace plumb {

/// |proj(p + delta * axis) - proj(p)| in pixels; +inf if either point lies at or behind the eye's
/// plane (depth <= 0).
///
/// world_m  the point p, in the camera's coordinates
/// axis     unit vector
/// delta_m  signed displacement along it
double screen_displacement_px(const Camera& camera, const glm::dvec3& world_m,
                              const glm::dvec3& axis, double delta_m);

/// The same for a point and an axis in view coordinates (see core/camera.h), for loops that have
/// them at hand.
double screen_displacement_of_view_px(const Camera& camera, const glm::dvec3& view_m,
                                      const glm::dvec3& axis_view, double delta_m);

/// (u, v) of the formula, the two parts of N(p) on the screen, px m.
inline glm::dvec2 screen_velocity(const Camera& camera, const glm::dvec3& view_m,
                                  const glm::dvec3& axis_view) {
  return {camera.gamma_h * (view_m.z * axis_view.x - axis_view.z * view_m.x),
          camera.gamma_v * (view_m.z * axis_view.y - axis_view.z * view_m.y)};
}

/// N(p) of the formula: how fast a point at view coordinates moves along an axis, times its depth
/// squared, px m. For loops that ask for several displacements of a point.
inline double screen_speed(const Camera& camera, const glm::dvec3& view_m,
                           const glm::dvec3& axis_view) {
  const glm::dvec2 n = screen_velocity(camera, view_m, axis_view);
  return std::sqrt(glm::dot(n, n));
}
/// screen_displacement_of_view_px of a point with that speed at depth `w`; `axis_w` is the axis's
/// own depth component.
inline double screen_displacement_at_speed_px(double speed, double w, double axis_w,
                                              double delta_m) {
  if (delta_m == 0.0) return 0.0;
  const double moved = w + delta_m * axis_w;
  if (!(w > 0.0) || !(moved > 0.0)) return std::numeric_limits<double>::infinity();
  return std::abs(delta_m) * speed / (w * moved);
}

/// A direction in view coordinates.
glm::dvec3 direction_to_view(const Camera& camera, const glm::dvec3& direction);

/// Largest displacement on screen of any point of `box` moved by at most `delta_m` along `axis`:
/// the exact supremum, +inf if a moved point may come to the eye's plane. The box need not be in
/// view. `axis` is a coordinate axis.
double largest_displacement_px(const Camera& camera, const Box& box, const glm::dvec3& axis,
                               double delta_m);

/// A displacement along `axis` that keeps every point of `box` within `error_px` of its place on
/// the screen.
///
///   (1) Conservative: every |delta| <= result moves no point of the box *that is in view* by more
///   than error_px. (2) Finite and >= 0 for every box and camera, boxes around or across the eye
///   included.
/// Up to 1.3 times smaller than the largest such displacement, 1.03 in the median. error_px >= 0,
/// finite. +inf where no part of the box can be in view.
double allowed_displacement_m(const Camera& camera, const Box& box, const glm::dvec3& axis,
                              double error_px);

/// A bound of how far a displacement of at most `delta_m` along `axis` moves any point of the box
/// *that is in view*: at least the largest such distance, +inf if a moved point may come to the
/// eye's plane; 0 where no part of the box can be in view. The inverse of allowed_displacement_m.
double displacement_bound_px(const Camera& camera, const Box& box, const glm::dvec3& axis,
                             double delta_m);

/// False only if no point of the box lies in the camera's frustum (near plane and four sides; far
/// is ignored).
bool may_be_in_view(const Camera& camera, const Box& box);

}  // namespace plumb
