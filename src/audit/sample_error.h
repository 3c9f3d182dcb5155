// The error at every height sample: what the methods promise, and what needs no ray.
#pragma once

#include <cstdint>
#include <vector>

#include "audit/distribution.h"
#include "audit/truth.h"
#include "core/camera.h"
#include "core/drawn_surface.h"
#include "core/hit_image.h"

namespace plumb::audit {

/// The sample that is farthest off.
struct WorstSample {
  int i = -1, j = -1;    // column and row of the heightfield; -1 if there is none
  double error = 0.0;    // metres or pixels
  double delta_m = 0.0;  // drawn minus true
  std::uint32_t triangle = kNoPrimitive;
  int patch = -1;
};

struct SampleErrors {
  std::vector<float>
      values_m;  // of all samples that exist and have something drawn over them, from the south
  std::vector<float> values_px;  // of those in the frustum
  Distribution metres, pixels;   // of these
  Distribution visible_pixels;   // of those that the truth shows, or hides by less than a pixel
  WorstSample worst_m, worst_px;
  std::vector<float>
      triangle_max_m;  // a triangle each, over the samples that it covers, edges included
  std::vector<double> patch_max_m;  // a patch each; 0 where a patch holds no sample
  std::int64_t uncovered = 0;       // samples of the surface with nothing drawn over them
  std::int64_t over_void = 0;       // void samples with something drawn over them
  std::int64_t overlapped = 0;      // samples in the inside of more than one triangle
  double pixels_per_metre =
      0.0;  // largest displacement on screen of a vertical metre, of the samples in the frustum
};

/// Vertical deviation of the drawn surface at every sample, in metres and projected: |proj(p + dz)
/// - proj(p)|. A sample counts as part of the surface if one of its triangles exists.
SampleErrors sample_errors(const HeightfieldTruth& truth, const HitImage& true_hits,
                           const DrawnSurface& surface, const Camera& camera);

/// The same between the samples: at the drawn mesh's vertices and wherever a drawn edge crosses an
/// edge of the truth. With the samples themselves these are all places where the distance of two
/// piecewise linear surfaces can be largest.
struct EdgeErrors {
  double max_m = 0.0;
  double max_px = 0.0;                     // of places in the frustum
  double pixels_per_metre = 0.0;           // on screen, where that is
  glm::dvec3 worst_m{0.0}, worst_px{0.0};  // places on the truth, relative to the terrain's origin
  std::uint32_t triangle_m = kNoPrimitive, triangle_px = kNoPrimitive;
  std::int64_t places = 0;  // looked at
};
EdgeErrors edge_errors(const HeightfieldTruth& truth, const DrawnSurface& surface,
                       const Camera& camera);

/// True if the point (in the camera's coordinates) is between near and far and inside the image.
bool in_frustum(const Camera& camera, const glm::dvec3& point_m);

}  // namespace plumb::audit
