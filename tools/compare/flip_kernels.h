// FLIP's stages on a row of pixels, several pixels at a time.
#pragma once

#include "compare/flip_filters.h"
#include "core/instruction_set.h"

namespace plumb::compare {

/// What filtering leaves of a row: three opponent colours as the eye sees them, and the answers of
/// the detectors.
enum FlipResponse { kSeenY, kSeenCx, kSeenCz, kEdgeX, kEdgeY, kPointX, kPointY };
inline constexpr int kFlipResponses = 7;

/// (k0 x^2 + k1 x + k2) / (k3 x^2 + k4 x + k5), of each channel, or for Reinhard x / (1 + L), L the
/// luminance.
struct ToneCurve {
  float k[6];
  bool by_luminance;
};

/// Rows hold `count` floats, a multiple of kFlipLanes, and everything in them is finite. An output
/// may be the input of the same place.
struct FlipKernels {
  /// sRGB, cut to 0..1, becomes linear.
  void (*linearise)(const float* srgb, int count, float* linear);
  /// rgb[c] = tone curve of gain * max(rgb[c], 0), cut to 0..1.
  void (*expose)(const ToneCurve& curve, float gain, int count, float* const rgb[3]);
  /// Linear RGB becomes (Y, X - Y, Y - Z).
  void (*to_opponent)(const FlipConstants& constants, int count, float* const rgb[3]);
  /// Each filter upwards and downwards from one row. above[p][k] and below[p][k] are the rows of
  /// opponent plane p that lie k rows up and down, k <= reach; out[f] one row a filter.
  void (*filter_down)(const FlipTaps& filters, const float* const* const above[3],
                      const float* const* const below[3], int count,
                      float* const out[kFlipFilters]);
  /// Each filter across what filter_down gave; a row may be read `reach` floats beyond both ends.
  void (*filter_across)(const FlipTaps& filters, const float* const in[kFlipFilters], int count,
                        float* const out[kFlipResponses]);
  /// Opponent colours become L*a*b*, cut to what linear RGB in 0..1 can show, with Hunt's
  /// adjustment.
  void (*to_hunt_lab)(const FlipConstants& constants, int count, float* const seen[3]);
  /// HyAB distance to the power of 0.7, redistributed to 0..1.
  void (*differ_in_colour)(const FlipConstants& constants, const float* const reference[3],
                           const float* const candidate[3], int count, float* out);
  /// The larger difference of edges' and points' strength, over sqrt(2), its root.
  void (*differ_in_features)(const float* const reference[4], const float* const candidate[4],
                             int count, float* out);
  /// colour ^ (1 - feature), in 0..1.
  void (*combine)(const float* colour, const float* feature, int count, float* error);
};

const FlipKernels& flip_kernels(InstructionSet set);

}  // namespace plumb::compare
