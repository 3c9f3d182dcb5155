// A pixel's ray, the planes of slices, and a fragment's test.
#pragma once

#include <algorithm>
#include <cmath>

#include "core/camera.h"
#include "slicing/height_lookup.h"
#include "slicing/slice_bundle.h"

namespace plumb::slicing {

/// A ray from the eye through a pixel's centre; t is the view depth.
struct SliceRay {
  glm::dvec3 eye_m;       // relative to the terrain's origin
  glm::dvec3 direction;   // of view depth one
  glm::dvec3 inverse;     // of each coordinate of the direction; infinite where that is zero
  glm::dvec3 per_column;  // change of the direction from one pixel to the next, rightwards
  glm::dvec3 per_row;     // and upwards

  SliceRay(const Camera& camera, int x, int y)
      : eye_m(camera.eye_m),
        direction(ray_direction(camera, x + 0.5, y + 0.5)),
        inverse(1.0 / direction),
        per_column(camera.right / camera.gamma_h),
        per_row(camera.up / camera.gamma_v) {}
};

/// The largest coordinate, in size, of a box and the eye: what roundings are measured by.
inline double greatest_coordinate_m(const Box& box, const glm::dvec3& eye_m) {
  double greatest_m = 0.0;
  for (const glm::dvec3& p : {box.low, box.high, eye_m}) {
    for (int k = 0; k < 3; ++k) greatest_m = std::max(greatest_m, std::abs(p[k]));
  }
  return greatest_m;
}

/// Where a ray meets the plane at `at_m` across an axis: at view depth `t`, the point exactly on
/// it.
struct PlanePoint {
  double t;
  glm::dvec3 point_m;
};
inline PlanePoint meet_plane(const SliceRay& ray, Axis axis, double at_m) {
  const int n = index_of(axis);
  PlanePoint met;
  met.t = (at_m - ray.eye_m[n]) * ray.inverse[n];
  met.point_m = ray.eye_m + met.t * ray.direction;
  met.point_m[n] = at_m;
  return met;
}

enum class QuadKind { Slice, Closing };

/// True if the point lies on the quad that the bundle's reach cuts from its plane across `axis`.
inline bool is_on_quad(const SliceBundle& bundle, QuadKind kind, Axis axis, const glm::dvec3& p) {
  const double rim_m = kind == QuadKind::Closing ? bundle.closing_rim_m : 0.0;
  for (int k = 0; k < 3; ++k) {
    if (k != index_of(axis) &&
        !(p[k] >= bundle.reach.low[k] - rim_m && p[k] <= bundle.reach.high[k] + rim_m))
      return false;
  }
  return true;
}

/// How many samples' distances the pixel spans on the plane, in its longer direction, as a texture
/// unit asks for its level: one pixel further the ray meets the plane t (c - d c_n / d_n) further,
/// c the change of the direction d.
inline double texels_of(const SliceRay& ray, Axis axis, double t, const HeightLookup& heights) {
  const int n = index_of(axis);
  double most_squared = 0.0;
  for (const glm::dvec3& change : {ray.per_column, ray.per_row}) {
    const glm::dvec3 along = t * (change - ray.direction * (change[n] * ray.inverse[n]));
    const double u = along.x * heights.columns_per_m(), v = along.y * heights.rows_per_m();
    most_squared = std::max(most_squared, u * u + v * v);
  }
  return std::sqrt(most_squared);
}

/// A fragment's height and what it is compared with.
struct FragmentHeight {
  double tested_m, terrain_m;  // terrain_m is NaN where there is none

  /// At or below the terrain.
  bool passes() const { return terrain_m >= tested_m; }
};
inline FragmentHeight fragment_height(const SliceBundle& bundle, QuadKind kind, Axis axis,
                                      const HeightLookup& heights, const SliceRay& ray,
                                      const PlanePoint& met) {
  const glm::dvec3& p = met.point_m;
  const double raise_m = kind == QuadKind::Slice ? bundle.raise_m : bundle.closing_raise_m;
  const double z =
      heights.reference_m(std::clamp(p.z - raise_m, bundle.least_z_m, bundle.greatest_z_m));
  if (heights.interpolation() == Interpolation::MipMapped)
    return {z, heights.mipmapped_m(p.x, p.y, texels_of(ray, axis, met.t, heights))};
  return {z, heights.height_m(p.x, p.y)};
}

/// A fragment's test.
inline bool passes(const SliceBundle& bundle, QuadKind kind, Axis axis, const HeightLookup& heights,
                   const SliceRay& ray, const PlanePoint& met) {
  return fragment_height(bundle, kind, axis, heights, ray, met).passes();
}

}  // namespace plumb::slicing
