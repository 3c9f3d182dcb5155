// Slices met by rays: planes are met and heights looked up, nothing else.
#pragma once

#include <cstdint>
#include <vector>

#include "core/camera.h"
#include "core/hit_image.h"
#include "slicing/height_lookup.h"
#include "slicing/slicing_cut.h"

namespace plumb::slicing {

/// A ray from the eye; t is the view depth.
struct SliceRay {
  glm::dvec3 eye_m;      // relative to the terrain's origin
  glm::dvec3 direction;  // of view depth one
  glm::dvec3 inverse;    // of each coordinate of the direction; infinite where that is zero

  SliceRay(const glm::dvec3& eye, const glm::dvec3& way)
      : eye_m(eye), direction(way), inverse(1.0 / way) {}
};

/// A fragment of a slice.
struct SliceHit {
  double t = kNoHit;
  std::uint32_t bundle = kNoPrimitive;

  explicit operator bool() const { return bundle != kNoPrimitive; }
  bool operator<(const SliceHit& other) const {
    return t < other.t || (t == other.t && bundle < other.bundle);
  }
};

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

/// True if the point lies on the quad that the bundle's reach cuts from its plane across `axis`.
inline bool is_on_quad(const SliceBundle& bundle, Axis axis, const glm::dvec3& p) {
  for (int k = 0; k < 3; ++k) {
    if (k != index_of(axis) && !(p[k] >= bundle.reach.low[k] && p[k] <= bundle.reach.high[k]))
      return false;
  }
  return true;
}

enum class QuadKind { Slice, Closing };

/// A fragment's test: at or below the terrain.
inline bool passes(const SliceBundle& bundle, QuadKind kind, const HeightLookup& heights,
                   const glm::dvec3& p) {
  const double raise_m = kind == QuadKind::Slice ? bundle.raise_m : bundle.closing_raise_m;
  const double z = std::clamp(p.z - raise_m, bundle.least_z_m, bundle.greatest_z_m);
  return heights.height_m(p.x, p.y) >= z;
}

/// The picture, and what it took.
struct SlicedImage {
  HitImage image;  // `primitive` is the bundle; `overdraw` the fragments tested
  std::int64_t fragments = 0;
};

/// Per pixel the nearest fragment that passes, of equal depths that of the first bundle.
///
///   (1) A hit is on its plane, and its x and y are those of the pixel's ray.
///   (2) `overdraw` counts the slices that the pixel's ray met on their quads, front to back within
///   a bundle, bundle by bundle until none could be nearer; `fragments` is their sum.
///   (3) Same bits on any number of threads.
/// camera  relative to the terrain's origin
SlicedImage slice_rays(const SlicingCut& cut, const Camera& camera, const HeightLookup& heights);

}  // namespace plumb::slicing
