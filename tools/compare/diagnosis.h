// Differences with a system: what a convention or a setting does to every pixel.
#pragma once

#include <string>
#include <vector>

#include "core/grid.h"
#include "image/plane_image.h"

namespace plumb::compare {

enum class Systematic {
  Offset,           // the same number more everywhere
  Gain,             // the same factor everywhere
  LinearAsSrgb,     // linear light stored where sRGB was meant
  SrgbAsLinear,     // and the other way round
  Gamma,            // a power
  FlippedY,         // upside down
  FlippedX,         // left and right changed
  Shift,            // moved by a part of a pixel or by some pixels
  FieldOfViewAxis,  // the angle of one axis taken for the other's
  DepthScale,       // depth in another unit, or beginning elsewhere
  WindowDepth,      // depth after the projection, not along the view
  DistanceAsDepth,  // distance along the ray
};

/// What was found, and how much of the difference it explains.
struct Diagnosis {
  Systematic kind;
  std::string text;  // one sentence, with its numbers
  double rms_before = 0.0, rms_after = 0.0;
};

/// The systematic differences that leave at most half of the root mean square difference (shifts: a
/// little less than all, see the source); the one that explains most of each of numbers, places and
/// depth, the best first. Nothing for pictures
/// that are equal, or that differ by noise, a level of detail or a hole: no constant, factor, power
/// or shift explains those.
///
/// Colour is judged by its luma (Rec. 709, of the numbers as stored), depth by Z; where there is no
/// colour, flips and shifts are looked for in 1 / Z. The pictures are
/// alike (image size and channels).
std::vector<Diagnosis> diagnose(const image::PlaneImage& reference,
                                const image::PlaneImage& candidate);

/// Luma of the colour channels, 0 where a number is not finite; empty without colour.
Grid<float> luma_of(const image::PlaneImage& picture);

}  // namespace plumb::compare
