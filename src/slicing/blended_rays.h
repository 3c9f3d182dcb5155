// Slices that are blended: softened at the ground, and in fog that thins with height.
#pragma once

#include <glm/vec3.hpp>

#include "core/camera.h"
#include "core/hit_image.h"
#include "core/layers.h"
#include "slicing/height_lookup.h"
#include "slicing/slicing_cut.h"

namespace plumb::slicing {

struct BlendOptions {
  /// Height over which a fragment's opacity falls from one at the ground to zero above it, pixels
  /// at its depth; >= 0, and 0 ends slices sharply.
  double falloff_px = 0.0;
  /// Light lost on a metre of fog at its base, 1/m, >= 0; over every fog_height_m (> 0) above it
  /// falls to 1/e.
  double fog_per_m = 0.0;
  double fog_height_m = 100.0;
  double fog_base_m = 0.0;           // relative to the terrain's origin
  glm::dvec3 fog{0.72, 0.77, 0.83};  // linear colour

  bool blends() const { return falloff_px > 0.0 || fog_per_m > 0.0; }
};

/// The share of light that fog lets through on a ray from the eye to view depth `t` (which may be
/// infinite), in [0, 1]. In closed form: density falls off exponentially with height.
double fog_transmittance(const BlendOptions& options, const glm::dvec3& eye_m,
                         const glm::dvec3& direction, double t);

/// Front to back, what the slices before each hit add to the picture. A fragment that its test
/// refuses, as it lies above the ground, still has opacity 1 - (its height above the ground) /
/// falloff, where that is above zero, and bundles reach as much higher. What a ray has met covers
/// as much as the most opaque of it: a fragment adds what it is more opaque than all before it, and
/// none where it is not. Fog attenuates each by the ray's way to it.
///
/// hits    what the ray-slicer and the polygons show, `camera` relative to the terrain's origin
/// returns layers whose weights, with `behind` and the fog's, add up to one in each pixel
///
///   (1) Without falloff no pixel has layers, and `behind` is the fog's transmittance.
///   (2) Same bits on any number of threads.
/// Throws std::invalid_argument if an option is out of its range.
/// Source: [Röttger & Ertl 2001], section 7. There every slice is blended over those behind, so
/// that the opacities of slices a pixel apart add up, and outlines swell by nearly the falloff; and
/// fog is what each slice's opacity adds up to, and so only where there are slices; here it fills
/// the space between them as well.
Layers blend_slices(const SlicingCut& cut, const Camera& camera, const HeightLookup& heights,
                    const HitImage& hits, const BlendOptions& options);

}  // namespace plumb::slicing
