// A logarithmic axis on which zero and infinity have places of their own.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace plumb::report {

struct OpenTick {
  double at = 0.0;   // in decades
  std::string text;  // "0", "0.02", "1e6", "∞"
};

/// Everything is in decades: 10 lies at 1, 1000 at 3.
struct OpenAxis {
  double low = 0.0, high = 1.0;       // the two ends, places of zero and infinity included
  double first = 0.0, last = 1.0;     // the ends of the logarithmic part
  std::optional<double> zero_at;      // none where no value is zero
  std::optional<double> infinite_at;  // none where no value is infinite
  std::vector<OpenTick> ticks;        // ascending

  /// Where a value of those that the axis was made for lies. value >= 0
  double place(double value) const;
};

/// The shortest axis between values 1, 2 or 5 times a power of ten that has all values on it;
/// powers of ten alone where they span more than three decades. Zero and infinity stand an eighth
/// of the logarithmic part beyond its ends.
///
/// values  >= 0, +inf among them, no NaN
///
///   (1) place() is finite and within [low, high] for each of the values.
///   (2) place(0) < place(any value above zero) < place(+inf).
/// Throws std::invalid_argument for a negative value or NaN. Without a value between zero and
/// infinity the logarithmic part goes from 0.1 to 1.
OpenAxis open_axis(std::span<const double> values);

}  // namespace plumb::report
