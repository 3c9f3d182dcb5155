// By how many pixels, or by which factor, one picture is another one moved.
#pragma once

#include <glm/vec2.hpp>

#include "core/grid.h"

namespace plumb::compare {

/// A shift and what it explains.
struct Shift {
  glm::dvec2 by_px{0.0};  // the candidate at p + by_px looks like the reference at p; y downwards
  double rms_before = 0.0;
  double rms_after = 0.0;      // of both pictures moved half of the way towards each other
  double rms_of_jitter = 0.0;  // that the best shift of at most kJitter_px would leave
};

/// Two samplers may differ by this much.
inline constexpr double kJitter_px = 0.2;

/// The shift within 3.5 pixels, in x and in y, that leaves the smallest root mean square
/// difference. Pictures are of finite numbers, row 0 at the top, of one size; smaller ones than
/// 16 x 16 are not shifted. `rms_before` is of the two as blurred as the moved ones are, so that a
/// blur explains nothing. Of pictures above 200,000 pixels some rows are looked at. Same
/// bits on any number of threads.
/// Whole shifts that are tried reach so far, in x and y.
inline constexpr int kFarthestShift_px = 8;

Shift find_shift(const Grid<float>& reference, const Grid<float>& candidate);

/// Share of the pixels in which the two pictures differ by more than a quarter of a pixel of shift
/// explains (local_difference.h, by more than 2/255 and 30 % of the contrast there): when both are
/// moved half of the way towards each other, and when both are moved the same way, as blurred.
struct Unexplained {
  double before = 0.0, after = 0.0;  // in [0, 1]
};
Unexplained unexplained_by(const Grid<float>& reference, const Grid<float>& candidate,
                           const glm::dvec2& by_px);

/// Root mean square difference of the candidate and the reference enlarged by `factor` > 0 around
/// the picture's middle, each averaged over squares of 4 x 4 pixels, where both have something.
/// A factor of 1 is the difference as they are.
double rms_enlarged(const Grid<float>& reference, const Grid<float>& candidate, double factor);

}  // namespace plumb::compare
