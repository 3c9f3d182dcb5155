// The distance on screen between what a pixel shows and the truth.
#pragma once

#include <cstdint>
#include <vector>

#include "audit/surface_deviation.h"
#include "audit/truth.h"
#include "core/camera.h"
#include "core/hit_image.h"

namespace plumb::audit {

/// One entry a pixel, row by row. NaN where the pixel shows nothing; +inf where it shows something
/// and the truth has no counterpart above or below it, or the counterpart lies behind the eye.
struct PixelErrors {
  std::vector<float> vertical_px;  // from the point drawn to the truth above or below it
  std::vector<float> vertical_m;   // the same in metres: drawn minus truth
  double max_vertical_px = 0.0;    // in double; +inf if any is
  std::int64_t worst_pixel = -1;   // where, the first of equals; -1 if nothing is drawn
  double pixels_per_metre =
      0.0;  // largest displacement on screen of one vertical metre, of all points drawn
};

/// With the drawn triangle that lies above or below the truth of each pixel; kNoPrimitive if none
/// does.
struct ReversePixelErrors : PixelErrors {
  std::vector<std::uint32_t> triangle;
};

/// `drawn` is in world coordinates through `camera`.
PixelErrors vertical_errors(const HeightfieldTruth& truth, const HitImage& drawn,
                            const Camera& camera);

/// The other way round: from the truth's hit to the drawn surface above or below it. +inf where
/// nothing is drawn there.
ReversePixelErrors reverse_vertical_errors(const HeightfieldTruth& truth, const HitImage& true_hits,
                                           const TriangleMesh& mesh, const Camera& camera);

/// Relative difference of view depths, |drawn - true| / true, where both see something; NaN
/// elsewhere.
std::vector<float> depth_errors(const HitImage& true_hits, const HitImage& drawn);

/// Angle in degrees between the normals of the triangles that both see; NaN where one sees nothing.
std::vector<float> normal_errors_deg(const HeightfieldTruth& truth, const HitImage& true_hits,
                                     const TriangleMesh& mesh, const HitImage& drawn);
/// The same of a truth that is a mesh, where outside and inside are told apart: 0 to 180.
std::vector<float> normal_errors_deg(const TriangleMesh& truth, const HitImage& true_hits,
                                     const TriangleMesh& mesh, const HitImage& drawn);

}  // namespace plumb::audit
