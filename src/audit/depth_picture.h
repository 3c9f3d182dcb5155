// A stranger's depth buffer as a picture that can be judged.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "audit/band_walk.h"
#include "audit/depth_meaning.h"
#include "audit/truth.h"
#include "core/drawn_surface.h"
#include "core/hit_image.h"
#include "image/depth_file.h"

namespace plumb::audit {

struct DepthPicture {
  HitImage image;  // primitive 0 wherever something is drawn
  /// Pixels whose numbers are none of the convention's, and the first of them; they show nothing.
  std::int64_t no_depths = 0;
  int first_x = -1, first_y = -1;
  float first_number = 0.0f;
  /// What rounding to the buffer's numbers may hide: half a range, the largest and the middle one
  /// of all that is drawn, along the view; the largest on the screen as well, as a vertical
  /// distance under a level surface.
  double largest_rounding_m = 0.0, middle_rounding_m = 0.0, largest_rounding_px = 0.0;
  /// Pixels that may be terrain or sky as far as the buffer tells.
  std::int64_t undecided = 0;
};

/// Puts each pixel's point on its ray, in double.
///
///   (1) A number stands for a range of depths (depth_range). Of that range the depth is taken that
///       is nearest to the truth's along the ray; if it lies beyond the band and another depth of
///       the range is nearer to the truth above or below it, that one. What is measured of the
///       picture is therefore a lower bound of what was drawn, off by no more than the rounding,
///       and a claim that was kept before rounding is kept after it.
///   (2) A pixel whose number stands for sky as well as for a point that keeps to the band is as
///   the truth is. is that.
/// true_hits is the truth through the same camera. Throws std::invalid_argument unless buffer,
/// camera and true_hits are of one size.
///
/// Derivation of (1): on a piece of the ray between two edges of the full-detail surface the
/// vertical distance g is linear in the depth w, and a vertical displacement of a point on a ray
/// spans N |g| / (w (w + g e_w)) pixels (core/screen_error.h), with N proportional to w: a ratio of
/// two linear functions, hence monotone where g keeps its sign. So the least error of a range lies
/// at its ends, at a crossing of an edge, or is zero where g changes its sign.
DepthPicture depth_picture(const HeightfieldTruth& truth, const HitImage& true_hits,
                           const image::DepthBuffer& buffer, const DepthMeaning& meaning,
                           const Camera& camera, const Band& band);

/// The picture as a surface without a mesh: a sheet, whose one patch is the buffer.
DrawnSurface surface_of(HitImage picture);

/// One sentence: what was taken for granted because the buffer rounds.
std::string rounding_text(const DepthPicture& picture, const image::NumberFormat& format);

}  // namespace plumb::audit
