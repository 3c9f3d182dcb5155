// The filters of FLIP for a distance from the screen, and the numbers of its colour spaces.
#pragma once

#include <array>
#include <vector>

namespace plumb::compare {

/// What a picture is filtered with: the eye's contrast sensitivity to luminance, to red against
/// green and (a sum of two) to blue against yellow; and a Gaussian and its derivatives, which
/// detect edges and points.
enum FlipFilter { kLuminance, kRedGreen, kBlueYellowA, kBlueYellowB, kGauss, kEdge, kPoint };
inline constexpr int kFlipFilters = 7;

/// Each weight stands this often side by side, so that a kernel with any number of lanes loads it.
inline constexpr int kFlipLanes = 16;

struct FlipTaps {
  int reach;
  const float* weights;  // of tap k and filter f from (k * kFlipFilters + f) * kFlipLanes
};

/// One half of every filter, from its middle outwards; the other half mirrors it, that of the edge
/// detector with the opposite sign.
///
///   (1) In two dimensions kLuminance, kRedGreen and kGauss sum to 1, and so do the two products of
///       blue and yellow together.
///   (2) Of kEdge and kPoint the positive weights sum to 1 and the negative ones to -1.
struct FlipFilters {
  int reach = 0;  // taps on either side of the middle, of the widest; beyond its own a filter is 0
  std::array<std::vector<double>, kFlipFilters> half;  // reach + 1 weights each
  std::vector<float> lanes;                            // the same for FlipTaps

  FlipTaps taps() const { return {reach, lanes.data()}; }
};

/// Radii: of the first four ceil(3 s), s the widest one's standard deviation, of the others
/// ceil(3 * 0.041 degrees). Throws std::invalid_argument unless pixels_per_degree is in [1, 1000].
FlipFilters flip_filters(double pixels_per_degree);

/// Colour spaces as matrices, row by row, and the constants of the error.
///
///   (1) White is (1, 1, 1) in linear RGB and in XYZ over the white's own XYZ.
///   (2) from_opponent undoes to_opponent.
struct FlipConstants {
  float to_xyz[9];         // linear RGB -> XYZ over white's
  float to_opponent[9];    // linear RGB -> (Y, X - Y, Y - Z), XYZ over white's
  float from_opponent[9];  // back
  float gentle, steep;     // error = gentle * d below `knee`, offset + steep * d from there,
  float knee, offset;      // d the colour difference to the power of 0.7
};

const FlipConstants& flip_constants();

/// The largest colour difference, green against blue, to the power of 0.7.
double flip_largest_difference();

}  // namespace plumb::compare
