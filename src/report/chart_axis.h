// An axis of a chart: where a value lies along it, and which values are written there.
#pragma once

#include <string>
#include <vector>

namespace plumb::report {

enum class AxisKind { Log10, Linear };

/// `low` and `high` count decades (Log10) or steps from zero (Linear).
struct ChartAxis {
  AxisKind kind = AxisKind::Log10;
  int low = 0, high = 1;                // low < high
  double step = 1.0;                    // Linear: between two ticks, 1, 2 or 5 times a power of ten
  double begin_px = 0.0, end_px = 1.0;  // of low and of high

  double place_px(double value) const;
  double tick_px(int tick) const;         // tick in [low, high]
  std::string tick_text(int tick) const;  // "0.01", "2500", "1e7"
};

/// The shortest axis of whole decades, or of at most eight steps, that has all values on it; of one
/// decade or from 0 to 1 without any.
///
/// values  finite; above zero for Log10
///
///   (1) A linear axis has zero on it.
ChartAxis axis_around(AxisKind kind, const std::vector<double>& values, double begin_px,
                      double end_px);

}  // namespace plumb::report
