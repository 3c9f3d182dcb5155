#include "compare/value_models.h"

#include <algorithm>

#include "core/reproducible_math.h"

namespace plumb::compare {
namespace {

// Of pairs of numbers (x, y).
struct Moments {
  double x = 0.0, y = 0.0, xx = 0.0, xy = 0.0;
  double count = 0.0;

  void add(double a, double b) {
    x += a;
    y += b;
    xx += a * a;
    xy += a * b;
    count += 1.0;
  }
  void add(const Moments& other) {
    x += other.x;
    y += other.y;
    xx += other.xx;
    xy += other.xy;
    count += other.count;
  }
};

// Of put(reference, candidate, moments) over all numbers.
template <class Put>
Moments moments_of(const std::vector<PlanePair>& pairs, const Put& put, std::int64_t stride = 1) {
  Moments all;
  for (const PlanePair& pair : pairs) {
    all.add(parallel_ordered_reduce(
        (static_cast<std::int64_t>(pair.reference.size()) + stride - 1) / stride, 65536, Moments{},
        [&](std::int64_t begin, std::int64_t end, Moments moments) {
          for (std::int64_t at = begin; at < end; ++at) {
            const auto k = static_cast<std::size_t>(at * stride);
            put(double{pair.reference[k]}, double{pair.candidate[k]}, moments);
          }
          return moments;
        },
        [](Moments a, const Moments& b) {
          a.add(b);
          return a;
        }));
  }
  return all;
}

}  // namespace

LineFit fit_line(const std::vector<PlanePair>& pairs) {
  const auto both_finite = [](double x, double y) { return std::isfinite(x) && std::isfinite(y); };
  const Moments about_zero = moments_of(pairs, [&](double x, double y, Moments& moments) {
    if (both_finite(x, y)) moments.add(x, y);
  });
  LineFit fit;
  if (about_zero.count == 0.0) return fit;
  fit.mean_reference = about_zero.x / about_zero.count;
  fit.mean_candidate = about_zero.y / about_zero.count;
  if (about_zero.xx > 0.0) fit.gain = about_zero.xy / about_zero.xx;
  // Around the means, so that depths far from zero keep their digits.
  const Moments about_means = moments_of(pairs, [&](double x, double y, Moments& moments) {
    if (both_finite(x, y)) moments.add(x - fit.mean_reference, y - fit.mean_candidate);
  });
  fit.slope = about_means.xx > 0.0 ? about_means.xy / about_means.xx : 0.0;
  fit.intercept = fit.mean_candidate - fit.slope * fit.mean_reference;
  return fit;
}

std::optional<double> fit_power(const std::vector<PlanePair>& pairs) {
  std::int64_t numbers = 0;
  for (const PlanePair& pair : pairs) numbers += static_cast<std::int64_t>(pair.reference.size());
  constexpr std::int64_t kEnough = 100'000;
  const std::int64_t stride = std::max<std::int64_t>(1, numbers / kEnough) | 1;  // odd: no column's
  const Moments logarithms = moments_of(
      pairs,
      [](double x, double y, Moments& moments) {
        constexpr double kLeast = 0.02, kMost = 0.98;  // where rounding and clipping say little
        if (x >= kLeast && x <= kMost && y >= kLeast && y <= kMost)
          moments.add(reproducible_log(x), reproducible_log(y));
      },
      stride);
  if (!(logarithms.xx > 0.0)) return std::nullopt;
  return logarithms.xy / logarithms.xx;
}

double power_of(double x, double power) { return x > 0.0 ? reproducible_pow(x, power) : 0.0; }

double linear_to_srgb(double linear) {
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * power_of(linear, 1.0 / 2.4) - 0.055;
}

}  // namespace plumb::compare
