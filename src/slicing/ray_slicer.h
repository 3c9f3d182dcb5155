// Slices met by rays: planes are met and heights looked up, nothing else.
#pragma once

#include <cstdint>
#include <vector>

#include "core/camera.h"
#include "core/hit_image.h"
#include "slicing/height_lookup.h"
#include "slicing/slice_ray.h"
#include "slicing/slicing_cut.h"

namespace plumb::slicing {

/// A fragment of a slice.
struct SliceHit {
  double t = kNoHit;
  std::uint32_t bundle = kNoPrimitive;

  explicit operator bool() const { return bundle != kNoPrimitive; }
  bool operator<(const SliceHit& other) const {
    return t < other.t || (t == other.t && bundle < other.bundle);
  }
};

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
