#include "compare/plane_errors.h"

#include <cmath>

#include "core/check.h"
#include "core/parallel.h"
#include "core/reproducible_math.h"

namespace plumb::compare {
namespace {

struct Sums {
  PlaneErrors errors;
  double sum = 0.0, squares = 0.0;

  void add(std::size_t pixel, float reference, float candidate) {
    if (!std::isfinite(reference) || !std::isfinite(candidate)) {
      const bool same = (std::isnan(reference) && std::isnan(candidate)) || reference == candidate;
      if (!same && errors.unlike == 0) errors.first_unlike = pixel;
      ++(same ? errors.alike : errors.unlike);
      return;
    }
    ++errors.compared;
    const double difference = std::abs(double{candidate} - double{reference});
    if (difference == 0.0) return;
    ++errors.differing;
    sum += difference;
    squares += difference * difference;
    if (difference > errors.largest) {
      errors.largest = difference;
      errors.worst = pixel;
    }
  }

  // Of pixels that come after.
  void add(const Sums& later) {
    if (errors.unlike == 0) errors.first_unlike = later.errors.first_unlike;
    errors.compared += later.errors.compared;
    errors.differing += later.errors.differing;
    errors.alike += later.errors.alike;
    errors.unlike += later.errors.unlike;
    sum += later.sum;
    squares += later.squares;
    if (later.errors.largest > errors.largest) {
      errors.largest = later.errors.largest;
      errors.worst = later.errors.worst;
    }
  }
};

}  // namespace

std::optional<double> PlaneErrors::psnr_db() const {
  if (differing == 0) return std::nullopt;
  constexpr double kDecibelsOfTwo = 3.010299956639812;  // 10 log10 2
  return -2.0 * kDecibelsOfTwo * reproducible_log2(root_mean_square);
}

PlaneErrors plane_errors(std::span<const float> reference, std::span<const float> candidate,
                         std::span<const std::uint8_t> mask) {
  require(reference.size() == candidate.size() && (mask.empty() || mask.size() == candidate.size()),
          "planes and mask must be of one size, got {}, {} and {}", reference.size(),
          candidate.size(), mask.size());
  const Sums all = parallel_ordered_reduce(
      static_cast<std::int64_t>(reference.size()), 65536, Sums{},
      [&](std::int64_t begin, std::int64_t end, Sums sums) {
        for (auto k = static_cast<std::size_t>(begin); k < static_cast<std::size_t>(end); ++k) {
          if (mask.empty() || mask[k] != 0) sums.add(k, reference[k], candidate[k]);
        }
        return sums;
      },
      [](Sums a, const Sums& b) {
        a.add(b);
        return a;
      });
  PlaneErrors errors = all.errors;
  if (errors.compared > 0) {
    const auto count = static_cast<double>(errors.compared);
    errors.mean = all.sum / count;
    errors.root_mean_square = std::sqrt(all.squares / count);
  }
  return errors;
}

}  // namespace plumb::compare
