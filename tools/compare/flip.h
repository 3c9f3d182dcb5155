// FLIP: how different two pictures look to somebody who flips between them.
#pragma once

#include <optional>
#include <span>
#include <vector>

namespace plumb::compare {

/// Three channels of a picture that stands elsewhere; one entry a pixel, row by row from the top
/// left.
struct ColourPlanes {
  int width_px = 0;
  int height_px = 0;
  std::span<const float> r, g, b;
};

/// A screen 0.7 m wide with 3840 pixels, seen from 0.7 m: 67.0206.
inline constexpr double kFlipPixelsPerDegree = 3840.0 * 3.14159265358979323846 / 180.0;

struct FlipOptions {
  double pixels_per_degree = kFlipPixelsPerDegree;  // in [1, 1000]
};

struct FlipMap {
  int width_px = 0;
  int height_px = 0;
  std::vector<float> error;  // in [0, 1], one entry a pixel from the top left
};

/// LDR-FLIP of a candidate against a reference, both sRGB. Values below 0 and above 1 count as 0
/// and 1.
///
///   (1) Equal pictures have the error 0 everywhere, to the bit.
///   (2) Reference and candidate may be exchanged, to the bit.
///   (3) The same bits on any number of threads and with any instruction set.
///   (4) An error is at most 1: evenly green beside evenly blue.
/// Throws std::invalid_argument unless both have one size, at least 1 x 1, with full channels and
/// finite values.
/// Source: [Andersson et al. 2020], with the filters of the authors' program, version 1.6;
/// departures in docs/algorithms/flip.md.
FlipMap flip_ldr(const ColourPlanes& reference_srgb, const ColourPlanes& candidate_srgb,
                 const FlipOptions& options = {});

/// How light without limit becomes a picture; numbers as in docs/algorithms/flip.md.
enum class ToneMapper { Aces, Hable, Reinhard };

struct HdrFlipOptions {
  double pixels_per_degree = kFlipPixelsPerDegree;  // in [1, 1000]
  ToneMapper tone_mapper = ToneMapper::Aces;
  std::optional<double> start_stops = {};  // if not given, computed from the reference
  std::optional<double> stop_stops = {};   // likewise; both in [-120, 120]
  std::optional<int> exposures =
      {};  // in [1, 1000]; if not given, as many as stops lie between, >= 2
};

/// Exposures in stops: a picture is multiplied by 2^stops. They lie evenly from start to stop.
struct ExposureRange {
  double start_stops = 0.0;
  double stop_stops = 0.0;
  int count = 0;

  double stops(int k) const {
    return count < 2 ? start_stops : start_stops + k * ((stop_stops - start_stops) / (count - 1));
  }
};

/// The exposures that HDR-FLIP looks at: from the one that maps the reference's largest luminance
/// to 0.85 to the one that does so with its median.
///
///   (1) A picture that is brighter by a factor of 2^n has a range that begins and ends n stops
///       lower.
/// A median of 0 (a black sky) is replaced by the median of the luminances above 0; a reference
/// without light has the range from 0 to 0.
/// Throws std::invalid_argument as flip_hdr does.
ExposureRange flip_exposures(const ColourPlanes& reference_linear,
                             const HdrFlipOptions& options = {});

struct HdrFlip {
  ExposureRange range;
  FlipMap largest;                  // over all exposures
  std::vector<int> exposure_index;  // a pixel's first exposure with that error; 0 without error
};

/// HDR-FLIP of a candidate against a reference, both linear with Rec. 709 primaries: the largest
/// LDR-FLIP over exposures, each tone-mapped. Values below 0 count as 0.
///
///   (1) Equal pictures have the error 0 everywhere; exchanging the two is not the same, since the
///       reference chooses the exposures.
///   (2) The same bits on any number of threads and with any instruction set.
/// No pair with a published answer is at hand: its stages are tested each, the whole against a
/// second computation of ours in double precision.
/// Throws std::invalid_argument unless both have one size, at least 1 x 1, with full channels and
/// finite values, and the start lies no later than the stop.
/// Source: [Andersson et al. 2021], with the numbers of the authors' program, version 1.6.
HdrFlip flip_hdr(const ColourPlanes& reference_linear, const ColourPlanes& candidate_linear,
                 const HdrFlipOptions& options = {});

}  // namespace plumb::compare
