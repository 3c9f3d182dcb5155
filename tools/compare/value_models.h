// Numbers of one picture foretold from those of another, and what the best line or power leaves.
#pragma once

#include <cmath>
#include <optional>
#include <span>
#include <vector>

#include "core/parallel.h"

namespace plumb::compare {

/// A channel of both pictures, of one size.
struct PlanePair {
  std::span<const float> reference, candidate;
};

/// Root mean square of candidate - model(reference), over the numbers that are finite in both (of
/// every `stride`-th pixel, stride >= 1); 0 if there are none. Same bits on any number of threads.
template <class Model>
double rms_of(const std::vector<PlanePair>& pairs, const Model& model, std::int64_t stride = 1) {
  struct Sum {
    double squares = 0.0;
    std::int64_t count = 0;
  };
  Sum all;
  for (const PlanePair& pair : pairs) {
    const Sum sum = parallel_ordered_reduce(
        (static_cast<std::int64_t>(pair.reference.size()) + stride - 1) / stride, 65536, Sum{},
        [&](std::int64_t begin, std::int64_t end, Sum value) {
          for (std::int64_t at = begin; at < end; ++at) {
            const auto k = static_cast<std::size_t>(at * stride);
            const double x = pair.reference[k], y = pair.candidate[k];
            if (!std::isfinite(x) || !std::isfinite(y)) continue;
            const double left = y - model(x);
            value.squares += left * left;
            ++value.count;
          }
          return value;
        },
        [](const Sum& a, const Sum& b) {
          return Sum{a.squares + b.squares, a.count + b.count};
        });
    all.squares += sum.squares;
    all.count += sum.count;
  }
  return all.count > 0 ? std::sqrt(all.squares / static_cast<double>(all.count)) : 0.0;
}

/// Least squares over the numbers that are finite in both: candidate = slope * reference +
/// intercept, and candidate = gain * reference.
struct LineFit {
  double mean_reference = 0.0, mean_candidate = 0.0;
  double slope = 1.0, intercept = 0.0, gain = 1.0;
};
LineFit fit_line(const std::vector<PlanePair>& pairs);

/// The power p of candidate = reference^p, least squares of the logarithms of numbers in
/// [0.02, 0.98], of a hundred thousand of them or a few more; nothing if there are no such numbers.
std::optional<double> fit_power(const std::vector<PlanePair>& pairs);

/// x^power for x >= 0; sRGB of linear light in [0, 1].
double power_of(double x, double power);
double linear_to_srgb(double linear);

}  // namespace plumb::compare
