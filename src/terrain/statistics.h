// What a terrain is like, in a few numbers.
#pragma once

#include <array>
#include <cstdint>

#include "terrain/heightfield.h"

namespace plumb::terrain {

inline constexpr int kSlopeBins = 18;            // of the histogram
inline constexpr double kSlopeBinWidth_deg = 5;  // so that it ends at 90 degrees

struct PlacedHeight {
  double height_m = 0.0;
  int i = 0, j = 0;  // sample
};

/// The height difference between two samples that stand side by side, (i, j) and its neighbour to
/// the east or to the north.
struct NeighbourStep {
  double rise_m = 0.0;  // >= 0
  int i = 0, j = 0;     // of the western or southern sample
  bool northwards = false;
  double slope_deg = 0.0;  // of the edge between them
};

struct TerrainStatistics {
  int columns = 0, rows = 0;
  double dx_m = 0.0, dy_m = 0.0;
  double width_m = 0.0, height_m = 0.0;  // between the outermost samples, east and north
  std::int64_t voids = 0;
  std::int64_t heights = 0;      // samples that are not void
  PlacedHeight lowest, highest;  // meaningless if heights is 0, as is the mean
  double mean_m = 0.0;

  std::int64_t cells = 0;  // cells whose four samples exist; the slopes are theirs
  /// Bin k counts cells whose slope lies in [5 k, 5 (k + 1)) degrees.
  std::array<std::int64_t, kSlopeBins> slope_histogram{};
  double rms_slope_deg = 0.0;      // of the root mean square gradient
  double largest_slope_deg = 0.0;  // of a cell
  NeighbourStep steepest_step;     // the one with the largest rise; zero if no two samples adjoin
};

/// Measures a terrain, in parallel.
///
/// A cell's slope is that of the bilinear surface at its centre: the gradient is the mean of its
/// two edges each way, whatever the diagonal. All cells have the same ground area, so that counts
/// are areas.
///
///   (1) voids + heights = columns * rows.
///   (2) The histogram sums up to `cells`.
///   (3) Of equal heights or steps the first counts: the southernmost, then the westernmost;
///       eastwards before northwards.
///   (4) The same bits on any number of threads.
TerrainStatistics statistics_of(const Heightfield& field);

}  // namespace plumb::terrain
